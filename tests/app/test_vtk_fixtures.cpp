#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/messages.h"
#include "tests/support/shell.h"

namespace clatter::vtk_shapes {

using testing::says;

// The plates of a triangle and of a partition with one hole are 5 lines, a disk is a polygon of 48
// corners: 5 x 2 + 48 points. A run without fixtures removes the file.
TEST_CASE("VTK fixtures: the folder of --vtk has the shapes of fixtures") {
  const Shell shell;
  shell.write("things.toml", R"(box.size = [20, 20]
particles.count = 5
walls.left.kind = "static"
walls.right.kind = "static"
obstacle = [{ kind = "ball", centre = [5, 5], radius = 2 },
            { kind = "polygon", corners = [[10, 4], [14, 4], [12, 8]] }]
partition = [{ axis = "y", position = 12, holes = [{ from = [5], to = [8] }] }]
measure = { burn_in = 1, duration = 2, fields = ["density"] }
)");
  REQUIRE(shell.run("clatter measure things.toml --vtk maps --out r.json --quiet").code == 0);
  const std::string text = shell.read("maps/fixtures.vtp");
  CHECK(says(text, "NumberOfPoints=\"58\""));
  CHECK(says(text, "NumberOfLines=\"5\""));
  CHECK(says(text, "NumberOfPolys=\"1\""));
  REQUIRE(
      shell
          .run("clatter measure things.toml --vtk maps --out r.json --quiet --set 'obstacle=[]' "
               "--set 'partition=[]'")
          .code == 0);
  CHECK(!std::filesystem::exists(shell.path("maps/fixtures.vtp")));
}

// Two lines across the box. A series over t = 0, 1, 2, 3.
TEST_CASE("VTK fixtures: a piston has its two faces, and its place over time in the result") {
  const Shell shell;
  shell.write("piston.toml", R"(box.size = [20, 10]
particles.count = 6
walls.left.kind = "static"
walls.right.kind = "static"
piston = { position = 8, mass = 5, thickness = 0.5, speed = 0.25 }
measure = { burn_in = 1, duration = 2, series_interval = 1, fields = ["density"] }
)");
  const auto series = [&](const std::string& options) {
    REQUIRE(shell.run("clatter measure piston.toml --out r.json --quiet " + options).code == 0);
    return nlohmann::json::parse(shell.read("r.json"))
        .at("piston")
        .at("position_series")
        .get<std::vector<double>>();
  };
  // It flies freely away from a particle at rest.
  CHECK(series("--set particles.count=1 --set particles.count_left=1 "
               "--set particles.start.temperature=0") == std::vector<double>{8.0, 8.25, 8.5, 8.75});
  CHECK(series("--set piston.pinned=true --vtk maps") == std::vector<double>(4, 8.0));
  const std::string text = shell.read("maps/fixtures.vtp");
  CHECK(says(text, "NumberOfPoints=\"4\""));
  CHECK(says(text, "NumberOfLines=\"2\""));
}

}  // namespace clatter::vtk_shapes
