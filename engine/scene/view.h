#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/field.h"
#include "engine/vec.h"

namespace clatter {

/// Quantity that a particle's colour shows.
enum class ColourBy {
  None,
  Speed,
  VelocityX,
  VelocityY,
  VelocityZ,
  Spin,
  Depth,
  Species,
  Diameter
};

/// Whether the colours of particles show the values of a quantity, on a scale.
constexpr bool has_scale(ColourBy colour_by) {
  return colour_by != ColourBy::None && colour_by != ColourBy::Species;
}

/// An axis of the box.
enum class Axis { X, Y, Z };

/// The colour maps for magnitudes.
enum class Palette { Viridis, Inferno, Cividis };

/// The colour maps for magnitudes of fields.
enum class FieldPalette { Blue, Grey, Viridis, Inferno, Cividis };

/// Drawing of a field between the centres of its cells.
enum class FieldStyle {
  Smooth,  ///< interpolated
  Cells    ///< one colour per cell
};

/// The colours of background, letters, walls and lines.
enum class Theme { Dark, Light, Projector };

/// A colour in sRGB.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

/// Range of values of a colour scale.
struct ColourRange {
  enum Kind {
    Auto,    ///< follows the shown values, in round steps
    Locked,  ///< keeps its first range; of a heatmap that of the first whole window
    Given    ///< the ends
  };
  /// Largest magnitude of an end, and least distance between both ends.
  static constexpr double kLargestEnd = 1e300, kLeastWidth = 1e-300;

  Kind kind = Auto;
  std::array<double, 2> ends = {0.0, 1.0};  ///< low < high, of Given

  bool operator==(const ColourRange&) const = default;
};

/// A key of the camera's path. Between two keys the camera is interpolated.
struct CameraKey {
  double time = 0.0;            ///< simulation time, >= 0
  std::optional<VecX> centre;   ///< world point in the middle; absent: centre of the box
  std::optional<int> follow;    ///< number of the particle in the middle, instead of a centre
  std::optional<double> width;  ///< width in world units, > 0; absent: the whole box is visible
  std::optional<double> azimuth = {};    ///< of spheres, degrees; absent: as View::azimuth
  std::optional<double> elevation = {};  ///< of spheres, degrees; absent: as View::elevation
};

/// A key of the pace of films and of the window. Between two keys the factor changes at a constant
/// rate while the gas plays.
struct PaceKey {
  double time = 0.0;    ///< simulation time, >= 0
  double factor = 1.0;  ///< of View::speed, > 0
};

/// A text over pictures, for some time.
struct Caption {
  std::string text;                 ///< see marked_text()
  std::optional<double> from = {};  ///< simulation time, >= 0; absent: from the beginning
  std::optional<double> to = {};    ///< simulation time, > from; absent: to the end
};

/// The part of the box between two planes across an axis.
struct Slab {
  Axis axis = Axis::Z;
  double from = 0.0, to = 1.0;  ///< positions of the planes, from < to
};

/// A particle with a colour of its own, whose path is drawn.
struct Tracer {
  int particle = 0;    ///< its number; beyond the last one: no particle
  double time = 20.0;  ///< duration of the path, > 0

  bool operator==(const Tracer&) const = default;
};

/// A plane across an axis, on which the heatmap of spheres is drawn.
struct Slice {
  Axis axis = Axis::Z;
  double position = 0.0;
};

/// The plot of lecture mode.
enum class LecturePlot { None, Temperature, Energy, Velocities, Profile };

/// The parts of the window in lecture mode.
struct Lecture {
  static constexpr int kMostSliders = 3;

  std::vector<std::string> sliders;  ///< names of at most kMostSliders; empty: chosen by the scene
  LecturePlot plot = LecturePlot::Temperature;
};

/// A plot beside the gas in films. The profiles are along Measure::profile_axis, in the order of
/// profiled_fields().
enum class FilmPlot {
  Temperature,
  Energy,
  Velocities,
  SpeciesTemperature,       ///< of mixtures only
  Mixing,                   ///< of mixtures only
  Compartments,             ///< of a scene with a divider, see divider_of()
  Piston,                   ///< of a scene with a free piston
  MeanSquaredDisplacement,  ///< with this observable only
  VelocityAutocorrelation,  ///< with this observable only
  DensityProfile,
  TemperatureProfile,
  StressProfile,
  HeatFluxProfile,
  DissipationProfile
};

/// Whether a plot is a profile.
constexpr bool is_profile(FilmPlot plot) {
  return plot >= FilmPlot::DensityProfile;
}

/// A part of the overlay: texts and scales on a picture.
enum class OverlayPart {
  Title,
  Caption,  ///< of the scene
  Time,
  Temperature,
  Collisions,
  Walls,  ///< kind of each wall
  ColourBars,
  ScaleBar,
  Captions  ///< timed texts, View::captions
};

/// Settings of pictures.
struct View {
  static constexpr std::size_t kMostPlots = 4;

  ColourBy colour_by = ColourBy::Speed;
  std::optional<Field> field;              ///< the heatmap below the particles; absent: none
  double window = 20.0;                    ///< averaging time of the live field, > 0
  Estimator estimator = Estimator::Exact;  ///< of the live field
  double interval = 0.1;  ///< between samples of the snapshot estimator, > 0 and at most the window
  double speed = 1.0;     ///< simulation time per second of film, > 0
  Palette palette = Palette::Viridis;               ///< of the particles' magnitudes
  ColourRange range;                                ///< of the particles' colours
  double opacity = 1.0;                             ///< of the particles, 0..1; 0: hidden
  FieldPalette field_palette = FieldPalette::Blue;  ///< of the heatmap's magnitudes
  FieldStyle field_style = FieldStyle::Smooth;      ///< of the heatmap; a volume has cells
  ColourRange field_range;                          ///< of the heatmap's colours
  std::optional<Quantity> arrows;  ///< one of kArrows, averaged as the heatmap; absent: none
  Theme theme = Theme::Dark;       ///< of background, letters, walls and lines
  std::optional<Rgb> background;   ///< absent: as the theme
  bool grid = false;               ///< lines over the box, spaced by the length of the scale bar
  bool tiling = false;             ///< of disks: repeats the gas beyond periodic edges
  bool overlay = true;             ///< time, title, captions, colour bar, scale bar
  std::vector<OverlayPart> overlay_hides = {};  ///< parts that the overlay does not have
  std::vector<FilmPlot> plots = {};             ///< beside the gas in films, at most kMostPlots
  std::optional<double> trails;       ///< duration of the particles' trails, > 0; absent: none
  std::optional<Tracer> tracer = {};  ///< absent: none
  std::optional<double> card;  ///< seconds of the title card at a film's start, > 0; absent: none
  /// Simulation time > 0 at which the window opens the scene; absent: its start.
  std::optional<double> open_at = {};
  /// Direction to the viewer of spheres, in degrees: 0, 0 is along z, from the front; azimuth turns
  /// about the y axis towards x, elevation raises the viewer towards y.
  double azimuth = 30.0, elevation = 20.0;
  double view_angle = 25.0;  ///< of spheres: horizontal angle of view, degrees; 0: orthographic
  std::optional<Slab> slab = {};   ///< only spheres, or their parts, in it are drawn; absent: all
  std::vector<Slice> slices = {};  ///< of the heatmap of spheres; empty: the middle plane across z
  /// Of the heatmap of spheres, drawn as a volume: extinction coefficient at the end of its colour
  /// range, 1/a; 0: no volume. With a volume there is no slice unless `slices` has it.
  double volume = 0.0;
  Lecture lecture = {};            ///< parts of the window in lecture mode
  std::vector<Caption> captions;   ///< in any order; several at one time are below each other
  std::vector<PaceKey> pace = {};  ///< in order of time; empty: the factor is 1
  std::vector<CameraKey> camera;   ///< in order of time; empty: always the whole box

  /// Replaces colours and fields of spins: the colour by the speed, the heatmap by none. Returns
  /// whether there were any.
  bool hide_spins();
  /// Whether the overlay, if any, lacks a part.
  bool hides(OverlayPart part) const;
  /// Whether it shows time averages: a heatmap or arrows.
  bool shows_averages() const { return field || arrows; }
  /// Whether another view needs the same averages.
  bool averages_like(const View& other) const {
    return field == other.field && arrows == other.arrows && window == other.window &&
           estimator == other.estimator && interval == other.interval;
  }
};

}  // namespace clatter
