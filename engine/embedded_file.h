#pragma once

#include <span>
#include <string_view>

namespace clatter {

/// A file embedded into the program: its name without folders, and its bytes.
struct EmbeddedFile {
  std::string_view name;
  std::string_view bytes;
};

/// The scenes of assets/scenes, in alphabetical order.
std::span<const EmbeddedFile> embedded_scenes();

/// The start states in assets/scenes that the gallery scenes name.
std::span<const EmbeddedFile> embedded_start_states();

}  // namespace clatter
