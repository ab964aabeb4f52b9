#include <doctest/doctest.h>

#include "app/sweep/sweep_file.h"
#include "tests/support/messages.h"

namespace clatter {

using testing::refusal_of;
using testing::says;

static std::vector<std::string> points_of(const std::string& text) {
  std::vector<std::string> points;
  for (const SweepPoint& point : read_sweep("scene = \"vibrated\"\n" + text, "s.toml").points()) {
    points.push_back(settings_text(point));
  }
  return points;
}

TEST_CASE("Sweep file: points are the product of axes, zipped axes and ranges") {
  struct Axes {
    std::string text;
    std::vector<std::string> points;
  };
  const std::string range = "[axes]\na = { from = ";
  for (const auto& [text, points] : {
           Axes{"", {""}},
           // The last axis is the fastest.
           Axes{"[axes]\n\"particles.restitution\" = [0.8, 0.9]\nparticles.count = [7, 5]\n",
                {"particles.restitution=0.8 particles.count=7",
                 "particles.restitution=0.8 particles.count=5",
                 "particles.restitution=0.9 particles.count=7",
                 "particles.restitution=0.9 particles.count=5"}},
           // The order is that of the file, not of the names; values may be texts and lists.
           Axes{"[axes]\n\"walls.left.kind\" = [\"static\"]\n\"box.size\" = [[10, 20.5]]\n",
                {"walls.left.kind=\"static\" box.size=[10, 20.5]"}},
           // Axes in zip vary together.
           Axes{"zip = [[\"c\", \"a\"]]\n[axes]\na = [1, 2]\nb = [3, 4]\nc = [5, 6]\n",
                {"a=1 c=5 b=3", "a=1 c=5 b=4", "a=2 c=6 b=3", "a=2 c=6 b=4"}},
           Axes{range + "0.1, to = 0.5, count = 5 }\n",
                {"a=0.1", "a=0.2", "a=0.3", "a=0.4", "a=0.5"}},
           Axes{range + "1.0, to = 2, count = 2 }\n", {"a=1.0", "a=2.0"}},
           // 10 * 10^(k/3): 21.54, 46.42.
           Axes{range + "10, to = 100, count = 4, scale = \"log\" }\n",
                {"a=10", "a=22", "a=46", "a=100"}},
           Axes{range + "1e-300, to = 1e300, count = 3, scale = \"log\" }\n",
                {"a=1e-300", "a=1.0", "a=1e+300"}},
           Axes{range + "-1e308, to = 1e308, count = 3 }\n", {"a=-1e+308", "a=0.0", "a=1e+308"}},
           Axes{range + "1e-3, to = 1e-1, count = 3, scale = \"log\" }\n",
                {"a=0.001", "a=0.01", "a=0.1"}},
           Axes{range + "3, to = 1, count = 1 }\n", {"a=3"}},
       }) {
    CAPTURE(text);
    CHECK(points_of(text) == points);
  }
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
  struct Mistake {
    std::string lines, place, words;
  };
  const std::string log_range = "[axes]\na = { from = 0, to = 1.0, count = 2, scale = ";
  for (const auto& [lines, place, words] : {
           Mistake{"replica = 3\n", "2:1", "did you mean 'replicas'?"},
           Mistake{"replicas = 0\n", "2:1", "between 1 and 1e+05"},
           Mistake{"replicas = 2\nseeds = [1]\n", "3:1", "give one of them"},
           Mistake{"seeds = [1, 1]\n", "2:13", "different whole numbers"},
           Mistake{"seeds = 4\n", "2:1", "seeds = [1, 2, 3]"},
           Mistake{"accuracy = 2\n", "2:1", "\"0.5%\" or 0.005"},
           Mistake{"accuracy_of = \"temperature\"\n", "2:1", "without 'accuracy'"},
           Mistake{"until = 0\n", "2:1", "greater than 0"},
           Mistake{"axes = 3\n", "2:1", "not a table"},
           Mistake{"[axes]\na = 3\n", "3:1", "a single value"},
           Mistake{"[axes]\na = []\n", "3:1", "no values"},
           Mistake{"[axes]\na = [1, 2, 1]\n", "3:1", "a=1 is given twice"},
           Mistake{"[axes]\na = { from = 1, count = 2 }\n", "3:1", "no 'to'"},
           Mistake{log_range + "\"log\" }\n", "3:1", "positive ends"},
           Mistake{log_range + "\"lin\" }\n", "3:38", "did you mean \"log\"?"},
           Mistake{"zip = [[\"a\", \"b\"]]\n[axes]\na = [1]\n", "2:14", "\"b\" is not an axis"},
           Mistake{"zip = [[\"a\", \"b\"]]\n[axes]\na = [1]\nb = [1, 2]\n", "5:1",
                   "\"b\" has 2 values, and \"a\" has 1"},
           Mistake{"replicas = 1000\n[axes]\na = { from = 1, to = 1000000, count = 1000 }\n"
                   "b = { from = 1, to = 1000000, count = 1000 }\n",
                   "3:1", "1e+09 runs"},
           Mistake{"[axes]\n\"a.b\" = [1, 2]\n[axes.a]\nb = [3, 4]\n", "5:1",
                   "\"a.b\" is given twice"},
           Mistake{"[set]\na = 1\n[axes]\na = [3, 4]\n", "5:1", "\"a\" is given twice"},
           Mistake{"[set]\n\"particles.cout\" = 3\n", "3:1", "did you mean 'count'?"},
           Mistake{"[set]\n\"particles.start.file\" = \"a.csv\"\n", "3:1",
                   "cannot set \"particles.start.file\""},
           Mistake{"[axes]\n\"particles.restitution\" = [0.5, 1.5]\n", "3:1",
                   "at particles.restitution=1.5: "},
           Mistake{"[axes]\n\"particles.restitution\" = [0.5, 0.6]\n"
                   "\"particles.count\" = [20, 100000]\n",
                   "4:1", "at particles.restitution=0.5 particles.count=100000: "},
       }) {
    CAPTURE(lines);
    const std::string found = refusal(lines);
    CAPTURE(found);
    CHECK(found.starts_with("s.toml:" + place + ": "));
    CHECK(says(found, words));
  }
}

}  // namespace clatter
