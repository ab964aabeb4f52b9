#include <fmt/format.h>

#include <algorithm>

#include "app/view/panels.h"
#include "engine/dimension.h"
#include "engine/physics/lattice.h"
#include "engine/scene/key_writer.h"

namespace clatter {

// Switches roughness on and off. The default coefficients, 0.5, are moderately rough.
static void roughness(Session& session, Controls& controls) {
  const Roughness& rough = session.scene().particles.roughness;
  const Roughness& usual = session.opened().particles.roughness;
  bool any = rough.any();
  const bool disks = session.scene().dimension() == 2;
  if (controls.toggle("rough", disks ? "Rough disks" : "Rough spheres",
                      "Collisions turn slip into spin, Walton's model", any)) {
    const auto keys = [](bool on) {
      return std::vector<Override>{{"particles.friction", on ? "0.5" : "0.0"},
                                   {"particles.tangential_restitution", on ? "0.5" : "-1.0"}};
    };
    controls.set(keys(!any), keys(any));
  }
  if (!any) return;
  // Friction may be infinite, which a slider cannot show. Above this limit sliding is negligible.
  constexpr double kMaxFriction = 2.0;
  controls.law({.key = "particles.friction",
                .name = "Friction",
                .symbol = "μ",
                .help = "Coulomb's: the largest tangential over normal impulse",
                .high = kMaxFriction},
               std::min(rough.friction_in_force(), kMaxFriction),
               std::min(usual.any() ? usual.friction_in_force() : 0.5, kMaxFriction));
  controls.law({.key = "particles.tangential_restitution",
                .name = "Tangential",
                .symbol = "β₀",
                .help = "Tangential restitution of rolling contacts: -1 keeps the slip, 1 reverses "
                        "it",
                .low = -1.0},
               rough.tangential_restitution_in_force(),
               usual.any() ? usual.tangential_restitution_in_force() : 0.5);
}

void gas_panel(Session& session, Controls& controls) {
  if (!controls.group("Gas")) return;
  const Scene& scene = session.scene();
  const bool disks = scene.dimension() == 2;
  const bool mixture = !scene.species.empty();
  if (!mixture && session.opened().particles.start.layout != Layout::File) {
    const int capacity = with_dimension(scene.dimension(), [&](auto dimension) {
      return lattice_capacity(scene.start_room<dimension>());
    });
    const int most = std::min(capacity, 100'000);
    controls.whole({.key = "particles.count",
                    .name = disks ? "Disks" : "Spheres",
                    .symbol = "N",
                    .help = "Removes particles, or adds them at random free places",
                    .low = 1.0,
                    .high = static_cast<double>(most),
                    .logarithmic = true,
                    .format = "%.0f",
                    .limit = capacity == most ? "no more fit into the box; enlarge it first"
                                              : "give a larger number by --set"},
                   scene.particles.count, session.opened().particles.count);
  }
  controls.note("packing_fraction",
                fmt::format("{} {:.3f}", disks ? "Area fraction φ =" : "Volume fraction",
                            scene.packing_fraction()));
  controls.law({.key = "particles.restitution",
                .name = "Restitution",
                .symbol = "α",
                .help = mixture ? "Of each two species without a value of their own"
                                : "Share of the normal velocity that a collision of two particles "
                                  "keeps; 1: elastic"},
               scene.particles.restitution, session.opened().particles.restitution);
  roughness(session, controls);
  species_controls(session, controls);
  // A gas that loses energy does not run back.
  const bool elastic = scene.particles.restitution == 1.0 &&
                       std::ranges::all_of(scene.pairs, [](const SpeciesPair& pair) {
                         return pair.restitution.value_or(1.0) == 1.0;
                       });
  if (elastic && !scene.shear_rate &&
      controls.button("reverse", "Reverse velocities",
                      "Changes the signs of all velocities and spins: the gas runs "
                      "back")) {
    session.reverse();
  }
}

}  // namespace clatter
