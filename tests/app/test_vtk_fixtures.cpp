#include <doctest/doctest.h>

#include <filesystem>
#include <string>

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

}  // namespace clatter::vtk_shapes
