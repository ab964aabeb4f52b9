#pragma once

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/shell.h"

namespace clatter {

/// The contents of a file in the shell's folder, read by a Python script of this folder.
inline nlohmann::json read_by(const Shell& shell, const std::string& reader,
                              const std::string& file) {
  const Outcome outcome = shell.run(CLATTER_READERS + reader + " " + file);
  CAPTURE(outcome.err);  // names a missing module, which ./run test installs
  REQUIRE(outcome.code == 0);
  return nlohmann::json::parse(outcome.out);
}

/// The frames of a trajectory, read by gsd or h5py, and by MDAnalysis.
inline nlohmann::json frames_of(const Shell& shell, const std::string& file) {
  return read_by(shell, "read_trajectory.py", file).at(file);
}

}  // namespace clatter
