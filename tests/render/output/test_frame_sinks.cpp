#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "render/output/movie.h"
#include "render/output/png_sink.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

using namespace testing;

namespace {

constexpr Size kFrameSize{16, 12};
constexpr std::size_t kBytes = 16 * 12 * 4;

Image grey(int value) {
  Image image{kFrameSize, std::vector<unsigned char>(kBytes, static_cast<unsigned char>(value))};
  for (std::size_t i = 3; i < kBytes; i += 4) image.rgba[i] = 255;
  return image;
}

// The grey values of decoded pictures, in order; -1 for a picture with several greys.
std::vector<int> greys_of(const std::string& input) {
  FILE* pipe =
      popen(("ffmpeg -v error " + input + " -f rawvideo -pix_fmt rgba - 2>&1").c_str(), "r");
  std::vector<int> greys;
  std::vector<unsigned char> picture(kBytes);
  while (std::fread(picture.data(), 1, kBytes, pipe) == kBytes) {
    greys.push_back(picture == grey(picture[0]).rgba ? picture[0] : -1);
  }
  pclose(pipe);
  return greys;
}

}  // namespace

// As in the thread that simulates and draws. This case also runs under the thread sanitizer.
TEST_CASE("Frame sinks: pictures that wait for encoders come whole and in order") {
  const TemporaryFolder folder;
  SinkOptions options;
  options.size = kFrameSize;
  std::vector<int> shown(2 * FrameSink::kPiece + 7);
  std::iota(shown.begin(), shown.end(), 1);
  {
    PngSequence sequence(folder / "frames", options);
    Movie movie(folder / "film.mkv", options);
    Movie given_up(folder / "other.mkv", options);
    for (const int value : shown) {
      Image image = grey(value);
      sequence.add(image, {});
      if (value < FrameSink::kPiece) given_up.add(image, {});
      movie.add(image, {{"Time", std::to_string(value)}});
      // The queues have their own copies of the pictures.
      std::ranges::fill(image.rgba, 0);
    }
    sequence.finish(Ending::Whole);
    movie.finish(Ending::Whole);
  }
  CHECK(greys_of("-i '" + (folder / "frames/frame_%06d.png").string() + "'") == shown);
  CHECK(greys_of("-i '" + (folder / "film.mkv").string() + "'") == shown);
}

}  // namespace clatter
