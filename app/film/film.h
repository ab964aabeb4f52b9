#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/film/companion.h"
#include "app/film/compared_scenes.h"
#include "app/film/film_ranges.h"
#include "app/film/frame_times.h"
#include "app/plots/plot_recorder.h"
#include "app/runs/run.h"
#include "engine/live/click_recorder.h"
#include "render/charts/plot_strip.h"
#include "render/output/frame_sink.h"
#include "render/sound/synthesiser.h"

// Films in parts are one film. FilmState has all data, beside the run, on which pictures depend:
// frame times, colour ranges, camera, the sums of the heatmap. Checkpoints contain it. Movie
// encodes pieces of FrameSink::kPiece frames, each with a new ffmpeg process, because an encoder
// depends on earlier frames. A checkpoint has the run before the first frame of a piece
// (Run::mark). The pictures of each piece and of the joined film are counted before pieces are
// deleted, because ffmpeg may report success on a full disk.

namespace clatter {

/// Frames of a film: `begin` <= number < `end`.
struct FrameRange {
  long begin = 0;
  long end = 0;
};

/// The sound of a film before its next frame.
struct FilmSound {
  std::optional<Synthesiser> synthesiser;  ///< absent: its scale is not chosen yet
  std::uint32_t checksum = 0;              ///< of the samples so far, see FrameSink

  /// Number of samples so far.
  long samples() const { return synthesiser ? synthesiser->samples() : 0; }
};

/// The cell of a gas in a film before the next frame.
struct CellState {
  std::optional<FilmRanges> ranges;  ///< absent: not chosen yet
  std::optional<Camera> camera;      ///< shows the whole box; absent: not chosen yet
};

/// All settings that the pictures of a film depend on, besides the scene and the run. Parts made
/// with the same settings form one film.
struct FilmState {
  FrameTimes times;
  Size size;                       ///< of the pictures
  int samples = 1;                 ///< samples per pixel along each axis
  double shutter = 0.0;            ///< exposure as a share of the time between two frames
  bool transparent = false;        ///< without a background
  Encoding encoding = Encoding::Balanced;  ///< of a film in a file
  bool overlay = true;             ///< whether pictures have text
  bool picture = false;            ///< one picture, at times.from; not a film
  std::optional<FilmSound> sound;  ///< absent: a silent film
  long next = 0;                   ///< number of the next frame
  std::optional<long> begin;       ///< of the part in progress; absent: none
  std::string shown;               ///< fields of the past, see ScheduledRun::save_shown()
  std::string plots = {};          ///< see PlotRecorder::save(); empty: no plots
  std::vector<std::uint32_t> checksums = {};  ///< of the pieces before `next`, see FrameSink
  std::vector<PngText> notes = {};            ///< of the picture before `next`
  std::vector<CellState> cells = {};          ///< of all gases, in order
  std::vector<std::string> companions = {};   ///< the gases after the first, see Companion::save()

  /// The simulation time that a frame averages over, before its own time, at a speed.
  double exposure(double speed) const { return shutter * speed / times.fps; }
  /// The largest exposure of a frame.
  double largest_exposure() const { return exposure(times.largest_speed()); }
};

/// The bytes of a film's state in a checkpoint.
std::string to_bytes(FilmState state);

/// The film of a checkpoint. Absent without a film. Throws UserError if it is damaged.
std::optional<FilmState> film_of(const Resumed& resumed);

/// Films a run, frame by frame. The first colour ranges come from the first averaging window of the
/// whole film, which the run computes in advance. Automatic ranges then follow the frames, see
/// moved(). The scale of the sound also comes from a run in advance, and stays. Companions are
/// drawn in cells beside the run, at the same times and with the same ranges. Plots of all gases
/// are beside the cells.
template <int D>
class Film {
 public:
  /// A film of a run at frame `state.next`. A film of one frame takes its ranges from this frame.
  /// `compared` has the scene of the run, and then those of its companions, if any.
  Film(Run<D>& run, const std::vector<ComparedScene>& compared, const View& view, FilmState state,
       int threads, const Gl& gl);

  /// Draws the remaining frames of the range into a sink. Earlier frames are simulated, not drawn.
  /// Ends early if the run does. Returns the number of the next frame. Checkpoints continue from
  /// the last drawn frame whose number is a multiple of FrameSink::kPiece: the pictures after it
  /// may be lost until the sink is finished.
  long draw(const FrameRange& frames, FrameSink& sink, Progress& progress);
  /// Ends the part that draw() has drawn, after the sink is finished. Checkpoints then have the
  /// present state of the run.
  void end_part();

 private:
  std::string state_now();
  FilmPlots film_plots() const;
  bool reach(double time, Progress& progress);
  Size gases_size() const;
  void add_cells(const std::vector<ComparedScene>& compared, const View& view, int threads,
                 const Gl& gl);
  bool companions_until(double time);
  bool choose_ranges(Progress& progress);
  std::vector<RangeEnds> shared(const std::vector<RangeEnds>& extents) const;
  void begin_ranges(const std::vector<RangeEnds>& extents);
  void move_ranges(const std::vector<Snapshot>& snapshots);
  std::vector<Snapshot> snapshots();
  Image picture_of(const std::vector<Snapshot>& snapshots);
  bool choose_sound(Progress& progress);
  void listen();
  std::vector<Click> take_clicks();
  Image strip();
  void render_sound(FrameSink& sink);
  void end_sound(FrameSink& sink) const;
  std::vector<PngText> notes() const;

  Run<D>& run_;
  Scene scene_;
  View view_;
  FilmState state_;
  std::vector<std::unique_ptr<Companion>> companions_;
  std::deque<FilmCell> cells_;              ///< of the run, then of its companions
  std::optional<ClickRecorder<D>> clicks_;  ///< from the first frame on, if the film has sound
  std::optional<PlotRecorder<D>> plots_;    ///< absent: no plots
  std::optional<PlotStrip> strip_;          ///< present with plots
};

extern template class Film<2>;
extern template class Film<3>;

}  // namespace clatter
