#pragma once

#include <imgui.h>

#include <chrono>
#include <deque>
#include <optional>

namespace clatter {

/// Lines over the picture: those of the pen, which stay, or the trail of the pointer, which fades
/// out.
class FadingInk {
 public:
  /// Each part of a line is visible for `life` seconds, infinite: until clear(), and fades in the
  /// last `fade` of them.
  FadingInk(double life, double fade) : life_(life), fade_(fade) {}

  /// Continues the line to a place at a time in seconds, or begins a line after lift().
  void draw_to(ImVec2 place, double now);
  /// Ends the line.
  void lift() { begins_ = true; }
  /// Removes all lines.
  void clear();
  /// Removes the parts that have faded out.
  void update(double now);
  /// Whether any part is visible.
  bool visible() const { return !points_.empty(); }
  /// Opacity of a part that was drawn at a time, 0..1.
  float opacity(double drawn, double now) const;
  /// Draws the lines.
  void paint(ImDrawList& list, ImU32 colour, float width, double now) const;

 private:
  struct Point {
    ImVec2 place;
    double time;
    bool begins;  // the first point of a line
  };

  double life_, fade_;
  std::deque<Point> points_;  // in order of time
  bool begins_ = true;
};

/// Measures simulation time and real time, with one button: start, stop, back to zero.
class Stopwatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// Times since the start.
  struct Reading {
    double simulated = 0.0;  ///< simulation time; negative after a jump into the past
    double seconds = 0.0;    ///< real time
  };

  /// Presses the button at a simulation time and a real time.
  void press(double time, Clock::time_point now);
  /// Sets the stopwatch to zero.
  void clear() { *this = {}; }
  /// Whether it has not been started.
  bool at_zero() const { return !started_; }
  /// Whether it runs.
  bool runs() const { return started_ && !stopped_; }
  /// The times at a simulation time and a real time; zeros before the start.
  Reading read(double time, Clock::time_point now) const;

 private:
  struct Start {
    double time;
    Clock::time_point moment;
  };

  std::optional<Start> started_;
  std::optional<Reading> stopped_;
};

}  // namespace clatter
