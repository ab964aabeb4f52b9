// Signals of terminals, scripts and batch systems.

#include <doctest/doctest.h>

#include "tests/support/shell.h"

namespace clatter {

namespace {

const std::string kEndless =
    "clatter measure vibrated --quiet --set measure.fields=[] --set measure.series_interval=1e3 "
    "--until 1e9 --out r.json --checkpoint c --checkpoint-every 0.02 ";

// Starts the endless run after `before`, and acts on it, $pid, once it has a checkpoint.
Outcome act_on_run(const Shell& shell, const std::string& before, const std::string& act) {
  return shell.run("rm -f c; " + before + kEndless +
                   "& pid=$!\nwhile [ ! -e c ] && kill -0 $pid; do sleep 0.02; done\n" + act);
}

}  // namespace

TEST_CASE("Interrupts: signals that a script or nohup ignores stay ignored") {
  const Shell shell;
  // A command in the background of a script ignores SIGINT (POSIX, 2.11).
  const std::string ignored =
      " $pid; sleep 0.5; rm -f c\nfor k in $(seq 200); do [ -e c ] || sleep 0.05; done\n"
      "[ -e c ] && echo runs; kill -TERM $pid; wait $pid";
  const Outcome background = act_on_run(shell, "", "kill -INT" + ignored);
  CHECK(background.out == "runs\n");
  CHECK(background.code == 130);
  CHECK(act_on_run(shell, "nohup ", "kill -HUP" + ignored).out == "runs\n");
  for (const std::string signal : {"XCPU", "USR1", "USR2"}) {
    CAPTURE(signal);
    CHECK(act_on_run(shell, "trap '' " + signal + "; ", "kill -" + signal + ignored).out ==
          "runs\n");
  }
}

TEST_CASE("Interrupts: a warning of a batch system saves the run") {
  const Shell shell;
  for (const std::string signal : {"XCPU", "USR1", "USR2", "TERM", "HUP"}) {
    CAPTURE(signal);
    const Outcome outcome = act_on_run(shell, "", "rm -f c; kill -" + signal + " $pid; wait $pid");
    CHECK(outcome.code == 130);
    CHECK_FALSE(shell.read("c").empty());
  }
  const Outcome limited = shell.run("rm -f c; ulimit -St 1; " + kEndless);
  CHECK(limited.code == 130);
  CHECK_FALSE(shell.read("c").empty());
}

// The kernel repeats SIGXCPU, and Slurm sends SIGTERM after a warning.
TEST_CASE("Interrupts: a warning is not the second signal that ends the program at once") {
  const Shell shell;
  for (const std::string act : {"kill -XCPU $pid; sleep 0.4; kill -XCPU $pid",
                                "kill -USR1 $pid; sleep 0.4; kill -TERM $pid",
                                "kill -TERM $pid; sleep 0.4; kill -USR2 $pid"}) {
    CAPTURE(act);
    // A pipe that nobody reads keeps the run from its end.
    shell.run("rm -f r.json; mkfifo r.json");
    const Outcome outcome =
        act_on_run(shell, "", act + "; sleep 0.4; cat r.json >/dev/null; wait $pid");
    CHECK(outcome.code == 130);
  }
}

// The sweep is in the background, so its processes ignore SIGINT.
TEST_CASE("Interrupts: a sweep in the background of a script ends with its runs") {
  const Shell shell;
  shell.write(
      "s.toml",
      "scene = \"vibrated\"\nreplicas = 2\n[set]\n\"measure.burn_in\" = 1.0\n"
      "\"measure.duration\" = 1e9\n\"measure.series_interval\" = 1e3\n\"measure.fields\" = []\n");
  const Outcome outcome = shell.run(
      "clatter sweep s.toml --out d --quiet --threads 2 & pid=$!\n"
      "until [ \"$(cat /proc/$pid/task/$pid/children | wc -w)\" -eq 2 ]; do sleep 0.02; done\n"
      "sleep 0.5; kill -TERM $pid; wait $pid");
  CHECK(outcome.code == 130);
  CHECK(shell.run("ls d/runs").out.find("1.checkpoint") != std::string::npos);
}

TEST_CASE("Interrupts: a film outlives the warning that its encoder receives too") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter render vibrated --quiet --size 64x64 --to 1e5 --out film.mp4 & pid=$!\n"
      "until [ -e film.mp4.part/000060.mp4 -a -n \"$(cat /proc/$pid/task/$pid/children)\" ]; do "
      "sleep 0.02; done\nkill -USR1 $(cat /proc/$pid/task/$pid/children) $pid; wait $pid");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 130);
  CHECK_FALSE(shell.read("film.mp4").empty());
}

}  // namespace clatter
