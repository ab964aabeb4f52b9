// libFuzzer: all that people give the program beside scenes and checkpoints. The first byte of an
// input chooses its kind: a start state, a picture that carries a scene, or a command line of
// commands that write no file, a word a line. Command lines take most of the time, so one in
// sixteen runs.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/commands.h"
#include "app/runs/picture_scene.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/state_file.h"
#include "tests/fuzz/depth.h"
#include "tests/fuzz/extreme_number.h"

using namespace clatter;

namespace {

const Scene& scene_of_three_disks(bool rough) {
  const auto scene = [](const std::string& more) {
    return parse_scene(
        "box.size = [9, 8]\nparticles = { count = 3, restitution = 0.9" + more + " }\n",
        "fuzz.toml", {});
  };
  static const Scene kSmooth = scene(""), kRough = scene(", friction = 0.5");
  return rough ? kRough : kSmooth;
}

void read_state(std::string_view text, bool rough) {
  const AnyState state = parse_state(text, "fuzz.csv", scene_of_three_disks(rough));
  const std::string written = state_to_csv(std::get<State<2>>(state));
  if (state_to_csv(std::get<State<2>>(
          parse_state(written, "written.csv", scene_of_three_disks(rough)))) != written) {
    std::abort();
  }
}

void read_picture(std::string_view bytes) {
  static const std::string file =
      (std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()) + ".png"))
          .string();
  std::ofstream(file, std::ios::binary) << bytes;
  load_any_scene(file);
  seed_of_picture(file);
}

// With the reports of the program, which go to stdout and stderr, out of sight.
void run_commands(std::string_view text) {
  constexpr std::array kCommands = {"check", "help", "completions", "scenes"};
  std::vector<std::string> words = {"clatter"};
  std::string word;
  for (const char c : text) {
    if (c == '\n') {
      words.push_back(word);
      word.clear();
    } else if (c != '\0') {
      word += c;
    }
  }
  if (words.size() < 2 || std::ranges::find(kCommands, words[1]) == kCommands.end()) return;
  // `help keys --markdown FILE` writes a file.
  if (std::ranges::any_of(words, [](const auto& w) { return w.starts_with("--m"); })) return;
  std::vector<const char*> argv;
  for (const std::string& each : words) argv.push_back(each.c_str());
  run_program(static_cast<int>(argv.size()), argv.data());
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
  return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

// Puts an extreme number at a random place, or lets libFuzzer change the bytes.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  std::minstd_rand random(seed);
  random.discard(2);
  const std::string number = extreme_number(random);
  if (random() % 3 || size < 2 || size + number.size() > most) {
    return LLVMFuzzerMutate(data, size, most);
  }
  const std::size_t at = 1 + random() % (size - 1);
  // The number that stands there gives way.
  std::size_t end = at;
  while (end < size && std::strchr("+-.0123456789e", data[end]) && data[end] != 0) ++end;
  std::memmove(data + at + number.size(), data + end, size - end);
  std::memcpy(data + at, number.data(), number.size());
  return size - (end - at) + number.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    switch (data[0]) {
      case 'S':
        read_state(text, false);
        break;
      case 'R':
        read_state(text, true);
        break;
      case 'P':
        read_picture(text);
        break;
      case 'C':
        if (is_one_in(16, text)) run_commands(text);
        break;
      default:
        return -1;
    }
  } catch (const UserError&) {
  }
  return 0;
}
