#include "app/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/film/companion.h"
#include "app/film/film_limits.h"
#include "engine/checkpoint/archive.h"
#include "engine/error.h"
#include "engine/system/signals.h"
#include "render/output/cells.h"

namespace clatter {

template <class Archive>
static void visit(Archive& io, PaceKey& key) {
  io(key.time, key.factor);
}

template <class Archive>
static void visit(Archive& io, Encoding& encoding) {
  auto number = static_cast<std::uint32_t>(encoding);
  io(number);
  encoding = static_cast<Encoding>(number);
}

template <class Archive>
static void visit(Archive& io, FrameTimes& times) {
  auto& [from, speed, fps, count, pace] = times;
  io(from, speed, fps, count, pace);
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
static void visit(Archive& io, CellState& state) {
  auto& [ranges, camera] = state;
  io(ranges, camera);
}

// Whether the sound ends at the next frame, or, in a complete film, at the last.
static bool fits(const std::optional<FilmSound>& sound, long next, double fps) {
  if (!sound || !sound->synthesiser) return true;
  return sound->samples() <= samples_before(next, fps) &&
         sound->samples() >= samples_before(std::max(next - 1, 0L), fps);
}

// Whether a film can have this state: its settings are those of flags, and its next frame is in it.
static bool makes_sense(const FilmState& state) {
  const FrameTimes& times = state.times;
  return times.count >= 1 && times.count <= kMostFrames && state.next >= 0 &&
         state.next <= times.count && times.fps >= 1.0 && times.fps <= kMostFps &&
         times.speed > 0.0 && std::isfinite(times.speed) && std::isfinite(times.from) &&
         state.samples >= 1 && state.samples <= kMostSamples && state.encoding >= Encoding::Fast &&
         state.encoding <= Encoding::Small && std::min(state.size.width, state.size.height) >= 1 &&
         std::max(state.size.width, state.size.height) <= kLongestSide && state.shutter >= 0.0 &&
         state.shutter <= 1.0 && state.begin.value_or(0) >= 0 &&
         state.begin.value_or(0) <= times.count && fits(state.sound, state.next, times.fps);
}

template <class Archive>
static void visit(Archive& io, FilmState& state) {
  auto& [times, size, samples, shutter, transparent, encoding, overlay, picture, sound, next, begin,
         shown, plots, checksums, notes, cells, companions] = state;
  io(times, size, samples, shutter, transparent, encoding, overlay, picture, sound, next, begin,
     shown, plots, checksums, notes, cells, companions);
  io.require(makes_sense(state));
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

// The texts of the cells. Cells beside each other have headings of one height and no captions.
static std::vector<OverlayText> texts_of(const std::vector<ComparedScene>& compared) {
  const Scene& first = compared.front().scene;
  OverlayText text{first.title, first.caption};
  if (compared.size() == 1) return {text};
  text.caption.clear();
  text.others = cell_titles(compared);
  std::vector<OverlayText> texts(compared.size(), text);
  for (std::size_t k = 0; k < texts.size(); ++k) texts[k].title = text.others[k];
  return texts;
}

template <int D>
Film<D>::Film(Run<D>& run, const std::vector<ComparedScene>& compared, const View& view,
              FilmState state, int threads, const Gl& gl)
    : run_(run), scene_(compared.front().scene), view_(view), state_(std::move(state)) {
  const std::size_t companions = compared.size() - 1;
  if (state_.next > 0 && state_.companions.size() != companions) {
    throw UserError({"--resume", 0, 0},
                    fmt::format("the number of gases in the film of the checkpoint is {}, not {}",
                                state_.companions.size() + 1, compared.size()),
                    "give the same scenes, or begin another film with --from");
  }
  state_.companions.resize(companions);
  state_.cells.resize(compared.size());
  run_.scheduled().show(view, state_.shown, state_.largest_exposure());
  run_.film_state = [this] { return state_now(); };
  if (!view.plots.empty()) {
    plots_.emplace(run_.scheduled(), film_plots(), state_.plots);
    strip_.emplace(gl, split_for_plots(state_.size).plots.size, state_.size, state_.transparent);
  }
  add_cells(compared, view, threads, gl);
  if (state_.sound && state_.sound->synthesiser) listen();
}

// All gases have the plots of the first one.
template <int D>
FilmPlots Film<D>::film_plots() const {
  return {view_.plots, scene_.measure.profile_axis, state_.times.speed};
}

// Size of the part of a picture that shows the gases.
template <int D>
Size Film<D>::gases_size() const {
  return strip_ ? split_for_plots(state_.size).gases.size : state_.size;
}

// The cells of the run and of its companions, and the companions.
template <int D>
void Film<D>::add_cells(const std::vector<ComparedScene>& compared, const View& view, int threads,
                        const Gl& gl) {
  const std::vector<OverlayText> texts = texts_of(compared);
  const Size whole = gases_size();
  const auto add = [&](std::size_t k, const View& own) {
    const PictureCell cell =
        picture_cell(whole, static_cast<int>(k), static_cast<int>(texts.size()));
    cells_.emplace_back(gl, cell.size, state_.samples, state_.transparent, own, texts[k]);
  };
  add(0, view);
  for (std::size_t k = 1; k < compared.size(); ++k) {
    View own = compared[k].scene.view;
    own.overlay = own.overlay && view.overlay;
    companions_.push_back(companion_of(compared[k], own, film_plots(), state_.largest_exposure(),
                                       threads, state_.companions[k - 1], "--resume"));
    add(k, own);
  }
}

template <int D>
std::string Film<D>::state_now() {
  FilmState state = state_;
  state.shown = run_.scheduled().save_shown();
  if (plots_) state.plots = plots_->save();
  for (std::size_t k = 0; k < companions_.size(); ++k) {
    state.companions[k] = companions_[k]->save();
  }
  return to_bytes(std::move(state));
}

template <int D>
long Film<D>::draw(const FrameRange& frames, FrameSink& sink, Progress& progress) {
  const long first = std::max(state_.next, frames.begin);
  state_.begin = frames.begin;
  for (; state_.next < frames.end; ++state_.next) {
    const long frame = state_.next;
    if (!reach(state_.times.of(frame), progress) || !choose_ranges(progress) ||
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
    const std::vector<Snapshot> now = snapshots();
    if (frame < first) continue;
    if (state_.times.count > 1) {
      const double seconds = static_cast<double>(frame) / state_.times.fps;
      for (FilmCell& cell : cells_) cell.show_card(seconds);
    }
    Image picture;
    try {
      picture = picture_of(now);
    } catch (const Interrupted&) {
      run_.until(state_.times.of(frame), progress);  // notes the early end
      return frame;
    }
    state_.notes = notes();
    sink.add(state_.transparent ? with_own_colours(picture) : picture, state_.notes);
    progress.update(now[0].time);
  }
  if (state_.sound && state_.next == state_.times.count) end_sound(sink);
  return state_.next;
}

template <int D>
void Film<D>::end_part() {
  state_.begin.reset();
  run_.mark();
}

// Brings all gases to a time. Returns false at an early end.
template <int D>
bool Film<D>::reach(double time, Progress& progress) {
  const auto run = [&](double end) { return run_.until(end, progress); };
  return (plots_ ? plots_->run_until(time, run) : run(time)) && companions_until(time);
}

// Brings the companions to the time of the run. Returns false at an interrupt or a stop.
template <int D>
bool Film<D>::companions_until(double time) {
  for (std::size_t k = 0; k < companions_.size(); ++k) {
    try {
      if (companions_[k]->run_until(time)) continue;
      run_.end_early();
    } catch (const PhysicalStop& stop) {
      const auto name = static_cast<char>('B' + k);
      run_.end_early(PhysicalStop(std::string(1, name) + ": " + stop.what()));
    }
    return false;
  }
  return true;
}

// All snapshots of the present frame. The first ones choose the cameras.
template <int D>
std::vector<Snapshot> Film<D>::snapshots() {
  std::vector<Snapshot> now = {run_.scheduled().snapshot()};
  for (const auto& companion : companions_) now.push_back(companion->snapshot());
  const double speed = state_.times.speed_at(now[0].time);
  for (Snapshot& snapshot : now) {
    snapshot.exposure = std::min(snapshot.exposure, state_.exposure(speed));
  }
  for (FilmCell& cell : cells_) cell.set_speed(speed);
  move_ranges(now);
  for (std::size_t k = 0; k < now.size(); ++k) {
    std::optional<Camera>& camera = state_.cells[k].camera;
    if (!camera) camera = cells_[k].fit(now[k]);
  }
  return now;
}

template <int D>
Image Film<D>::picture_of(const std::vector<Snapshot>& snapshots) {
  std::vector<Image> pictures;
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    pictures.push_back(cells_[k].draw(snapshots[k], *state_.cells[k].camera));
  }
  if (!strip_) return joined_cells(state_.size, std::move(pictures));
  const auto [gases, plots] = split_for_plots(state_.size);
  std::vector<PlacedPicture> parts;
  parts.push_back({gases, joined_cells(gases.size, std::move(pictures))});
  parts.push_back({plots, strip()});
  return joined(state_.size, parts);
}

// The picture of the plots. Several gases have the letters of their cells.
template <int D>
Image Film<D>::strip() {
  std::vector<PlottedGas> gases = {plots_->gas()};
  for (const auto& companion : companions_) gases.push_back(companion->plotted());
  for (std::size_t k = 0; k < gases.size(); ++k)
    gases[k].name = std::string(1, static_cast<char>('A' + k));
  const ThemeColours theme = theme_of(view_);
  std::vector<std::optional<LivePlot>> plots;
  for (const FilmPlot plot : view_.plots) plots.push_back(film_plot(plot, gases, theme));
  return strip_->draw(plots, theme);
}

template <int D>
bool Film<D>::choose_ranges(Progress& progress) {
  if (state_.cells[0].ranges || state_.times.count == 1) return true;
  const double last = state_.times.last();
  std::vector<RangeEnds> extents = {
      first_extents(run_.scheduled(), scene_, cells_[0].view(), state_.largest_exposure(), last)};
  for (const auto& companion : companions_) extents.push_back(companion->first_extents(last));
  // The look-ahead may have been interrupted.
  if (!run_.until(run_.simulation().time(), progress)) return false;
  begin_ranges(extents);
  return true;
}

// The extents that all cells have together.
template <int D>
std::vector<RangeEnds> Film<D>::shared(const std::vector<RangeEnds>& extents) const {
  std::vector<View> views;
  for (const FilmCell& cell : cells_) views.push_back(cell.view());
  return shared_extents(extents, views);
}

template <int D>
void Film<D>::begin_ranges(const std::vector<RangeEnds>& extents) {
  const std::vector<RangeEnds> all = shared(extents);
  for (std::size_t k = 0; k < cells_.size(); ++k) state_.cells[k].ranges = first_ranges(all[k]);
}

// Moves the ranges of all cells to those of the present frame. A single picture begins with them.
template <int D>
void Film<D>::move_ranges(const std::vector<Snapshot>& snapshots) {
  const bool single = state_.times.count == 1;
  std::vector<RangeEnds> extents;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const View& view = cells_[k].view();
    extents.push_back(single ? extents_of(snapshots[k], view)
                             : settled_extents(snapshots[k], view));
  }
  if (single) begin_ranges(extents);
  const std::vector<RangeEnds> all = shared(extents);
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    FilmRanges& ranges = *state_.cells[k].ranges;
    ranges = moved(ranges, all[k], cells_[k].view(), state_.times.fps);
    cells_[k].fix(ranges.shown);
  }
}

template <int D>
bool Film<D>::choose_sound(Progress& progress) {
  if (!state_.sound || state_.sound->synthesiser) return true;
  std::vector<SoundPreview> gases;
  gases.push_back(preview_of(run_.scheduled(), scene_));
  for (const auto& companion : companions_) gases.push_back(companion->preview());
  const SoundScale scale = sound_scale(gases, state_.times);
  // The look-ahead may have been interrupted.
  if (!run_.until(run_.simulation().time(), progress)) return false;
  state_.sound->synthesiser.emplace().use(scale);
  listen();
  return true;
}

// Lists the clicks of all gases from now on.
template <int D>
void Film<D>::listen() {
  clicks_.emplace(run_.simulation());
  for (const auto& companion : companions_) companion->listen();
}

// The clicks of all gases since the last call. Each gas is heard from the side of its cell.
template <int D>
std::vector<Click> Film<D>::take_clicks() {
  const auto count = static_cast<int>(cells_.size());
  const Size whole = gases_size();
  std::vector<Click> all;
  const auto add = [&](int number, std::vector<Click> clicks) {
    const PictureCell cell = picture_cell(whole, number, count);
    for (Click& click : clicks) {
      click.place = (cell.left + click.place * cell.size.width) / whole.width;
      all.push_back(click);
    }
  };
  add(0, clicks_->take());
  for (int k = 1; k < count; ++k)
    add(k, companions_[static_cast<std::size_t>(k - 1)]->take_clicks());
  return all;
}

// The samples between the previous frame and the next.
template <int D>
void Film<D>::render_sound(FrameSink& sink) {
  const FrameTimes& times = state_.times;
  Synthesiser& synthesiser = *state_.sound->synthesiser;
  for (const Click& click : take_clicks()) {
    synthesiser.add(click, times.seconds_at(click.time));
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
  std::vector<PngText> notes = {{"Simulation time", fmt::format("{:.17g}", simulation.time())},
                                {"State hash", fmt::format("{:016x}", simulation.state_hash())}};
  for (std::size_t k = 0; k < companions_.size(); ++k) {
    notes.push_back({fmt::format("State hash {}", static_cast<char>('B' + k)),
                     fmt::format("{:016x}", companions_[k]->state_hash())});
  }
  return notes;
}

template class Film<2>;
template class Film<3>;

}  // namespace clatter
