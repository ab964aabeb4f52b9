// Prints the state hash of every gallery scene after some thousand collisions, for .ci/run to
// compare between compilers and optimisation levels.

#include <cinttypes>
#include <cstdio>

#include "engine/dynamics/simulation.h"
#include "engine/embedded_file.h"
#include "engine/initial/start_state.h"
#include "engine/scene/scene_file.h"

int main() {
  using namespace clatter;
  constexpr std::uint64_t kSeed = 1;
  constexpr std::uint64_t kCollisions = 5000;
  for (const EmbeddedFile& file : embedded_scenes()) {
    const std::string name(file.name);
    const Scene scene = load_gallery_scene(file);
    Simulation<2> simulation(model_of(scene, kSeed), start_state(scene, kSeed));
    simulation.run_until(kNever, kCollisions);
    std::printf("%-20s %016" PRIx64 "\n", name.c_str(), simulation.state_hash());
  }
}
