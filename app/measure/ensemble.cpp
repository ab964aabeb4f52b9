#include "app/measure/ensemble.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/measure/feature_cost.h"
#include "app/results/result_json.h"
#include "app/runs/run.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/run/scheduled_run.h"
#include "engine/system/allocation.h"
#include "engine/system/signals.h"

namespace clatter {

namespace {

using Json = nlohmann::ordered_json;

struct Replica {
  Json result;
  std::vector<std::pair<std::string, Estimate>> estimates;
};

// Distributes the replicas over threads and collects their results.
template <int D>
class Replicas {
 public:
  Replicas(const Scene& scene, const Ensemble& ensemble, Progress& progress)
      : scene_(scene),
        ensemble_(ensemble),
        progress_(progress),
        done_(static_cast<std::size_t>(ensemble.replicas)),
        times_(done_.size()),
        failed_(done_.size()) {}

  void run() {
    const auto wanted =
        static_cast<std::size_t>(ensemble_.threads.value_or(fitting_processors(memory_of(scene_))));
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < std::min(wanted, done_.size()); ++k) {
      threads.emplace_back([this] { work(); });
    }
    threads.clear();  // joins them
  }

  const std::vector<std::optional<Replica>>& done() const { return done_; }

  // Replicas are started in order, and all before the first failure are complete. The reported seed
  // thus does not depend on the threads.
  std::exception_ptr failure() const {
    const std::string seed = "seed " + std::to_string(ensemble_.first_seed + failed_) + ": ";
    try {
      if (failure_) std::rethrow_exception(failure_);
    } catch (const PhysicalStop& stop) {
      return std::make_exception_ptr(PhysicalStop(seed + stop.what(), stop.remedy()));
    } catch (const RunError& error) {
      return std::make_exception_ptr(RunError(seed + error.what()));
    } catch (...) {  // another error stays as it is
    }
    return failure_;
  }

 private:
  void work() {
    while (const std::optional<std::size_t> next = take()) {
      try {
        measure(*next);
      } catch (const Interrupted&) {
        return;  // the replica has no result
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (*next < failed_) {
          failed_ = *next;
          failure_ = std::current_exception();
        }
      }
    }
  }

  std::optional<std::size_t> take() {
    const std::scoped_lock lock(mutex_);
    if (next_ == done_.size() || failure_ || interrupted()) return {};
    return next_++;
  }

  void measure(std::size_t index) {
    constexpr std::uint64_t kSlice = 1 << 16;  // steps between messages to progress
    const std::uint64_t seed = ensemble_.first_seed + index;
    const auto simulation = simulation_of<D>(scene_, seed, interrupted);
    Measurement measurement(*simulation, scene_.measure, ensemble_.end);
    while (!simulation->run_until(ensemble_.end, kNoLimit, simulation->counts().steps() + kSlice,
                                  interrupted)) {
      if (interrupted() || !show_progress(index, simulation->time())) return;
    }
    require_no_overlap(simulation->checks());
    const Measured measured = measurement.result();
    if (measured.residuals) require_closed(*measured.residuals);
    Json result = result_json(scene_, seed, *simulation, measured, {});
    result.erase("performance");
    const std::scoped_lock lock(mutex_);
    done_[index] = Replica{std::move(result), estimates_of(measured)};
  }

  // Shows the progress of all replicas. Returns whether this replica is still needed.
  bool show_progress(std::size_t index, double time) {
    const std::scoped_lock lock(mutex_);
    times_[index] = time;
    double sum = 0.0;
    for (const double each : times_) sum += each;
    progress_.update(sum);
    return index < failed_;
  }

  const Scene& scene_;
  Ensemble ensemble_;
  Progress& progress_;
  std::mutex mutex_;  // protects all members below
  std::size_t next_ = 0;
  std::vector<std::optional<Replica>> done_;
  std::vector<double> times_;
  std::size_t failed_;  // the first failed replica; the number of replicas if none failed
  std::exception_ptr failure_;
};

}  // namespace

template <int D>
static EnsembleResult measure_replicas(const Scene& scene, const Ensemble& ensemble,
                                       Progress& progress) {
  Replicas<D> replicas(scene, ensemble, progress);
  replicas.run();
  Json json{{"schema", 1}, {"seeds", Json::array()}, {"results", Json::array()}};
  std::vector<const Replica*> done;
  for (const std::optional<Replica>& replica : replicas.done()) {
    if (!replica) continue;
    done.push_back(&*replica);
    json["seeds"].push_back(replica->result.at("seed"));
    json["results"].push_back(replica->result);
  }
  for (std::size_t k = 0; !done.empty() && k < done.front()->estimates.size(); ++k) {
    std::vector<double> values;
    for (const Replica* replica : done) values.push_back(replica->estimates[k].second.mean);
    const Estimate over_replicas = independent_estimate(values);
    place_of_estimate(json, done.front()->estimates[k].first) = {
        {"mean", over_replicas.mean}, {"standard_error", over_replicas.standard_error}};
  }
  return {std::move(json), replicas.failure()};
}

EnsembleResult measure_ensemble(const Scene& scene, const Ensemble& ensemble, Progress& progress) {
  return with_dimension(scene.dimension(), [&](auto dimension) {
    return measure_replicas<dimension>(scene, ensemble, progress);
  });
}

}  // namespace clatter
