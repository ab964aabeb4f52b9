#include "app/system/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "engine/system/terminal.h"

namespace clatter {

Progress::Progress(ProgressStyle style, std::string doing, double start, double end)
    : style_(style),
      doing_(std::move(doing)),
      start_(start),
      end_(end),
      terminal_(style == ProgressStyle::Auto && error_is_terminal()),
      began_(Clock::now()),
      last_shown_(began_) {}

Progress::~Progress() {
  if (bar_shown_) std::fputs("\r\033[K", stderr);
}

void Progress::expect(double end, std::string doing) {
  end_ = end;
  doing_ = std::move(doing);
}

std::string spell_seconds(double seconds) {
  constexpr double kLongest = 1e9;  // about thirty years
  if (!(seconds < kLongest)) return "ages";
  const auto whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

void Progress::update(double time) {
  if (style_ == ProgressStyle::None) return;
  const auto now = Clock::now();
  const std::chrono::duration<double> since_shown = now - last_shown_;
  if (since_shown.count() < (terminal_ ? 0.1 : 5.0)) return;
  last_shown_ = now;
  const double span = end_ - start_;
  const double done = span > 0.0 ? std::clamp((time - start_) / span, 0.0, 1.0) : 1.0;
  const double elapsed = std::chrono::duration<double>(now - began_).count();
  const double left = done > 0.0 ? elapsed * (1.0 - done) / done : 0.0;
  if (style_ == ProgressStyle::Json) {
    std::fprintf(stderr, "{\"time\":%.17g,\"until\":%.17g,\"done\":%.6f,\"seconds_left\":%.1f}\n",
                 time, end_, done, left);
  } else if (terminal_) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(done * kWidth);
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(kWidth - filled), '.');
    std::fprintf(stderr, "\r\033[K%s [%s] %3.0f %%  t = %.6g of %.6g  %s left", doing_.c_str(),
                 bar.c_str(), 100.0 * done, time, end_, spell_seconds(left).c_str());
    bar_shown_ = true;
  } else {
    std::fprintf(stderr, "%s: %.0f %%, t = %.6g of %.6g, %s left\n", doing_.c_str(), 100.0 * done,
                 time, end_, spell_seconds(left).c_str());
  }
}

}  // namespace clatter
