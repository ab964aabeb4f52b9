#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/film/compared_scenes.h"
#include "app/film/frame_times.h"
#include "app/plots/plot_recorder.h"
#include "engine/picture/snapshot.h"
#include "engine/run/scheduled_run.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"
#include "render/output/image.h"
#include "render/sound/synthesiser.h"

// Films of several gases have a FilmCell per gas, which draws it as if it were alone. The first gas
// is the Run. Each of the others is a Companion that runs to the same times; it hides whether its
// scene has disks or spheres. Colour ranges are the larger ends of all cells. The companions' runs
// are part of FilmState.

namespace clatter {

/// A copy of a gas that runs ahead to a simulation time. Adds its clicks since the last call, and
/// returns false at an interrupt. Throws PhysicalStop.
using SoundPreview = std::function<bool(double time, ClickSums& sums)>;

/// A preview from the present time of a run of `scene`. The run stays where it is.
template <int D>
SoundPreview preview_of(const ScheduledRun<D>& run, const Scene& scene);

/// The scale of the first seconds of a film that have a click, over all of its gases. Ends early at
/// an interrupt and where a gas stops.
SoundScale sound_scale(const std::vector<SoundPreview>& gases, const FrameTimes& times);

/// Draws a gas into its cell of the pictures of a film.
class FilmCell {
 public:
  /// A cell of `size` with the heading `text`. The other arguments are as for Renderer.
  FilmCell(const Gl& gl, Size size, int samples, bool transparent, const View& view,
           OverlayText text);

  const View& view() const { return view_; }
  /// Sets the ends of the automatic colour ranges.
  void fix(const RangeEnds& ends) { ranges_.fix(ends); }
  /// The camera that shows the whole box.
  Camera fit(const Snapshot& snapshot) {
    return renderer_.fit(snapshot, canvas_.size(), view_, text_, ranges_.legends(snapshot, view_));
  }
  /// Sets the simulation time per second of film, for captions that fade.
  void set_speed(double speed) { text_.speed = speed; }
  /// Sets the title card to its state `seconds` after the start of the film.
  void show_card(double seconds);
  /// The picture of a snapshot. `whole` is the result of fit(). Throws Interrupted.
  Image draw(const Snapshot& snapshot, const Camera& whole);

 private:
  View view_;
  OverlayText text_;
  Canvas canvas_;
  Renderer renderer_;
  AutoRanges ranges_;
};

/// A gas beside the run of a film, in step with it. Its scene has disks or spheres.
class Companion {
 public:
  virtual ~Companion() = default;

  /// Runs to a simulation time. Returns false at an interrupt. Throws PhysicalStop.
  virtual bool run_until(double time) = 0;
  /// The gas at its time.
  virtual Snapshot snapshot() = 0;
  /// The gas for plots, without a name. Only if the film has plots. Valid until the next call.
  virtual PlottedGas plotted() = 0;
  /// Lists its clicks from now on.
  virtual void listen() = 0;
  /// The clicks since the last call, after listen().
  virtual std::vector<Click> take_clicks() = 0;
  /// As preview_of().
  virtual SoundPreview preview() const = 0;
  /// As first_extents().
  virtual RangeEnds first_extents(double last) const = 0;
  /// As Simulation::state_hash().
  virtual std::uint64_t state_hash() const = 0;
  /// The run, its scene and its averages, for a checkpoint.
  virtual std::string save() = 0;
};

/// Starts the run of a scene with the averages of a view and the plots of a film, or continues the
/// result of save(); empty: none. `file` is the name of the checkpoint. Throws UserError if `saved`
/// has another scene or seed.
std::unique_ptr<Companion> companion_of(const ComparedScene& compared, const View& view,
                                        const FilmPlots& plots, double exposure, int threads,
                                        const std::string& saved, const std::string& file);

}  // namespace clatter
