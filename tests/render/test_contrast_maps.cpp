#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "engine/scene/enum_names.h"
#include "render/contrast_maps.h"
#include "render/theme.h"

namespace clatter {

namespace {

// The grounds of all themes, and four more that a scene may set.
std::vector<Colour> grounds() {
  std::vector<Colour> list = {
      {0x00, 0x00, 0x00}, {0x30, 0x10, 0x10}, {0xd0, 0xe8, 0xd0}, {0xff, 0xff, 0xff}};
  for (const auto& [name, theme] : kThemes) {
    View view;
    view.theme = theme;
    list.push_back(theme_of(view).background);
  }
  return list;
}

std::vector<ColourMap> field_maps(Colour ground) {
  std::vector<ColourMap> maps = {signed_field_map(ground)};
  for (const auto& [name, palette] : kFieldPalettes) maps.push_back(field_map(palette, ground));
  return maps;
}

// The colours of the slowest particles: at zero on each scale.
std::vector<Colour> slowest(Colour ground) {
  std::vector<Colour> colours = {signed_particle_map(ground)[8]};
  for (const auto& [name, palette] : kPalettes) {
    colours.push_back(particle_map(palette, ground).front());
  }
  return colours;
}

}  // namespace

TEST_CASE("Contrast maps: contrast ratios are those of WCAG 2.1") {
  // By hand: the luminance of #777777 is ((0x77/255 + 0.055)/1.055)^2.4 = 0.18447.
  CHECK(contrast_ratio({0, 0, 0}, {255, 255, 255}) == doctest::Approx(21.0));
  CHECK(contrast_ratio({0x77, 0x77, 0x77}, {255, 255, 255}) ==
        doctest::Approx(1.05 / 0.23447).epsilon(1e-4));
  CHECK(contrast_ratio({0, 0, 255}, {0, 0, 0}) == doctest::Approx((0.0722 + 0.05) / 0.05));
  for (const int channel : {0, 10, 11, 128, 255}) {
    const auto value = static_cast<std::uint8_t>(channel);
    CHECK(encoded_light(linear_light(value)) == value);
  }
}

TEST_CASE("Contrast maps: the slowest particle is visible on every field") {
  for (const Colour ground : grounds()) {
    CAPTURE(int{ground.red});
    for (const Colour particle : slowest(ground)) {
      for (const ColourMap& map : field_maps(ground)) {
        for (const Colour field : map) CHECK(contrast_ratio(particle, field) >= 3.0);
      }
    }
  }
}

TEST_CASE("Contrast maps: particles without a value are visible on every field of their theme") {
  for (const auto& [name, theme] : kThemes) {
    CAPTURE(std::string(name));
    View view;
    view.theme = theme;
    const ThemeColours colours = theme_of(view);
    for (const ColourMap& map : field_maps(colours.background)) {
      for (const Colour field : map) CHECK(contrast_ratio(colours.disk, field) >= 3.0);
    }
  }
}

TEST_CASE("Contrast maps: every particle is visible on the ground") {
  for (const Colour ground : grounds()) {
    CAPTURE(int{ground.red});
    std::vector<ColourMap> maps = {signed_particle_map(ground)};
    for (const auto& [name, palette] : kPalettes) maps.push_back(particle_map(palette, ground));
    for (const ColourMap& map : maps) {
      for (const Colour colour : map) CHECK(contrast_ratio(colour, ground) >= 3.0);
    }
  }
}

TEST_CASE("Contrast maps: a field rises from the ground, and stays close to it") {
  for (const Colour ground : grounds()) {
    for (const auto& [name, palette] : kFieldPalettes) {
      const ColourMap map = field_map(palette, ground);
      CHECK(map.front() == ground);
      for (std::size_t i = 1; i < map.size(); ++i) {
        CHECK(contrast_ratio(map[i], ground) >= contrast_ratio(map[i - 1], ground));
      }
      CHECK(contrast_ratio(map.back(), ground) == doctest::Approx(2.0).epsilon(0.05));
    }
    const ColourMap map = signed_field_map(ground);
    CHECK(map[8] == ground);
    CHECK(map.front().blue > map.front().red);
    CHECK(map.back().red > map.back().blue);
  }
}

TEST_CASE("Contrast maps: faster particles are lighter, and differ") {
  for (const Colour ground : grounds()) {
    for (const auto& [name, palette] : kPalettes) {
      const ColourMap map = particle_map(palette, ground);
      for (std::size_t i = 1; i < map.size(); ++i) {
        CHECK(luminance(map[i]) > luminance(map[i - 1]));
      }
    }
  }
}

}  // namespace clatter
