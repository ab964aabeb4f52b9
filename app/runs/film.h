#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/runs/run.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"
#include "render/output/frame_sink.h"

namespace clatter {

/// Frames of a film, from number `begin` on and before `end`.
struct FrameRange {
  long begin = 0;
  long end = 0;
};

/// When a film's frames are: the k-th at from + k speed/fps.
struct FrameTimes {
  double from = 0.0;   ///< simulation time of the first
  double speed = 1.0;  ///< simulation time per second of film
  double fps = 30.0;   ///< frames per second of film
  long count = 1;      ///< of the whole film, of which parts may be made elsewhere

  double of(long frame) const { return from + static_cast<double>(frame) * (speed / fps); }
  double last() const { return of(count - 1); }
};

/// All that the pictures of a film depend on beside the scene and the run, so that films made in
/// parts are one film.
struct FilmState {
  FrameTimes times;
  Size size;                        ///< of the pictures
  int samples = 1;                  ///< drawn along each axis for a pixel
  double shutter = 0.0;             ///< share of the time between frames that each of them shows
  bool transparent = false;         ///< without a background
  bool overlay = true;              ///< whether anything is written on them
  long next = 0;                    ///< number of the frame that comes next
  std::optional<long> begin;        ///< of the part that is being drawn; absent: none is
  std::optional<RangeEnds> ranges;  ///< absent: not chosen yet
  std::optional<Camera> camera;     ///< that shows the whole box; absent: not chosen yet
  std::string shown;                ///< of the time before, see ScheduledRun::save_shown()
  std::vector<std::uint32_t> checksums = {};  ///< of the pieces before `next`, see FrameSink
  std::vector<PngText> notes = {};            ///< of the picture before `next`

  /// The time up to a frame that it shows.
  double exposure() const { return shutter * times.speed / times.fps; }
};

/// A film's state as checkpoints keep it.
std::string to_bytes(FilmState state);

/// The film of a checkpoint, if there is one. Throws UserError where it is damaged.
std::optional<FilmState> film_of(const Resumed& resumed);

/// Films a run: draws one frame after the other. Automatic colour ranges are chosen once, by what
/// is shown in the first averaging window of the whole film, which the run goes through ahead.
template <int D>
class Film {
 public:
  /// Of a run that has come to frame `state.next`. A film of a single frame chooses its ranges by
  /// that.
  Film(Run<D>& run, const Scene& scene, const View& view, FilmState state, const Gl& gl);

  /// Draws those of the frames that are still to come into a sink, and only goes through those
  /// before; ends early where the run does. Returns the number of the frame that comes next.
  /// Checkpoints go on from the last frame whose number is a multiple of FrameSink::kPiece.
  long draw(const FrameRange& frames, FrameSink& sink, Progress& progress);

 private:
  std::string state_now() const;
  bool choose_ranges(Progress& progress);
  RangeEnds look_ahead() const;
  std::vector<PngText> notes() const;

  Run<D>& run_;
  const Scene& scene_;
  View view_;
  OverlayText text_;
  FilmState state_;
  Canvas canvas_;
  Renderer renderer_;
};

extern template class Film<2>;
extern template class Film<3>;

}  // namespace clatter
