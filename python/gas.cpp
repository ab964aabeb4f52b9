#include "python/gas.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/measure/measure_run.h"
#include "app/results/result_json.h"
#include "app/runs/run.h"
#include "engine/checkpoint/archive.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/scene/scene_file.h"
#include "engine/system/usage.h"
#include "engine/text.h"
#include "render/camera_path.h"
#include "render/context/context.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"

namespace clatter {

/// The turn of one call. Another thread, or a signal handler, would find a gas in motion.
class Gas::Turn {
 public:
  explicit Turn(Gas& gas) : busy_(gas.busy_) {
    if (busy_.exchange(true)) throw RunError("the gas is busy; wait until its other call ends");
  }
  ~Turn() { busy_ = false; }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::atomic_bool& busy_;
};

Gas::AnyRun Gas::run_of(const Scene& scene, std::uint64_t seed, const StopRequest& stop) {
  return with_dimension(scene.dimension(), [&](auto dimension) {
    AnyRun run(std::in_place_type<ScheduledRun<dimension()>>, scene, seed, stop);
    std::get<ScheduledRun<dimension()>>(run).show(scene.view);
    return run;
  });
}

Gas::Gas(const Scene& scene, std::uint64_t seed, const StopRequest& stop)
    : started_(scene), seed_(seed), run_(run_of(scene, seed, stop)) {}

Gas::Gas(const Scene& scene, std::uint64_t seed, AnyRun run)
    : started_(scene), seed_(seed), run_(std::move(run)) {}

std::string Gas::saved() {
  const Turn turn(*this);
  Checkpoint checkpoint;
  checkpoint.program = "clatter " CLATTER_VERSION;
  checkpoint.command = "python";
  checkpoint.scene = scene_to_toml(recorded());
  checkpoint.start_temperature = started_.particles.start.temperature;
  checkpoint.seed = seed_;
  std::visit(
      [&](auto& run) {
        checkpoint.saved = run.simulation().save();
        checkpoint.film = run.save_shown();
      },
      run_);
  ArchiveWriter writer;
  std::string bytes = checkpoint_bytes(checkpoint);
  writer(bytes, arrived_);
  return writer.written();
}

std::unique_ptr<Gas> Gas::restored(const std::string& saved) {
  const std::string name = "the saved gas";
  std::string bytes;
  bool arrived = false;
  ArchiveReader reader(saved, name);
  reader(bytes, arrived);
  reader.finish();
  const Checkpoint checkpoint = checkpoint_of(bytes, name);
  Scene scene = parse_scene(checkpoint.scene, name, {}, StartFile::Skip);
  scene.particles.start.temperature = checkpoint.start_temperature;
  return std::visit(
      [&]<int D>(const RunState<D>& state) {
        AnyRun run(std::in_place_type<ScheduledRun<D>>, scene, checkpoint.seed, state);
        std::get<ScheduledRun<D>>(run).show(scene.view, checkpoint.film);
        std::unique_ptr<Gas> gas(new Gas(scene, checkpoint.seed, std::move(run)));
        gas->arrived_ = arrived;
        return gas;
      },
      checkpoint.saved);
}

double Gas::time() {
  const Turn turn(*this);
  return std::visit([](auto& run) { return run.simulation().time(); }, run_);
}

double Gas::temperature() {
  const Turn turn(*this);
  return std::visit([](auto& run) { return run.simulation().temperature(); }, run_);
}

std::string Gas::hash() {
  const Turn turn(*this);
  return std::visit([](auto& run) { return fmt::format("{:016x}", run.simulation().state_hash()); },
                    run_);
}

AnyState Gas::state() {
  const Turn turn(*this);
  return std::visit([](auto& run) -> AnyState { return run.simulation().state(); }, run_);
}

Scene Gas::recorded() const {
  Scene scene = started_;
  scene.changes = std::visit([](const auto& run) { return run.scene().changes; }, run_);
  return scene;
}

std::string Gas::scene_json() {
  const Turn turn(*this);
  return scene_to_json(recorded());
}

void Gas::run_until(double time, const StopRequest& stop) {
  const Turn turn(*this);
  std::visit(
      [&](auto& run) {
        const double now = run.simulation().time();
        if (!std::isfinite(time)) {
          throw UserError({"run_until"}, "the time is not finite", "give a simulation time");
        }
        if (time < now) {
          throw UserError({"run_until"}, "the gas is already at t = " + number_text(now),
                          "give this time or a later one");
        }
        arrived_ = false;
        if (!run.run_until(time, kNoLimit, kNoLimit, stop)) throw Interrupted();
        arrived_ = true;
      },
      run_);
}

void Gas::change(const std::vector<Override>& laws) {
  const Turn turn(*this);
  std::visit(
      [&](auto& run) {
        if (!arrived_) run.settle();
        run.change_here(laws);
      },
      run_);
}

namespace {

// Collects the collisions of a run.
template <int D>
class Collisions final : private Observer<D> {
 public:
  Collisions(Simulation<D>& simulation, bool spins)
      : simulation_(simulation), spins_(spins), observation_(simulation, *this) {}

  std::vector<double> records;

 private:
  void on_collision(const PairCollision<D>& collision) override { add(collision); }
  void on_wall(const WallCollision<D>& collision) override { add(collision); }
  template <class Collision>
  void add(const Collision& collision) {
    append_record<D>(records, simulation_.domain(), simulation_.time(), collision, spins_);
  }

  const Simulation<D>& simulation_;
  bool spins_;
  Observation<D> observation_;
};

// Runs until all collisions have occurred, in steps whose lengths double.
template <int D>
void run_for(ScheduledRun<D>& run, std::uint64_t collisions, const StopRequest& stop) {
  constexpr double kLongest = 1e7;  // beyond it a lone particle would take minutes
  const auto occurred = [&] {
    const EventCounts& counts = run.simulation().counts();
    return counts.pair_collisions + counts.wall_collisions;
  };
  const std::uint64_t last = occurred() + collisions;
  for (double step = 1.0; occurred() < last; step *= 2.0) {
    if (step > kLongest) {
      throw RunError(fmt::format("only {} of {} collisions occur up to t = {:g}",
                                 collisions - (last - occurred()), collisions,
                                 run.simulation().time()));
    }
    const bool arrived = run.run_until(run.simulation().time() + step, last, kNoLimit, stop);
    if (!arrived && occurred() < last) throw Interrupted();
  }
}

template <int D>
EventTable collisions_of(ScheduledRun<D>& run, std::uint64_t count, const StopRequest& stop) {
  const bool spins = run.simulation().model().spins;
  Collisions<D> collisions(run.simulation(), spins);
  run_for(run, count, stop);
  EventTable table{event_quantities(D, spins), std::move(collisions.records)};
  const Simulation<D>& simulation = run.simulation();
  for (std::uint32_t i = 0; simulation.is_mixture() && i < simulation.particles().size(); ++i) {
    table.species.push_back(simulation.grain(i).species);
  }
  return table;
}

template <int D>
std::string measured(ScheduledRun<D>& run, const Scene& scene, double end,
                     const StopRequest& stop) {
  const double cpu_before = cpu_seconds();
  const auto began = std::chrono::steady_clock::now();
  const std::uint64_t collisions_before = run.simulation().counts().pair_collisions;
  Measurement<D> measurement(run.simulation(), scene.measure, end);
  if (!run.run_until(end, kNoLimit, kNoLimit, stop)) throw Interrupted();
  const Measured result = measurement.result(stop);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
  const Performance performance{cpu_seconds() - cpu_before, elapsed.count(),
                                run.simulation().counts().pair_collisions - collisions_before,
                                peak_memory_bytes()};
  require_no_overlap(run.simulation().checks());
  if (result.residuals) require_closed(*result.residuals);
  return result_json(scene, run.seed(), run.simulation(), result, performance).dump();
}

// The size of a picture whose sides have the ratio of the box, seen from the view's direction
// without perspective.
Size size_of(int width, const Scene& scene) {
  constexpr int kLeast = 16;
  constexpr double kTallest = 8.0;  // in widths
  if (width < kLeast) {
    throw UserError({"width"}, std::to_string(width) + " pixels are too few",
                    "give at least " + std::to_string(kLeast));
  }
  double wide = scene.box[0], high = scene.box[1];
  if (scene.dimension() == 3) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    const double azimuth = kDegree * scene.view.azimuth, elevation = kDegree * scene.view.elevation;
    const auto seen = [](double first, double second, double angle) {
      return first * std::fabs(std::cos(angle)) + second * std::fabs(std::sin(angle));
    };
    wide = seen(scene.box[0], scene.box[2], azimuth);
    high = seen(scene.box[1], seen(scene.box[2], scene.box[0], azimuth), elevation);
  }
  const double height = std::clamp(width * high / wide, double{kLeast}, kTallest * width);
  return {width, static_cast<int>(std::round(height))};
}

// The first drawing starts threads of OpenGL, which a forked process lacks: it would wait for them
// without end.
void require_own_threads() {
  static const int first = process_number();
  if (process_number() == first) return;
  throw RunError(
      "this process was forked after a drawing, and lacks the threads of OpenGL; draw in processes "
      "of multiprocessing.get_context(\"spawn\")");
}

}  // namespace

std::string Gas::measure(const std::optional<double>& duration, const StopRequest& stop) {
  const Turn turn(*this);
  Scene scene = recorded();
  if (duration) scene = with_settings(scene, {{"measure.duration", number_text(*duration)}});
  return std::visit(
      [&](auto& run) {
        const double now = run.simulation().time();
        const double end = std::max(now, scene.measure.burn_in) + scene.measure.duration;
        require_bounded_samples(scene.measure, now, end);
        arrived_ = false;
        std::string result = measured(run, scene, end, stop);
        arrived_ = true;
        return result;
      },
      run_);
}

EventTable Gas::events(long count, const StopRequest& stop) {
  const Turn turn(*this);
  constexpr long kMost = 100'000'000;
  if (count < 1 || count > kMost) {
    throw UserError({"events"}, std::to_string(count) + " collisions are not possible",
                    "give a number from 1 to " + std::to_string(kMost));
  }
  return std::visit(
      [&](auto& run) {
        arrived_ = false;
        return collisions_of(run, static_cast<std::uint64_t>(count), stop);
      },
      run_);
}

Image Gas::draw(int width, const StopRequest& stop) {
  const Turn turn(*this);
  const Size size = size_of(width, started_);
  require_own_threads();
  const Snapshot snapshot = std::visit([](auto& run) { return run.snapshot(); }, run_);
  // Dear ImGui, which draws the text, has one state for all threads.
  static std::mutex drawing;
  const std::scoped_lock lock(drawing);
  const auto context = open_context(Backend::Auto);
  const int largest = Canvas::largest_side(context->gl());
  if (std::max(size.width, size.height) > largest) {
    throw UserError({"width"},
                    "this OpenGL supports " + std::to_string(largest) + " pixels along a side",
                    "give a smaller width");
  }
  const Canvas canvas(context->gl(), size);
  Renderer renderer(context->gl(), 1, false, stop);
  const OverlayText text{started_.title, started_.caption};
  const Camera whole = renderer.fit(snapshot, size, started_.view, text);
  canvas.bind();
  renderer.draw(snapshot, camera_at(started_.view.camera, snapshot, whole), size, started_.view,
                text);
  return canvas.read();
}

}  // namespace clatter
