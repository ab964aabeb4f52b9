#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/live/engine_work.h"

// The commands to the engine.

namespace clatter {

namespace {

// Whether two commands set the same laws or the time, so that only the later one counts. The user
// may drag a slider or the timeline faster than a large gas can follow.
bool supersedes(const Command& later, const Command& earlier) {
  using command::Jump;
  if (std::holds_alternative<Jump>(later) && std::holds_alternative<Jump>(earlier)) return true;
  const auto* a = std::get_if<command::SetLaws>(&later);
  const auto* b = std::get_if<command::SetLaws>(&earlier);
  return a && b && std::ranges::equal(a->laws, b->laws, {}, &Override::key, &Override::key);
}

// Whether a command abandons the way to another time.
bool ends_way(const Command& command) {
  const auto* open = std::get_if<command::Open>(&command);
  return std::holds_alternative<command::Jump>(command) ||
         std::holds_alternative<command::CancelOpen>(command) || (open && !open->keeps_gas);
}

}  // namespace

// Commands wait while a scene is being opened, and while the run is on its way to another time.
void EngineWork::execute_all() {
  std::vector<Command> asked = commands_.take();
  bool any = !asked.empty();
  std::ranges::move(asked, std::back_inserter(waiting_));
  if (opens()) abandon();
  if (any) attempt([this] { end_rewind(); });
  if (is_away() && !waiting_.empty() && ends_way(waiting_.front())) errand_ = {};
  while (!has_errand() && !waiting_.empty() && !commands_.closed()) {
    const Command next = std::move(waiting_.front());
    waiting_.pop_front();
    any = true;
    if (waiting_.empty() || !supersedes(waiting_.front(), next)) {
      attempt([&] { std::visit([this](const auto& command) { execute(command); }, next); });
    }
    if (!opens()) ++handled_;
  }
  if (any && !is_away()) publish();
}

// Another scene, or CancelOpen, ends the opening and the commands between.
void EngineWork::abandon() {
  const auto ends = [](const Command& command) {
    const auto* open = std::get_if<command::Open>(&command);
    return (open && !open->keeps_gas) || std::holds_alternative<command::CancelOpen>(command);
  };
  const auto last = std::ranges::find_if(waiting_.rbegin(), waiting_.rend(), ends).base();
  if (last == waiting_.begin()) return;
  errand_ = {};
  handled_ += static_cast<std::uint64_t>(last - waiting_.begin());
  waiting_.erase(waiting_.begin(), last - 1);
}

void EngineWork::execute(const command::Play& asked) {
  halt();
  if (asked.on) {
    motion_ = Playing{.until = asked.until};
  } else if (gases_) {
    gases_->settle();
  }
}

void EngineWork::execute(const command::PlayBackwards&) {
  halt();
  if (gases_ && time() > 0.0) motion_.emplace<PlayingBackwards>();
}

void EngineWork::execute(const command::Step& asked) {
  halt();
  if (gases_) motion_ = Stepping{.to = time() + asked.duration};
}

void EngineWork::execute(const command::StepCollision&) {
  halt();
  if (gases_) motion_ = SteppingToCollision{.number = gases_->counts().pair_collisions + 1};
}

void EngineWork::execute(const command::Jump& asked) {
  halt();
  if (gases_) go_to(std::clamp(asked.time, 0.0, gases_->head()));
}

void EngineWork::execute(const command::StepBack&) {
  halt();
  if (gases_) errand_ = Searching{};
}

void EngineWork::execute(const command::MoveChange& asked) {
  halt();
  if (gases_) errand_ = Travelling{.to = gases_->move_change(asked.number, asked.time)};
}

void EngineWork::execute(const command::ReplaceChanges& asked) {
  halt();
  if (gases_) errand_ = Travelling{.to = gases_->replace_changes(asked.changes, asked.from)};
}

void EngineWork::execute(const command::ExchangeFutures&) {
  halt();
  if (gases_) errand_ = Travelling{.to = gases_->exchange_futures()};
}

void EngineWork::execute(const command::Loop& asked) {
  loop_.reset();
  if (asked.from < asked.to) loop_ = {asked.from, asked.to};
}

void EngineWork::execute(const command::SetSpeed& asked) {
  pace_.set_speed(asked.speed);
}

void EngineWork::execute(const command::SetLaws& asked) {
  played_.change_laws();
  if (gases_) gases_->change(asked.laws, delay());
}

void EngineWork::execute(const command::Nudge& asked) {
  if (gases_) gases_->nudge(asked.nudge, delay());
}

void EngineWork::execute(const command::AddPuff& asked) {
  if (gases_) gases_->puff(asked.puff, delay());
}

void EngineWork::execute(const command::Reverse&) {
  if (gases_) gases_->reverse(delay());
}

void EngineWork::execute(const command::MovePiston& asked) {
  if (gases_) gases_->move_piston(asked.position, asked.duration, delay());
}

void EngineWork::execute(const command::Show& asked) {
  if (gases_) gases_->show(asked.view);
}

void EngineWork::execute(const command::ShowProfile& asked) {
  profiled_ = asked;
  if (gases_) gases_->show_profile(asked.what, asked.axis);
}

void EngineWork::execute(const command::Listen& asked) {
  played_.listen(asked.on);
  if (gases_) gases_->listen(asked.on);
}

void EngineWork::execute(const command::Pick& asked) {
  if (gases_) gases_->pick(asked.particle);
}

void EngineWork::execute(const command::CopyGas&) {
  if (gases_) gases_->add_copy(++ids_);
}

void EngineWork::execute(const command::RemoveGas& asked) {
  if (!gases_) return;
  leave_leader();
  gases_->remove(asked.gas);
}

void EngineWork::execute(const command::SelectGas& asked) {
  if (!gases_) return;
  leave_leader();
  gases_->select(asked.gas);
}

void EngineWork::execute(const command::Open& asked) {
  errand_ = OpeningGases(asked, gases_.get(), record_bytes_);
  work_on_opening();
  const auto* opening = std::get_if<OpeningGases>(&errand_);
  if (opening && opening->complete()) finish_opening();
}

void EngineWork::execute(const command::CancelOpen&) {}

// Ends what counts the events of the selected gas, before another one is selected.
void EngineWork::leave_leader() {
  if (in<SteppingToCollision>()) halt();
  partners_.reset();
  rate_.restart();
}

}  // namespace clatter
