// Conversion of mixtures: of files of clatter, and of other programs.

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/app/trajectory_scenes.h"
#include "tests/support/shell.h"

namespace clatter {

using namespace testing;

namespace {

constexpr const char* kTwoKinds = R"([[species]]
name = "small"
count = 10
diameter = 0.5
mass = 0.2
[[species]]
name = "large"
count = 3
diameter = 2.0
mass = 6.0
polydispersity = { kind = "lognormal", width = 0.1 }
)";

// A scene with tables of species, and with more keys of its particles.
std::string scene_of_kinds(int dimension, bool rough, const std::string& tables = kTwoKinds,
                           const std::string& keys = "") {
  return std::string("title = \"M\"\nbox.size = ") +
         (dimension == 2 ? "[14, 9]\n" : "[14, 9, 8]\n") + "particles = { restitution = 0.9" +
         (rough ? ", friction = 0.4" : "") + keys + " }\n" +
         "measure = { burn_in = 1.0, duration = 2.0 }\n"
         "walls.left = { kind = \"driven\", drive_speed = 1.0 }\n"
         "walls.right = { kind = \"static\" }\n" +
         tables;
}

// The text with other words, everywhere.
std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// The trajectory t of a run of a mixture: the file, or the list of files of VTK.
std::string mixture_in(const std::string& format) {
  return "t." + format + (format == "vtp" ? ".series" : "");
}

// A text dump of LAMMPS of disks in a box of 9 x 9 between walls.
std::string dump_of(const std::string& columns, const std::vector<std::string>& rows) {
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(rows.size()) +
                     "\nITEM: BOX BOUNDS ff ff pp\n0 9\n0 9\n-1 1\nITEM: ATOMS " + columns + '\n';
  for (const std::string& row : rows) text += row + '\n';
  return text;
}

}  // namespace

TEST_CASE("Mixture convert: each format gives back the state of the run, to the bit") {
  for (const auto& [dimension, rough] : {std::pair(2, true), {2, false}, {3, true}}) {
    CAPTURE(dimension);
    CAPTURE(rough);
    const Shell shell;
    shell.write("s.toml", scene_of_kinds(dimension, rough));
    REQUIRE(shell
                .run(kRun + "--set measure.burn_in=0 --until 1 --save-state want.csv "
                            "--checkpoint c")
                .code == 0);
    const std::string want = shell.read("want.csv");
    REQUIRE(says(want, ",diameter,mass,species\n"));
    const Outcome saved = shell.run("clatter convert c from_c.csv && cmp from_c.csv want.csv");
    CHECK(saved.code == 0);
    CHECK(saved.err.empty());
    for (const std::string format : {"csv", "xyz", "lammpstrj", "gsd", "h5md", "vtp"}) {
      CAPTURE(format);
      REQUIRE(shell.run(kRun + "--until 2 --every 0.25 --trajectory t." + format).code == 0);
      const Outcome middle =
          shell.run("clatter convert " + mixture_in(format) + " --frame 4 a.csv");
      CAPTURE(middle.err);
      REQUIRE(middle.code == 0);
      // A dump has numbers of types, and no names.
      const bool named = format != "lammpstrj";
      CHECK(shell.read("a.csv") ==
            (named ? want : with(with(want, "small", "type1"), "large", "type2")));
      // The note describes the species, so that a scene can begin with the state.
      const std::string tables = middle.err.substr(middle.err.find("[[species]]"));
      CHECK(says(middle.err, "note: the scene of this start state needs these species:\n"));
      CHECK(says(tables, named ? "name = \"small\"\ndiameter = 0.5\nmass = 0.2\n"
                               : "name = \"type1\"\ndiameter = 0.5\nmass = 0.2\n"));
      shell.write("next.toml", scene_of_kinds(dimension, rough, tables,
                                              ", start = { layout = \"file\", file = \"a.csv\" }"));
      const Outcome next = shell.run(
          "clatter measure next.toml --quiet --until 1 --set measure.burn_in=0 --out next.json");
      CAPTURE(next.err);
      CHECK(next.code == 0);
    }
  }
}

TEST_CASE("Mixture convert: a frame in one format is the frame in each other format") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Shell shell;
    shell.write("s.toml", scene_of_kinds(dimension, true));
    const std::vector<std::string> boxed = {"xyz", "lammpstrj", "gsd", "h5md", "vtp"};
    for (const std::string& format : boxed) {
      REQUIRE(shell.run(kRun + "--until 2 --every 2 --trajectory t." + format).code == 0);
    }
    REQUIRE(shell.run("clatter convert t.xyz want.xyz").code == 0);
    for (const std::string& from : boxed) {
      for (const std::string& to : boxed) {
        CAPTURE(from);
        CAPTURE(to);
        REQUIRE(shell.run("clatter convert " + mixture_in(from) + " out." + to).code == 0);
        REQUIRE(shell.run("clatter convert out." + to + " back.xyz").code == 0);
        std::string back = shell.read("back.xyz"), want = shell.read("want.xyz");
        if (from == "lammpstrj" || to == "lammpstrj") {  // without time and names
          want = with(with(want, " Time=2 ", " Time=0 "), "\"small large\"", "\"type1 type2\"");
          back = with(back, " Time=2 ", " Time=0 ");
        }
        CHECK(back == want);
      }
    }
    // A start state has the box and the order of the species of its scene.
    REQUIRE(shell.run(kRun + "--set measure.burn_in=0 --until 1 --save-state s.csv").code == 0);
    for (const std::string& to : boxed) {
      REQUIRE(shell.run("clatter convert s.csv --scene s.toml a." + to).code == 0);
      REQUIRE(shell.run("clatter convert a." + to + " back.csv").code == 0);
      const std::string want = shell.read("s.csv");
      CHECK(shell.read("back.csv") ==
            (to != "lammpstrj" ? want : with(with(want, "small", "type1"), "large", "type2")));
    }
  }
}

TEST_CASE("Mixture convert: a start state without sizes needs its scene") {
  const Shell shell;
  shell.write("s.toml",
              "box.size = [9, 9]\n[[species]]\nname = \"a\"\ncount = 1\n[[species]]\n"
              "name = \"b\"\ncount = 1\ndiameter = 2\nmass = 3\n");
  shell.write("s.csv", "x,y,vx,vy,species\n1,2,1,0,b\n4,5,0,1,a\n");
  check_refused(shell, "clatter convert s.csv out.csv",
                {"s.csv: the columns diameter and mass are missing", "--scene"});
  REQUIRE(shell.run("clatter convert s.csv --scene s.toml a.csv").code == 0);
  CHECK(shell.read("a.csv") == "x,y,vx,vy,diameter,mass,species\n1,2,1,0,2,3,b\n4,5,0,1,1,1,a\n");
  REQUIRE(shell.run("clatter convert s.csv --scene s.toml a.xyz").code == 0);
  CHECK(says(shell.read("a.xyz"), "type_names=\"a b\""));
  CHECK(says(shell.read("a.xyz"), "\nX 1 2 0 1 0 0 0 0 0 1 2 3\nX 4 5 0 0 1 0 0 0 0 0.5 1 1\n"));
  shell.write("s.csv", "x,y,vx,vy,species\n1,2,1,0,c\n");
  check_refused(shell, "clatter convert s.csv --scene s.toml out.csv",
                {"--scene: the scene has no species \"c\""});
  shell.write("s.csv", "x,y,vx,vy\n1,2,1,0\n");
  check_refused(shell, "clatter convert s.csv --scene s.toml out.csv",
                {"--scene: the scene has species, and s.csv has none"});
  shell.write("s.csv", "x,y,vx,vy,species,species\n1,2,1,0,c,c\n");
  check_refused(shell, "clatter convert s.csv out.csv", {"s.csv:1: two columns are species"});
}

TEST_CASE("Mixture convert: without types, equal diameters and masses are a species") {
  const Shell shell;
  const std::string head =
      "5\nLattice=\"9 0 0 0 9 0 0 0 2\" pbc=\"F F F\" "
      "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1\n";
  shell.write("a.xyz", head +
                           "X 1 1 0 1 0 0 0.5 1\nX 3 1 0 0 0 0 1 7\nX 5 1 0 0 0 0 0.5 1\n"
                           "X 7 1 0 0 0 0 0.5 2\nX 1 3 0 0 0 0 0.5000000001 1\n");
  const Outcome run = shell.run("clatter convert a.xyz a.csv");
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  CHECK(shell.read("a.csv") ==
        "x,y,vx,vy,diameter,mass,species\n1,1,1,0,1,1,type1\n3,1,0,0,2,7,type2\n"
        "5,1,0,0,1,1,type1\n7,1,0,0,1,2,type3\n1,3,0,0,1,1,type1\n");
  CHECK(says(run.err, "name = \"type2\"\ndiameter = 2\nmass = 7\n"));
  // Masses that are absent are those of the density 1: d^2 of disks. Symbols are types.
  shell.write("a.xyz",
              "2\nLattice=\"9 0 0 0 9 0 0 0 2\" "
              "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1\n"
              "Ar 1 1 0 1 0 0 0.5\nKr 3 1 0 0 0 0 0.75\n");
  REQUIRE(shell.run("clatter convert a.xyz a.csv").code == 0);
  CHECK(shell.read("a.csv") ==
        "x,y,vx,vy,diameter,mass,species\n1,1,1,0,1,1,Ar\n3,1,0,0,1.5,2.25,Kr\n");
  // The diameter of one species as the unit of length.
  REQUIRE(shell.run("clatter convert a.xyz a.csv --scale 0.5").code == 0);
  CHECK(shell.read("a.csv") == "x,y,vx,vy,diameter,mass,species\n2,2,2,0,2,4,Ar\n6,2,0,0,3,9,Kr\n");
  // More diameters than a scene has species are a polydispersity of one.
  std::string many =
      "120\nLattice=\"300 0 0 0 9 0 0 0 2\" "
      "Properties=species:S:1:pos:R:3:velo:R:3:diameter:R:1\n";
  for (int i = 0; i < 120; ++i) {
    many +=
        "X " + std::to_string(2 * i + 1) + " 1 0 1 0 0 " + std::to_string(1.0 + i / 200.0) + '\n';
  }
  shell.write("a.xyz", many);
  const Outcome wide = shell.run("clatter convert a.xyz a.csv");
  REQUIRE(wide.code == 0);
  CHECK(says(wide.err, "polydispersity = { kind = \"uniform\", width = 0.229"));  // .595/2.595
  CHECK(says(shell.read("a.csv"), "239,1,1,0,1.595,2.544025,type1\n"));
}

TEST_CASE("Mixture convert: unequal particles of one type are polydisperse, or refused") {
  const Shell shell;
  const auto converted = [&](const std::string& text) {
    shell.write("a.dump", text);
    return shell.run("clatter convert a.dump a.csv");
  };
  const std::string columns = "id type x y z vx vy vz radius mass";
  const Outcome unequal = converted(dump_of(
      columns, {"1 3 1 1 0 1 0 0 0.5 2", "2 3 3 1 0 0 0 0 0.75 4.5", "3 1 6 1 0 0 0 0 0.5 2"}));
  CAPTURE(unequal.err);
  REQUIRE(unequal.code == 0);
  CHECK(shell.read("a.csv") ==
        "x,y,vx,vy,diameter,mass,species\n1,1,1,0,1,2,type3\n3,1,0,0,1.5,4.5,type3\n"
        "6,1,0,0,1,2,type1\n");
  // The middle of 1 and 1.5 is 1.25, the width a fifth, and the mass 2 x 1.25^2.
  CHECK(says(unequal.err,
             "[[species]]\nname = \"type3\"\ndiameter = 1.25\nmass = 3.125\n"
             "polydispersity = { kind = \"uniform\", width = 0.2 }\n"));
  CHECK(says(unequal.err, "[[species]]\nname = \"type1\"\ndiameter = 1\nmass = 2\n"));
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    shell.write("a.dump", text);
    check_refused(shell, "clatter convert a.dump out.csv", parts);
  };
  refused(
      dump_of(columns, {"1 1 1 1 0 1 0 0 0.5 2", "2 1 3 1 0 0 0 0 0.5 3"}),
      {"a.dump:11: particles of the type \"type1\" have equal diameters, and the masses 2 and 3",
       "different types"});
  refused(dump_of(columns, {"1 1 1 1 0 1 0 0 0.5 2", "2 2 3 1 0 0 0 0 0.5 0"}),
          {"a.dump:11: masses must be positive, not 0"});
  refused(dump_of(columns, {"1 1 1 1 0 1 0 0 0.5 2", "2 2 3 1 0 0 0 0 -0.5 1"}),
          {"a.dump:11: diameters must be positive, not -1"});
  refused(dump_of(columns, {"1 1 1 1 0 1 0 0 0.5 2", "2 2 3 1 0 0 0 0 0.5 1e12"}),
          {"a.dump:11: the mass is 1e+12", "1e+09"});
  refused(dump_of(columns, {"1 1 1 1 0 1 0 0 0.5 2", "2 2 3 1 0 0 0 0 1e-5 1"}),
          {"a.dump:11: the diameter is 2e-05", "--scale"});
  // The width (3 - 0.012) / (3 + 0.012) is more than that of any scene.
  refused(dump_of(columns, {"1 1 2 2 0 1 0 0 1.5 2", "2 1 5 1 0 0 0 0 0.006 1"}),
          {"a.dump:10: particles of the type \"type1\" have too different diameters, "
           "of a width of more than 0.99",
           "different types"});
  refused(dump_of(columns, {"1 1 1 1 0 1 0 0 0.5 2", "2 2 3 1 0 0 0 0 5 1"}),
          {"the box is 9 along x, not more than a diameter"});
}

TEST_CASE("Mixture convert: velocities are drawn with equal temperatures and no momentum") {
  const Shell shell;
  const std::string columns = "id type x y z radius mass";
  shell.write("a.dump", dump_of(columns, {"1 1 1 1 0 0.5 1", "2 1 3 1 0 0.5 1", "3 2 6 6 0 1 8"}));
  REQUIRE(shell.run("clatter convert a.dump a.csv --temperature 2 --seed 3").code == 0);
  const Outcome sums = shell.run(
      "awk -F, 'NR > 1 { x += $6 * $3; y += $6 * $4; e += $6 * ($3^2 + $4^2) } "
      "END { print (x^2 + y^2 < 1e-26), (e / 6 - 2)^2 < 1e-26 }' a.csv");
  CHECK(sums.out == "1 1\n");
}

}  // namespace clatter
