#include "app/view/thumbnails.h"

#include <exception>
#include <utility>

#include "engine/scene/scene_file.h"
#include "render/gl/canvas.h"

namespace clatter {

GLuint Thumbnails::of(const EmbeddedFile& scene) {
  const auto found = textures_.find(scene.name);
  if (found != textures_.end()) return found->second ? found->second->id() : 0;
  if (!making_) making_ = &scene;
  return 0;
}

void Thumbnails::work(std::chrono::milliseconds budget) {
  if (!making_) return;
  try {
    if (!advance(budget)) return;
    draw();
  } catch (const std::exception&) {
    // The scene has no picture. Opening it reports the error.
    textures_[making_->name];
  }
  making_ = nullptr;
  opening_.reset();
  run_.reset();
}

// Starts the run, or continues it up to its picture. Returns whether it is there. The number of
// events is limited.
bool Thumbnails::advance(std::chrono::milliseconds budget) {
  constexpr double kSeconds = 20.0;
  constexpr std::uint64_t kMaxSteps = 60'000, kSlice = 500;
  const auto due = std::chrono::steady_clock::now() + budget;
  const auto over = [due] { return std::chrono::steady_clock::now() >= due; };
  if (!run_) {
    if (!opening_) {
      const Scene scene = load_gallery_scene(*making_);
      view_ = scene.view;
      opening_.emplace(scene, 1);
    }
    if (!opening_->advance(over)) return false;
    run_ = std::exchange(opening_, std::nullopt)->take();
  }
  while (!over()) {
    const std::uint64_t steps = run_->counts().steps();
    if (steps >= kMaxSteps) return true;
    if (run_->run_until(kSeconds * view_.speed, kNoLimit, steps + kSlice)) return true;
  }
  return false;
}

void Thumbnails::draw() {
  view_.overlay = false;
  Frame frame;
  run_->fill(frame, false);
  const Snapshot& gas = frame.snapshot;
  const Canvas canvas(*gl_, kSize);
  canvas.bind();
  renderer_->draw(gas, renderer_->fit(gas, kSize, view_, {}), kSize, view_, {});
  Texture texture = generate<Texture>(*gl_, gl_->GenTextures);
  gl_->BindTexture(GL_TEXTURE_2D, texture.id());
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kSize.width, kSize.height, 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, nullptr);
  const Framebuffer framebuffer = generate<Framebuffer>(*gl_, gl_->GenFramebuffers);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  // Reading the pixels would wait until all earlier pictures are drawn.
  canvas.copy_to(framebuffer.id());
  gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
  textures_[making_->name] = std::move(texture);
}

}  // namespace clatter
