// Conversion of start states, trajectories and checkpoints.

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/trajectory_scenes.h"
#include "tests/support/shell.h"

namespace clatter {

using namespace testing;

namespace {

const std::vector<std::string> kBoxed = {"xyz", "lammpstrj", "gsd", "h5md", "vtp"};
constexpr const char* kFrame =
    "2\nLattice=\"8 0 0 0 6 0 0 0 1\" pbc=\"T F F\" Time=3 "
    "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1\n"
    "X 1 2 0 0.5 0.25 0 0.5\nX 3 4 0 -0.5 0 0 0.5\n";

// The trajectory t of a run: the file, or the list of files of VTK.
std::string run_in(const std::string& format) {
  return "t." + format + (format == "vtp" ? ".series" : "");
}

std::string hash_after(const Shell& shell, const std::string& state) {
  const Outcome run = shell.run(
      "clatter measure s.toml --quiet --set measure.burn_in=0 --until 3 "
      "--set 'particles.start={layout=\"file\",file=\"" +
      state + "\"}' --out h.json && grep state_hash h.json");
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  return run.out;
}

}  // namespace

TEST_CASE("Convert: each format gives back the state of the run, to the bit") {
  for (const char* scene : {kDisks, kSmoothDisks, kSpheres}) {
    const Shell shell;
    shell.write("s.toml", scene);
    CAPTURE(scene);
    // The state at a frame in the middle of a trajectory. At 1 the wall of the disks is at rest.
    REQUIRE(shell
                .run(kRun + "--set measure.burn_in=0 --until 1 --save-state want.csv "
                            "--checkpoint c")
                .code == 0);
    REQUIRE(shell.run("clatter convert c from_c.csv && cmp from_c.csv want.csv").code == 0);
    std::vector<std::string> formats = kBoxed;
    formats.push_back("csv");
    for (const std::string& format : formats) {
      CAPTURE(format);
      REQUIRE(shell.run(kRun + "--until 2 --every 0.25 --trajectory t." + format).code == 0);
      const Outcome middle = shell.run("clatter convert " + run_in(format) + " --frame 4 a.csv");
      CAPTURE(middle.err);
      REQUIRE(middle.code == 0);
      CHECK(shell.read("a.csv") == shell.read("want.csv"));
      CHECK(hash_after(shell, "a.csv") == hash_after(shell, "want.csv"));
      REQUIRE(shell.run("clatter convert " + run_in(format) + " last.csv").code == 0);
      REQUIRE(shell.run("clatter convert " + run_in(format) + " --frame 8 eight.csv").code == 0);
      CHECK(shell.run("cmp last.csv eight.csv").code == 0);
      CHECK(shell.run("cmp last.csv want.csv").code != 0);
    }
  }
}

TEST_CASE("Convert: a frame in one format is the frame in each other format") {
  for (const char* scene : {kDisks, kSmoothDisks, kSpheres}) {
    const Shell shell;
    shell.write("s.toml", scene);
    CAPTURE(scene);
    for (const std::string& format : kBoxed) {
      REQUIRE(shell.run(kRun + "--until 9 --every 9 --trajectory t." + format).code == 0);
    }
    REQUIRE(shell.run("clatter convert t.xyz want.xyz").code == 0);
    for (const std::string& from : kBoxed) {
      for (const std::string& to : kBoxed) {
        CAPTURE(from);
        CAPTURE(to);
        REQUIRE(shell.run("clatter convert " + run_in(from) + " out." + to).code == 0);
        // Back as extended XYZ, which has all quantities. A dump has no time.
        REQUIRE(shell.run("clatter convert out." + to + " back.xyz").code == 0);
        CHECK(shell
                  .run("for f in want back; do sed 's/ Time=[^ ]*//' $f.xyz >$f; done; "
                       "cmp want back")
                  .code == 0);
        if (from != "lammpstrj" && to != "lammpstrj") {
          CHECK(says(shell.read("back.xyz"), " Time=9 "));
        }
      }
    }
    // A start state gets its box from the scene, and a checkpoint has it.
    REQUIRE(shell
                .run(kRun + "--set measure.burn_in=0 --until 1 --save-state s.csv "
                            "--checkpoint c")
                .code == 0);
    for (const std::string& to : kBoxed) {
      REQUIRE(shell.run("clatter convert s.csv --scene s.toml a." + to).code == 0);
      REQUIRE(shell.run("clatter convert a." + to + " back.csv && cmp s.csv back.csv").code == 0);
      REQUIRE(shell
                  .run("clatter convert c b." + to + " && clatter convert a." + to +
                       " a.csv && clatter convert b." + to + " b.csv && cmp a.csv b.csv")
                  .code == 0);
    }
    check_refused(shell, "clatter convert s.csv new.xyz",
                  {"s.csv: the file has no box; give its scene with --scene"});
    check_refused(shell, "clatter convert t.xyz --scene s.toml new.xyz",
                  {"--scene: t.xyz has a box; omit --scene"});
    check_refused(shell, "clatter convert c --frame 0 new.csv",
                  {"--frame: a checkpoint has one state; omit --frame"});
  }
}

TEST_CASE("Convert: a file without particles keeps the dimension of its box") {
  for (const bool spheres : {false, true}) {
    const Shell shell;
    shell.write("s.toml", spheres ? kSpheres : kDisks);
    for (const std::string& format : kBoxed) {
      CAPTURE(spheres);
      CAPTURE(format);
      const Outcome run = shell.run(
          "clatter measure s.toml --quiet --set particles.count=0 "
          "--until 2 --every 2 --trajectory t." +
          format + " && clatter convert " + run_in(format) + " a.csv");
      CAPTURE(run.err);
      REQUIRE(run.code == 0);
      CHECK(says(shell.read("a.csv"), ",vz") == spheres);
    }
  }
}

TEST_CASE("Convert: files of other programs with the same columns") {
  const Shell shell;
  // A box away from the origin, atoms in any order, and one beyond the periodic side.
  shell.write("a.dump",
              "ITEM: UNITS\nlj\nITEM: TIME\n2.5\nITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\n"
              "ITEM: BOX BOUNDS pp ff pp\n-4 4\n-3 3\n-0.5 0.5\n"
              "ITEM: ATOMS id type mass x y z vx vy vz\n"
              "7 1 1 4.5 1 0 0.5 0.25 0\n3 1 1 -2 -1 0 1 0 0 \n");
  REQUIRE(shell.run("clatter convert a.dump a.xyz").code == 0);
  CHECK(says(shell.read("a.xyz"), "pbc=\"T F F\" Time=2.5 "));
  CHECK(says(shell.read("a.xyz"), "\nX 2 2 0 1 0 0 0 0 0 0.5\nX 0.5 4 0 0.5 0.25 0 1 0 0 0.5\n"));
  const Outcome written = shell.run(CLATTER_READERS
                                    "write_trajectories.py o.gsd o.h5md heavy.gsd heavy.h5md "
                                    "huge.h5md");
  CAPTURE(written.err);
  REQUIRE(written.code == 0);
  const std::string want = "x,y,z,vx,vy,vz\n0.5,3.5,2.25,1,0,0.5\n5,1.5,2.5,0,2,0\n";
  for (const std::string file : {"o.gsd", "o.h5md"}) {
    CAPTURE(file);
    const Outcome converted = shell.run("clatter convert " + file + " o.csv");
    CAPTURE(converted.err);
    REQUIRE(converted.code == 0);
    CHECK(shell.read("o.csv") == want);
    REQUIRE(shell.run("clatter convert " + file + " o.xyz").code == 0);
    CHECK(says(shell.read("o.xyz"), file == "o.gsd" ? "pbc=\"T T T\"" : "pbc=\"T F F\" Time=0.5"));
  }
  for (const std::string file : {"heavy.gsd", "heavy.h5md"}) {
    REQUIRE(shell.run("clatter convert " + file + " o.csv").code == 0);
    CHECK(shell.read("o.csv") ==
          "x,y,z,vx,vy,vz,diameter,mass,species\n0.5,3.5,2.25,1,0,0.5,1,1,type1\n"
          "5,1.5,2.5,0,2,0,1,2.5,type2\n");
  }
  shell.run("rm o.csv");
  check_refused(shell, "clatter convert huge.h5md o.csv",
                {"huge.h5md: the quantity \"position\" is too large"});
}

TEST_CASE("Convert, measure: a text file without its last newline is read with a note") {
  const Shell shell;
  shell.write("s.csv", "x,y,vx,vy\n2,2,1,0.25\n");
  shell.write("cut.csv", "x,y,vx,vy\n2,2,1,0.25");
  CHECK(shell.run("clatter convert s.csv a.csv").err.empty());
  const Outcome cut = shell.run("clatter convert cut.csv b.csv && cmp a.csv b.csv");
  CHECK(cut.code == 0);
  CHECK(says(cut.err, "note: cut.csv ends without a newline"));
  // As a start state of a scene.
  for (const std::string file : {"s.csv", "cut.csv"}) {
    shell.write("s.toml",
                "box.size = [8, 6]\nparticles.start.layout = \"file\"\nparticles.start.file = '" +
                    file + "'\n");
    const Outcome run = shell.run("clatter measure s.toml --until 1 --progress none");
    CHECK(run.code == 0);
    CHECK(says(run.err, "cut.csv ends without a newline") == (file == "cut.csv"));
  }
  CHECK(shell.run("clatter measure s.toml --until 1 --quiet").err.empty());
}

TEST_CASE("Convert: malformed text files are refused with the line") {
  const Shell shell;
  const std::string good = kFrame;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  struct Row {
    std::string file, text, part;
  };
  for (const Row& row : {
           Row{"a.xyz", "", "a.xyz: the file has no frame"},
           {"a.xyz", good.substr(0, good.size() - 21), "a.xyz:3: the file ends within"},
           {"a.xyz", good.substr(0, good.size() - 8), "a.xyz:4: this line has 5 columns"},
           {"a.xyz", changed("-0.5 0 0", "nan 0 0"), "a.xyz:4: \"nan\""},
           {"a.xyz", changed("2\n", "3\n"), "a.xyz:4: the file ends within"},
           {"a.xyz", changed("2\n", "99999999999999999999\n"), "is no number of particles"},
           {"a.xyz", changed("2\n", "-1\n"), "a.xyz:1: \"-1\""},
           {"a.xyz", changed("8 0 0", "0 0 0"), "a.xyz:2: the edge of the box along x is 0"},
           {"a.xyz", changed("Lattice", "Other"), "a.xyz:2: the box is missing"},
           {"a.xyz", changed("velo:R:3", "velo:R:9999999999"), "\"velo\" has a wrong width"},
           {"a.xyz", changed("radius:R:1", "vel:R:1"), "a.xyz:2: the property \"vel\""},
           {"a.dump", "ITEM: TIMESTEP\n", "a.dump:1: the file ends within"},
           {"a.dump", "nothing", "a.dump:1: unexpected line \"nothing\""},
           {"a.csv", "", "a.csv: the file has no header line"},
           {"a.csv", "x,y,vx\n", "a.csv:1: the column vy is missing"},
           {"a.csv", "x;y;vx;vy\n", "a.csv:1: unknown column \"x;y;vx;vy\""},
           {"a.csv", "x,y,vx,vy\n1,2,3\n", "a.csv:2: this line has 3 columns instead of 4"},
           {"a.csv", "x,y,vx,vy\n1,2,3,inf\n", "a.csv:2: \"inf\""},
           {"a.csv", "time,x,y,vx,vy\n0,1,2,3,4\n0,3,4,3,4\n1,1,2,3,4\n", "a.csv:4: "},
           {"a.csv", "time,x,y,vx,vy\n0,1,2,3,4\n1,1,2,3,4\n1,3,4,3,4\n2,1,2,3,4\n", "a.csv:5: "},
       }) {
    CAPTURE(row.text);
    shell.write(row.file, row.text);
    check_refused(shell, "clatter convert " + row.file + " out.csv", {row.part});
  }
  shell.write("b.xyz", good + good);
  shell.run("cp b.xyz b.foo");
  for (const auto& [files, part] :
       {std::pair<std::string, std::string>{"b.xyz --frame 2 out.csv", "--frame from 0 to 1"},
        {"b.xyz out.csv --frame -1", "--frame"},
        {"none.xyz out.csv", "none.xyz: there is no such file"},
        {"b.xyz b.xyz", "b.xyz is the file that this command reads"},
        {"b.xyz out.foo", "OUT: out.foo"},
        {"b.foo out.csv", "IN: b.foo"}}) {
    check_refused(shell, "clatter convert " + files, {part});
  }
}

TEST_CASE("Convert: no quantity is lost, doubled or invented") {
  const Shell shell;
  std::string masses = kFrame;
  masses.replace(masses.find("radius"), 6, "masses");  // the name of ASE
  shell.write("same.xyz", masses);
  CHECK(shell.run("clatter convert same.xyz a.csv").code == 0);
  const std::string dump =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n"
      "ITEM: ATOMS ";
  for (const auto& [file, text, part] :
       {std::array<std::string, 3>{"a.csv", "x,y,x,vx,vy\n1,2,3,0,0\n", ":1: two columns are x"},
        {"a.csv", "x,y,z,vx,vy\n1,2,3,0,0\n", ":1: the velocities of spheres lack vz"},
        {"a.csv", "x,y,vx,vy,vz\n1,2,0,0,3\n", ":1: the positions of spheres lack z"},
        {"a.dump", dump + "x y vx vy vz\n1 2 0 0 3\n", ":9: the positions of spheres lack z"},
        {"a.dump", dump + "x x y vx vy\n1 1 2 0 0\n", ":9: two columns are x"}}) {
    shell.write(file, text);
    check_refused(shell, "clatter convert " + file + " out.csv", {file + part});
  }
  std::string deep = dump + "x y z vx vy\n1 2 3 0 0\n4 5 6 0 0\n";
  shell.write("a.dump", deep.replace(deep.find("\n1\n"), 3, "\n2\n"));
  check_refused(shell, "clatter convert a.dump out.csv", {"the velocities of spheres lack vz"});
  // Disks need no velocity along z.
  shell.write("a.dump", dump + "x y z vx vy diameter\n1 2 0 3 4 1\n");
  REQUIRE(shell.run("clatter convert a.dump a.csv").code == 0);
  CHECK(shell.read("a.csv") == "x,y,vx,vy\n1,2,3,4\n");
  // A byte order mark, and blank lines between frames.
  shell.write("b.csv", "\xef\xbb\xbfx,y,vx,vy\r\n1,2,3,4\r\n");
  REQUIRE(shell.run("clatter convert b.csv out.csv").code == 0);
  CHECK(shell.read("out.csv") == shell.read("a.csv"));
  std::string later = kFrame;
  later.replace(later.find("X 1 2"), 5, "X 2 2");
  shell.write("b.xyz", std::string(kFrame) + "\n \n" + later + "\n");
  REQUIRE(shell.run("clatter convert b.xyz out.csv").code == 0);
  CHECK(shell.read("out.csv") == "x,y,vx,vy\n2,2,0.5,0.25\n3,4,-0.5,0\n");
}

TEST_CASE("Convert: particles of a CSV are moved into the periodic box of the scene") {
  const Shell shell;
  shell.write("s.toml", "box.size = [8, 6]\nparticles.count = 1\n");
  shell.write("a.csv", "x,y,vx,vy\n-1.5,14,1,0\n");
  REQUIRE(shell.run("clatter convert a.csv a.xyz --scene s.toml").code == 0);
  CHECK(says(shell.read("a.xyz"), "\nX 6.5 2 0 1 0 0 -1 2 0 0.5\n"));
  shell.write("a.csv", "x,y,vx,vy\n1e17,3,1,0\n");
  check_refused(shell, "clatter convert a.csv b.xyz --scene s.toml",
                {"a.csv:2: a periodic image is no whole number of 32 bits"});
}

TEST_CASE("Convert: a pipe is refused, and a signal ends the reading of a scene at once") {
  const Shell shell;
  REQUIRE(shell.run("mkfifo pipe.csv pipe.toml").code == 0);
  shell.write("a.csv", "x,y,vx,vy\n1,2,3,4\n");
  check_refused(shell, "clatter convert pipe.csv out.csv", {"IN: pipe.csv is not a regular file"});
  // timeout(1) has exit code 137 instead of 124 if its second signal, KILL, is needed.
  CHECK(shell.run("timeout -k 5 0.5 clatter convert a.csv out.xyz --scene pipe.toml").code == 124);
}

TEST_CASE("Convert: damaged binary files are refused") {
  const Shell shell;
  shell.write("s.toml", kSpheres);
  for (const std::string format : {"gsd", "h5md", "vtp"}) {
    REQUIRE(shell.run(kRun + "--every 1 --trajectory t." + format).code == 0);
    const std::string whole = shell.read(format == "vtp" ? "t_000021.vtp" : "t." + format);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 10}) {
      CAPTURE(size);
      shell.write("d." + format, whole.substr(0, size));
      // Files of VTK are XML, with lines.
      check_refused(shell, "clatter convert d." + format + " out.csv",
                    {"d." + format + (format == "vtp" ? ":" : ": ")});
    }
    // Each byte of the head in turn is damaged. The program gives a frame or an error. HDF5 may ask
    // for a huge allocation, which the address sanitizer must refuse as malloc does.
    const std::string options = "ASAN_OPTIONS=allocator_may_return_null=1 ";
    for (std::size_t k = 0; k < 400; k += 7) {
      std::string damaged = whole;
      damaged[k] = static_cast<char>(~damaged[k]);
      shell.write("d." + format, damaged);
      const Outcome outcome = shell.run(options + "clatter convert d." + format + " out.csv");
      CAPTURE(k);
      CAPTURE(outcome.err);
      CHECK((outcome.code == 0 || outcome.code == 2));
    }
  }
}

TEST_CASE("Convert: a full disk leaves the earlier file") {
  const Shell shell;
  REQUIRE(shell.run("clatter measure vibrated --until 1 --save-state s.csv --out r.json").code ==
          0);
  for (const std::string& format : kBoxed) {
    CAPTURE(format);
    shell.write("out." + format, "earlier");
    const std::vector<std::string> before = shell.files();
    const Outcome full =
        shell.run("ulimit -f 20; clatter convert s.csv --scene vibrated out." + format);
    CAPTURE(full.err);
    CHECK(full.code == 1);
    CHECK(says(full.err, "cannot write out." + format));
    CHECK(shell.files() == before);
    CHECK(shell.read("out." + format) == "earlier");
  }
}

}  // namespace clatter
