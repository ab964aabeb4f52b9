#include <doctest/doctest.h>

#include "render/contrast_maps.h"
#include "render/layers/renderer.h"
#include "render/layers/wall_colours.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

Wall thermal(double temperature) {
  return Wall{.kind = WallKind::Thermal, .temperature = temperature};
}

constexpr Size kColourSize{200, 200};

// The colour of the face of a thermal wall beside a gas.
Colour face(const Gl& gl, double wall_temperature, double gas_temperature, const View& view) {
  Renderer renderer(gl);
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.walls[kLeft] = snapshot.walls[kRight] = thermal(wall_temperature);
  snapshot.temperature = gas_temperature;
  return pixel(draw(renderer, gl, snapshot, {{5.0, 5.0}, 20.0}, kColourSize, view), 49, 100);
}

}  // namespace

TEST_CASE("Wall colours: a thermal wall has the colour of the speed of a gas at its temperature") {
  const ColourScale speeds{particle_map(Palette::Viridis, kDarkTheme.background), 0.0, 4.0};
  WallColours colours{.theme = kDarkTheme, .speeds = speeds};
  // The root mean square of two components of variance 2 is 2, of three of variance 3 is 3.
  CHECK(colours.of(thermal(2.0)) == speeds(2.0));
  colours.dimension = 3;
  CHECK(colours.of(thermal(3.0)) == speeds(3.0));
  CHECK(colours.of(thermal(0.0)) == speeds(0.0));
}

TEST_CASE("Wall colours: without a scale of speeds it is that of temperatures") {
  const ColourScale shown{field_map(FieldPalette::Blue, kDarkTheme.background), 0.0, 4.0};
  WallColours colours{.theme = kDarkTheme, .temperatures = shown};
  CHECK(colours.of(thermal(3.0)) == shown(3.0));
  colours.temperatures.reset();
  CHECK(colours.of(thermal(3.0)) == kDarkTheme.static_wall);
}

TEST_CASE("Wall colours: a thermal wall keeps its colour while the gas heats") {
  const auto context = open_context(Backend::Auto);
  View view;
  view.overlay = false;
  view.range = {ColourRange::Given, {0.0, 3.0}};
  const Colour cold = face(context->gl(), 0.1, 0.1, view);
  CHECK(cold == face(context->gl(), 0.1, 50.0, view));
  CHECK_FALSE(cold == face(context->gl(), 4.0, 0.1, view));
}

TEST_CASE("Wall colours: a cold wall is not red on any palette and in any theme") {
  const auto context = open_context(Backend::Auto);
  for (const Palette palette : {Palette::Viridis, Palette::Inferno, Palette::Cividis}) {
    for (const Theme theme : {Theme::Dark, Theme::Light, Theme::Projector}) {
      View view;
      view.overlay = false;
      view.palette = palette;
      view.theme = theme;
      view.range = {ColourRange::Given, {0.0, 3.0}};
      const Colour cold = face(context->gl(), 0.01, 1.0, view);
      CHECK(cold.red <= cold.blue);
    }
  }
}

}  // namespace clatter
