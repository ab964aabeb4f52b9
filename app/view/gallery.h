#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "app/view/controls.h"
#include "app/view/thumbnails.h"
#include "engine/embedded_file.h"

namespace clatter {

/// The gallery: a list of the built-in scenes, in the order of `clatter scenes`.
class Gallery {
 public:
  /// Calls `on_ready` when the picture of a scene is ready to be drawn, possibly on another thread.
  Gallery(const Gl& gl, std::function<void()> on_ready);

  /// Draws the gallery over a window of `width` x `height`. Arrow keys move the selection, Enter
  /// chooses. Returns the chosen scene; null: none.
  const EmbeddedFile* draw(Controls& controls, float width, float height);
  /// The scene `step` places after the scene with this title; the list is cyclic.
  const EmbeddedFile& neighbour(const std::string& title, int step) const;

 private:
  struct Entry {
    const EmbeddedFile* file;
    std::string name, title, caption, goal, try_this;
  };

  std::vector<const Entry*> matches() const;
  bool select(int matches);
  bool draw_card(const Entry& entry, bool selected, Controls& controls);

  Thumbnails thumbnails_;
  std::vector<Entry> entries_;
  std::array<char, 64> search_ = {};
  int selected_ = 0;  // index into matches()
};

}  // namespace clatter
