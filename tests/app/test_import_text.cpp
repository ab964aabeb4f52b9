// Text files of other programs, as their formats specify them.

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/shell.h"

namespace clatter {

using namespace testing;

namespace {

// A frame of two disks with a head, and properties behind pos:R:3.
std::string xyz_frame(const std::string& head, const std::string& properties = ":vel:R:3",
                      const std::string& first = " 0.5 0.25 0",
                      const std::string& second = " -0.5 -0.25 0") {
  return "2\n" + head + " Properties=species:S:1:pos:R:3" + properties + "\nA 1 2 0" + first +
         "\nA 5 6 0" + second + "\n";
}

const std::string kLattice = "Lattice=\"20 0 0 0 10 0 0 0 1\"";

std::string dump_frame(const std::string& bounds, const std::string& columns,
                       const std::vector<std::string>& atoms) {
  std::string text = "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n" + std::to_string(atoms.size()) +
                     "\nITEM: BOX BOUNDS " + bounds + "\nITEM: ATOMS " + columns + "\n";
  for (const std::string& atom : atoms) text += atom + "\n";
  return text;
}

const std::string kBounds = "pp pp pp\n-10 10\n-5 5\n-0.5 0.5";

// The start state in a file.
std::string state_in(const Shell& shell, const std::string& file, const std::string& flags = "") {
  const Outcome converted = shell.run("clatter convert " + file + " state.csv " + flags);
  CAPTURE(file);
  CAPTURE(shell.read(file));
  CAPTURE(converted.err);
  CHECK(converted.code == 0);
  return shell.read("state.csv");
}

void refuse_text(const Shell& shell, const std::string& file, const std::string& text,
                 const std::vector<std::string>& parts, const std::string& flags = "") {
  CAPTURE(text);
  shell.write(file, text);
  check_refused(shell, "clatter convert " + file + " out.csv " + flags, parts);
}

}  // namespace

TEST_CASE("Import: extended XYZ has every legal form of pbc, and no other") {
  const Shell shell;
  const auto sides = [&](const std::string& head) {
    shell.write("a.xyz", xyz_frame(kLattice + " " + head));
    const Outcome converted = shell.run("clatter convert a.xyz a.lammpstrj");
    CAPTURE(head);
    CAPTURE(converted.err);
    CHECK(converted.code == 0);
    const std::string dump = shell.read("a.lammpstrj");
    return dump.substr(dump.find("BOUNDS") + 7, 5);
  };
  for (const char* truth :
       {"pbc=\"T F F\"", "pbc=\"t f f\"", "pbc=\"true false false\"", "pbc=\"True False False\"",
        "pbc=\"TRUE FALSE FALSE\"", "pbc=\"1 0 0\"", "pbc=[T, F, F]", "pbc=[true,false,false]",
        "pbc={T F F}", "pbc='T F F'", "PBC=\"T F F\"", "Pbc = \"T,F,F\"",
        "note=\"a \\\" pbc=\" pbc=\"T F F\"", "\"pbc\"=\"T F F\""}) {
    CHECK(sides(truth) == "pp ff");
  }
  CHECK(sides("pbc=[F, F, F]") == "ff ff");
  CHECK(sides("pbc=\"0 1 0\"") == "ff pp");
  CHECK(sides("") == "pp pp");  // the default with a Lattice
  for (const char* wrong : {"pbc=\"T T\"", "pbc=\"T T T T\"", "pbc=\"\"", "pbc=\"yes no no\"",
                            "pbc=\"2 0 0\"", "pbc=\"TTF\"", "pbc=T", "pbc=\"T T F", "pbc=[T, T, F",
                            "pbc=\"T T F\" pbc=\"T T T\"", "pbc=\"T T F\"x"}) {
    refuse_text(shell, "a.xyz", xyz_frame(kLattice + " " + wrong), {"a.xyz:2: "});
  }
}

TEST_CASE("Import: extended XYZ, the head and the columns follow the specification") {
  const Shell shell;
  const std::string want = "x,y,vx,vy\n1,2,0.5,0.25\n5,6,-0.5,-0.25\n";
  const std::string matrix = "lattice=[[20, 0, 0], [0, 10, 0], [0, 0, 1]]";
  for (const std::string& text :
       {xyz_frame(kLattice), xyz_frame("Lattice={20 0 0 0 10 0 0 0 1}"), xyz_frame(matrix),
        xyz_frame("LATTICE = '20 0 0 0 10 0 0 0 1e-0'"),
        xyz_frame("a comment " + kLattice + " name=\"it's \\\\ \\n\" n=1"),
        xyz_frame(kLattice, ":velo:R:3"), xyz_frame(kLattice, ":velocities:R:3"),
        xyz_frame(kLattice, ":VELO:R:3", " 5d-1 +2.5D-1 0"),
        xyz_frame(kLattice, ":L:L:1:I:I:1:vel:R:3:f:R:1", " T -1 0.5 0.25 0 nan",
                  " False +2 -0.5 -0.25 0 1")}) {
    shell.write("a.xyz", text);
    CHECK(state_in(shell, "a.xyz") == want);
  }
  shell.write("a.xyz", xyz_frame(kLattice + " Origin=\"-1 -2 0\""));
  CHECK(state_in(shell, "a.xyz") == "x,y,vx,vy\n2,4,0.5,0.25\n6,8,-0.5,-0.25\n");
  const std::string vel = ":vel:R:3";
  const std::vector<std::pair<std::string, std::string>> rows = {
      {xyz_frame("Lattice=\"20 0 0\""), "a.xyz:2: lattice has 3 numbers"},
      {xyz_frame("Lattice=\"20 0 0 1 10 0 0 0 1\""), "a.xyz:2: the box is tilted"},
      {xyz_frame("Lattice=\"20 0 0 0 10 0 0 0 -8\""), "a.xyz:2: the edge of the box along z is -8"},
      {xyz_frame(kLattice + " Origin=\"1 2\""), "a.xyz:2: origin has 2 numbers"},
      {xyz_frame(kLattice + " pbc \"F F F\""), "a.xyz:2: the key pbc has no value"},
      {xyz_frame(kLattice + " Time=late"), "a.xyz:2: \"late\""},
      {xyz_frame(kLattice + " p[bc=\"F F F\""), "a.xyz:2: the key \"p[bc\""},
      {xyz_frame(kLattice, vel + ":x"), "a.xyz:2: the properties are no triples"},
      {xyz_frame(kLattice, ":vel:S:3"), "a.xyz:2: the property \"vel\" has the type S"},
      {xyz_frame(kLattice, ":vel:Q:3"), "a.xyz:2: the property \"vel\" has the type \"Q\""},
      {xyz_frame(kLattice, vel + ":f:R:1:f:R:1"), "a.xyz:2: the property \"f\" occurs twice"},
      {xyz_frame(kLattice, vel + "::R:1", " 0 0 0 1", " 0 0 0 1"), "a.xyz:2: a property"},
      {xyz_frame(kLattice, vel, " 0.5 +-0.25 0"), "a.xyz:3: \"+-0.25\""},
      {xyz_frame(kLattice, vel + ":n:I:1", " 0 0 0 1", " 0 0 0 1.5"), "a.xyz:4: \"1.5\""},
      {xyz_frame(kLattice, vel + ":n:L:1", " 0 0 0 T", " 0 0 0 2"), "a.xyz:4: \"2\""},
      {xyz_frame(kLattice, vel + ":radius:R:1:radii:R:1", " 0 0 0 .5 .5", " 0 0 0 .5 .5"),
       "a.xyz:2: the columns radius and radii"},
      {"2 x" + xyz_frame(kLattice).substr(1), "a.xyz:1: "}};
  for (const auto& [text, part] : rows) refuse_text(shell, "a.xyz", text, {part});
  shell.write("s.xyz", xyz_frame("\"p[bc\"=1 a [comment] " + kLattice));
  CHECK(state_in(shell, "s.xyz") == want);
}

TEST_CASE("Import: extended XYZ, arrays have two dimensions, and skipped properties any width") {
  const Shell shell;
  // A nested array of any depth is read without recursion.
  shell.write("a.xyz", xyz_frame("Lattice=" + std::string(300'000, '[')));
  check_refused(shell, "clatter convert a.xyz out.csv",
                {"a.xyz:2: arrays have at most two dimensions"});
  refuse_text(shell, "a.xyz", xyz_frame("Lattice=[[20, 0, 0], [0, 10, 0], [0, 0, 1]"),
              {"a.xyz:2: a [ has no ]"});
  std::string descriptor;
  for (int k = 0; k < 252; ++k) descriptor += " 0.5";
  shell.write("a.xyz", xyz_frame(kLattice, ":vel:R:3:soap:R:252", " 0.5 0.25 0" + descriptor,
                                 " -0.5 -0.25 0" + descriptor));
  CHECK(state_in(shell, "a.xyz") == "x,y,vx,vy\n1,2,0.5,0.25\n5,6,-0.5,-0.25\n");
  refuse_text(shell, "a.xyz", xyz_frame(kLattice, ":vel:R:3:soap:R:0"),
              {"a.xyz:2: the property \"soap\" has no positive number of columns"});
  refuse_text(shell, "a.xyz", xyz_frame(kLattice, ":vel:R:3:soap:R:1000000"),
              {"a.xyz:2: the properties have more than 1000000 columns"});
}

TEST_CASE("Import: periodic images along an axis with walls are 0 in each format") {
  const Shell shell;
  const std::string images = " 0.5 0.25 0 3 1 0", none = " -0.5 -0.25 0 0 0 0";
  shell.write("a.xyz",
              xyz_frame(kLattice + " pbc=\"F T F\"", ":vel:R:3:map_shift:I:3", images, none));
  REQUIRE(shell.run("clatter convert a.xyz out.xyz").code == 0);
  CHECK(says(shell.read("out.xyz"), "\nX 1 2 0 0.5 0.25 0 0 1 0 0.5\n"));
  shell.write("a.dump",
              dump_frame("ff pp pp\n0 20\n0 10\n0 1", "x y ix iy vx vy", {"1 2 3 1 0.5 0.25"}));
  REQUIRE(shell.run("clatter convert a.dump out.xyz").code == 0);
  CHECK(says(shell.read("out.xyz"), "\nX 1 2 0 0.5 0.25 0 0 1 0 0.5\n"));
}

TEST_CASE("Import: the extension of a trajectory counts more than a name data.NAME") {
  const Shell shell;
  shell.write("data.csv", "x,y,vx,vy\n1,2,3,4\n");
  CHECK(state_in(shell, "data.csv") == "x,y,vx,vy\n1,2,3,4\n");
  shell.write("data.xyz", xyz_frame(kLattice));
  const std::string want = "x,y,vx,vy\n1,2,0.5,0.25\n5,6,-0.5,-0.25\n";
  REQUIRE(shell.run("clatter convert data.xyz data.gsd && gzip data.xyz").code == 0);
  CHECK(state_in(shell, "data.xyz.gz") == want);
  CHECK(state_in(shell, "data.gsd") == want);
}

TEST_CASE("Import: extended XYZ, velocities follow from momenta and masses") {
  const Shell shell;
  REQUIRE(shell.run(CLATTER_READERS "write_foreign.py").code == 0);
  const std::string want = "x,y,vx,vy\n2,2,1,2\n6,6,0.5,0\n";
  CHECK(state_in(shell, "momenta.extxyz") == want);
  CHECK(state_in(shell, "heavy.extxyz") == want);
  // The file does not have the mass of an element.
  check_refused(shell, "clatter convert iron.extxyz out.csv",
                {"iron.extxyz:3: momenta need masses; give the property masses"});
  refuse_text(shell, "a.xyz", xyz_frame(kLattice, ":vel:R:3:momenta:R:3", " 1 0 0 1 0 0"),
              {"a.xyz:2: there are velocities and momenta"});
  refuse_text(
      shell, "a.xyz", xyz_frame(kLattice, ":forces:R:3"),
      {"a.xyz:2: the velocities are missing", "velo, vel, velocities or momenta", "--temperature"});
}

TEST_CASE("Import: a LAMMPS dump has scaled, unwrapped or wrapped positions") {
  const Shell shell;
  const auto state = [&](const std::string& columns, const std::vector<std::string>& atoms) {
    shell.write("a.dump", dump_frame(kBounds, columns, atoms));
    return state_in(shell, "a.dump");
  };
  const std::string want = "x,y,vx,vy\n1,2,1,0\n15,7.5,-1,0\n";
  CHECK(state("id x y z vx vy vz", {"1 -9 -3 0 1 0 0", "2 5 2.5 0 -1 0 0"}) == want);
  CHECK(state("id type xs ys zs vx vy vz ",
              {"1 1 0.05 0.2 0.5 1 0 0 ", "2 1 0.75 0.75 0.5 -1 0 0"}) == want);
  CHECK(state("xs y vx vy", {"0.05 -3 1 0", "0.75 2.5 -1 0"}) == want);
  // Periodic images are those of the file, once.
  for (const std::string columns :
       {"x y z ix iy iz", "xu yu zu", "xu yu zu ix iy iz", "xsu ysu zsu", "x y z xu yu zu"}) {
    const std::string place = columns.starts_with("x y z xu") ? "-9 -3 0 11 -13 0"
                              : columns.starts_with("x y")    ? "-9 -3 0 1 -1 0"
                              : columns.starts_with("xs")     ? "1.05 -0.8 0.5"
                              : columns.ends_with("iz")       ? "11 -13 0 1 -1 0"
                                                              : "11 -13 0";
    CAPTURE(columns);
    shell.write("a.dump", dump_frame(kBounds, columns + " vx vy vz", {place + " 1 0 0"}));
    REQUIRE(shell.run("clatter convert a.dump a.xyz").code == 0);
    CHECK(says(shell.read("a.xyz"), "\nX 1 2 0 1 0 0 1 -1 0 0.5\n"));
  }
  const auto refused = [&](const std::string& columns, const std::vector<std::string>& atoms,
                           const std::string& part) {
    refuse_text(shell, "a.dump", dump_frame(kBounds, columns, atoms), {part});
  };
  refused("id x z vx vy", {"1 0 0 0 0"}, "a.dump:9: the positions are missing");
  refused("id x y ix vx vy", {"1 0 0 0 0 0"}, "a.dump:9: the column iy is missing");
  refused("id x y vx vy", {"1 0 0 0 0", "1 2 2 0 0"}, "a.dump:11: the particle 1 occurs twice");
  refused("id x y vx vy", {"1.5 0 0 0 0"}, "a.dump:10: the number of the particle is 1.5");
  // Each column of a position agrees with the others, up to the six digits of LAMMPS.
  CHECK(state("x xs xu xsu ix y iy vx vy",
              {"-9 0.05 11 1.05 1 -3 0 1 0", "5 .75 5 .75 0 2.5 0 -1 0"}) == want);
  CHECK(state("x xs y vx vy", {"-9.0001220703125 0.05 -3 1 0"}) ==
        "x,y,vx,vy\n0.9998779296875,2,1,0\n");
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"x y xu vx vy", "1 2 8 0 0", "1 and 8"},
                                             {"x y xs vx vy", "1 2 0.5 0 0", "1 and 0"},
                                             {"x y xu xsu vx vy", "1 2 1 1.5 0 0", "1 and 20"},
                                             {"x y ix iy xu vx vy", "1 2 1 0 1 0 0", "21 and 1"}}) {
    refused(wrong[0], {wrong[1]},
            "a.dump:10: the positions along x contradict each other: " + wrong[2]);
  }
  // Atoms without an atom map have the number 0.
  CHECK(state("id x y vx vy", {"0 -9 -3 1 0", "0 5 2.5 -1 0"}) == want);
}

TEST_CASE("Import: a LAMMPS dump has a box in each form of its header") {
  const Shell shell;
  const std::string columns = "id x y z vx vy vz", atom = "1 -9 -3 0 1 0 0";
  for (const std::string& bounds :
       {kBounds, std::string("xy xz yz pp pp pp\n-10 10 0\n-5 5 0\n-0.5 0.5 0"),
        std::string("xy xz yz pp pp pp\n-10 10 -0.0\n-5 5 1e-17\n-0.5 0.5 0"),
        std::string("abc origin pp pp pp\n20 0 0 -10\n0 10 0 -5\n0 0 1 -0.5")}) {
    shell.write("a.dump", dump_frame(bounds, columns, {atom}));
    CHECK(state_in(shell, "a.dump") == "x,y,vx,vy\n1,2,1,0\n");
    REQUIRE(shell.run("clatter convert a.dump a.xyz").code == 0);
    CHECK(says(shell.read("a.xyz"), "Lattice=\"20 0 0 0 10 0 0 0 1\""));
    CHECK(says(shell.read("a.xyz"), "pbc=\"T T F\""));
  }
  const auto refused = [&](const std::string& bounds, const std::string& part) {
    refuse_text(shell, "a.dump", dump_frame(bounds, columns, {atom}), {part});
  };
  refused("xy xz yz pp pp pp\n-10 10 0.5\n-5 5 0\n-0.5 0.5 0", "the box is tilted");
  refused("abc origin pp pp pp\n20 1 0 -10\n0 10 0 -5\n0 0 1 -0.5", "the box is tilted");
  refused("xy xz yz\n-10 10 0\n-5 5 0\n-0.5 0.5 0", "a.dump:5: the kinds of boundaries");
  refused("\n-10 10\n-5 5\n-0.5 0.5", "a.dump:5: the kinds of boundaries are missing");
  refused("pp pp pp\n-10 10\n-5 5\n0.5 -25", "a.dump:8: the edge of the box along z is -25.5");
  shell.write("a.dump", dump_frame("pp pp pp\n-10 10\n-5 5\n0 0", columns, {atom}));
  CHECK(state_in(shell, "a.dump") == "x,y,vx,vy\n1,2,1,0\n");  // disks in a box without depth
  refused("pp pf pp\n-10 10\n-5 5\n-0.5 0.5", "a.dump:5: \"pf\" is no kind of boundaries");
  refused("pp pp pp\n-10 10 0\n-5 5 0\n-0.5 0.5 0", "a.dump:6: this line has 3 words");
  refused("pp pp pp\n10 -10\n-5 5\n-0.5 0.5", "a.dump:6: the edge of the box along x is -20");
}

TEST_CASE("Import: a frame of a LAMMPS dump has each of its items once") {
  const Shell shell;
  const std::string good = dump_frame(kBounds, "x y vx vy", {"-9 -3 1 0"});
  const auto refused = [&](const std::string& from, const std::string& to,
                           const std::string& part) {
    std::string text = good;
    refuse_text(shell, "a.dump", text.replace(text.find(from), from.size(), to), {part});
  };
  const std::string step = "ITEM: TIMESTEP\n100\n", count = "ITEM: NUMBER OF ATOMS\n1\n";
  refused(step, "", "a.dump:1: unexpected line \"ITEM: NUMBER OF ATOMS\"; give a text dump");
  refused(step, step + step, "a.dump:3: the frame has a second \"ITEM: TIMESTEP\"");
  refused(count, count + count, "a.dump:5: the frame has a second \"ITEM: NUMBER OF ATOMS\"");
  shell.write("a.dump", good + good);
  CHECK(state_in(shell, "a.dump") == "x,y,vx,vy\n1,2,1,0\n");
}

TEST_CASE("Import: particles that stay in a plane are disks") {
  const Shell shell;
  const auto write = [&](const std::string& z_bounds, const std::string& first,
                         const std::string& second) {
    shell.write("a.dump", dump_frame("pp pp pp\n0 20\n0 10\n" + z_bounds, "id x y z vx vy vz",
                                     {"1 1 3 " + first, "2 12 7 " + second}));
  };
  const std::string disks = "x,y,vx,vy\n1,3,1,0\n12,7,-1,0\n";
  const std::vector<std::vector<std::string>> planes = {
      {"0 1", "0.5 1 0 0", "0.5 -1 0 0"},
      {"-0.5 0.5", "1e-17 1 0 0", "-0 -1 0 -1e-17"},
      {"0 1", "0.5 1 0 1e-16", "0.49999999999999994 -1 0 0"},
      {"-0.1 0.1", "0 1 0 0", "0 -1 0 0"}};
  for (const std::vector<std::string>& plane : planes) {
    write(plane[0], plane[1], plane[2]);
    CHECK(state_in(shell, "a.dump") == disks);
  }
  // A deep box may also be meant for spheres, so there is a note and a choice.
  write("0 10", "5 1 0 0", "5 -1 0 0");
  const Outcome deep = shell.run("clatter convert a.dump state.csv");
  CHECK(deep.code == 0);
  CHECK(says(deep.err, "note: all particles of a.dump move in one plane z"));
  CHECK(shell.read("state.csv") == disks);
  CHECK(state_in(shell, "a.dump", "--dimensions 3") ==
        "x,y,z,vx,vy,vz\n1,3,5,1,0,0\n12,7,5,-1,0,0\n");
  CHECK(shell.run("clatter convert a.dump a.csv --dimensions 2").err.empty());
  // No scene has spheres in a layer of one diameter.
  write("0 1", "0.5 1 0 0", "0.75 -1 0 0");
  check_refused(shell, "clatter convert a.dump out.csv",
                {"a.dump:11: the box is 1 along z, too thin for spheres"});
  write("0 10", "0.5 1 0 0", "0.5 -1 0 0.25");
  check_refused(shell, "clatter convert a.dump out.csv --dimensions 2",
                {"a.dump:11: the particle is not in the plane of the first, or leaves it"});
}

TEST_CASE("Import: sizes and masses are equal apart from rounding") {
  const Shell shell;
  const auto dump = [&](const std::string& quantity, const std::string& first,
                        const std::string& second) {
    return dump_frame(kBounds, "id x y z vx vy vz " + quantity,
                      {"1 -9 -3 0 1 0 0 " + first, "2 5 2.1 0 -1 0 0 " + second});
  };
  const auto state = [&](const std::string& text, const std::string& flags = "") {
    shell.write("a.dump", text);
    return state_in(shell, "a.dump", flags);
  };
  const std::string want = state(dump("radius", "0.5", "0.5"));
  CHECK(state(dump("radius", "0.49999999999999994", "0.5")) == want);  // 0.0065 * (1 / 0.013)
  CHECK(state(dump("diameter", "0.9999999999", "1.0000000001")) == want);
  CHECK(state(dump("mass", "1", "0.99999999999999989")) == want);
  CHECK(state(dump("mass", "5e-9", "5.000000001e-9")) == want);
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts,
                           const std::string& flags = "") {
    refuse_text(shell, "a.dump", text, parts, flags);
  };
  CHECK(says(state(dump("radius", "0.5", "0.7")), ",diameter,mass,species\n"));
  CHECK(says(state(dump("mass", "1", "1.00001")), ",1,1,type1\n"));
  refused(dump("mass", "0", "0"), {"a.dump:10: masses must be positive"});
  refused(dump("radius", "0.7", "0.7"),
          {"a.dump:10: the diameter is 1.4 instead of 1", "--scale 1.4"});
  refused(dump("radius diameter", "0.5 1", "0.5 1.1"), {"a.dump:11: the radius 0.5 does not fit"});
  // With its diameter as the unit of length the box is 10 x 5, and speeds are half.
  const std::string large = dump("radius", "1", "1");
  CHECK(state(large, "--scale 2") == "x,y,vx,vy\n0.5,1,0.5,0\n7.5,3.55,-0.5,0\n");
  REQUIRE(shell.run("clatter convert a.dump a.xyz --scale 2").code == 0);
  CHECK(says(shell.read("a.xyz"), "Lattice=\"10 0 0 0 5 0 0 0 1\""));
  refused(large, {"the diameter is 0.8 instead of 1", "--scale 2"}, "--scale 2.5");
  // In metres the box has no room for a particle of diameter 1.
  const std::string metres = dump_frame("pp pp pp\n0 0.02\n0 0.01\n0 0.001", "x y z vx vy vz",
                                        {"0.001 0.002 0 0.001 0 0"});
  refused(metres, {"the box is 0.02 along x", "--scale"});
  CHECK(state(metres, "--scale 0.001") == "x,y,vx,vy\n1,2,1,0\n");
  refused(large, {"--scale"}, "--scale 0");
  refused(large, {"--scale"}, "--scale -1");
}

TEST_CASE("Import: velocities are drawn for particles without any") {
  const Shell shell;
  // The same velocities as those of a scene with as many particles.
  shell.write("s.toml",
              "box.size = [20, 10]\n[particles]\ncount = 3\nstart = { temperature = 2.5 }\n");
  REQUIRE(shell
              .run("clatter measure s.toml --set measure.burn_in=0 --until 1e-9 --seed 7 "
                   "--trajectory t.csv --every 1 --out r.json --quiet")
              .code == 0);
  const std::string lines = shell.read("t.csv");
  shell.write("a.xyz", "3\n" + kLattice + "\nX 1 2 0\nX 5 6 0\nX 9 3 0\n");
  check_refused(shell, "clatter convert a.xyz out.csv",
                {"a.xyz:2: the velocities are missing", "--temperature"});
  REQUIRE(shell.run("clatter convert a.xyz a.csv --temperature 2.5 --seed 7").code == 0);
  const auto velocities = [](const std::string& csv, int first) {
    std::string found;
    for (std::size_t line = csv.find('\n') + 1; line < csv.size();
         line = csv.find('\n', line) + 1) {
      std::size_t cell = line;
      for (int k = 0; k < first; ++k) cell = csv.find(',', cell) + 1;
      found += csv.substr(cell, csv.find('\n', cell) - cell) + '\n';
    }
    return found;
  };
  CHECK(velocities(shell.read("a.csv"), 2) == velocities(lines, 6));
  // Another seed, momentum and temperature.
  REQUIRE(shell.run("clatter convert a.xyz b.csv --temperature 2.5").code == 0);
  CHECK(shell.read("a.csv") != shell.read("b.csv"));
  const Outcome sums = shell.run(
      "awk -F, 'NR > 1 { x += $3; y += $4; e += $3^2 + $4^2 } "
      "END { print (x^2 + y^2 < 1e-28), (e / 6 - 2.5)^2 < 1e-28 }' b.csv");
  CHECK(sums.out == "1 1\n");
  REQUIRE(shell.run("clatter convert a.xyz c.csv --temperature 0").code == 0);
  CHECK(shell.read("c.csv") == "x,y,vx,vy\n1,2,0,0\n5,6,0,0\n9,3,0,0\n");
  // Particles at rest have none, and velocities are not replaced.
  CHECK(
      shell.run("clatter convert c.csv d.csv --temperature 2.5 --seed 7 && cmp a.csv d.csv").code ==
      0);
  check_refused(shell, "clatter convert a.csv out.csv --temperature 1",
                {"--temperature: a.csv has velocities"});
  check_refused(shell, "clatter convert a.xyz out.csv --seed 3", {"--seed", "--temperature"});
}

TEST_CASE("Import: a CSV of other programs is read whole, or refused") {
  const Shell shell;
  const auto state = [&](const std::string& text) {
    shell.write("a.csv", text);
    return state_in(shell, "a.csv");
  };
  const std::string want = "x,y,vx,vy\n1,2,3,4\n5,6,7,8\n";
  CHECK(state("\"x\",\"y\",\"vx\",\"vy\"\r\n1,2,\"3\",4\r\n 5 ,\t6,+7,8\r\n") == want);
  CHECK(state("particle,x,y,vx,vy\n1,5,6,7,8\n0,1,2,3,4\n") == want);
  CHECK(state("# a comment\n\ntime,x,y,vx,vy\n0,9,9,9,9\n0,8,8,8,8\n1,1,2,3,4\n1,5,6,7,8\n") ==
        want);
  const auto refused = [&](const std::string& text, const std::string& part) {
    refuse_text(shell, "a.csv", text, {part});
  };
  refused("particle,x,y,vx,vy\n1,5,6,7,8\n1,1,2,3,4\n", "a.csv:3: the particle 1 occurs twice");
  refused("particle,x,y,vx,vy\n0,5,6,7,8\n0,1,2,3,4\n", "a.csv:3: the particle 0 occurs twice");
  refused("time,particle,x,y,vx,vy\n0,0,1,2,3,4\n1,0,1,2,3,4\n0,1,5,6,7,8\n1,1,5,6,7,8\n",
          "a.csv:4: the time goes back from 1 to 0");
  refused("x,y,vx,vy,omega_x\n1,2,3,4,5\n", "a.csv:1: the column \"omega_x\" is not one of disks");
  refused("x,y,z,vx,vy,vz,omega\n1,2,3,4,5,6,7\n",
          "a.csv:1: the column \"omega\" is not one of spheres");
  refused("x,y,z,vx,vy,vz,omega_x\n1,2,3,4,5,6,7\n", "a.csv:1: the angular velocities of spheres");
  refused("x,y,vx,vy\n1,2,3,\"4\n", "a.csv:2: \"\\\"4\" is no finite number");
  refused("x,y\n1,2\n", "a.csv:1: the velocities are missing");
  // A scene reads the same file as its start state.
  shell.write("a.csv", "\"x\",\"y\",\"vx\",\"vy\"\r\n1,2,+3,4\r\n");
  shell.write("s.toml",
              "box.size = [8, 6]\nparticles.start = { layout = \"file\", file = \"a.csv\" }\n");
  CHECK(shell.run("clatter measure s.toml --until 1 --quiet --out r.json").code == 0);
}

TEST_CASE("Import: text may be compressed by gzip") {
  const Shell shell;
  shell.write("a.xyz", xyz_frame(kLattice));
  shell.write("a.dump", dump_frame(kBounds, "x y vx vy", {"-9 -3 1 0"}));
  shell.write("a.csv", "x,y,vx,vy\n1,2,3,4\n");
  for (const std::string file : {"a.xyz", "a.dump", "a.csv"}) {
    const std::string plain = state_in(shell, file);
    CHECK(shell.run("gzip -k " + file).code == 0);
    CHECK(state_in(shell, file + ".gz") == plain);
    CHECK(shell.run("clatter convert " + file + ".gz out.csv").err.empty());
  }
  // Two parts, and a file much larger than its compressed form.
  REQUIRE(shell.run("head -1 a.csv | gzip >b.csv.gz; tail -1 a.csv | gzip >>b.csv.gz").code == 0);
  CHECK(state_in(shell, "b.csv.gz") == shell.read("a.csv"));
  REQUIRE(
      shell.run("(head -1 a.csv; yes '# filling' | head -300000; tail -1 a.csv) | gzip >c.csv.gz")
          .code == 0);
  CHECK(state_in(shell, "c.csv.gz") == shell.read("a.csv"));
  const std::string whole = shell.read("a.csv.gz");
  shell.write("d.csv.gz", whole.substr(0, whole.size() - 5));
  check_refused(shell, "clatter convert d.csv.gz out.csv",
                {"d.csv.gz: the compressed file is damaged"});
  // A compressed file is no text without its last newline, whatever its name.
  REQUIRE(shell.run("gzip -c a.csv >e.csv").code == 0);
  const Outcome plain_name = shell.run("clatter convert e.csv out.csv");
  CHECK(plain_name.code == 0);
  CHECK(plain_name.err.empty());
  check_refused(
      shell,
      "gzip -c a.csv >a.gsd.gz; clatter convert a.gsd.gz out.csv; e=$?; rm a.gsd.gz; exit $e",
      {"IN: a.gsd.gz is compressed", "gunzip"});
}

}  // namespace clatter
