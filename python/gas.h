#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/results/event_log.h"
#include "engine/physics/state.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene.h"
#include "engine/stop_request.h"
#include "render/output/image.h"

// The Python module links the libraries of the program, which are therefore position-independent.
// Their symbols are hidden, so calls stay direct: a run has the same number of instructions within
// 0.1 %. A call of a Gas releases Python's lock. Its StopRequest asks Python for signals every 50
// ms. Values of keys become TOML and so have the checks and errors of --set; results become the
// text of their JSON. A change by set is a [[change]] at the time of the gas.

namespace clatter {

/// Collisions in order of time, as in an event log.
struct EventTable {
  std::vector<EventQuantity> quantities;
  std::vector<double> records;              ///< [events][record_size(quantities)]
  std::vector<std::uint32_t> species = {};  ///< [N] numbers of a mixture; empty: all are alike
};

/// A gas of disks or spheres for a notebook: a run of a scene, with its measurements and pictures.
/// Long work throws Interrupted after a stop request. The gas is then where the request halted it,
/// and can continue. A call during another call of the same gas throws RunError.
class Gas {
 public:
  /// The gas at time 0. Throws UserError and Interrupted.
  Gas(const Scene& scene, std::uint64_t seed, const StopRequest& stop = {});

  /// The gas of saved(). Throws UserError if the bytes are damaged or of another version.
  static std::unique_ptr<Gas> restored(const std::string& saved);

  /// The whole gas: its state, future, changes of laws, and the averages of its view.
  std::string saved();
  /// Simulation time.
  double time();
  /// Granular temperature T = (m/DN) sum v^2.
  double temperature();
  /// The state hash, as in the result of `clatter measure`: 16 hexadecimal digits.
  std::string hash();
  /// All particles at time().
  AnyState state();
  /// The seed of all random numbers of the run.
  std::uint64_t seed() const { return seed_; }
  /// The scene at the start, with all changes of laws, as JSON.
  std::string scene_json();

  /// The names of the species of the scene; empty: the particles are alike.
  std::vector<std::string> species() const { return names_of(started_.species); }

  /// Runs to a simulation time at or after time(). The scene's changes of laws happen. Throws
  /// UserError for an earlier or infinite time, PhysicalStop and Interrupted.
  void run_until(double time, const StopRequest& stop = {});
  /// Changes laws now, as a [[change]] of the scene does. Throws UserError or PhysicalStop if the
  /// change is impossible; the old laws then remain.
  void change(const std::vector<Override>& laws);
  /// Runs on and averages from measure.burn_in, or from time() if that is later, over `duration`;
  /// absent: measure.duration. Returns the result of `clatter measure` as JSON. Throws UserError,
  /// RunError, PhysicalStop and Interrupted.
  std::string measure(const std::optional<double>& duration, const StopRequest& stop = {});
  /// Runs on for `count` collisions of particles and with walls, and returns them. Throws
  /// UserError, PhysicalStop, Interrupted, and RunError if no more collisions occur.
  EventTable events(long count, const StopRequest& stop = {});
  /// The picture that `clatter render` draws at this time, as wide as `width` pixels. Its height
  /// follows the box. Averages and trails of the scene's view begin at time 0. Throws UserError,
  /// RunError and Interrupted.
  Image draw(int width, const StopRequest& stop = {});

 private:
  using AnyRun = std::variant<ScheduledRun<2>, ScheduledRun<3>>;
  class Turn;

  Gas(const Scene& scene, std::uint64_t seed, AnyRun run);
  static AnyRun run_of(const Scene& scene, std::uint64_t seed, const StopRequest& stop);
  Scene recorded() const;

  Scene started_;
  std::uint64_t seed_;
  AnyRun run_;
  bool arrived_ = true;  // whether all events up to the time have been processed
  std::atomic_bool busy_ = false;
};

}  // namespace clatter
