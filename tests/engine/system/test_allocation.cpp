#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "engine/system/allocation.h"
#include "engine/system/platform.h"
#include "tests/support/temporary_folder.h"

namespace clatter::testing {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// A folder with the files of proc and of control groups.
class FakeSystem {
 public:
  void add(const std::string& path, const std::string& text) const {
    const std::filesystem::path file = folder_ / path;
    std::filesystem::create_directories(file.parent_path());
    write_bytes(file, text);
  }
  GroupLimits limits() const { return control_group_limits(folder_ / ""); }

 private:
  TemporaryFolder folder_;
};

// Mounts as a kernel lists them: proc_pid_mountinfo(5).
const std::string kVersion2 =
    "22 28 0:21 / /proc rw,nosuid shared:14 - proc proc rw\n"
    "35 24 0:30 / /sys/fs/cgroup rw,nosuid,nodev shared:9 - cgroup2 cgroup2 rw,nsdelegate\n";
const std::string kVersion1 =
    "31 23 0:28 / /sys/fs/cgroup rw - tmpfs tmpfs rw,mode=755\n"
    "32 31 0:29 / /sys/fs/cgroup/cpu,cpuacct rw shared:10 - cgroup cgroup rw,cpu,cpuacct\n"
    "35 31 0:32 / /sys/fs/cgroup/memory rw shared:11 - cgroup cgroup rw,memory\n"
    "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n";

}  // namespace

TEST_CASE("Control groups: without any, and without limits, there is no limit") {
  const FakeSystem none;
  CHECK(none.limits().processors == kNone);
  CHECK(none.limits().memory == kNone);
  const FakeSystem free;
  free.add("proc/self/mountinfo", kVersion2);
  free.add("proc/self/cgroup", "0::/user.slice/session-1.scope\n");
  free.add("sys/fs/cgroup/user.slice/session-1.scope/cpu.max", "max 100000\n");
  free.add("sys/fs/cgroup/user.slice/session-1.scope/memory.max", "max\n");
  CHECK(free.limits().processors == kNone);
  CHECK(free.limits().memory == kNone);
}

TEST_CASE("Control groups: version 2 has the least limits of a group and of those above it") {
  const FakeSystem system;
  system.add("proc/self/mountinfo", kVersion2);
  system.add("proc/self/cgroup", "0::/jobs/job 7/task\n");
  system.add("sys/fs/cgroup/jobs/cpu.max", "800000 100000\n");
  system.add("sys/fs/cgroup/jobs/job 7/cpu.max", "150000 100000\n");
  system.add("sys/fs/cgroup/jobs/job 7/task/cpu.max", "max 100000\n");
  system.add("sys/fs/cgroup/jobs/memory.max", "8589934592\n");
  system.add("sys/fs/cgroup/jobs/job 7/task/memory.max", "536870912\n");
  system.add("sys/fs/cgroup/other/memory.max", "1\n");
  CHECK(system.limits().processors == 1.5);
  CHECK(system.limits().memory == 536870912.0);
  system.add("sys/fs/cgroup/memory.max", "1000000\n");
  CHECK(system.limits().memory == 1e6);
}

TEST_CASE("Control groups: version 1 has a hierarchy for each controller") {
  const FakeSystem system;
  system.add("proc/self/mountinfo", kVersion1);
  system.add("proc/self/cgroup",
             "12:memory:/slurm/uid_1/job_2/step_0\n3:cpu,cpuacct:/slurm/uid_1\n"
             "1:name=systemd:/init.scope\n0::/\n");
  const std::string processors = "sys/fs/cgroup/cpu,cpuacct/slurm/uid_1/";
  system.add(processors + "cpu.cfs_period_us", "100000\n");
  system.add(processors + "cpu.cfs_quota_us", "-1\n");
  const std::string memory = "sys/fs/cgroup/memory/slurm/uid_1/job_2/";
  system.add(memory + "memory.limit_in_bytes", "2000000000\n");
  system.add(memory + "step_0/memory.limit_in_bytes", "9223372036854771712\n");
  CHECK(system.limits().processors == kNone);
  CHECK(system.limits().memory == 2e9);
  system.add(processors + "cpu.cfs_quota_us", "50000\n");
  CHECK(system.limits().processors == 0.5);
}

// The group of a container is mounted as the top. Its path is that of the outside, or begins with
// "..".
TEST_CASE("Control groups: a container sees its group as the top") {
  for (const std::string group : {"/docker/3f2a", "/../../docker/3f2a"}) {
    CAPTURE(group);
    const FakeSystem system;
    system.add("proc/self/mountinfo",
               "935 924 0:30 /docker/3f2a /sys/fs/cgroup\\040here ro - cgroup2 cgroup rw\n");
    system.add("proc/self/cgroup", "0::" + group + "\n");
    system.add("sys/fs/cgroup here/cpu.max", "200000 100000");
    system.add("sys/fs/cgroup here/memory.max", "1000000");
    CHECK(system.limits().processors == 2.0);
    CHECK(system.limits().memory == 1e6);
  }
}

TEST_CASE("Control groups: damaged files are no limits") {
  const FakeSystem system;
  system.add("proc/self/mountinfo", "a\n" + kVersion2 + "1 2 3 / /x - \n1 2 3 / /x\n");
  system.add("proc/self/cgroup", "\n::\n0:/\n0::/\n");
  system.add("sys/fs/cgroup/cpu.max", "many\n");
  system.add("sys/fs/cgroup/memory.max", "\n");
  CHECK(system.limits().processors == kNone);
  CHECK(system.limits().memory == kNone);
}

TEST_CASE("Allocation: a limit of the shell is the memory that there is") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  MESSAGE("[skipped] a program with a sanitizer has more data than any limit");
#else
  const double machine = std::fmin(machine_memory(), 1e11);
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_DATA, &before) == 0);
  rlimit limit = before;
  limit.rlim_cur = static_cast<rlim_t>(0.5 * machine);
  REQUIRE(setrlimit(RLIMIT_DATA, &limit) == 0);
  CHECK(available_memory() == static_cast<double>(limit.rlim_cur));
  CHECK(fitting_processors(0.3 * machine) == 1);
  setrlimit(RLIMIT_DATA, &before);
  CHECK(fitting_processors(1.0) == processors());
  CHECK(fitting_processors(kNone) == 1);
#endif
}

}  // namespace clatter::testing
