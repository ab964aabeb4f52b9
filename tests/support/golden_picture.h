#pragma once

#include <doctest/doctest.h>
#include <stb_image.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "render/output/image.h"
#include "render/output/png_sink.h"
#include "tests/render/picture.h"

namespace clatter::testing {

/// Reads a picture file. Fails the test without it.
inline Image read_png(const std::filesystem::path& path) {
  Image image;
  int channels = 0;
  unsigned char* pixels =
      stbi_load(path.c_str(), &image.size.width, &image.size.height, &channels, 4);
  REQUIRE_MESSAGE(pixels, "no picture " << path);
  image.rgba.assign(pixels, pixels + 4 * image.size.width * image.size.height);
  stbi_image_free(pixels);
  return image;
}

/// Whether the pixels around a pixel have different colours.
inline bool on_edge(const Image& image, int x, int y) {
  constexpr int kFlat = 4;
  for (int v = std::max(0, y - 1); v <= std::min(y + 1, image.size.height - 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(x + 1, image.size.width - 1); ++u) {
      if (difference(pixel(image, x, y), pixel(image, u, v)) > kFlat) return true;
    }
  }
  return false;
}

/// Number of pixels that differ by more than a driver's rounding error. Limits: a level or two away
/// from edges, and a shift of 1/30 pixel of the strongest edge.
inline int wrong_pixels(const Image& golden, const Image& image) {
  constexpr int kOffEdges = 2, kOnEdges = 8;
  int wrong = 0;
  for (int y = 0; y < golden.size.height; ++y) {
    for (int x = 0; x < golden.size.width; ++x) {
      const int allowed = on_edge(golden, x, y) ? kOnEdges : kOffEdges;
      wrong += difference(pixel(golden, x, y), pixel(image, x, y)) > allowed;
    }
  }
  return wrong;
}

/// Checks a picture against the golden one of this name in assets/golden. With the environment
/// variable CLATTER_WRITE_GOLDEN the golden one is written first.
inline void check_golden(const std::string& name, const Image& image) {
  CAPTURE(name);
  const auto path = std::filesystem::path(CLATTER_GOLDEN) / (name + ".png");
  if (std::getenv("CLATTER_WRITE_GOLDEN")) write_png(path, image);
  const Image golden = read_png(path);
  REQUIRE(golden.rgba.size() == image.rgba.size());
  const int wrong = wrong_pixels(golden, image);
  CHECK(wrong == 0);
  if (wrong == 0) return;
  const auto seen = std::filesystem::temp_directory_path() / ("golden_" + name + ".png");
  write_png(seen, image);
  MESSAGE("drawn picture: " << seen);
}

}  // namespace clatter::testing
