#include "app/runs/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/system/interrupt.h"
#include "engine/checkpoint/archive.h"
#include "engine/publish/moving_sum.h"
#include "render/camera_path.h"

namespace clatter {

template <class Archive>
static void visit(Archive& io, FrameTimes& times) {
  auto& [from, speed, fps, count] = times;
  io(from, speed, fps, count);
}

template <class Archive>
static void visit(Archive& io, PngText& text) {
  io(text.keyword, text.text);
}

template <class Archive>
static void visit(Archive& io, FilmSound& sound) {
  auto& [synthesiser, checksum] = sound;
  io(synthesiser, checksum);
}

template <class Archive>
static void visit(Archive& io, FilmState& state) {
  auto& [times, size, samples, shutter, transparent, overlay, sound, next, begin, ranges, camera,
         shown, checksums, notes] = state;
  io(times, size, samples, shutter, transparent, overlay, sound, next, begin, ranges, camera, shown,
     checksums, notes);
}

std::string to_bytes(FilmState state) {
  ArchiveWriter writer;
  writer(state);
  return writer.written();
}

std::optional<FilmState> film_of(const Resumed& resumed) {
  const std::string& bytes = resumed.checkpoint.film;
  if (bytes.empty()) return std::nullopt;
  FilmState state;
  ArchiveReader reader(bytes, resumed.file);
  reader(state);
  reader.finish();
  return state;
}

template <int D>
Film<D>::Film(Run<D>& run, const Scene& scene, const View& view, FilmState state, const Gl& gl)
    : run_(run),
      scene_(scene),
      view_(view),
      text_{scene.title, scene.caption},
      state_(std::move(state)),
      canvas_(gl, state_.size),
      renderer_(gl, state_.samples, state_.transparent, interrupted) {
  run_.scheduled().show(view_, state_.shown, state_.exposure());
  run_.film_state = [this] { return state_now(); };
  if (state_.ranges) renderer_.fix(*state_.ranges);
  if (state_.sound && state_.sound->synthesiser) follow(run_.simulation());
}

// A single picture needs no film state; it is drawn again.
template <int D>
std::string Film<D>::state_now() const {
  if (state_.times.count == 1) return "";
  FilmState state = state_;
  state.shown = run_.scheduled().save_shown();
  return to_bytes(std::move(state));
}

template <int D>
long Film<D>::draw(const FrameRange& frames, FrameSink& sink, Progress& progress) {
  const long first = std::max(state_.next, frames.begin);
  state_.begin = frames.begin;
  for (; state_.next < frames.end; ++state_.next) {
    const long frame = state_.next;
    if (!run_.until(state_.times.of(frame), progress) || !choose_ranges(progress) ||
        !choose_sound(progress)) {
      return frame;
    }
    if (state_.sound) render_sound(sink);
    if (frame == first || (frame > first && frame % FrameSink::kPiece == 0)) {
      sink.flush();
      state_.checksums = sink.checksums();
      run_.mark();
    }
    // Skipped frames take a snapshot as well. Bitwise equal averages need the same snapshot times.
    const Snapshot snapshot = run_.scheduled().snapshot();
    if (!state_.camera) state_.camera = renderer_.fit(snapshot, canvas_.size(), view_, text_);
    if (frame < first) continue;
    if (view_.card && state_.times.count > 1) {
      text_.card = card_opacity(*view_.card, static_cast<double>(frame) / state_.times.fps);
    }
    text_.speed = state_.times.speed;
    const Camera camera = camera_at(view_.camera, snapshot, *state_.camera);
    canvas_.bind();
    try {
      renderer_.draw(snapshot, camera, canvas_.size(), view_, text_);
    } catch (const Interrupted&) {
      run_.until(state_.times.of(frame), progress);  // notes the early end
      return frame;
    }
    const Image picture = canvas_.read();
    state_.notes = notes();
    sink.add(state_.transparent ? with_own_colours(picture) : picture, state_.notes);
    progress.update(snapshot.time);
  }
  if (state_.sound && state_.next == state_.times.count) end_sound(sink);
  return state_.next;
}

template <int D>
void Film<D>::end_part() {
  state_.begin.reset();
  run_.mark();
}

template <int D>
bool Film<D>::choose_ranges(Progress& progress) {
  if (state_.ranges || state_.times.count == 1) return true;
  const RangeEnds ends = look_ahead();
  // The look-ahead may have been interrupted.
  if (!run_.until(run_.simulation().time(), progress)) return false;
  state_.ranges = ends;
  renderer_.fix(ends);
  return true;
}

// The largest values at the ends of the parts of the window, and of its average.
template <int D>
RangeEnds Film<D>::look_ahead() const {
  const ScheduledRun<D>& run = run_.scheduled();
  ScheduledRun<D> ahead(scene_, run.seed(), run.simulation().save());
  ahead.show(view_, run.save_shown(), state_.exposure());
  const double start = run.simulation().time();
  const double window = std::min(view_.window, state_.times.last() - start);
  RangeEnds ends;
  try {
    for (int part = 1; part <= kWindowParts; ++part) {
      const double time = start + window * part / kWindowParts;
      if (!ahead.run_until(time, kNoLimit, kNoLimit, interrupted)) return ends;
      const double disks = ends.disks;
      ends = range_ends(ahead.snapshot(), view_);
      ends.disks = std::max(ends.disks, disks);
    }
  } catch (const PhysicalStop&) {
    // The film itself runs into the same stop later.
  }
  return ends;
}

template <int D>
bool Film<D>::choose_sound(Progress& progress) {
  if (!state_.sound || state_.sound->synthesiser) return true;
  const SoundScale scale = listen_ahead();
  // The look-ahead may have been interrupted.
  if (!run_.until(run_.simulation().time(), progress)) return false;
  state_.sound->synthesiser.emplace().use(scale);
  follow(run_.simulation());
  return true;
}

// The scale of the first seconds of the film that have a click. A dense gas has many clicks within
// a frame.
template <int D>
SoundScale Film<D>::listen_ahead() const {
  constexpr double kSeconds = 2.0;
  constexpr long kManyClicks = 100'000;
  ScheduledRun<D> ahead(scene_, run_.scheduled().seed(), run_.simulation().save());
  ClickRecorder<D> clicks;
  ahead.on_change = [&clicks](Simulation<D>& next) { clicks.follow(next); };
  clicks.follow(ahead.simulation());
  ClickSums sums;
  double seconds = 0.0;
  try {
    for (long frame = 1; frame < state_.times.count; ++frame) {
      if (!ahead.run_until(state_.times.of(frame), kNoLimit, kNoLimit, interrupted)) break;
      sums.add(clicks.take());
      seconds = static_cast<double>(frame) / state_.times.fps;
      if (sums.count() >= kManyClicks || (sums.count() > 0 && seconds >= kSeconds)) break;
    }
  } catch (const PhysicalStop&) {
    // The film itself runs into the same stop later.
  }
  return sums.scale(seconds);
}

template <int D>
void Film<D>::follow(Simulation<D>& next) {
  clicks_.follow(next);
  run_.scheduled().on_change = [this](Simulation<D>& changed) { clicks_.follow(changed); };
}

// The samples between the previous frame and the next.
template <int D>
void Film<D>::render_sound(FrameSink& sink) {
  const FrameTimes& times = state_.times;
  Synthesiser& synthesiser = *state_.sound->synthesiser;
  for (const Click& click : clicks_.take()) {
    synthesiser.add(click, (click.time - times.from) / times.speed);
  }
  sink.add_sound(synthesiser.render(samples_before(state_.next, times.fps)));
  state_.sound->checksum = sink.sound_checksum();
}

// The last frame lasts as long as the others, but the run ends with it. A film that is continued
// renders these samples with the clicks of the run, so the state of the sound does not change.
template <int D>
void Film<D>::end_sound(FrameSink& sink) const {
  Synthesiser synthesiser = *state_.sound->synthesiser;
  sink.add_sound(synthesiser.render(samples_before(state_.next, state_.times.fps)));
}

template <int D>
std::vector<PngText> Film<D>::notes() const {
  const Simulation<D>& simulation = run_.simulation();
  return {{"Simulation time", fmt::format("{:.17g}", simulation.time())},
          {"State hash", fmt::format("{:016x}", simulation.state_hash())}};
}

template class Film<2>;
template class Film<3>;

}  // namespace clatter
