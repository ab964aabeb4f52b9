#include "engine/system/allocation.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "engine/system/platform.h"
#include "engine/whole_number.h"

namespace clatter {

int processors() {
  const char* task = std::getenv("SLURM_CPUS_PER_TASK");
  const int allowed = whole_number<int>(task ? task : "").value_or(0);
  return allowed > 0 ? std::min(allowed, machine_processors()) : machine_processors();
}

double available_memory() {
  double memory = machine_memory();
  for (const int resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
      memory = std::min(memory, static_cast<double>(limit.rlim_cur));
    }
  }
  return memory;
}

int fitting_processors(double bytes) {
  return static_cast<int>(std::clamp(available_memory() / bytes, 1.0, 1.0 * processors()));
}

namespace {

using Words = std::vector<std::string>;

Words split(const std::string& line, char at) {
  Words words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, at);) words.push_back(word);
  return words;
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The first numbers of a file; "max" is infinity. Absent if the file has fewer.
std::optional<std::vector<double>> numbers_in(const std::filesystem::path& file,
                                              std::size_t count) {
  std::ifstream stream(file);
  std::vector<double> numbers;
  for (std::string word; numbers.size() < count && stream >> word;) {
    double number = std::numeric_limits<double>::infinity();
    if (word != "max" && !(std::istringstream(word) >> number)) return std::nullopt;
    numbers.push_back(number);
  }
  if (numbers.size() < count) return std::nullopt;
  return numbers;
}

void lower(double& limit, double to) {
  if (to > 0.0) limit = std::min(limit, to);
}

// The limits of one group. A group of version 1 has the files of its controllers only, and -1 for a
// quota without a limit.
void lower_to_group(GroupLimits& limits, const std::filesystem::path& group) {
  if (const auto quota = numbers_in(group / "cpu.max", 2)) {
    lower(limits.processors, (*quota)[0] / (*quota)[1]);
  }
  const auto quota = numbers_in(group / "cpu.cfs_quota_us", 1);
  const auto period = numbers_in(group / "cpu.cfs_period_us", 1);
  if (quota && period) lower(limits.processors, (*quota)[0] / (*period)[0]);
  for (const char* file : {"memory.max", "memory.limit_in_bytes"}) {
    if (const auto memory = numbers_in(group / file, 1)) lower(limits.memory, (*memory)[0]);
  }
}

// A place in /proc/self/mountinfo, where the kernel writes blanks as \040.
std::string unescaped(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '\\' && i + 3 < text.size();
    plain += escape ? static_cast<char>(std::stoi(text.substr(i + 1, 3), nullptr, 8)) : text[i];
    if (escape) i += 3;
  }
  return plain;
}

// A mounted hierarchy of groups (proc_pid_mountinfo(5)).
struct Hierarchy {
  std::filesystem::path root;   // its group that is mounted
  std::filesystem::path place;  // where
  Words controllers;            // of version 1; version 2: one empty name
};

std::optional<Hierarchy> hierarchy_of(const std::string& mount) {
  const Words words = split(mount, ' ');
  const auto separator = std::ranges::find(words, "-");
  if (words.size() < 5 || words.end() - separator < 4) return std::nullopt;
  Hierarchy hierarchy{unescaped(words[3]), unescaped(words[4]), {""}};
  if (separator[1] == "cgroup") {
    hierarchy.controllers = split(separator[3], ',');
  } else if (separator[1] != "cgroup2") {
    return std::nullopt;
  }
  return hierarchy;
}

// The groups of this process by the names of their controllers. A line is NUMBER:NAMES:GROUP.
std::optional<std::filesystem::path> group_in(const Hierarchy& hierarchy,
                                              const std::vector<std::string>& groups) {
  for (const std::string& line : groups) {
    const std::size_t names = line.find(':') + 1, end = line.find(':', names);
    if (names == 0 || end == line.npos) continue;
    Words own = split(line.substr(names, end - names), ',');
    if (own.empty()) own = {""};
    const bool is_own = std::ranges::any_of(hierarchy.controllers, [&](const std::string& name) {
      return std::ranges::find(own, name) != own.end();
    });
    if (is_own) return line.substr(end + 1);
  }
  return std::nullopt;
}

}  // namespace

GroupLimits control_group_limits(const std::filesystem::path& root) {
  GroupLimits limits;
  const std::vector<std::string> groups = lines_of(root / "proc/self/cgroup");
  for (const std::string& mount : lines_of(root / "proc/self/mountinfo")) {
    const auto hierarchy = hierarchy_of(mount);
    const auto group = hierarchy ? group_in(*hierarchy, groups) : std::nullopt;
    if (!group) continue;
    // A container sees its group as the top, and a path outside it begins with "..".
    std::filesystem::path below = group->lexically_relative(hierarchy->root);
    if (below.empty() || *below.begin() == "..") below = ".";
    const std::filesystem::path top = root / hierarchy->place.relative_path();
    lower_to_group(limits, top);
    std::filesystem::path place = top;
    for (const auto& name : below) lower_to_group(limits, place /= name);
  }
  return limits;
}

}  // namespace clatter
