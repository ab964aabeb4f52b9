#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/event_loop.h"
#include "engine/dynamics/foreseen_events.h"
#include "engine/dynamics/grain_array.h"
#include "engine/dynamics/large_array.h"
#include "engine/dynamics/particle_states.h"
#include "engine/dynamics/subdomain.h"
#include "engine/dynamics/tile_record.h"
#include "engine/dynamics/tile_sizes.h"
#include "engine/laws/model.h"
#include "engine/physics/flight.h"
#include "engine/stop_request.h"

// Several threads. EventLoop has the particles, their plans and the calendar; Simulation has the
// clock, timers and kicks. A large gas has no calendar of its own. Foresight runs tiles of it, each
// an EventLoop with a TileRecord, and a Certificate proves that a tile's particles had their true
// collisions (docs/parallel.md). The loop of the whole gas takes over their flights. If it has
// observers, it processes the tiles' collisions in order (ForeseenEvents, process_foreseen), by the
// code that processes planned ones. Simulation chooses the way at each move of the base,
// and after a change of laws.

namespace clatter {

/// Finds the collisions of a large gas on several threads, before the run reaches their times.
/// Tiles of the box, each with a halo of copies, run alone for a window of time. A certificate then
/// proves that each tile's own particles had their true collisions; see docs/parallel.md. So the
/// run processes the same events, in the same order, as without foresight.
template <int D>
class Foresight {
 public:
  /// Work since the construction.
  struct Work {
    std::uint64_t windows = 0;
    std::uint64_t tiles = 0;   ///< runs of tiles
    std::uint64_t redone = 0;  ///< of these, runs with a larger halo
    std::uint64_t own = 0;     ///< collisions of own particles
    std::uint64_t all = 0;     ///< collisions of all particles, copies and abandoned runs included
  };
  /// Result of the work on a window.
  enum class Outcome {
    Done,
    Paused,  ///< at a stop request; the next call continues with the tiles that remain
    Failed,  ///< without a certificate, or after far more events than expected
  };

  /// Foresight for a number of particles. `model`, `boundary` and `grains`, see EventLoop::grains,
  /// must outlive it. It has one tile if the box is too small for several.
  Foresight(const Model<D>& model, const Boundary<D>& boundary, const GrainArray& grains,
            std::size_t particles, int threads, const TileSizes& sizes);
  Foresight(const Foresight&) = delete;
  Foresight& operator=(const Foresight&) = delete;

  /// Number of tiles into which the box divides.
  std::size_t tiles() const { return tiles_.size(); }
  /// Drops all foreseen events. The next window begins at a time on the base.
  void restart(double time);
  /// Whether all events up to and at a time on the base are foreseen. Others may have the time of
  /// restart().
  bool covers(double time) const { return fresh_ ? end_ > time : end_ >= time; }
  /// Finds the events of the next window, but none after `horizon`. `gas` has had all earlier
  /// events. `most` is the number of events for which the caller has use. At a stop request each
  /// thread completes its tile.
  Outcome look_ahead(const ParticleStates<D>& gas, double horizon, std::uint64_t most,
                     const StopRequest& stop = {});
  /// Runs `gas`, which has had all earlier events, through the next window, up to `horizon` at
  /// most. Changes nothing unless the outcome is Done. Fails also after more than `most`
  /// collisions, or if the base would have to move. Only for gases without t_c that nobody
  /// observes.
  Outcome advance(EventLoop<D>& gas, double horizon, std::uint64_t most,
                  const StopRequest& stop = {});
  /// Number of collisions of a full window.
  double typical_window() const {
    return 0.5 * sizes_.collisions * static_cast<double>(order_.size());
  }
  /// Whether a full window is expected to end before a time on the base.
  bool fits_before(double time) const {
    return rate_ * (time - end_) >= typical_window() || rate_ == 0.0;
  }
  /// The events of the last window that look_ahead() has found.
  ForeseenEvents<D>& events() { return events_; }
  /// Work so far.
  const Work& work() const { return work_; }

 private:
  // A particle of a halo after the run of its tile.
  struct Copy {
    std::uint32_t number;
    float strayed;   // largest distance from home
    float distance;  // of its home from the core
    Flight<D> end;
  };
  struct Tile {
    IntVec<D> from, to;  // blocks of its core
    double halo = 0.0;
    double width = 0.0;  // least width of the halo
    std::vector<Copy> copies;
    std::vector<ForeseenEvent<D>> events;
    double farthest = 0.0;  // way of an own particle
    double exposure = 0.0;  // largest way of an own particle minus its depth in the core
    std::uint64_t pair_collisions = 0;  // of own particles
    std::uint64_t wall_collisions = 0;
    RunChecks checks;       // of own particles
    bool base_due = false;  // whether a particle became too fast for the base
    double lack = 0.0;  // part of the halo's width that a certificate lacks; negative: certified
  };
  // A window whose tiles do not all have a certificate yet.
  struct Window {
    double end;
    bool is_cut;  // whether the caller has use for a part of a full window only
    bool keep_events;
    int rounds = 0;                 // that are complete
    std::vector<std::size_t> todo;  // tiles that the present round has not run yet
  };
  // Limits of the work of tiles that run at the same time.
  struct Limits {
    const StopRequest& stop;
    double most;  // collisions of all particles, copies included
    std::atomic<std::uint64_t> collisions{0};
    std::atomic<bool> exceeded{false};
  };
  // The loop of one thread, which runs one tile after another.
  struct Bench {
    Bench(const Model<D>& model, const Boundary<D>& boundary) : loop(model, boundary) {}
    EventLoop<D> loop;
    TileRecord<D> record;
    std::vector<std::uint32_t> offsets;
  };

  IntVec<D> count_tiles(int threads) const;
  double full_span(const ParticleStates<D>& gas) const;
  double speed_scale(const ParticleStates<D>& gas) const;
  double most_collisions() const;
  Outcome run_window(const ParticleStates<D>& gas, double horizon, double most, bool keep_events,
                     const StopRequest& stop);
  bool begin_window(const ParticleStates<D>& gas, double horizon, double most, bool keep_events);
  Outcome run_rounds(const ParticleStates<D>& gas, const StopRequest& stop);
  void certify_all(Window& window);
  void sort_into_blocks(const ParticleStates<D>& gas);
  Subdomain<D> subdomain_of(Tile& tile) const;
  void gather(const ParticleStates<D>& gas, const Tile& tile, const Subdomain<D>& subdomain,
              TileRecord<D>& record) const;
  void run(const ParticleStates<D>& gas, Limits& limits, Tile& tile, Bench& bench);
  bool finish(EventLoop<D>& loop, Limits& limits, Tile& tile) const;
  void certify(Tile& tile, double farthest, double bend) const;
  void fit_halo();
  void note_window();

  const Model<D>& model_;
  const GrainArray& grains_;
  GridSizes grid_sizes_;
  TileSizes sizes_;
  double halo_;
  double edge_;  // of a tile
  IntVec<D> tile_counts_;
  IntVec<D> block_counts_;
  Vec<D> block_widths_;
  Vec<D> cut_;  // 1 along axes with several tiles
  std::vector<Tile> tiles_;
  std::vector<std::unique_ptr<Bench>> benches_;  // of each thread
  LargeArray<std::uint32_t> block_of_;           // [N]
  LargeArray<std::uint32_t> order_;              // [N] numbers of particles, by block
  std::vector<std::uint32_t> first_;             // [blocks + 1] places in order_
  ParticleStates<D> ends_;                       // [N] at the end of the window
  LargeArray<float> strayed_;                    // [N]
  double end_ = 0.0;                             // of the last window, on the base
  std::optional<Window> window_;                 // that a stop request has interrupted
  bool fresh_ = true;                            // no window since restart()
  double rate_ = 0.0;                            // collisions per time; 0: unknown
  double span_ =
      0.0;  // of the last full window, or a small part of one that was too long; 0: unknown
  ForeseenEvents<D> events_;
  Work work_;
};

extern template class Foresight<2>;
extern template class Foresight<3>;

}  // namespace clatter
