#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/view/panels.h"

namespace clatter {

// The sliders of one species: its particles, which are those of the start.
static void sliders_of(const Session& session, Controls& controls, std::size_t number) {
  const Scene& scene = session.scene();
  const Species& species = scene.species[number];
  const std::vector<Species>& opened = session.opened().species;
  const Species& usual = number < opened.size() ? opened[number] : species;
  const std::string path = "species." + species.name + '.';
  const std::string count = path + "count", diameter = path + "diameter", mass = path + "mass";
  if (session.opened().particles.start.layout == Layout::File) return;
  controls.whole({.key = count.c_str(),
                  .name = scene.dimension() == 2 ? "Disks" : "Spheres",
                  .symbol = "N",
                  .help = "Number of particles of this species. The gas starts again",
                  .low = 1.0,
                  .high = 10'000.0,
                  .logarithmic = true,
                  .format = "%.0f",
                  .limit = "give a larger number by --set"},
                 species.count, usual.count);
  controls.of_start({.key = diameter.c_str(),
                     .name = "Diameter",
                     .symbol = "d",
                     .unit = "a",
                     .help = "Of unequal particles the mean. The gas starts again. Without a mass "
                             "of its own a larger particle is heavier",
                     .low = 0.1,
                     .high = 10.0,
                     .logarithmic = true,
                     .format = "%.2f"},
                    species.diameter, usual.diameter);
  controls.of_start({.key = mass.c_str(),
                     .name = "Mass",
                     .symbol = "m",
                     .unit = "m",
                     .help = "Of a particle with this diameter. The gas starts again",
                     .low = 0.01,
                     .high = 1000.0,
                     .logarithmic = true,
                     .format = "%.3g"},
                    species.mass_in(scene.dimension()), usual.mass_in(scene.dimension()));
}

// The restitution of one species with each, a row of the matrix.
static void restitutions(const Session& session, Controls& controls, std::size_t number) {
  const Scene& scene = session.scene();
  const Scene& opened = session.opened();
  for (std::size_t other = 0; other < scene.species.size(); ++other) {
    const std::string key =
        "pair." + scene.species[number].name + '.' + scene.species[other].name + ".restitution";
    const std::string name = "α with " + scene.species[other].name;
    const bool same = opened.species.size() == scene.species.size();
    controls.law({.key = key.c_str(),
                  .name = name.c_str(),
                  .help = "Share of the normal velocity that a collision with this species keeps"},
                 scene.pair_law(number, other).restitution,
                 same ? opened.pair_law(number, other).restitution : 1.0);
  }
}

void species_controls(Session& session, Controls& controls) {
  const std::vector<Species>& species = session.scene().species;
  if (species.empty()) return;
  if (controls.chooses()) {
    for (std::size_t number = 0; number < species.size(); ++number) {
      sliders_of(session, controls, number);
      restitutions(session, controls, number);
    }
    return;
  }
  const std::vector<std::string> names = names_of(species);
  int& chosen = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("species"), 0);
  chosen = std::min(chosen, static_cast<int>(names.size()) - 1);
  controls.choice("species", "Species", "Whose particles and collisions the sliders below set",
                  names, chosen, chosen);
  sliders_of(session, controls, static_cast<std::size_t>(chosen));
  restitutions(session, controls, static_cast<std::size_t>(chosen));
}

}  // namespace clatter
