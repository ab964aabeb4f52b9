#include "app/view/session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/error.h"
#include "engine/scene/act_checks.h"
#include "engine/scene/change_dimension.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/schedule.h"

namespace clatter {

// Frames per second that step_frame() assumes, whatever the refresh rate of the display.
static constexpr double kFramesPerSecond = 60.0;

void Session::send(Command command) {
  ++sent_;
  engine_.send(std::move(command));
}

static nlohmann::json status(const Frame& frame) {
  nlohmann::json told = {{"time", frame.snapshot.time},
                         {"temperature", frame.snapshot.temperature},
                         {"collisions", frame.snapshot.collisions},
                         {"run", frame.run},
                         {"handled", frame.handled},
                         {"plays", frame.plays},
                         {"backwards", frame.backwards},
                         {"held", frame.held},
                         {"changes", frame.scene->changes.size()},
                         {"head", frame.head},
                         {"box", std::vector(frame.snapshot.box.begin(), frame.snapshot.box.end())},
                         {"particles", frame.snapshot.count()},
                         {"flights", frame.snapshot.flights.size()},
                         {"restitution", frame.scene->particles.restitution}};
  told["gas"] = frame.gas;
  for (const Frame& gas : frame.others) {
    nlohmann::json beside = {{"gas", gas.gas},
                             {"time", gas.snapshot.time},
                             {"temperature", gas.snapshot.temperature},
                             {"restitution", gas.scene->particles.restitution},
                             {"changes", gas.scene->changes.size()}};
    if (gas.state_hash) beside["hash"] = fmt::format("{:016x}", *gas.state_hash);
    told["beside"].push_back(std::move(beside));
  }
  if (frame.other_future) told["other_future"] = *frame.other_future;
  if (frame.loop) told["loop"] = *frame.loop;
  if (frame.state_hash) told["hash"] = fmt::format("{:016x}", *frame.state_hash);
  if (frame.partners) told["partners"] = *frame.partners;
  if (frame.contact_time_error) told["elasticised"] = frame.contact_time_error->elasticised;
  if (frame.residuals && !frame.residuals->residuals.equations.empty()) {
    told["residuals"] = frame.residuals->residuals.largest();
  }
  return told;
}

bool Session::update() {
  if (!engine_.frames().update()) return false;
  const Frame& now = frame();
  if (now.messages > messages_) {
    messages_ = now.messages;
    report(now.message);
  }
  if (now.handled > handled_) {
    handled_ = now.handled;
    log_.event("handled", {{"command", handled_}});
  }
  // The panels show the requested settings until the engine has answered all commands.
  if (now.handled == sent_ && now.run > 0) {
    answered(now);
    if (const auto act = std::exchange(postponed_, nullptr)) (this->*act)();
  }
  watch_heat();
  constexpr std::chrono::milliseconds kStatus{100};
  if (log_.on() && now.scene && (Clock::now() - logged_ > kStatus || now.state_hash)) {
    logged_ = Clock::now();
    log_.event("status", status(now));
  }
  return true;
}

// Reports once in a run that the gas heats without bound, long before its speeds diverge.
void Session::watch_heat() {
  constexpr double kMuch = 100.0;
  const double now = frame().snapshot.temperature;
  if (frame().run != heated_run_) {
    heated_run_ = frame().run;
    heat_limit_ = kMuch * now;
  }
  if (!(heat_limit_ > 0.0) || now < heat_limit_) return;
  heat_limit_ = 0.0;
  report(
      fmt::format("T is {} times as high as at the start: the gas gains more energy than its "
                  "collisions lose",
                  kMuch));
}

static Scene without_changes(Scene scene) {
  scene.changes.clear();
  return scene;
}

// Takes the state of the engine, which drops refused settings.
void Session::answered(const Frame& now) {
  plays_ = now.plays;
  jumped_to_.reset();
  speed_ = now.speed;
  seed_ = now.seed;
  const bool refused_scene = before_ && before_->run == now.run;
  if (refused_scene) {
    gases_ = before_->gases;
    view_ = before_->view;
    ++views_;
  }
  before_.reset();
  if (!now.scene) return;
  const std::vector<const Frame*> frames = frames_of(now);
  gas_ = now.gas;
  gases_.resize(frames.size());
  seen_.resize(frames.size());
  for (std::size_t k = 0; k < gases_.size(); ++k) {
    if (frames[k]->scene == seen_[k] && !wishes_) continue;
    seen_[k] = frames[k]->scene;
    gases_[k].scene = *frames[k]->scene;
    gases_[k].scene.particles.start = gases_[k].opened.particles.start;
  }
  wishes_ = false;
  remove_refused(refused_scene);
}

// Whether a scene of the gallery is this one.
static bool is_of_gallery(const Scene& scene) {
  return std::ranges::any_of(embedded_scenes(), [&](const EmbeddedFile& file) {
    const Scene known = load_gallery_scene(file);
    return known.title == scene.title && scene_to_toml(known) == scene_to_toml(scene);
  });
}

// Notes a change by hand. Work that lasts is more than an experiment.
void Session::note_work(bool lasts) {
  unsaved_ = unsaved_ || lasts || own_;
}

void Session::open(const Scene& scene, std::uint64_t seed, bool plays,
                   const std::vector<Scene>& others) {
  plays_ = plays;
  const OpenedScene now{scene, scene, seed};
  if (frame().run > 0) {
    if (!done_.empty() && done_.back().scenes.empty()) {
      report(fmt::format("Ctrl+Z returns to {} with its changes", opened().title));
    }
    remember({.scenes = {present_scene(), now}});
  }
  start(now, "open", others);
}

OpenedScene Session::present_scene() const {
  return {restarted(selected()), opened(), seed_, unsaved_};
}

// Sends a scene and those beside it to the engine, whose refusal restores the present ones.
void Session::start(const OpenedScene& opened, const char* event,
                    const std::vector<Scene>& others) {
  if (!before_ && frame().run > 0) before_ = Before{gases_, view_, frame().run};
  wishes_ = true;
  gases_ = {{opened.scene, opened.opened}};
  for (const Scene& other : others) gases_.push_back({other, other});
  gas_ = 0;
  seed_ = opened.seed;
  unsaved_ = opened.unsaved;
  own_ = !is_of_gallery(opened.opened);
  view_ = scene().view;
  const double at = std::exchange(view_.open_at, std::nullopt).value_or(0.0);
  speed_ = view_.speed;
  ++views_;
  log_.event(event, {{"title", scene().title},
                     {"seed", seed_},
                     {"dimension", scene().dimension()},
                     {"gases", gases_.size()},
                     {"command", sent_ + 1}});
  send_open(scene(), false, {}, at);
  if (at > 0.0) {
    report(fmt::format("Opened at t = {}; R starts the scene from t = 0", number_text(at)));
  }
}

// Opens a scene of the selected gas. The other gases start again with it.
void Session::send_open(const Scene& scene, bool keeps_gas, const VecX& shift, double at) {
  command::Open open{scene, seed_, plays_, keeps_gas, shift};
  open.at = at;
  open.gas = gas_;
  for (std::size_t k = 0; k < gases_.size(); ++k) {
    if (k == gas_) continue;
    const Gas& other = gases_[k];
    open.others.push_back(
        {keeps_gas ? as_shown(without_changes(other.scene)) : restarted(other), seed_});
  }
  send(std::move(open));
}

void Session::add_copy() {
  if (frame().run == 0) return;
  if (gases_.size() == kMostGases) {
    return report(fmt::format("No more than {} gases run in step; remove one first", kMostGases));
  }
  gases_.push_back(selected());
  log_.event("add_copy", {{"of", gas_}, {"command", sent_ + 1}});
  send(command::CopyGas{});
  select(gases_.size() - 1);
}

void Session::remove_gas() {
  if (gases_.size() == 1) return;
  log_.event("remove_gas", {{"gas", gas_}, {"command", sent_ + 1}});
  send(command::RemoveGas{gas_});
  for (std::vector<Edit>* edits : {&done_, &undone_}) {
    std::erase_if(*edits, [&](const Edit& edit) { return edit.gas == gas_; });
    for (Edit& edit : *edits) edit.gas -= edit.gas > gas_ ? 1 : 0;
  }
  const std::vector<Species> species = scene().species;
  gases_.erase(gases_.begin() + static_cast<std::ptrdiff_t>(gas_));
  seen_.clear();
  gas_ -= gas_ > 0 ? 1 : 0;
  view_ = scene().adapted(view_, species);
}

void Session::select(std::size_t gas) {
  if (gas == gas_ || gas >= gases_.size()) return;
  const std::vector<Species> species = scene().species;
  gas_ = gas;
  view_ = scene().adapted(view_, species);
  picked_.reset();
  log_.event("select", {{"gas", gas_}, {"command", sent_ + 1}});
  send(command::SelectGas{gas_});
}

void Session::cancel_open() {
  log_.event("cancel", {{"command", sent_ + 1}});
  send(command::CancelOpen{});
}

// A scene with the view and the speed on screen. A view of spheres does not fit disks.
Scene Session::as_shown(Scene scene) const {
  if (scene.dimension() == this->scene().dimension()) {
    scene.view = scene.adapted(view_, this->scene().species);
  }
  scene.view.speed = speed_;
  return scene;
}

Scene Session::recorded(const Frame& gas) const {
  Scene scene = *gas.started;
  scene.changes = gas.scene->changes;
  scene = as_shown(std::move(scene));
  if (gas.snapshot.time > 0.0) scene.view.open_at = gas.snapshot.time;
  // Roughness may have been switched on later: the scene at the start has no spins to show.
  if (!scene.spins()) scene.view.hide_spins();
  return scene;
}

Scene Session::restarted(const Gas& gas) const {
  // Scheduled changes start from the opened laws.
  if (!gas.opened.changes.empty()) return as_shown(gas.opened);
  return as_shown(without_changes(gas.scene));
}

void Session::restart() {
  log_.event("reset", {{"seed", seed_}, {"command", sent_ + 1}});
  send_open(restarted(selected()), false);
}

void Session::switch_dimension() {
  const OpenedScene before = present_scene();
  try {
    const auto [scene, removed] = change_dimension(before.scene, 5 - before.scene.dimension());
    if (!removed.empty()) {
      report(fmt::format("Without meaning for {}, and removed: {}; Ctrl+Z restores the former scene",
                       scene.dimension() == 2 ? "disks" : "spheres", fmt::join(removed, ", ")));
    }
    remember({.scenes = {before, {scene, scene, seed_, true}}});
  } catch (const UserError& error) {
    report(error.problem() + "; " + error.advice());
    return;
  }
  start(done_.back().scenes[1], "dimension");
}

void Session::refit(const VecX& shift) {
  log_.event("refit", {{"command", sent_ + 1}});
  send_open(as_shown(without_changes(scene())), true, shift);
}

void Session::restart_with_new_seed() {
  ++seed_;
  restart();
}

void Session::play(bool on) {
  plays_ = on;
  log_.event(on ? "play" : "pause", {{"command", sent_ + 1}});
  send(command::Play{on});
}

void Session::play_backwards() {
  plays_ = true;
  log_.event("play_backwards", {{"command", sent_ + 1}});
  send(command::PlayBackwards{});
}

void Session::play_until(double time) {
  plays_ = true;
  log_.event("play", {{"until", time}, {"command", sent_ + 1}});
  send(command::Play{true, time});
}

void Session::step_frame() {
  log_.event("step_frame", {{"command", sent_ + 1}});
  send(command::Step{speed_ / kFramesPerSecond});
}

void Session::step_collision() {
  log_.event("step_collision", {{"command", sent_ + 1}});
  send(command::StepCollision{});
}

void Session::jump(double time) {
  log_.event("jump", {{"to", time}, {"command", sent_ + 1}});
  plays_ = false;
  jumped_to_ = std::clamp(time, 0.0, frame().head);
  send(command::Jump{*jumped_to_});
}

// The simulation time on screen, or the one that will be there.
double Session::present() const {
  return jumped_to_.value_or(frame().snapshot.time);
}

void Session::skip(double seconds) {
  const bool plays = plays_;
  jump(present() + seconds * speed_);
  if (plays) play(true);
}

void Session::repeat(double from, double to) {
  log_.event("repeat", {{"from", from}, {"to", to}, {"command", sent_ + 1}});
  send(command::Loop{from, to});
  if (!(from < to)) return;
  jump(from);
  play(true);
}

void Session::step_frame_back() {
  jump(present() - speed_ / kFramesPerSecond);
}

void Session::step_collision_back() {
  log_.event("step_collision_back", {{"command", sent_ + 1}});
  send(command::StepBack{});
}

void Session::go_to_head() {
  const bool plays = plays_;
  jump(frame().head);
  if (plays) play(true);
}

void Session::move_change(std::size_t number, double time) {
  log_.event("move_change", {{"number", number}, {"to", time}, {"command", sent_ + 1}});
  send(command::MoveChange{number, time});
  note_work(true);
  remember({.fork = ++forks_});
}

void Session::exchange_futures() {
  send_exchange();
  remember({.fork = forks_});
}

void Session::send_exchange() {
  log_.event("exchange_futures", {{"command", sent_ + 1}});
  send(command::ExchangeFutures{});
  note_work(false);
}

void Session::set_speed(double speed) {
  speed_ = std::clamp(speed, 1e-4, 1e6);
  log_.event("speed", {{"speed", speed_}});
  send(command::SetSpeed{speed_});
}

void Session::change_speed(bool faster) {
  constexpr double kNext = 1.001;  // larger than rounding
  const double speed = frame().speed * (faster ? kNext : 1.0 / kNext);
  const double decade = std::pow(10.0, std::floor(std::log10(speed)));
  constexpr std::array kSteps = {1.0, 2.0, 5.0, 10.0};
  const auto above = std::ranges::upper_bound(kSteps, speed / decade);
  set_speed(decade * (faster ? *above : *std::prev(above)));
}

bool Session::set(const std::vector<Override>& settings, const VecX& shift) {
  try {
    selected().scene = with_settings(scene(), settings);
    wishes_ = true;
  } catch (const UserError& error) {
    report(error.problem() + "; " + error.advice());
    return false;
  }
  View view = view_;
  if (!scene().spins() && view.hide_spins()) set_view(view);
  nlohmann::json keys;
  for (const Override& setting : settings) keys[setting.key] = setting.value;
  log_.event("set", {{"keys", keys}, {"command", sent_ + 1}});
  const bool live = std::ranges::all_of(
      settings, [](const Override& setting) { return may_change_live(setting.key); });
  note_work(!live);
  if (live) {
    note_fork();
    send(command::SetLaws{settings});
  } else {
    refit(shift);
  }
  return true;
}

// A change in the past begins another future.
void Session::note_fork() {
  if (frame().snapshot.time >= frame().head || forked_) return;
  ++forks_;
  forked_ = true;
}

static nlohmann::json keys_of(const Nudge& nudge) {
  const auto numbers = [](const VecX& vector) { return std::vector(vector.begin(), vector.end()); };
  nlohmann::json keys;
  if (nudge.particle) keys["particle"] = *nudge.particle;
  if (nudge.centre) keys["centre"] = numbers(*nudge.centre);
  if (nudge.radius) keys["radius"] = *nudge.radius;
  if (nudge.scale) keys["scale"] = *nudge.scale;
  if (nudge.add) keys["add"] = numbers(*nudge.add);
  if (nudge.set) keys["set"] = numbers(*nudge.set);
  return keys;
}

void Session::nudge(const Nudge& nudge) {
  try {
    check_nudge(nudge, scene(), static_cast<std::int64_t>(frame().snapshot.count()));
  } catch (const UserError& error) {
    report(error.problem() + "; " + error.advice());
    return;
  }
  note_work(false);
  note_fork();
  log_.event("nudge", {{"nudge", keys_of(nudge)}, {"command", sent_ + 1}});
  send(command::Nudge{nudge});
}

void Session::add(const Puff& puff) {
  note_work(true);
  note_fork();
  log_.event("puff", {{"count", puff.count},
                      {"centre", std::vector(puff.centre.begin(), puff.centre.end())},
                      {"radius", puff.radius},
                      {"temperature", puff.temperature},
                      {"species", puff.species},
                      {"command", sent_ + 1}});
  send(command::AddPuff{puff});
}

void Session::reverse() {
  note_work(false);
  note_fork();
  log_.event("reverse", {{"command", sent_ + 1}});
  send(command::Reverse{});
  remember({.acts = {{.reverse = true}}});
}

void Session::move_piston(double position, double duration) {
  note_work(false);
  note_fork();
  log_.event("piston", {{"position", position}, {"duration", duration}, {"command", sent_ + 1}});
  send(command::MovePiston{position, duration});
}

void Session::set_view(const View& view) {
  const bool observes_anew =
      !view.averages_like(view_) || view.trails != view_.trails || view.tracer != view_.tracer;
  if (view.azimuth != view_.azimuth || view.elevation != view_.elevation) {
    log_.event("turn", {{"azimuth", view.azimuth}, {"elevation", view.elevation}});
  }
  view_ = view;
  ++views_;
  if (observes_anew) send(command::Show{view});
}

void Session::pick(std::optional<std::size_t> particle) {
  if (std::exchange(picked_, particle) == particle) return;
  command::Pick pick;
  if (particle) pick.particle = static_cast<std::uint32_t>(*particle);
  log_.event("pick", {{"particle", particle ? nlohmann::json(*particle) : nlohmann::json()}});
  send(pick);
}

void Session::show_profile(Profiled what, Axis axis) {
  if (profiled_.what == what && profiled_.axis == axis) return;
  profiled_ = {what, axis};
  send(profiled_);
}

void Session::listen(bool on) {
  listens_ = on;
  log_.event("sound", {{"on", on}, {"command", sent_ + 1}});
  send(command::Listen{on});
}

void Session::report(const std::string& message) {
  message_ = message;
  ++told_;
  log_.event("message", {{"text", message}});
}

}  // namespace clatter
