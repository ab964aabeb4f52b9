#include <doctest/doctest.h>

#include <functional>

#include "engine/checkpoint/archive.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/error.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

std::string archived(Checkpoint& checkpoint) {
  auto& [program, command, scene, start_temperature, seed, saved, measurement, film, trajectory,
         events] = checkpoint;
  ArchiveWriter writer;
  writer(program, command, scene, start_temperature, seed, saved, measurement, film, trajectory,
         events);
  return writer.written();
}

// All numbers are different, so that a swap changes the file.
Checkpoint example() {
  RunState<2> saved;
  saved.gravity = {0.5, -1.5};
  saved.wall_motions[1] = {WallPath::Sinusoidal, 0.75, 21.0, -0.25};
  saved.phase_shifts = {0.1, 0.2, 0.3, 0.4};
  saved.base = {1e9, 1e-9};
  saved.now = 3.25;
  saved.flights = {{{1.0, 2.0}, {-0.0, 1e-300}, 0.25, 7}, {{3.0, 4.0}, {5.0, 6.0}, 0.75, 8}};
  saved.spins = {Spin<2>(0.125), Spin<2>(-8.0)};
  saved.last_collisions = {-HUGE_VAL, 2.5};
  saved.remainders = {{1e-11, 2e-11}, {3e-11, 4e-11}};
  saved.until_base_moves = 11;
  saved.mean_collision_time = 11.5;
  saved.watchdog = WatchdogState{.most_per_pair = 38,
                                 .look_interval = 40,
                                 .until_look = 39,
                                 .look_start = 0.25,
                                 .window_start = 0.375,
                                 .collisions = 41,
                                 .participations = 82,
                                 .longest_early = 0.875,
                                 .means = {1.5, 2.5},
                                 .suspicious = true,
                                 .still_since = 0.4375,
                                 .still_mean = 3.5,
                                 .still_collisions = 43,
                                 .pairs = {{{0, 1}, 44}, {{1, 7}, 45}}};
  saved.kick_interval = 0.0625;
  saved.kick_origin = 1e9 + 12.0;
  saved.kicks_since_origin = 13;
  saved.era = 3;
  saved.counts = {14, 15, 16, 17, 18, 19, 20};
  saved.checks = {1e-14, 1e-15};
  return {"clatter 9.8", "measure",    "title = \"ρ\"\n", 0.5, 42, saved, std::string("\0bytes", 6),
          "film",        "trajectory", "events"};
}

RunState<2>& disks(Checkpoint& checkpoint) {
  return std::get<RunState<2>>(checkpoint.saved);
}

// The error message for a file; empty if it is valid.
std::string reading_error(const std::filesystem::path& file) {
  return refusal_of([&] { read_checkpoint(file); });
}

std::uint32_t crc_32(const std::string& bytes) {
  std::uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

}  // namespace

TEST_CASE("Checkpoint: all that is written is read back, bit for bit") {
  const TemporaryFolder folder;
  Checkpoint written = example();
  write_checkpoint(folder / "a", written);
  Checkpoint read = read_checkpoint(folder / "a");
  CHECK(read.scene == "title = \"ρ\"\n");
  CHECK(read.measurement == written.measurement);
  CHECK(disks(read).counts.stale == 0);
  CHECK(std::signbit(disks(read).flights[0].v.x()));
  CHECK(archived(read) == archived(written));
}

// The checksum is valid, the content is not. Only malicious files are like this.
TEST_CASE("Checkpoint: a state that no run has is refused") {
  const double nan = std::nan("");
  const std::vector<std::function<void(RunState<2>&)>> spoilt = {
      [&](RunState<2>& s) { s.now = nan; },
      [](RunState<2>& s) { s.now = -1.0; },
      [](RunState<2>& s) { s.base.high = HUGE_VAL; },
      [](RunState<2>& s) { s.gravity.x() = HUGE_VAL; },
      [&](RunState<2>& s) { s.flights[1].r.x() = nan; },
      [](RunState<2>& s) { s.flights[1].r.y() = 1e300; },
      [](RunState<2>& s) { s.flights[0].v.x() = 1e300; },
      [](RunState<2>& s) { s.flights[0].time = 4.0; },
      [](RunState<2>& s) { s.flights[0].time = -1e300; },
      [](RunState<2>& s) { s.spins.pop_back(); },
      [&](RunState<2>& s) { s.spins[0][0] = nan; },
      [](RunState<2>& s) { s.last_collisions.push_back(0.0); },
      [](RunState<2>& s) { s.last_collisions[0] = 4.0; },
      [](RunState<2>& s) { s.remainders.pop_back(); },
      [](RunState<2>& s) { s.until_base_moves = ~std::uint64_t{0}; },
      [](RunState<2>& s) { s.kick_origin = -1e300; },
      [](RunState<2>& s) { s.kick_interval = -1.0; },
      [&](RunState<2>& s) { s.wall_motions[2].phase = nan; },
      [&](RunState<2>& s) { s.phase_shifts[2] = nan; },
      [&](RunState<2>& s) { s.wall_motions[2].frequency = nan; },
      [&](RunState<2>& s) { s.checks.deepest_overlap = nan; },
  };
  const TemporaryFolder folder;
  for (std::size_t i = 0; i < spoilt.size(); ++i) {
    CAPTURE(i);
    Checkpoint checkpoint = example();
    spoilt[i](disks(checkpoint));
    write_checkpoint(folder / "a", checkpoint);
    CHECK(reading_error(folder / "a").find("its content does not fit this program") !=
          std::string::npos);
  }
}

TEST_CASE("Checkpoint: a failure to write is an error and leaves the previous one") {
  const TemporaryFolder folder;
  Checkpoint checkpoint = example();
  CHECK_THROWS_AS(write_checkpoint(folder / "missing/a", checkpoint), RunError);
  write_checkpoint(folder / "a", checkpoint);
  std::filesystem::create_directory(folder / "a.previous");
  CHECK_THROWS_AS(write_checkpoint(folder / "a", checkpoint), RunError);
  CHECK(read_checkpoint(folder / "a").seed == 42);
}

TEST_CASE("Checkpoint: a file with any byte changed, cut off or added is refused") {
  const TemporaryFolder folder;
  Checkpoint checkpoint = example();
  write_checkpoint(folder / "a", checkpoint);
  const std::string sound = bytes_of(folder / "a");
  REQUIRE(sound.size() < 1000);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    CAPTURE(i);
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string damaged = sound;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      write_bytes(folder / "a", damaged);
      CHECK(says(reading_error(folder / "a"), "a: "));
    }
    write_bytes(folder / "a", sound.substr(0, i));
    CHECK(says(reading_error(folder / "a"), "a: "));
  }
  write_bytes(folder / "a", sound + '\0');
  CHECK(says(reading_error(folder / "a"), "extra bytes follow its end"));
  write_bytes(folder / "a", sound);
  CHECK(reading_error(folder / "a").empty());
}

TEST_CASE("Checkpoint: an error names the problem and the previous checkpoint") {
  const TemporaryFolder folder;
  CHECK(says(reading_error(folder / "a"), "there is no such file"));
  CHECK(says(reading_error(folder / ""), "this is not a file"));
  write_bytes(folder / "a", "schema = 1\n");
  CHECK(says(reading_error(folder / "a"), "this is not a checkpoint"));
  CHECK_FALSE(says(reading_error(folder / "a"), "a.previous"));

  Checkpoint checkpoint = example();
  write_checkpoint(folder / "a", checkpoint);
  write_checkpoint(folder / "a", checkpoint);
  const std::string sound = bytes_of(folder / "a");
  const auto refusal_of = [&](std::size_t at, int flip) {
    std::string damaged = sound;
    damaged[at] = static_cast<char>(damaged[at] ^ flip);
    write_bytes(folder / "a", damaged);
    return reading_error(folder / "a");
  };
  const std::size_t version = sound.find('\n', sound.find('\n') + 1) + 1;
  CHECK(says(refusal_of(version, 2), "checksum"));
  CHECK(says(refusal_of(version + 5, 0xff), "truncated"));
  CHECK(says(refusal_of(version + 30, 1), "checksum"));
  CHECK(says(refusal_of(version + 30, 1), "the previous checkpoint is "));
  CHECK(bytes_of(folder / "a.previous") == sound);
  CHECK(std::distance(std::filesystem::directory_iterator(folder / ""), {}) == 2);
  std::filesystem::remove(folder / "a");
  CHECK(says(reading_error(folder / "a"), "a.previous"));
}

TEST_CASE("Checkpoint: a file of another version names the program that wrote it") {
  const TemporaryFolder folder;
  Checkpoint checkpoint = example();
  write_checkpoint(folder / "a", checkpoint);
  std::string bytes = bytes_of(folder / "a");
  const std::size_t version = bytes.find('\n', bytes.find('\n') + 1) + 1;
  bytes[version] = 99;
  bytes.resize(bytes.size() - 4);
  const std::uint32_t sum = crc_32(bytes);
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(sum >> shift);
  write_bytes(folder / "a", bytes);
  CHECK(says(reading_error(folder / "a"),
             "`measure` of clatter 9.8 wrote this checkpoint, in version 99"));
  CHECK(says(reading_error(folder / "a"), "resume it with clatter 9.8"));
}

// As in a file with another layout of structs and a valid checksum.
TEST_CASE("Checkpoint: lengths beyond the end of the file are refused, not allocated") {
  std::uint64_t length = ~std::uint64_t{0} / 16;
  ArchiveWriter writer;
  writer(length, length);
  std::vector<double> numbers;
  std::vector<std::vector<double>> rows;
  std::string text;
  CHECK_THROWS_AS(ArchiveReader(writer.written(), "a")(numbers), UserError);
  CHECK_THROWS_AS(ArchiveReader(writer.written(), "a")(rows), UserError);
  CHECK_THROWS_AS(ArchiveReader(writer.written(), "a")(text), UserError);
  // 30 bytes hold no two flights, which are refused although two bytes hold them.
  length = 2;
  ArchiveWriter few;
  few(length);
  std::vector<Flight<2>> flights;
  CHECK_THROWS_AS(ArchiveReader(few.written() + std::string(30, '\0'), "a")(flights), UserError);
  CHECK(flights.capacity() == 0);
  length = ~std::uint64_t{0} / 16;
  AnyRunState saved;
  std::string bytes(1000, '\0');
  bytes[0] = 2;  // neither disks nor spheres
  CHECK_THROWS_AS(ArchiveReader(bytes, "a")(saved), UserError);
  ArchiveReader reader(writer.written(), "a");
  reader(length);
  CHECK_THROWS_AS(reader.finish(), UserError);
  reader(length);
  reader.finish();
  CHECK_THROWS_AS(reader(length), UserError);
}
