#include "app/view/viewport.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/style.h"
#include "engine/live/command.h"
#include "render/output/cells.h"
#include "render/picking.h"

namespace clatter {

static bool set_angles(View& view, double azimuth, double elevation) {
  const bool changed = view.azimuth != azimuth || view.elevation != elevation;
  view.azimuth = azimuth;
  view.elevation = elevation;
  return changed;
}

bool face(View& view, const Preset& preset) {
  return set_angles(view, preset.azimuth, preset.elevation);
}

bool turn(View& view, float right, float down) {
  constexpr double kDegrees = 0.4;  // per window unit
  if (right == 0.0f && down == 0.0f) return false;
  return set_angles(view, std::remainder(view.azimuth - kDegrees * right, 360.0),
                    std::clamp(view.elevation + kDegrees * down, -90.0, 90.0));
}

static_assert(kMostGases == kMostCells);

static bool are_equal(const VecX& a, const VecX& b) {
  return a.size() == b.size() && a == b;
}

// Makes a picture for each gas. A new one has the camera of the selected gas.
void Viewport::resize(Size size, std::size_t gases) {
  if (size.width == size_.width && size.height == size_.height && gases == pictures_.size()) return;
  std::vector<Picture> former = std::exchange(pictures_, {});
  const auto count = static_cast<int>(gases);
  for (int number = 0; number < count; ++number) {
    pictures_.push_back({Canvas(*gl_, picture_cell(size, number, count).size)});
    if (former.empty()) continue;
    const auto own = static_cast<std::size_t>(number);
    const Picture& like = former[own < former.size() ? own : std::min(gas_, former.size() - 1)];
    pictures_.back().camera = like.camera;
    pictures_.back().box = like.box;
  }
  size_ = size;
  stale_ = true;
}

void Viewport::draw(const Frame& frame, const View& view, Size size, double letters, double least,
                    bool heading, const std::vector<std::string>& titles) {
  const std::vector<const Frame*> gases = frames_of(frame);
  resize(size, gases.size());
  if (frame.run != run_) {
    run_ = frame.run;
    fits_ = true;
    let_go();
  }
  if (std::exchange(gas_, frame.gas) != frame.gas) {
    let_go();
    stale_ = true;
  }
  if (!std::exchange(stale_, false)) return;
  OverlayText text{.title = "",
                   .caption = "",
                   .letters = letters,
                   .least = least,
                   .speed = frame.speed,
                   .others = titles};
  if (heading && titles.empty()) {
    text.title = frame.scene->title;
    text.caption = frame.scene->caption;
  }
  std::array<Legends, 2> legends;
  for (const std::size_t dimension : {2u, 3u}) {
    std::vector<const Snapshot*> alike;
    for (const Frame* gas : gases) {
      if (gas->snapshot.box.size() == static_cast<Eigen::Index>(dimension)) {
        alike.push_back(&gas->snapshot);
      }
    }
    if (!alike.empty()) legends[dimension - 2] = ranges_[dimension - 2].legends(alike, view);
  }
  // The selected gas first, because the others may have its camera.
  std::vector<const Frame*> order = gases;
  std::swap(order.front(), order[frame.gas]);
  for (const Frame* gas : order) {
    if (!titles.empty()) text.title = titles[gas->gas];
    const auto dimension = static_cast<std::size_t>(gas->snapshot.box.size());
    draw_gas(pictures_[gas->gas], *gas, view, text, legends[dimension - 2]);
  }
}

void Viewport::draw_gas(Picture& picture, const Frame& frame, const View& view,
                        const OverlayText& text, const Legends& legends) {
  const Snapshot& gas = frame.snapshot;
  const Size size = picture.canvas.size();
  const bool selected = frame.gas == gas_;
  const bool resized = !are_equal(std::exchange(picture.box, gas.box), gas.box);
  if (fits_) {
    picture.camera = renderer_.fit(gas, size, view, text, legends);
  } else if (!selected && are_equal(gas.box, pictures_[gas_].box)) {
    picture.camera = camera();
  } else if (!selected && resized) {
    picture.camera = renderer_.fit(gas, size, view, text, legends);
  }
  if (gas.box.size() == 3) {
    picture.camera.orbit.azimuth = view.azimuth;
    picture.camera.orbit.elevation = view.elevation;
    picture.camera.orbit.view_angle = view.view_angle;
  }
  if (selected && follows_ && *picked_ < gas.count()) {
    aim(in_space(gas.positions.col(static_cast<Eigen::Index>(*picked_))));
  }
  picture.canvas.bind();
  renderer_.draw(gas, picture.camera, size, view, text, legends);
}

void Viewport::show(int x, int y) const {
  const auto count = static_cast<int>(pictures_.size());
  for (int number = 0; number < count; ++number) {
    const PictureCell cell = picture_cell(size_, number, count);
    const int bottom = size_.height - cell.top - cell.size.height;
    pictures_[static_cast<std::size_t>(number)].canvas.copy_to(0, x + cell.left, y + bottom);
  }
}

Image Viewport::picture() const {
  std::vector<Image> cells;
  for (const Picture& picture : pictures_) cells.push_back(picture.canvas.read());
  return joined_cells(size_, std::move(cells));
}

WindowMap Viewport::map(ImVec2 corner, float scale) const {
  const Picture& picture = pictures_[gas_];
  return {picture.camera, picture.canvas.size(), cell(corner, scale).low, scale};
}

Area Viewport::cell(ImVec2 corner, float scale, std::size_t gas) const {
  const auto [left, top, size] =
      picture_cell(size_, static_cast<int>(gas), static_cast<int>(pictures_.size()));
  const auto place = [&](int x, int y) {
    return ImVec2(corner.x + static_cast<float>(x) / scale,
                  corner.y + static_cast<float>(y) / scale);
  };
  return {place(left, top), place(left + size.width, top + size.height)};
}

void Viewport::fit() {
  fits_ = true;
  follows_ = false;
  stale_ = true;
}

bool Viewport::let_go() {
  const bool had = picked_.has_value();
  picked_.reset();
  follows_ = false;
  return had;
}

void Viewport::aim(const Vec3& centre) {
  camera().centre = centre.head<2>();
  camera().orbit.z = centre.z();
}

std::optional<ImVec2> Viewport::picked_place(const Frame& frame, const WindowMap& map) const {
  if (!picked_ || *picked_ >= frame.snapshot.count()) return std::nullopt;
  return map.place(frame.snapshot.positions.col(static_cast<Eigen::Index>(*picked_)));
}

bool Viewport::use_mouse(const Frame& frame, View& view, const WindowMap& map, bool over,
                         bool presses) {
  if (over && ImGui::GetIO().MouseWheel != 0.0f) zoom(frame, map);
  if (over && (ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2))) pan(map);
  return drag_or_click(frame, view, map, over && presses);
}

// The point under the mouse, at the depth of the camera's centre, stays there.
void Viewport::zoom(const Frame& frame, const WindowMap& map) {
  const Vec3& centre = map.eye().centre();
  const Vec3 point = map.world(ImGui::GetIO().MousePos, centre);
  const double factor = std::pow(0.85, ImGui::GetIO().MouseWheel);
  const double wide = frame.snapshot.box.maxCoeff() * 10.0;
  const double width = std::clamp(camera().width * factor, 2.0, std::max(20.0, wide));
  aim(point + (centre - point) * (width / camera().width));
  camera().width = width;
  fits_ = false;
  stale_ = true;
}

void Viewport::pan(const WindowMap& map) {
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (moved.x == 0.0f && moved.y == 0.0f) return;
  aim(map.eye().world({-moved.x / map.units(), moved.y / map.units(), 0.0}));
  fits_ = false;
  follows_ = false;
  stale_ = true;
}

// A click picks the particle that was under the mouse at the press. A drag turns spheres, or moves
// the view with Shift.
bool Viewport::drag_or_click(const Frame& frame, View& view, const WindowMap& map, bool over) {
  constexpr float kClick = 3.0f;  // a shorter motion of the mouse is a click, window units
  const ImGuiIO& io = ImGui::GetIO();
  if (over && ImGui::IsMouseClicked(0)) {
    press_ = Press{io.MousePos};
    press_->particle = particle_at(frame.snapshot, map.eye(), map.pixel(io.MousePos), view.slab);
    press_->twice = ImGui::IsMouseDoubleClicked(0);
  }
  if (!press_) return false;
  const float x = io.MousePos.x - press_->place.x, y = io.MousePos.y - press_->place.y;
  press_->dragged |= std::hypot(x, y) >= kClick;
  bool turned = false;
  if (press_->dragged && io.KeyShift) {
    pan(map);
  } else if (press_->dragged && frame.snapshot.box.size() == 3) {
    turned = turn(view, io.MouseDelta.x, io.MouseDelta.y);
  }
  if (ImGui::IsMouseDown(0)) return turned;
  const Press press = *std::exchange(press_, std::nullopt);
  if (press.dragged) return turned;
  picked_ = press.particle;
  follows_ = picked_ && (press.twice || follows_);
  if (follows_) fits_ = false;
  stale_ = true;
  return turned;
}

void Viewport::mark(ImDrawList& list, const Frame& frame, const WindowMap& map) const {
  const Snapshot& gas = frame.snapshot;
  const auto ring = [&](std::size_t number, const VecX& position, ImU32 ink) {
    const auto outline = map.outline(position, gas.radius(number));
    if (outline) list.AddCircle(outline->centre, outline->radius + 2.0f, ink, 0, 2.5f);
  };
  if (picked_ && *picked_ < gas.count()) {
    ring(*picked_, gas.positions.col(static_cast<Eigen::Index>(*picked_)), packed(accent_colour()));
  }
  if (!frame.partners) return;
  // The pair touches, if need be across a periodic border.
  const auto [first, second] = *frame.partners;
  if (std::max(first, second) >= gas.count()) return;
  constexpr ImU32 kPair = IM_COL32(255, 214, 90, 255);
  ring(first, gas.positions.col(first), kPair);
  ring(second, nearest_image(gas, gas.positions.col(first), gas.positions.col(second)), kPair);
}

}  // namespace clatter
