#include "render/layers/auto_ranges.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "render/contrast_maps.h"
#include "render/label.h"
#include "render/layers/disk_colours.h"
#include "render/layers/field_layer.h"
#include "render/species_colours.h"
#include "render/theme.h"

namespace clatter {

namespace {

ColourMap map_of(Sign sign, const View& view, Colour ground) {
  return sign == Sign::Either ? signed_particle_map(ground) : particle_map(view.palette, ground);
}

ColourMap map_of(Field field, const View& view, Colour ground) {
  return sign_of(field) == Sign::Either ? signed_field_map(ground)
                                        : field_map(view.field_palette, ground);
}

// The first colour is the smallest magnitude. For Sign::Either it is the smallest value.
ColourScale scale_from(double low, double high, Sign sign, ColourMap map) {
  switch (sign) {
    case Sign::Positive:
      return {map, low, high};
    case Sign::Negative:
      return {map, high, low};
    case Sign::Either:
      return {.map = map, .low = low, .high = high, .about_zero = true};
  }
  return {map};
}

ColourScale scale_to(double extent, Sign sign, ColourMap map) {
  return scale_from(sign == Sign::Positive ? 0.0 : -extent, sign == Sign::Negative ? 0.0 : extent,
                    sign, map);
}

double disk_extent(const Snapshot& snapshot, ColourBy colour_by) {
  if (colour_by == ColourBy::Depth) return 0.5 * snapshot.box.norm();
  std::vector<double> values(snapshot.count());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = disk_value(snapshot, colour_by, i);
  return robust_extent(std::move(values));
}

// The extent of the values that a heatmap shows.
double field_extent(const Snapshot& snapshot, const View& view) {
  const FieldMap& map = *snapshot.field;
  if (!has_values(map)) return 0.0;
  const bool smooth = style_of(map.field, view) == FieldStyle::Smooth && map.cells.size() == 2;
  return robust_extent(smooth ? smoothed(plane_of(snapshot)).values : map.values);
}

double arrow_extent(const ArrowMap& map) {
  std::vector<double> sizes;
  for (const ArrowMap::Arrow& arrow : map.arrows) sizes.push_back(arrow.value.norm());
  return robust_extent(std::move(sizes));
}

bool shows_field(const Snapshot& snapshot, const View& view) {
  return view.field && snapshot.field;
}

}  // namespace

RangeEnds extents_of(const Snapshot& snapshot, const View& view) {
  RangeEnds extents;
  if (has_scale(view.colour_by)) extents.disks = disk_extent(snapshot, view.colour_by);
  if (shows_field(snapshot, view)) extents.field = field_extent(snapshot, view);
  if (view.arrows && snapshot.arrows) extents.arrows = arrow_extent(*snapshot.arrows);
  return extents;
}

Legend AutoRanges::Followed::legend(const Label& shown, const ColourRange& range, ColourMap map,
                                    const std::function<double()>& extent, bool lockable) {
  if (range.kind == ColourRange::Given) {
    return {shown, scale_from(range.ends[0], range.ends[1], shown.sign, map), "given"};
  }
  const bool locked = range.kind == ColourRange::Locked;
  const double last = end(shown, extent, locked && lockable);
  const bool held = locked && (fixed > 0.0 || followed.held());
  return {shown, scale_to(last, shown.sign, map), held ? "locked" : "auto"};
}

double AutoRanges::Followed::end(const Label& shown, const std::function<double()>& extent,
                                 bool hold) {
  if (fixed > 0.0) return fixed;
  if (!(label == shown)) *this = {shown, {}};
  return followed.follow(extent(), hold);
}

void AutoRanges::fix(const RangeEnds& ends) {
  const auto fixed = [](double end) { return end > 0.0 ? end : 1.0; };
  disks_.fixed = fixed(ends.disks);
  field_.fixed = fixed(ends.field);
  arrows_.fixed = fixed(ends.arrows);
}

Legends AutoRanges::legends(const std::vector<const Snapshot*>& snapshots, const View& view) {
  const Snapshot& first = *snapshots.front();
  const auto dimension = static_cast<int>(first.box.size());
  const Colour ground = theme_of(view).background;
  const auto largest = [&](auto extent) {
    return [&snapshots, extent] {
      double most = 0.0;
      for (const Snapshot* snapshot : snapshots) most = std::max(most, extent(*snapshot));
      return most;
    };
  };
  Legends legends;
  if (has_scale(view.colour_by)) {
    const Label label = label_of(view.colour_by, dimension);
    legends.disks = disks_.legend(
        label, view.range, map_of(label.sign, view, ground),
        largest([&](const Snapshot& gas) { return disk_extent(gas, view.colour_by); }), true);
  }
  if (view.colour_by == ColourBy::Species && !first.species.empty()) {
    legends.species = SpeciesLegend{first.species, species_colours(first.species, ground)};
  }
  if (shows_field(first, view)) {
    const FieldMap& map = *first.field;
    legends.field = field_.legend(
        label_of(map.field, dimension, map.species), view.field_range,
        map_of(map.field, view, ground),
        largest([&](const Snapshot& gas) { return gas.field ? field_extent(gas, view) : 0.0; }),
        map.whole_window);
  }
  if (view.arrows && first.arrows) {
    const Label label = label_of(first.arrows->quantity, dimension);
    const double longest = first.arrows->cell.minCoeff();
    const auto extent =
        largest([](const Snapshot& gas) { return gas.arrows ? arrow_extent(*gas.arrows) : 0.0; });
    legends.arrows = {label, longest / arrows_.end(label, extent)};
  }
  return legends;
}

}  // namespace clatter
