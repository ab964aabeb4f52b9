// libFuzzer target: a checkpoint of a run with its measurement, with changed numbers in its body
// and a valid checksum. The target reads it and continues the run for some collisions. One input in
// eight continues for a hundred collisions, and has a result.

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "engine/checkpoint/archive.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "engine/system/checksum.h"
#include "engine/system/read_file.h"
#include "tests/fuzz/depth.h"

using namespace clatter;

namespace {

constexpr double kSaved = 3.0, kSoon = 3.05, kEnd = 8.0;

constexpr const char* kDisks =
    "box.size = [9, 8]\n"
    "particles = { count = 12, restitution = 0.9, friction = 0.5 }\n"
    "gravity.acceleration = [0.1, -0.2]\n"
    "measure.cells = [3, 2]\n";
// Dense enough for lists of neighbours.
constexpr const char* kSpheres =
    "box.size = [3.2, 3.0, 2.8]\n"
    "particles = { count = 22, restitution = 0.9, friction = 0.5 }\n"
    "gravity.acceleration = [0.1, -0.2, 0.1]\n"
    "measure.cells = [3, 2, 1]\n";
constexpr const char* kBoth =
    "walls.left = { kind = 'sinusoidal', stroke = 0.2, frequency = 2.0 }\n"
    "walls.right = { kind = 'thermal', temperature = 1.0 }\n"
    "bulk_drive = { interval = 0.3, kick_speed = 0.2 }\n"
    "collapse.contact_time = 1e-4\n"
    "measure.burn_in = 1\nmeasure.duration = 7\nmeasure.series_interval = 0.1\n"
    "measure.fields = ['density', 'velocity', 'stress', 'heat_flux', 'balance']\n";

template <int D>
const Scene& fuzzed_scene() {
  static const Scene scene =
      parse_scene(std::string(D == 2 ? kDisks : kSpheres) + kBoth, "fuzz.toml", {});
  return scene;
}

std::string file_name() {
  static const std::string name =
      (std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()))).string();
  return name;
}

// A checkpoint file of the run at kSaved.
template <int D>
const std::string& whole_checkpoint() {
  static const std::string bytes = [] {
    ScheduledRun<D> run(fuzzed_scene<D>(), 1);
    Measurement<D> measurement(run.simulation(), fuzzed_scene<D>().measure, kEnd);
    run.run_until(kSaved);
    Checkpoint checkpoint{.program = "clatter",
                          .command = "measure",
                          .scene = scene_to_toml(fuzzed_scene<D>()),
                          .start_temperature = 1.0,
                          .seed = 1,
                          .saved = run.simulation().save(),
                          .measurement = measurement.save(),
                          .film = "",
                          .trajectory = "",
                          .events = ""};
    write_checkpoint(file_name(), checkpoint);
    return read_file(file_name(), 1'000'000, "");
  }();
  return bytes;
}

void put(std::string& bytes, std::size_t at, double number) {
  if (at + sizeof number <= bytes.size()) std::memcpy(&bytes[at], &number, sizeof number);
}

// Each four bytes of the input are a position in the file and a number to write there.
std::string spoilt(std::string bytes, const std::uint8_t* data, std::size_t size) {
  constexpr std::array<double, 16> kNumbers = {0.0,  -0.0,  5e-324, -1.0,     1.0, 1e-300,
                                               1e15, 1e300, -1e300, HUGE_VAL, NAN, 2.5,
                                               -7.0, 1e9,   3.0,    1e-9};
  for (std::size_t i = 0; i + 4 <= size; i += 4) {
    const std::size_t at = (data[i] * 256u + data[i + 1]) % bytes.size();
    if (data[i + 2] < 128) {
      put(bytes, at, kNumbers[data[i + 3] % kNumbers.size()]);
    } else {
      bytes[at] = static_cast<char>(data[i + 3]);
    }
  }
  const std::uint32_t sum = checksum({bytes.data(), bytes.size() - sizeof(std::uint32_t)});
  std::memcpy(&bytes[bytes.size() - sizeof sum], &sum, sizeof sum);
  return bytes;
}

template <int D>
void resume(const std::string& bytes, bool deep) {
  std::ofstream(file_name(), std::ios::binary) << bytes;
  const Checkpoint checkpoint = read_checkpoint(file_name());
  const auto* saved = std::get_if<RunState<D>>(&checkpoint.saved);
  const auto count = static_cast<std::size_t>(fuzzed_scene<D>().particles.count);
  if (!saved || saved->flights.size() != count) return;
  ScheduledRun<D> run(fuzzed_scene<D>(), 1, *saved);
  if (!checkpoint.measurement.empty()) {
    Measurement<D> measurement(run.simulation(), fuzzed_scene<D>().measure, kEnd,
                               ArchiveReader(checkpoint.measurement, "fuzz"));
    if (deep) {
      run.run_until(kEnd, 100, 1000);
      measurement.result();
    } else {
      run.run_until(kSoon, 5, 50);
    }
  }
}

}  // namespace

// The first byte of the input selects the dimension.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const bool deep = is_one_in(8, {reinterpret_cast<const char*>(data), size});
  try {
    with_dimension(data[0] % 2 ? 3 : 2, [&](auto dimension) {
      resume<dimension>(spoilt(whole_checkpoint<dimension>(), data + 1, size - 1), deep);
    });
  } catch (const UserError&) {
  } catch (const PhysicalStop&) {
  }
  return 0;
}
