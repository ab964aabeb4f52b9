#include <doctest/doctest.h>

#include "engine/error.h"
#include "render/output/png_sink.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

using namespace testing;

namespace {

const SinkOptions kOptions{{64, 48}, 30.0, {{"Title", "title"}, {"Seed", "1"}}};

Image frame() {
  return {kOptions.size, std::vector<unsigned char>(64 * 48 * 4, 100)};
}

void write_frames(const std::filesystem::path& path, const SinkOptions& options, int count) {
  const auto sink = open_sink(path, options);
  for (int i = 0; i < count; ++i) sink->add(frame(), {});
  sink->finish(Ending::Whole);
}

}  // namespace

TEST_CASE("PngSequence: a sequence has a file for each frame, numbered from 0") {
  const TemporaryFolder folder;
  write_frames(folder / "deep/sequence", kOptions, 23);
  CHECK(std::filesystem::file_size(folder / "deep/sequence/frame_000000.png") > 0);
  CHECK(std::filesystem::file_size(folder / "deep/sequence/frame_000022.png") > 0);
  const std::filesystem::directory_iterator files(folder / "deep/sequence");
  CHECK(std::distance(begin(files), end(files)) == 23);
}

TEST_CASE("PngSequence: a sequence replaces frames only where it may") {
  const TemporaryFolder folder;
  write_frames(folder / "sequence", kOptions, 2);
  CHECK_THROWS_AS(open_sink(folder / "sequence", kOptions), UserError);
  SinkOptions overwrite = kOptions;
  overwrite.overwrite = true;
  CHECK_NOTHROW(write_frames(folder / "sequence", overwrite, 2));
}

TEST_CASE(
    "PngSequence: a part of a sequence has its own numbers, and needs only those to be free") {
  const TemporaryFolder folder;
  SinkOptions part = kOptions;
  part.begin = part.next = 10;
  part.end = 12;
  write_frames(folder / "sequence", part, 2);
  CHECK(std::filesystem::exists(folder / "sequence/frame_000011.png"));
  CHECK_THROWS_AS(open_sink(folder / "sequence", part), UserError);
  part.begin = part.next = 12;
  part.end = 14;
  CHECK_NOTHROW(write_frames(folder / "sequence", part, 2));
}

TEST_CASE("PngSequence: a resumed sequence needs its earlier frames and replaces its later ones") {
  const TemporaryFolder folder;
  write_frames(folder / "sequence", kOptions, 3);
  SinkOptions on = kOptions;
  on.next = 2;
  CHECK_THROWS_AS(open_sink(folder / "sequence", on), UserError);
  on.goes_on = true;
  CHECK_NOTHROW(write_frames(folder / "sequence", on, 2));
  CHECK(std::filesystem::exists(folder / "sequence/frame_000003.png"));
  on.next = 6;
  CHECK_THROWS_WITH_AS(open_sink(folder / "sequence", on), doctest::Contains("frame_000004.png"),
                       UserError);
}

TEST_CASE("PngSequence: a sequence does not continue after an empty or truncated frame") {
  const TemporaryFolder folder;
  write_frames(folder / "sequence", kOptions, 4);
  SinkOptions on = kOptions;
  on.begin = 1;
  on.next = 3;
  on.goes_on = true;
  const auto size_of = [&](const char* frame, std::uintmax_t size) {
    std::filesystem::resize_file(folder / "sequence" / frame, size);
  };
  // Frames of another part, and frames that are drawn again.
  size_of("frame_000000.png", 0);
  size_of("frame_000003.png", 0);
  CHECK_NOTHROW(open_sink(folder / "sequence", on));
  size_of("frame_000002.png", std::filesystem::file_size(folder / "sequence/frame_000002.png") - 1);
  CHECK_THROWS_WITH_AS(open_sink(folder / "sequence", on),
                       doctest::Contains("frame_000002.png is damaged"), DamagedPiece);
  size_of("frame_000001.png", 0);
  CHECK_THROWS_WITH_AS(open_sink(folder / "sequence", on),
                       doctest::Contains("frame_000001.png is damaged"), DamagedPiece);
}

TEST_CASE("PngSequence: a sequence cannot be where a file is") {
  const TemporaryFolder folder;
  write_frames(folder / "one.png", kOptions, 1);
  CHECK_THROWS_AS(PngSequence(folder / "one.png", kOptions), RunError);
}

TEST_CASE("PngSequence: a folder that vanishes fails the sequence") {
  const TemporaryFolder folder;
  const auto sink = open_sink(folder / "sequence", kOptions);
  std::filesystem::remove(folder / "sequence");
  auto add_many = [&] {
    for (int i = 0; i < 100; ++i) sink->add(frame(), {});
    sink->finish(Ending::Whole);
  };
  CHECK_THROWS_AS(add_many(), RunError);
}

TEST_CASE("PngSequence: the path selects the kind of output") {
  const TemporaryFolder folder;
  write_frames(folder / "one.png", kOptions, 1);
  CHECK(std::filesystem::is_regular_file(folder / "one.png"));
  CHECK_THROWS_AS(open_sink(folder / "film.avi", kOptions), UserError);
}

}  // namespace clatter
