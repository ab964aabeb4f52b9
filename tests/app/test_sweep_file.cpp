#include <doctest/doctest.h>

#include "app/sweep/sweep_file.h"
#include "tests/support/messages.h"

namespace clatter {

using testing::refusal_of;

static std::vector<std::string> points_of(const std::string& text) {
  std::vector<std::string> points;
  for (const SweepPoint& point : read_sweep("scene = \"vibrated\"\n" + text, "s.toml").points()) {
    points.push_back(settings_text(point));
  }
  return points;
}

TEST_CASE("Sweep file: points are the product of the axes, the last axis fastest") {
  CHECK(points_of("") == std::vector<std::string>{""});
  CHECK(points_of("[axes]\n\"particles.restitution\" = [0.8, 0.9]\nparticles.count = [7, 5]\n") ==
        std::vector<std::string>{"particles.restitution=0.8 particles.count=7",
                                 "particles.restitution=0.8 particles.count=5",
                                 "particles.restitution=0.9 particles.count=7",
                                 "particles.restitution=0.9 particles.count=5"});
  // The order is that of the file, not of the names; values may be texts and lists.
  CHECK(points_of("[axes]\n\"walls.left.kind\" = [\"static\"]\n\"box.size\" = [[10, 20.5]]\n") ==
        std::vector<std::string>{"walls.left.kind=\"static\" box.size=[10, 20.5]"});
}

TEST_CASE("Sweep file: axes in zip vary together") {
  CHECK(points_of("zip = [[\"c\", \"a\"]]\n[axes]\na = [1, 2]\nb = [3, 4]\nc = [5, 6]\n") ==
        std::vector<std::string>{"a=1 c=5 b=3", "a=1 c=5 b=4", "a=2 c=6 b=3", "a=2 c=6 b=4"});
}

TEST_CASE("Sweep file: ranges are linear or logarithmic, and whole between whole ends") {
  CHECK(points_of("[axes]\na = { from = 0.1, to = 0.5, count = 5 }\n") ==
        std::vector<std::string>{"a=0.1", "a=0.2", "a=0.3", "a=0.4", "a=0.5"});
  CHECK(points_of("[axes]\na = { from = 1.0, to = 2, count = 2 }\n") ==
        std::vector<std::string>{"a=1.0", "a=2.0"});
  // 10 * 10^(k/3): 21.54, 46.42.
  CHECK(points_of("[axes]\na = { from = 10, to = 100, count = 4, scale = \"log\" }\n") ==
        std::vector<std::string>{"a=10", "a=22", "a=46", "a=100"});
  CHECK(points_of("[axes]\na = { from = 1e-300, to = 1e300, count = 3, scale = \"log\" }\n") ==
        std::vector<std::string>{"a=1e-300", "a=1.0", "a=1e+300"});
  CHECK(points_of("[axes]\na = { from = -1e308, to = 1e308, count = 3 }\n") ==
        std::vector<std::string>{"a=-1e+308", "a=0.0", "a=1e+308"});
  CHECK(points_of("[axes]\na = { from = 1e-3, to = 1e-1, count = 3, scale = \"log\" }\n") ==
        std::vector<std::string>{"a=0.001", "a=0.01", "a=0.1"});
  CHECK(points_of("[axes]\na = { from = 3, to = 1, count = 1 }\n") ==
        std::vector<std::string>{"a=3"});
}

TEST_CASE("Sweep file: seeds, settings of all runs, accuracy and end") {
  const Sweep sweep = read_sweep(
      "scene = \"a.toml\"\nseeds = [7, 3]\naccuracy = \"0.5%\"\naccuracy_of = \"pressure.left\"\n"
      "until = 30\n[set]\n\"particles.count\" = 9\n[set.measure]\nburn_in = 5\nfields = "
      "[\"density\"]\n",
      "s.toml");
  CHECK(sweep.scene == "a.toml");
  CHECK(sweep.seeds == std::vector<std::uint64_t>{7, 3});
  CHECK(sweep.accuracy.relative == 0.005);
  CHECK(sweep.accuracy.of == "pressure.left");
  CHECK(sweep.until == 30.0);
  CHECK(settings_text(sweep.set) ==
        "particles.count=9 measure.burn_in=5 measure.fields=[\"density\"]");
  CHECK(read_sweep("scene = \"a\"\nreplicas = 3\n", "s.toml").seeds ==
        std::vector<std::uint64_t>{1, 2, 3});
  CHECK(read_sweep("scene = \"a\"\naccuracy = 0.01\n", "s.toml").accuracy.relative == 0.01);
}

TEST_CASE("Sweep file: each mistake is refused at its place") {
  const auto refusal = [](const std::string& lines) {
    const std::string text = "scene = \"vibrated\"\n" + lines;
    return refusal_of(
        [&] { check_entries(read_sweep(text, "s.toml"), find_scene("vibrated"), text, "s.toml"); });
  };
  CHECK(refusal("[axes]\n\"particles.count\" = [20, 30]\n") == "");
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"replica = 3\n", "s.toml:2:1: unknown key 'replica'; did you mean 'replicas'?"},
      {"replicas = 0\n",
       "s.toml:2:1: 'replicas' cannot be 0; give a whole number between 1 and 1e+05"},
      {"replicas = 2\nseeds = [1]\n",
       "s.toml:3:1: both 'replicas' and 'seeds' are given; give one of them; replicas = 3 means "
       "seeds = [1, 2, 3]"},
      {"seeds = [1, 1]\n",
       "s.toml:2:13: 1 cannot be one of the seeds; give different whole numbers of at least 0"},
      {"seeds = 4\n", "s.toml:2:1: 'seeds' is no list of seeds; write, say, seeds = [1, 2, 3]"},
      {"accuracy = 2\n",
       "s.toml:2:1: 'accuracy' cannot be 2; give a share such as \"0.5%\" or 0.005"},
      {"accuracy_of = \"temperature\"\n",
       "s.toml:2:1: 'accuracy_of' without 'accuracy'; add, say, accuracy = \"0.5%\""},
      {"until = 0\n", "s.toml:2:1: 'until' cannot be 0; give a number greater than 0"},
      {"axes = 3\n",
       "s.toml:2:1: 'axes' is not a table; write [axes] and below it keys of the scene"},
      {"[axes]\na = 3\n",
       "s.toml:3:1: the axis \"a\" has a single value; give a list such as [0.8, 0.9], a range "
       "such "
       "as { from = 0.5, to = 0.9, count = 5 }, or move the key to [set]"},
      {"[axes]\na = []\n", "s.toml:3:1: the axis \"a\" has no values; give at least one"},
      {"[axes]\na = [1, 2, 1]\n",
       "s.toml:3:1: a=1 is given twice; remove one, or write a range of decimals as from = 0.0"},
      {"[axes]\na = { from = 1, count = 2 }\n",
       "s.toml:3:1: the range of \"a\" has no 'to'; write, say, { from = 0.5, to = 0.9, count = 5 "
       "}"},
      {"[axes]\na = { from = 0, to = 1.0, count = 2, scale = \"log\" }\n",
       "s.toml:3:1: a logarithmic range needs positive ends; give from and to greater than 0, or "
       "scale = \"linear\""},
      {"[axes]\na = { from = 0, to = 1.0, count = 2, scale = \"lin\" }\n",
       "s.toml:3:38: 'scale' cannot be \"lin\"; give one of \"linear\", \"log\"; did you mean "
       "\"log\"?"},
      {"zip = [[\"a\", \"b\"]]\n[axes]\na = [1]\n",
       "s.toml:2:14: \"b\" is not an axis; name keys of [axes]"},
      {"zip = [[\"a\", \"b\"]]\n[axes]\na = [1]\nb = [1, 2]\n",
       "s.toml:5:1: the axis \"b\" has 2 values, and \"a\" has 1; axes in one list of 'zip' need "
       "the same number of values"},
      {"replicas = 1000\n[axes]\na = { from = 1, to = 1000000, count = 1000 }\n"
       "b = { from = 1, to = 1000000, count = 1000 }\n",
       "s.toml:3:1: the sweep has 1e+09 runs; give fewer values; a sweep has at most 100000 runs"},
      {"[axes]\n\"a.b\" = [1, 2]\n[axes.a]\nb = [3, 4]\n",
       "s.toml:5:1: \"a.b\" is given twice; remove one"},
      {"[set]\na = 1\n[axes]\na = [3, 4]\n", "s.toml:5:1: \"a\" is given twice; remove one"},
      {"[set]\n\"particles.cout\" = 3\n", "s.toml:3:1: unknown key 'cout'; did you mean 'count'?"},
      {"[set]\n\"particles.start.file\" = \"a.csv\"\n",
       "s.toml:3:1: a sweep cannot set \"particles.start.file\"; name the start file in the scene, "
       "and set single keys such as \"particles.start.temperature\""},
      {"[axes]\n\"particles.restitution\" = [0.5, 1.5]\n",
       "s.toml:3:1: at particles.restitution=1.5: 'particles.restitution' cannot be 1.5; give a "
       "number between 0 and 1"},
      {"[axes]\n\"particles.restitution\" = [0.5, 0.6]\n\"particles.count\" = [20, 100000]\n",
       "s.toml:4:1: at particles.restitution=0.5 particles.count=100000: 100000 particles have no "
       "place on a lattice in the box; give at most 552"},
  };
  for (const auto& [lines, message] : mistakes) {
    CAPTURE(lines);
    const std::string found = refusal(lines);
    CHECK_MESSAGE(found.starts_with(message), found);
  }
}

}  // namespace clatter
