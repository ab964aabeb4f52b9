#pragma once

#include "engine/scene/enum_names.h"
#include "engine/scene/key_rules.h"
#include "engine/scene/key_table.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

// The keys of pictures, see scene_keys.h.

namespace clatter {

inline constexpr Limits kAzimuths = between(-kMaxAzimuth, kMaxAzimuth);
inline constexpr Limits kElevations = between(-kMaxElevation, kMaxElevation);

inline constexpr auto kCameraKeys = key_table(
    "render",
    {{"time", "t", "Simulation time at which the camera has this position. Times increase."},
     {"follow", "1", "Number of the particle in the middle of the picture, from 0."},
     {"centre", "a",
      "Point in the middle of the picture. Without a value it is the centre of the box."},
     {"width", "a", "Width of the picture. Without a value the whole box is visible."},
     {"azimuth", "deg",
      "Of spheres: as in [view], at this time. Without a value it is that angle."},
     {"elevation", "deg",
      "Of spheres: as in [view], at this time. Without a value it is that angle."}});

/// The keys of one item of [[view.camera]].
template <class Visitor>
void visit_camera(Visitor& io, CameraKey& key, int dimension) {
  io.value(kCameraKeys.at("time"), key.time, at_least(0.0));
  io.value(kCameraKeys.at("follow"), key.follow, between(0, kMaxCount));
  io.value(kCameraKeys.at("centre"), key.centre, between(-kMaxCameraWidth, kMaxCameraWidth),
           key.follow ? kNotBesideFollow : kOptional);
  io.value(kCameraKeys.at("width"), key.width, between(kMinCameraWidth, kMaxCameraWidth));
  if (dimension == 3) {
    io.value(kCameraKeys.at("azimuth"), key.azimuth, kAzimuths);
    io.value(kCameraKeys.at("elevation"), key.elevation, kElevations);
  }
}

inline constexpr auto kPaceKeys =
    key_table("view render",
              {{"time", "t", "Simulation time at which the pace has this factor. Times increase."},
               {"factor", "1", "Factor of the speed: below 1 slow motion."}});

/// The keys of one item of [[view.pace]].
template <class Visitor>
void visit_pace(Visitor& io, PaceKey& key) {
  io.value(kPaceKeys.at("time"), key.time, at_least(0.0), kRequired);
  io.value(kPaceKeys.at("factor"), key.factor, between(1e-6, 1e6), kRequired);
}

inline constexpr auto kCaptionKeys = key_table(
    "view render",
    {{"text", "",
      "Text over the picture. `_` and `^` lower and raise the next letter or the letters in "
      "braces: "
      "`T_x`, `v^2`, `T_{refined}`. A backslash before such a mark writes the mark."},
     {"from", "t",
      "Simulation time at which the text appears. Without a value it is there from the beginning."},
     {"to", "t",
      "Simulation time at which the text has disappeared. Without a value it stays to the end."}});

/// The keys of one item of [[view.captions]].
template <class Visitor>
void visit_caption(Visitor& io, Caption& caption) {
  io.value(kCaptionKeys.at("text"), caption.text, Limits{}, kRequired);
  io.value(kCaptionKeys.at("from"), caption.from, at_least(0.0));
  io.value(kCaptionKeys.at("to"), caption.to, above(caption.from.value_or(0.0)));
}

inline constexpr auto kSlabKeys = key_table(
    "view render", {{"axis", "", "Axis perpendicular to the planes."},
                    {"from", "a", "Position of the first plane."},
                    {"to", "a", "Position of the second plane. It is larger than `from`."}});

/// The keys of [view.slab].
template <class Visitor>
void visit_slab(Visitor& io, Slab& slab) {
  io.choice(kSlabKeys.at("axis"), slab.axis, kAxes, kRequired);
  io.value(kSlabKeys.at("from"), slab.from, between(-kMaxLength, kMaxLength), kRequired);
  io.value(kSlabKeys.at("to"), slab.to,
           Limits{.lowest = slab.from, .highest = kMaxLength, .above = true}, kRequired);
}

inline constexpr auto kTracerKeys = key_table(
    "view render",
    {{"particle", "1",
      "Number of the particle, from 0. It has the colour of the letters, and its path is drawn "
      "above the others. A number beyond the last particle has no path."},
     {"time", "t", "Duration of the path, which fades with age."}});

/// The keys of [view.tracer].
template <class Visitor>
void visit_tracer(Visitor& io, Tracer& tracer) {
  io.value(kTracerKeys.at("particle"), tracer.particle, between(0, kMaxCount), kRequired);
  io.value(kTracerKeys.at("time"), tracer.time, between(kMinViewTime, kMaxViewTime));
}

inline constexpr auto kSliceKeys =
    key_table("view render", {{"axis", "", "Axis perpendicular to the slice."},
                              {"position", "a", "Position of the slice on this axis."}});

/// The keys of one item of [[view.slices]].
template <class Visitor>
void visit_slice(Visitor& io, Slice& slice) {
  io.choice(kSliceKeys.at("axis"), slice.axis, kAxes, kRequired);
  io.value(kSliceKeys.at("position"), slice.position, between(0.0, kMaxLength), kRequired);
}

inline constexpr auto kLectureKeys = key_table(
    "view", {{"sliders", "",
              "Names of the sliders, as `?embed` has them. Most are keys. An empty list stands for "
              "the restitution and the drive of the scene."},
             {"plot", "",
              "The large plot: the temperature, the energy balance, the distribution of velocities "
              "or the profile."}});

/// The keys of [view.lecture].
template <class Visitor>
void visit_lecture(Visitor& io, Lecture& lecture) {
  io.value(kLectureKeys.at("sliders"), lecture.sliders, between(0, Lecture::kMostSliders));
  io.choice(kLectureKeys.at("plot"), lecture.plot, kLecturePlots);
}

inline constexpr auto kViewKeys = key_table(
    "view render",
    {{"colour_by", "",
      "Quantity that colours the particles. Spin needs rough particles or walls, species and "
      "diameter need `[[species]]`."},
     {"field", "",
      "Field of the heatmap below the particles, in a mixture also of one species. Without a value "
      "there is none."},
     {"window", "t",
      "Averaging time of the heatmap and the arrows. Profiles beside films have windows of an "
      "eighth of it."},
     {"estimator", "", "Estimator of the heatmap and the arrows, as in `measure`."},
     {"interval", "t",
      "Time between snapshots. Its range follows the `window`. The values shown are for the "
      "default window."},
     {"speed", "t/s", "Simulation time per second of film or window."},
     {"palette", "", "Colours of the particles. Quantities with a sign are blue and red."},
     {"range", "",
      "Range of the particles' colours. auto follows the picture in round steps. locked keeps the "
      "first range, in films that of their first averaging window."},
     {"opacity", "1",
      "Opacity of the particles with their spin marks: the picture is a weighted mean of pictures "
      "with and without particles. Spheres therefore fade as one front surface. Trails and arrows "
      "do not fade. 0: no particles."},
     {"field_palette", "",
      "Hues of the heatmap. Zero has the colour of the background. Particles stand out from all "
      "hues. Quantities with a sign are blue and red."},
     {"field_style", "",
      "Drawing of the heatmap. smooth interpolates between cells. cells gives each cell the colour "
      "of its exact value, and hatches cells without a value. A volume has cells."},
     {"field_range", "",
      "Range of the heatmap's colours. auto follows the picture in round steps. In films it "
      "does so after the first averaging window. locked keeps the range of the first whole "
      "window."},
     {"arrows", "", "Field of the arrows. Without a value there are none."},
     {"theme", "",
      "Colours of background, letters, walls and lines. It does not change the size of letters."},
     {"background", "", "Colour of the background. Without a value the theme sets it."},
     {"grid", "", "Grid lines over the box. Their spacing is the length of the scale bar."},
     {"tiling", "",
      "Of disks: repeats particles, trails and heatmap beyond periodic edges, at half their "
      "opacity. Each side has at most 8 copies of the box, and at least 1. Between these limits "
      "all boxes together have at most 4 million disks."},
     {"overlay", "",
      "Texts and scales: title, captions, figures, walls, colour bars and scale bar."},
     {"overlay_hides", "",
      "Parts that the overlay does not have. caption is that of the scene, captions are timed."},
     {"plots", "",
      "Plots beside the gas in films and pictures, at most 4. Profiles are along "
      "`measure.profile_axis`. The window opens its own plots with such a scene."},
     {"trails", "t",
      "Duration of the particles' trails. At the mean speed they are at most a quarter of the "
      "narrowest side long. Without a value: none."},
     {"card", "s",
      "Time of title and caption at the start of a film, while the gas moves. They fade out in the "
      "last half second. Without a value: none.",
      "render"},
     {"open_at", "t",
      "Time at which the window opens the scene. The run goes there at once. A scene that the "
      "window saves has the time of its picture. Without a value: the start.",
      "view"},
     {"azimuth", "deg",
      "Of spheres: direction of the viewer, as an angle about the y axis. 0 is along z, 90 along "
      "x."},
     {"elevation", "deg", "Of spheres: height of the viewer, as an angle above the xz plane."},
     {"view_angle", "deg", "Of spheres: horizontal angle of view. 0 is a parallel projection."},
     {"volume", "1/a",
      "Of spheres: draws the heatmap as a volume, like glowing fog. The number is its extinction "
      "coefficient at the end of the colour range. Smaller magnitudes are more transparent, and "
      "cells without a value are empty. 0: no volume. With a volume there is no default slice."}});

/// The keys of [view] in a box of this dimension, with the names of species. The list comes last,
/// because a file has it below the other keys.
template <class Visitor>
void visit_view(Visitor& io, View& view, int dimension, const std::vector<std::string>& species) {
  io.choice(kViewKeys.at("colour_by"), view.colour_by, kColourings);
  io.choice(kViewKeys.at("field"), view.field, field_names(dimension, species));
  const Limits times = between(kMinViewTime, kMaxViewTime);
  io.value(kViewKeys.at("window"), view.window, times);
  io.choice(kViewKeys.at("estimator"), view.estimator, kEstimators);
  const bool exact = view.estimator == Estimator::Exact;
  io.value(kViewKeys.at("interval"), view.interval,
           between(view.window / kMaxWindowSamples, view.window), exact ? kNotOfExact : kRequired);
  io.value(kViewKeys.at("speed"), view.speed, times);
  io.choice(kViewKeys.at("palette"), view.palette, kPalettes);
  const Limits colours = between(-ColourRange::kLargestEnd, ColourRange::kLargestEnd);
  io.value(kViewKeys.at("range"), view.range, colours);
  io.value(kViewKeys.at("opacity"), view.opacity, between(0.0, 1.0));
  io.choice(kViewKeys.at("field_palette"), view.field_palette, kFieldPalettes);
  io.choice(kViewKeys.at("field_style"), view.field_style, kFieldStyles);
  io.value(kViewKeys.at("field_range"), view.field_range, colours);
  io.choice(kViewKeys.at("arrows"), view.arrows, kArrows);
  io.choice(kViewKeys.at("theme"), view.theme, kThemes);
  io.value(kViewKeys.at("background"), view.background, Limits{});
  io.value(kViewKeys.at("grid"), view.grid);
  io.value(kViewKeys.at("tiling"), view.tiling, Limits{},
           dimension == 3 ? kNotOfSpheres : kOptional);
  io.value(kViewKeys.at("overlay"), view.overlay);
  io.choice(kViewKeys.at("overlay_hides"), view.overlay_hides, kOverlayParts);
  io.choice(kViewKeys.at("plots"), view.plots, kFilmPlots);
  io.value(kViewKeys.at("trails"), view.trails, times);
  io.value(kViewKeys.at("card"), view.card, times);
  io.value(kViewKeys.at("open_at"), view.open_at, times);
  if (dimension == 3) {
    io.value(kViewKeys.at("azimuth"), view.azimuth, kAzimuths);
    io.value(kViewKeys.at("elevation"), view.elevation, kElevations);
    io.value(kViewKeys.at("view_angle"), view.view_angle, between(0.0, kMaxViewAngle));
    io.value(kViewKeys.at("volume"), view.volume, between(0.0, kMaxVolume));
    io.table("slab", view.slab, [](auto& io, Slab& slab) { visit_slab(io, slab); });
    io.list("slices", view.slices, [](auto& io, Slice& slice) { visit_slice(io, slice); });
  }
  io.table("tracer", view.tracer, [](auto& io, Tracer& tracer) { visit_tracer(io, tracer); });
  io.table("lecture", [&](auto& io) { visit_lecture(io, view.lecture); });
  io.list("captions", view.captions,
          [](auto& io, Caption& caption) { visit_caption(io, caption); });
  io.list("pace", view.pace, [](auto& io, PaceKey& key) { visit_pace(io, key); });
  io.list("camera", view.camera,
          [&](auto& io, CameraKey& key) { visit_camera(io, key, dimension); });
}

}  // namespace clatter
