#include "app/film/film_cell.h"

#include <utility>

#include "engine/system/signals.h"
#include "render/camera_path.h"

namespace clatter {

FilmCell::FilmCell(const Gl& gl, Size size, int samples, bool transparent, const View& view,
                   OverlayText text)
    : view_(view),
      text_(std::move(text)),
      canvas_(gl, size),
      renderer_(gl, samples, transparent, interrupted) {}

void FilmCell::show_card(double seconds) {
  if (view_.card) text_.card = card_opacity(*view_.card, seconds);
}

Image FilmCell::draw(const Snapshot& snapshot, const Camera& whole) {
  canvas_.bind();
  renderer_.draw(snapshot, camera_at(view_.camera, snapshot, whole), canvas_.size(), view_, text_,
                 ranges_.legends(snapshot, view_));
  return canvas_.read();
}

}  // namespace clatter
