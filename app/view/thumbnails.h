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

/// Small pictures of scenes, each some seconds after its start. They are made one after the other
/// on a thread of their own, and drawn when they are asked for.
class Thumbnails {
 public:
  static constexpr Size kSize = {192, 144};

  /// Calls `on_ready`, on a thread of its own, when there is another to be drawn.
  Thumbnails(const Gl& gl, std::function<void()> on_ready)
      : gl_(&gl), on_ready_(std::move(on_ready)) {}

  /// The texture with the picture of a gallery scene; 0 until there is one.
  GLuint of(const EmbeddedFile& scene);

 private:
  void finish();
  void draw(const EmbeddedFile& scene, const Snapshot& snapshot);

  const Gl* gl_;
  std::function<void()> on_ready_;
  std::map<std::string_view, std::optional<Texture>> textures_;  // absent: could not be made
  const EmbeddedFile* making_ = nullptr;                         // the one under way; null: none
  std::future<Snapshot> snapshot_;
};

}  // namespace clatter
