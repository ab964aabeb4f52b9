// HDF5 files on which the library itself fails.

#include <doctest/doctest.h>

#include <csignal>
#include <random>
#include <string>

#include "app/import/frame_reader.h"
#include "app/results/isolated_hdf5.h"
#include "engine/error.h"
#include "tests/app/trajectory_scenes.h"
#include "tests/support/shell.h"

namespace clatter {

using namespace testing;

TEST_CASE("Damaged HDF5: a crash of the library is an error with the file and an advice") {
  CHECK(says(refusal_of([] {
               read_hdf5_apart("bad.h5md", []() -> std::string {
                 raise(SIGSEGV);
                 return "";
               });
             }),
             "bad.h5md: the HDF5 library crashed (Segmentation fault); "));
  CHECK(refusal_of([] {
          read_hdf5_apart("bad.h5md", []() -> std::string {
            throw UserError({"bad.h5md"}, "the box is tilted", "give another file");
          });
        }) == "bad.h5md: the box is tilted; give another file");
  CHECK(read_hdf5_apart("good.h5md", [] { return std::string("a frame"); }) == "a frame");
}

// Zeros are left as they are, because many of them are unused space.
TEST_CASE("Damaged HDF5: a file with random bytes is read or refused") {
  const Shell shell;
  shell.write("s.toml", kSpheres);
  REQUIRE(shell.run(kRun + "--every 5 --trajectory t.h5md").code == 0);
  const std::string whole = shell.read("t.h5md");
  const std::filesystem::path path = shell.path("t.h5md");
  REQUIRE(read_frame(path, {}, "IN").positions.size() == 9);
  std::mt19937 random(7);
  int read = 0, refused = 0;
  for (int k = 0; k < 250; ++k) {
    std::string damaged = whole;
    std::size_t place = random() % whole.size();
    while (whole[place] == '\0') place = (place + 1) % whole.size();
    const std::size_t count = k % 3 == 0 ? 4 : 1;
    for (std::size_t j = place; j < std::min(place + count, whole.size()); ++j) {
      damaged[j] = static_cast<char>(random());
    }
    CAPTURE(k);
    shell.write("t.h5md", damaged);
    try {
      read_frame(path, {}, "IN");
      ++read;
    } catch (const UserError& error) {
      CHECK(error.place().file == path.string());
      ++refused;
    }
  }
  CHECK(read > 0);
  CHECK(refused > 0);
}

TEST_CASE("Convert: a large H5MD file gives back its start state") {
  const Shell shell;
  std::string state = "x,y,vx,vy\n";
  for (int i = 0; i < 40'000; ++i) {
    state += std::to_string(i % 200) + ',' + std::to_string(i / 200) + ",0.5," + std::to_string(i) +
             '\n';
  }
  shell.write("s.csv", state);
  shell.write("s.toml", "box.size = [300, 300]\nparticles.count = 1\n");
  const Outcome there = shell.run("clatter convert s.csv --scene s.toml t.h5md");
  CAPTURE(there.err);
  REQUIRE(there.code == 0);
  REQUIRE(shell.run("clatter convert t.h5md back.csv && cmp s.csv back.csv").code == 0);
}

}  // namespace clatter
