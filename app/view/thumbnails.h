#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/embedded_file.h"
#include "engine/live/opening_run.h"
#include "engine/live/watched_run.h"
#include "render/gl/gl_object.h"
#include "render/layers/renderer.h"

namespace clatter {

/// Small pictures of scenes, each a few seconds after the start. They are made one after the other
/// in slices of time, on the thread of the window.
class Thumbnails {
 public:
  static constexpr Size kSize = {192, 144};  ///< size of the pictures

  /// The renderer draws the pictures. It must outlive the thumbnails.
  Thumbnails(const Gl& gl, Renderer& renderer) : gl_(&gl), renderer_(&renderer) {}

  /// The texture with the picture of a gallery scene, lowest row first; 0: not ready, or failed.
  /// The first request for a scene starts its picture if no other is being made.
  GLuint of(const EmbeddedFile& scene);
  /// Continues the present picture for about `budget`.
  void work(std::chrono::milliseconds budget);
  /// Whether a picture is being made.
  bool busy() const { return making_ != nullptr; }

 private:
  bool advance(std::chrono::milliseconds budget);
  void draw();

  const Gl* gl_;
  Renderer* renderer_;
  std::map<std::string_view, std::optional<Texture>> textures_;  // absent: failed
  const EmbeddedFile* making_ = nullptr;                         // scene of the run; null: none
  View view_;                                                    // of that scene
  std::optional<OpeningRun> opening_;                            // until the run has started
  std::unique_ptr<WatchedRun> run_;                              // from its start on
};

}  // namespace clatter
