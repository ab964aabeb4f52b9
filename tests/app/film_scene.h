#pragma once

#include <string>

#include "tests/support/shell.h"

namespace clatter {

/// Writes the file scene.toml: a gas between a moving and a fixed wall, with averages and trails.
/// `view` has further keys of the view, each after a comma; `tables` follow the scene.
inline void write_film_scene(const Shell& shell, const std::string& view = "",
                             const std::string& tables = "") {
  shell.write("scene.toml",
              "title = \"Parts\"\nbox.size = [20, 15]\n"
              "particles = { count = 100, restitution = 0.9 }\n"
              "walls.left = { kind = \"sinusoidal\", stroke = 0.2, frequency = 1.0 }\n"
              "walls.right = { kind = \"static\" }\n"
              "view = { field = \"temperature\", window = 2.0, trails = 0.7" +
                  view + " }\n" + tables);
}

}  // namespace clatter
