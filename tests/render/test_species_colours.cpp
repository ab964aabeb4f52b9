#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "engine/scene/enum_names.h"
#include "render/contrast_maps.h"
#include "render/species_colours.h"
#include "render/theme.h"

namespace clatter {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// How the colour-blind see linear light, completely without one kind of cones: G. M. Machado,
// M. M. Oliveira and L. A. F. Fernandes, "A physiologically-based model for simulation of color
// vision deficiency" (2009), table 1. The first is usual vision.
std::vector<Matrix3d> kinds_of_vision() {
  Matrix3d protanopia, deuteranopia, tritanopia;
  protanopia << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
      1.051998;
  deuteranopia << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
      0.968881;
  tritanopia << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
      0.303900;
  return {Matrix3d::Identity(), protanopia, deuteranopia, tritanopia};
}

// CIELAB of a colour as seen with a kind of vision, for the white of sRGB.
Vector3d lab_of(Colour colour, const Matrix3d& vision) {
  const Vector3d light(linear_light(colour.red), linear_light(colour.green),
                       linear_light(colour.blue));
  Matrix3d xyz;
  xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Vector3d white(0.9505, 1.0, 1.089);
  Vector3d f = (xyz * (vision * light).cwiseMax(0.0).cwiseMin(1.0)).cwiseQuotient(white);
  for (double& share : f) {
    share = share > 0.008856 ? std::cbrt(share) : 7.787 * share + 16.0 / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

std::vector<Colour> theme_grounds() {
  std::vector<Colour> grounds;
  for (const auto& [name, theme] : kThemes) {
    View view;
    view.theme = theme;
    grounds.push_back(theme_of(view).background);
  }
  return grounds;
}

}  // namespace

TEST_CASE("Species colours: the colour-blind can distinguish the colours of each theme") {
  // A difference of 2.3 in CIELAB is just noticeable (Sharma 2003).
  for (const Colour ground : theme_grounds()) {
    const std::vector<Colour> colours = species_colours(std::vector<Species>(8), ground);
    for (const Matrix3d& vision : kinds_of_vision()) {
      for (std::size_t i = 0; i < colours.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
          CAPTURE(i);
          CAPTURE(k);
          const double off = (lab_of(colours[i], vision) - lab_of(colours[k], vision)).norm();
          CHECK(off > (i < 2 ? 40.0 : i < 4 ? 20.0 : 11.0));
        }
      }
    }
  }
}

TEST_CASE("Species colours: they differ from all fields as particles do") {
  for (const Colour ground : theme_grounds()) {
    for (const Colour colour : species_colours(std::vector<Species>(8), ground)) {
      for (const auto& [name, palette] : kFieldPalettes) {
        for (const Colour field : field_map(palette, ground)) {
          CHECK(contrast_ratio(colour, field) > 1.98);
        }
      }
    }
  }
}

TEST_CASE("Species colours: a species has its own colour if the scene gives one") {
  std::vector<Species> species(10);
  species[1].colour = Rgb{1, 2, 3};
  const std::vector<Colour> colours = species_colours(species, kDarkTheme.background);
  CHECK(colours[1] == Colour{1, 2, 3});
  CHECK(colours[8] == colours[0]);
  CHECK_FALSE(colours[9] == colours[1]);
}

}  // namespace clatter
