#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"

namespace clatter {

/// Groups of particles that an observable averages over: all particles, and of a mixture then each
/// species that has particles. The particles must not change.
template <int D>
class SpeciesGroups {
 public:
  /// The groups of the particles of a simulation.
  explicit SpeciesGroups(const Simulation<D>& simulation)
      : particles_(simulation.particles().size()) {
    const Model<D>& model = simulation.model();
    const std::size_t species = model.species ? model.species->count() : 0;
    for (std::size_t s = 0; s < species; ++s) {
      Group group{'_' + model.species->name(s), {}};
      for (std::uint32_t i = 0; i < particles_; ++i) {
        if (simulation.grain(i).species == s) group.particles.push_back(i);
      }
      if (!group.particles.empty()) species_.push_back(std::move(group));
    }
  }

  /// Number of groups; 1 if particles are alike.
  std::size_t count() const { return 1 + species_.size(); }
  /// Number of particles of a group.
  std::size_t size(std::size_t group) const {
    return group == 0 ? particles_ : species_[group - 1].particles.size();
  }
  /// 1 / size(group).
  double per_particle(std::size_t group) const { return 1.0 / static_cast<double>(size(group)); }
  /// End of the names of its columns: "", or "_large" of a species.
  std::string suffix(std::size_t group) const {
    return group == 0 ? std::string() : species_[group - 1].suffix;
  }
  /// Calls visit(i) for each particle i of a group, in increasing order.
  template <class Visit>
  void for_each(std::size_t group, const Visit& visit) const {
    if (group == 0) {
      for (std::size_t i = 0; i < particles_; ++i) visit(i);
    } else {
      for (const std::uint32_t i : species_[group - 1].particles) visit(std::size_t{i});
    }
  }

 private:
  struct Group {
    std::string suffix;
    std::vector<std::uint32_t> particles;
  };

  std::size_t particles_;
  std::vector<Group> species_;
};

}  // namespace clatter
