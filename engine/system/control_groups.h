#pragma once

#include <filesystem>
#include <limits>

namespace clatter {

/// Limits of Linux control groups; infinity: none.
struct GroupLimits {
  double processors = std::numeric_limits<double>::infinity();  ///< CPU time per time
  double memory = std::numeric_limits<double>::infinity();      ///< bytes
};

/// The least limits of the control groups of this process and of all groups above them, of both
/// versions (cgroups(7)). `root` is the folder of proc, and of the folders where proc says that the
/// groups are mounted. No limits where it has none.
GroupLimits control_group_limits(const std::filesystem::path& root = "/");

}  // namespace clatter
