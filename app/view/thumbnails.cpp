#include "app/view/thumbnails.h"

#include <chrono>
#include <exception>
#include <utility>

#include "engine/dimension.h"
#include "engine/publish/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "render/gl/canvas.h"

namespace clatter {

// The gas of a scene after a few seconds on screen; the number of events is limited.
static Snapshot snapshot_of_scene(const EmbeddedFile& file) {
  constexpr double kSeconds = 20.0;
  constexpr std::uint64_t kMaxSteps = 60'000;
  const Scene scene = load_gallery_scene(file);
  return with_dimension(scene.dimension(), [&](auto dimension) {
    ScheduledRun<dimension> run(scene, 1);
    run.show(scene.view);
    run.run_until(kSeconds * scene.view.speed, kNoLimit, kMaxSteps);
    return run.snapshot();
  });
}

GLuint Thumbnails::of(const EmbeddedFile& scene) {
  finish();
  const auto found = textures_.find(scene.name);
  if (found != textures_.end()) return found->second ? found->second->id() : 0;
  if (!making_) {
    making_ = &scene;
    constexpr auto kAnyThread = std::launch::async | std::launch::deferred;
    snapshot_ = std::async(kAnyThread, [this, &scene] {
      Snapshot snapshot = snapshot_of_scene(scene);
      on_ready_();
      return snapshot;
    });
  }
  return 0;
}

void Thumbnails::finish() {
  if (!making_ || snapshot_.wait_for(std::chrono::seconds(0)) == std::future_status::timeout)
    return;
  const EmbeddedFile& scene = *std::exchange(making_, nullptr);
  textures_[scene.name];
  try {
    draw(scene, snapshot_.get());
  } catch (const std::exception&) {
    // The scene has no picture. Opening it reports the error.
  }
}

void Thumbnails::draw(const EmbeddedFile& scene, const Snapshot& snapshot) {
  View view = load_gallery_scene(scene).view;
  view.overlay = false;
  const Canvas canvas(*gl_, kSize);
  canvas.bind();
  Renderer renderer(*gl_);
  renderer.draw(snapshot, renderer.fit(snapshot, kSize, view, {}), kSize, view, {});
  const Image picture = canvas.read();
  Texture texture = generate<Texture>(*gl_, gl_->GenTextures);
  gl_->BindTexture(GL_TEXTURE_2D, texture.id());
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kSize.width, kSize.height, 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, picture.rgba.data());
  gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
  textures_[scene.name] = std::move(texture);
}

}  // namespace clatter
