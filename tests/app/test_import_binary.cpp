// GSD and H5MD files of other programs, as their formats specify them.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/support/shell.h"

namespace clatter {

using namespace testing;

namespace {

std::string state_of_binary(const Shell& shell, const std::string& file) {
  const Outcome converted = shell.run("clatter convert " + file + " state.csv");
  CAPTURE(file);
  CAPTURE(converted.err);
  CHECK(converted.code == 0);
  return shell.read("state.csv");
}

}  // namespace

TEST_CASE("Import: GSD frames lack chunks where these are those of frame 0, or defaults") {
  const Shell shell;
  REQUIRE(shell.run(CLATTER_READERS "write_foreign.py").code == 0);
  const std::string disks = "x,y,vx,vy\n1,2,1,0\n12,7,-1,0\n";
  // Frame 1 has another number of disks. These have the default velocity, mass and image.
  CHECK(state_of_binary(shell, "more.gsd") == "x,y,vx,vy\n1,2,0,0\n12,7,0,0\n15,1,0,0\n");
  CHECK(state_of_binary(shell, "more.gsd --frame 0") == disks);
  REQUIRE(shell.run("clatter convert more.gsd a.xyz").code == 0);
  CHECK(says(shell.read("a.xyz"), "\nX 1 2 0 0 0 0 0 0 0 0.5\n"));
  // A box without extent along z, or with a layer that has no room for spheres, has disks.
  CHECK(state_of_binary(shell, "old.gsd") == disks);
  CHECK(state_of_binary(shell, "layer.gsd") == disks);
  CHECK(state_of_binary(shell, "spheres.gsd") == "x,y,z,vx,vy,vz\n1,2,4,1,0,0\n12,7,4,-1,0,0\n");
  CHECK(state_of_binary(shell, "spheres.gsd --dimensions 2") == disks);
  check_refused(shell, "clatter convert tilted.gsd out.csv", {"tilted.gsd: the box is tilted"});
  // Velocities that are 0 may be drawn.
  CHECK(state_of_binary(shell, "rest.gsd") == "x,y,vx,vy\n1,2,0,0\n12,7,0,0\n");
  REQUIRE(shell.run("clatter convert rest.gsd a.csv --temperature 1").code == 0);
  const Outcome sums = shell.run(
      "awk -F, 'NR > 1 { x += $3; y += $4; e += $3^2 + $4^2 } "
      "END { print (x^2 + y^2 < 1e-28), (e / 4 - 1)^2 < 1e-28 }' a.csv");
  CHECK(sums.out == "1 1\n");  // the sum of v^2 is 2 N T
  // Angular velocities are in the space of the box: 3 and -1 along z, in single precision.
  const std::string turning = state_of_binary(shell, "turning.gsd");
  const Outcome spins = shell.run(
      "awk -F, 'NR > 1 { print ($7^2 < 1e-12), ($8^2 < 1e-12), sprintf(\"%.5f\", $9) }' state.csv");
  CAPTURE(turning);
  CHECK(spins.out == "1 1 3.00000\n1 1 -1.00000\n");
}

TEST_CASE("Import: chunks of GSD that are wrong or missing are refused") {
  const Shell shell;
  REQUIRE(shell.run(CLATTER_READERS "write_foreign.py").code == 0);
  const auto refused = [&](const std::string& file, const std::string& part,
                           const std::string& flags = "") {
    check_refused(shell, "clatter convert " + file + " out.csv" + flags, {file + ": " + part});
  };
  // Exact numbers without the chunk that they belong to, which then means defaults.
  refused("lost_position.gsd", "the chunk log/particles/position contradicts the default");
  refused("lost_velocity.gsd", "the chunk log/particles/velocity contradicts the default");
  refused("lost_velocity.gsd", "the chunk log/particles/velocity contradicts", " --temperature 1");
  refused("lost_inertia.gsd", "the chunk log/particles/angular_velocity contradicts the default");
  refused("negative.gsd", "the edge of the box along z is -8");
  refused("inertia.gsd", "the moments of inertia are not those of disks or spheres");
  refused("nan_inertia.gsd", "the moments of inertia are not those of disks or spheres");
}

TEST_CASE("Import: numbers of a GSD log that contradict its chunks are refused") {
  const Shell shell;
  REQUIRE(shell
              .run("clatter measure vibrated --until 1 --every 1 --trajectory a.gsd --out r.json "
                   "--quiet")
              .code == 0);
  REQUIRE(shell.run(CLATTER_READERS "move_gsd.py").code == 0);
  // The file of the run with a particle moved, and with a frame without the exact numbers.
  check_refused(shell, "clatter convert moved.gsd out.csv",
                {"moved.gsd: the chunks log/particles/position and particles/position contradict",
                 "remove the chunk log/particles/position"});
  const Outcome rounded = shell.run("clatter convert rounded.gsd a.csv && sed -n 2p a.csv");
  CHECK(rounded.code == 0);
  CHECK(rounded.out.starts_with("10,12.5,"));  // the centre of the box
}

TEST_CASE("Import: H5MD quantities belong to the steps at which they were sampled") {
  const Shell shell;
  REQUIRE(shell.run(CLATTER_READERS "write_foreign.py").code == 0);
  check_refused(
      shell, "clatter convert rare.h5md out.csv",
      {"rare.h5md: the quantity \"velocity\" has no value at step 2 of frame 2", "--frame 0"});
  CHECK(state_of_binary(shell, "rare.h5md --frame 0") == "x,y,vx,vy\n1,2,1,0\n12,7,-1,0\n");
  // Velocities are drawn where none were sampled.
  CHECK(state_of_binary(shell, "rare.h5md --temperature 0") == "x,y,vx,vy\n3,2,0,0\n10,7,0,0\n");
  check_refused(shell, "clatter convert rare.h5md --frame 0 --temperature 0 out.csv",
                {"--temperature: rare.h5md has velocities"});
  // Fixed steps: positions at 4, 6, 8, velocities at 0, 4, 8.
  CHECK(state_of_binary(shell, "fixed.h5md") == "x,y,vx,vy\n3,2,3,0\n10,7,-3,0\n");
  CHECK(state_of_binary(shell, "fixed.h5md --frame 0") == "x,y,vx,vy\n1,2,2,0\n12,7,-2,0\n");
  check_refused(shell, "clatter convert fixed.h5md --frame 1 out.csv",
                {"no value at step 6 of frame 1", "--frame 2"});
  CHECK(state_of_binary(shell, "box.h5md") == "x,y,vx,vy\n3,2,2,0\n10,7,-2,0\n");
  check_refused(shell, "clatter convert swapped.h5md out.csv",
                {"swapped.h5md: the steps of the quantity \"velocity\"", "do not increase"});
  REQUIRE(shell.run("clatter convert still.h5md a.csv --temperature 1").code == 0);
  check_refused(
      shell, "clatter convert still.h5md out.csv",
      {"still.h5md: the particles of the group \"grains\" have no velocity", "--temperature"});
}

TEST_CASE("Import: H5MD particles have the order of their identifiers") {
  const Shell shell;
  REQUIRE(shell.run(CLATTER_READERS "write_foreign.py").code == 0);
  CHECK(state_of_binary(shell, "ids.h5md --frame 0") == "x,y,vx,vy\n1,2,1,0\n12,7,-1,0\n5,5,0,1\n");
  CHECK(state_of_binary(shell, "ids.h5md") == "x,y,vx,vy\n2,2,2,0\n11,7,-2,0\n");
  CHECK(state_of_binary(shell, "zero.h5md") == "x,y,vx,vy\n12,7,-1,0\n1,2,1,0\n");
  CHECK(state_of_binary(shell, "heavy_ids.h5md") ==
        "x,y,vx,vy,diameter,mass,species\n12,7,-1,0,1,2.5,type1\n1,2,1,0,1,1,type2\n");
}

TEST_CASE("Import: messages about H5MD name what is missing or unknown") {
  const Shell shell;
  REQUIRE(shell.run(CLATTER_READERS "write_foreign.py").code == 0);
  const auto refused = [&](const std::string& file, const std::vector<std::string>& parts) {
    check_refused(shell, "clatter convert " + file + " out.csv", parts);
  };
  refused("unbounded.h5md", {"unbounded.h5md: the box has no attribute boundary"});
  refused("strange.h5md", {"strange.h5md: the boundary \"wall\" of the box is unknown"});
  refused("next.h5md", {"next.h5md: the file has version 2 of H5MD"});
  refused("anonymous.h5md", {"anonymous.h5md: the file does not say its version of H5MD"});
  refused("scalar.h5md", {"scalar.h5md: the file does not say its version of H5MD"});
  refused("line.h5md", {"line.h5md: the dimension of the box is 1", "give 3"});
  refused("undimensioned.h5md", {"undimensioned.h5md: the box has no whole number as its"});
  refused("spelled.h5md", {"spelled.h5md: the box has no whole number as its attribute dimension"});
  refused("open.h5md", {"open.h5md: the box has no edges", "clatter needs walls"});
  refused("overflow.h5md", {"overflow.h5md: the quantity \"mass\" is too large"});
  refused("groups.h5md", {"several groups of particles", "\"Walls\"", "\"grains\"", "--group"});
  refused("groups.h5md --group Walls", {"the particles of the group \"Walls\" have no velocity"});
  refused("groups.h5md --group floor", {"no group of particles \"floor\"", "\"Walls\""});
  CHECK(state_of_binary(shell, "groups.h5md --group grains") == "x,y,vx,vy\n3,2,3,0\n10,7,-3,0\n");
  shell.write("a.csv", "x,y,vx,vy\n1,2,3,4\n");
  refused("a.csv --group all", {"--group: a.csv is no H5MD file"});
}

}  // namespace clatter
