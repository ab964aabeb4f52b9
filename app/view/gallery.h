#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/view/controls.h"
#include "app/view/thumbnails.h"
#include "app/view/window_input.h"
#include "engine/embedded_file.h"

namespace clatter {

/// The gallery: a list of the built-in scenes, in the order of `clatter scenes`.
class Gallery {
 public:
  /// The renderer draws the pictures of scenes. It must outlive the gallery.
  Gallery(const Gl& gl, Renderer& renderer);

  /// Forgets the searched text.
  void forget() { search({}); }
  /// Takes a key before the next picture. Arrow keys move the selection, Enter chooses, and
  /// Backspace removes the last letter of the searched text.
  void press(const KeyPress& press);
  /// Adds typed signs of ASCII to the searched text. A slash begins another text.
  void type(const std::string& signs);
  /// Draws the gallery over a window of `width` x `height`. A button sets `open` to false. Returns
  /// the chosen scene; null: none.
  const EmbeddedFile* draw(Controls& controls, float width, float height, bool& open);
  /// Whether the pictures of scenes are being made.
  bool busy() const { return thumbnails_.busy(); }
  /// The scene `step` places after the scene with this title; the list is cyclic.
  const EmbeddedFile& neighbour(const std::string& title, int step) const;

 private:
  struct Entry {
    const EmbeddedFile* file;
    std::string name, title, caption, goal, try_this;
  };

  static constexpr int kRanks = 4;
  static int rank(const Entry& entry, const std::string& wanted);
  void search(const std::string& text);
  std::vector<const Entry*> matches() const;
  bool select(int matches);
  bool draw_card(const Entry& entry, bool selected, Controls& controls);

  Thumbnails thumbnails_;
  std::vector<Entry> entries_;
  std::array<char, 64> search_ = {};
  int selected_ = 0;  // index into matches()
  // Of the keys before the next picture: steps of the selection, and Enter.
  int steps_ = 0;
  bool enters_ = false;
};

}  // namespace clatter
