#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/results/event_log.h"
#include "engine/dynamics/simulation.h"
#include "engine/system/growing_file.h"

namespace clatter {

/// The events of an event log.
struct EventSelection {
  std::vector<std::uint32_t> particles;  ///< only events of these; empty: of all
  /// Only events with the centre of a particle in lower and upper x, then y (, z); empty: the box.
  std::vector<double> region;
  double share = 1.0;  ///< share of these events, evenly spaced, 0 < share <= 1
};

/// The file that collects the records of a log during the run: FILE.h5.records, or the CSV itself.
std::filesystem::path records_path(const std::filesystem::path& log);

/// The table of what the particles of a mixture are, beside an event log in CSV:
/// FILE.particles.csv.
std::filesystem::path particles_path(const std::filesystem::path& log);

/// Logs the collisions of a run, between particles and with walls.
template <int D>
class EventRecorder final : private Observer<D> {
 public:
  /// Begins a log. `spins`: whether particles spin at some time of the run. `species` are the names
  /// of those of a mixture; empty: all particles are alike. Throws RunError.
  EventRecorder(const std::filesystem::path& path, EventSelection selection, bool spins,
                std::vector<std::string> species, Simulation<D>& simulation);
  /// Continues a log from the result of save() at this time of the run. `checkpoint` is the name
  /// for errors. Throws UserError if the selection or the format differs, and RunError.
  EventRecorder(const std::filesystem::path& path, EventSelection selection, bool spins,
                std::vector<std::string> species, Simulation<D>& simulation,
                const std::string& saved, const std::string& checkpoint);

  /// Writes the events so far. To be called between steps of the run, because an event cannot fail.
  /// Throws RunError.
  void flush();
  /// Waits until the events are on the disk. Returns the state for a checkpoint. Throws RunError.
  std::string save();
  /// Ends a log. `resumable`: whether a checkpoint of this time exists, which needs the records.
  /// Throws RunError; save() is then still possible.
  void finish(bool resumable);
  /// The flags of `clatter measure` that continue this log.
  std::string flags() const;

 private:
  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  LoggedParticles logged_particles() const;
  bool selects(const ParticleChange<D>& first, const ParticleChange<D>* second);

  EventLogFormat format_;
  std::filesystem::path path_;
  EventSelection selection_;
  bool spins_;
  std::vector<std::string> species_;  // names; empty: all particles are alike
  std::vector<EventQuantity> quantities_;
  const Simulation<D>& simulation_;
  std::uint64_t candidates_ = 0;  // events before the share was taken
  std::vector<double> records_;   // not yet written
  std::optional<GrowingFile> file_;
  Observation<D> observation_;
};

extern template class EventRecorder<2>;
extern template class EventRecorder<3>;

}  // namespace clatter
