// Processors and memory of the allocation of a process, which may be less than those of the
// machine.

#include <doctest/doctest.h>

#include "tests/support/shell.h"

namespace clatter {

namespace {

const std::string kCheck = "clatter check vibrated ";
// About 0.9 GB.
const std::string kLarge = "--set particles.count=4000000 --set box.size=[4000,4000] ";

}  // namespace

TEST_CASE("Allocation: processors are those of the affinity and of the Slurm task") {
  const Shell shell;
  if (shell.run("taskset -c 0 true").code != 0) {
    MESSAGE("[skipped] this machine has no taskset");
    return;
  }
  CHECK(says(shell.run("taskset -c 0 " + kCheck).err, "may use 1 processor and "));
  CHECK(says(shell.run("SLURM_CPUS_PER_TASK=1 " + kCheck).err, "may use 1 processor and "));
  const std::string all = shell.run(kCheck).err;
  for (const std::string task : {"", "0", "many", "1000000"}) {
    CHECK(shell.run("SLURM_CPUS_PER_TASK=" + task + " " + kCheck).err == all);
  }
}

TEST_CASE("Allocation: a sweep starts one process per processor of the allocation") {
  const Shell shell;
  shell.write("s.toml",
              "scene = \"vibrated\"\nreplicas = 3\n[set]\n\"measure.burn_in\" = 1.0\n"
              "\"measure.duration\" = 1000.0\n\"measure.fields\" = []\n");
  const Outcome outcome = shell.run(
      "SLURM_CPUS_PER_TASK=1 clatter sweep s.toml --out d --quiet & pid=$!\n"
      "while kill -0 $pid; do cat /proc/$pid/task/$pid/children; echo; sleep 0.02; done");
  CHECK(outcome.out.find_first_of("0123456789") != std::string::npos);
  for (std::size_t at = outcome.out.find(' '); at != std::string::npos;
       at = outcome.out.find(' ', at + 1)) {
    CHECK(outcome.out.compare(at, 2, " \n") == 0);  // one number a line
  }
}

TEST_CASE("Allocation: a scene that needs more memory than the process may use is refused") {
  const Shell shell;
  if (is_sanitized()) {
    MESSAGE("[skipped] a program with a sanitizer takes more address space");
    return;
  }
  const std::string limit = "ulimit -v 800000; ";
  for (const std::string command : {"check", "measure", "measure --replicas 2"}) {
    CAPTURE(command);
    check_refused(
        shell, limit + "clatter " + command + " vibrated --quiet " + kLarge,
        {"4000000 particles take about 0.8", "this process may use 0.819 GB", "choose at most "});
  }
  check_refused(shell, limit + "clatter measure vibrated --quiet --set measure.cells=[2000,2000]",
                {"this process may use 0.819 GB", "fields"});
  CHECK(shell.run(limit + kCheck).code == 0);
}

}  // namespace clatter
