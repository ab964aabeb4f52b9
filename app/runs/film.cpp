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
static void visit(Archive& io, FilmState& state) {
  auto& [times, size, samples, shutter, transparent, overlay, next, begin, ranges, camera, shown,
         checksums, notes] = state;
  io(times, size, samples, shutter, transparent, overlay, next, begin, ranges, camera, shown,
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
    if (!run_.until(state_.times.of(frame), progress) || !choose_ranges(progress)) return frame;
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
std::vector<PngText> Film<D>::notes() const {
  const Simulation<D>& simulation = run_.simulation();
  return {{"Simulation time", fmt::format("{:.17g}", simulation.time())},
          {"State hash", fmt::format("{:016x}", simulation.state_hash())}};
}

template class Film<2>;
template class Film<3>;

}  // namespace clatter
