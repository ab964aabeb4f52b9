#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/live/watched_run.h"

namespace clatter {

/// Runs that are compared, at the same simulation time. The selected one leads: it determines the
/// end of each stretch, and the others run to the same time. Changes of laws, nudges, puffs,
/// strokes, futures, picks and clicks concern the selected run only. Times and profiles concern all
/// runs, views those of its dimension.
///
/// A frame is that of the selected run, with the frames of the others in Frame::others. Each run
/// has the bits that it has alone. Where a run stops, all go to this time.
class GasesInStep final : public WatchedRun {
 public:
  /// Runs at the same time, and their Frame::id. One of them is selected.
  GasesInStep(std::vector<std::unique_ptr<WatchedRun>> runs, std::vector<std::uint64_t> ids,
              std::size_t selected);

  /// Number of runs.
  std::size_t count() const { return gases_.size(); }
  /// All particles of a run at time().
  AnyState state_of(std::size_t gas) const { return gases_[gas].run->state(); }
  /// Adds a copy of the selected run as the last one. Throws UserError if there are kMostGases.
  void add_copy(std::uint64_t id);
  /// Removes a run, but not the only one. Later numbers move down. If the selected run is removed,
  /// the one before it is selected.
  void remove(std::size_t gas);
  /// Selects a run. The former one follows no particle.
  void select(std::size_t gas);

  /// The least time of the runs. They differ only while run_until() is paused.
  double time() const override;
  const EventCounts& counts() const override { return selected().counts(); }
  int dimension() const override { return selected().dimension(); }
  const Scene& laws() const override { return selected().laws(); }
  AnyState state() const override { return selected().state(); }
  std::unique_ptr<WatchedRun> copy() override { return selected().copy(); }
  bool prepare(const StopRequest& pause) override;
  bool run_until(double time, std::uint64_t collisions, std::uint64_t steps,
                 const StopRequest& pause = {}) override;
  void settle() override;
  void change(const std::vector<Override>& laws, double delay) override;
  void nudge(const Nudge& nudge, double delay) override;
  void puff(const Puff& puff, double delay) override;
  void reverse(double delay) override;
  void move_piston(double position, double duration, double delay) override;
  double replace_changes(std::vector<Change> changes, double from) override;
  double exchange_futures() override;
  double move_change(std::size_t number, double time) override;
  double head() const override { return selected().head(); }
  void go_back(double time) override;
  bool search_back(const StopRequest& pause) override { return selected().search_back(pause); }
  std::optional<PreviousCollision> previous_collision() const override {
    return selected().previous_collision();
  }
  void show(const View& view) override;
  void show_profile(Profiled what, Axis axis) override;
  void listen(bool on) override;
  std::vector<Click> take_clicks() override { return selected().take_clicks(); }
  void pick(std::optional<std::uint32_t> particle) override { selected().pick(particle); }
  void fill(Frame& frame, bool halted) override;
  bool looks_ahead() const override { return selected().looks_ahead(); }
  const std::optional<std::array<std::uint32_t, 2>>& partners() const override {
    return selected().partners();
  }

 private:
  struct Gas {
    std::unique_ptr<WatchedRun> run;
    std::uint64_t id;
  };

  WatchedRun& selected() { return *gases_[selected_].run; }
  const WatchedRun& selected() const { return *gases_[selected_].run; }
  template <class Act>
  bool lead(const Act& act, const StopRequest& pause = {});
  double others_go_back(double time);
  bool follow(const StopRequest& pause = {});
  void meet_at(double time);

  std::vector<Gas> gases_;
  std::size_t selected_;
  bool listens_ = false;
};

}  // namespace clatter
