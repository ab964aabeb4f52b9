// The undo history of a session. An entry is a change of laws, of the view or of the scene, an
// exchange of futures, or acts on the gas, such as nudges.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/view/session.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"

namespace clatter {

void Session::remember(Edit edit) {
  const bool changes = !edit.after.empty() || !edit.acts.empty();
  if (changes && std::exchange(forked_, false)) edit.fork = forks_;
  edit.gas = gas_;
  done_.push_back(std::move(edit));
  undone_.clear();
}

// Whether a change of a run is an act. A puff of the run has only the particles that found room.
static bool is_act(const Change& change, const Change& act) {
  std::optional<Puff> puff = change.puff;
  if (puff && act.puff) puff->count = act.puff->count;
  return change.nudge == act.nudge && puff == act.puff && change.piston == act.piston &&
         change.reverse == act.reverse && change.set.empty();
}

// The last changes of a run that are these acts, and are removed from it.
static std::vector<Change> take_acts(std::vector<Change>& changes,
                                     const std::vector<Change>& acts) {
  std::vector<Change> taken;
  for (auto act = acts.rbegin(); act != acts.rend(); ++act) {
    const auto is_it = [&](const Change& change) { return is_act(change, *act); };
    const auto after = std::find_if(changes.rbegin(), changes.rend(), is_it).base();
    if (after == changes.begin()) continue;
    taken.insert(taken.begin(), *(after - 1));
    changes.erase(after - 1);
  }
  return taken;
}

// Whether a scene has the former values of all keys of an entry.
static bool is_unchanged(const Scene& scene, const Edit& edit) {
  try {
    return scene_to_toml(with_settings(scene, edit.before)) == scene_to_toml(scene);
  } catch (const UserError&) {
    return false;
  }
}

// Removes new entries whose change the engine has refused: there is nothing to undo.
void Session::remove_refused(bool refused_scene) {
  std::erase_if(done_, [&](Edit& edit) {
    if (std::exchange(edit.made, true) || edit.gas >= gases_.size()) return false;
    if (!edit.scenes.empty()) return refused_scene;
    std::vector<Change> changes = gases_[edit.gas].scene.changes;
    if (!edit.acts.empty()) return take_acts(changes, edit.acts).empty();
    return !edit.before.empty() && is_unchanged(gases_[edit.gas].scene, edit);
  });
}

// Removes the acts of an entry from the run, or puts them back at their times. The run continues
// from the first of them.
void Session::exchange_acts(Edit& edit, bool again) {
  std::vector<Change> changes = frame().scene->changes;
  if (!again) edit.undone_acts = take_acts(changes, edit.acts);
  if (edit.undone_acts.empty()) return report("These changes are no longer part of the run");
  if (again) changes.insert(changes.end(), edit.undone_acts.begin(), edit.undone_acts.end());
  const double from = std::ranges::min(edit.undone_acts, {}, &Change::time).time;
  log_.event("replace_changes",
             {{"changes", changes.size()}, {"from", from}, {"command", sent_ + 1}});
  const bool plays = plays_;
  send(command::ReplaceChanges{std::move(changes), from});
  if (plays) play(true);
  note_work(false);
  edit.fork = ++forks_;
}

void Session::apply(Edit& edit, bool again) {
  if (!edit.scenes.empty()) {
    edit.scenes[again ? 0 : 1].unsaved = unsaved_;
    start(edit.scenes[again ? 1 : 0], "open");
  }
  if (edit.fork > 0 && edit.fork == forks_ && frame().other_future) {
    send_exchange();
  } else if (!edit.after.empty()) {
    set(again ? edit.after : edit.before, again ? edit.shift : -edit.shift);
    if (std::exchange(forked_, false)) edit.fork = forks_;
  } else if (!edit.acts.empty()) {
    exchange_acts(edit, again);
  }
  if (edit.views) set_view((*edit.views)[again ? 1 : 0]);
}

// Whether the last entry must wait: it has acts that no frame has yet, or another gas is
// selected, which is selected now.
bool Session::must_wait(const std::vector<Edit>& edits) {
  const Edit& last = edits.back();
  if (last.scenes.empty() && last.gas != gas_) {
    select(last.gas);
    return true;
  }
  return !last.acts.empty() && !is_answered();
}

// Removes the last entries of gases that no longer exist, since a scene was opened.
void Session::forget_missing(std::vector<Edit>& edits) const {
  while (!edits.empty() && edits.back().gas >= gases_.size()) edits.pop_back();
}

void Session::undo() {
  forget_missing(done_);
  if (done_.empty()) return;
  if (must_wait(done_)) {
    postponed_ = &Session::undo;
    return;
  }
  log_.event("undo", nlohmann::json::object());
  apply(done_.back(), false);
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
}

void Session::redo() {
  forget_missing(undone_);
  if (undone_.empty()) return;
  if (must_wait(undone_)) {
    postponed_ = &Session::redo;
    return;
  }
  log_.event("redo", nlohmann::json::object());
  apply(undone_.back(), true);
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
}

}  // namespace clatter
