#include "app/view/lecture_tools.h"

#include <algorithm>
#include <cmath>

namespace clatter {

void FadingInk::draw_to(ImVec2 place, double now) {
  if (!begins_ && !points_.empty()) {
    const auto& [last, time, begins] = points_.back();
    if (last.x == place.x && last.y == place.y) return;
  }
  points_.push_back({place, now, begins_});
  begins_ = false;
}

void FadingInk::clear() {
  points_.clear();
  begins_ = true;
}

void FadingInk::update(double now) {
  while (!points_.empty() && now - points_.front().time >= life_) {
    points_.pop_front();
    if (!points_.empty()) points_.front().begins = true;
  }
  if (points_.empty()) begins_ = true;
}

float FadingInk::opacity(double drawn, double now) const {
  return static_cast<float>(std::clamp((life_ - (now - drawn)) / fade_, 0.0, 1.0));
}

void FadingInk::paint(ImDrawList& list, ImU32 colour, float width, double now) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto& [place, time, begins] = points_[i];
    const auto alpha = static_cast<ImU32>(std::lround(255.0f * opacity(time, now)));
    const ImU32 ink = (colour & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
    if (!begins) list.AddLine(points_[i - 1].place, place, ink, width);
    list.AddCircleFilled(place, 0.5f * width, ink);
  }
}

void Stopwatch::press(double time, Clock::time_point now) {
  if (!started_) {
    started_ = {time, now};
  } else if (!stopped_) {
    stopped_ = read(time, now);
  } else {
    clear();
  }
}

Stopwatch::Reading Stopwatch::read(double time, Clock::time_point now) const {
  if (stopped_) return *stopped_;
  if (!started_) return {};
  return {time - started_->time, std::chrono::duration<double>(now - started_->moment).count()};
}

}  // namespace clatter
