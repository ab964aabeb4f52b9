#pragma once

#include <functional>
#include <future>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/embedded_file.h"
#include "engine/publish/snapshot.h"
#include "render/gl/gl_object.h"
#include "render/layers/renderer.h"

namespace clatter {

/// Small pictures of scenes, each a few seconds after the start. A worker thread simulates one
/// scene at a time, or the calling thread where threads are missing. The calling thread draws the
/// picture.
class Thumbnails {
 public:
  static constexpr Size kSize = {192, 144};  ///< size of the pictures

  /// Calls `on_ready` on the worker thread when a scene is ready to be drawn.
  Thumbnails(const Gl& gl, std::function<void()> on_ready)
      : gl_(&gl), on_ready_(std::move(on_ready)) {}

  /// The texture with the picture of a gallery scene; 0: not ready, or failed.
  GLuint of(const EmbeddedFile& scene);

 private:
  void finish();
  void draw(const EmbeddedFile& scene, const Snapshot& snapshot);

  const Gl* gl_;
  std::function<void()> on_ready_;
  std::map<std::string_view, std::optional<Texture>> textures_;  // absent: failed
  const EmbeddedFile* making_ = nullptr;                         // scene in the thread; null: none
  std::future<Snapshot> snapshot_;
};

}  // namespace clatter
