#include "render/charts/chart_layout.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "render/chart_axis.h"
#include "render/charts/chart_marker.h"
#include "render/typography/fonts.h"

namespace clatter {

namespace {

using Box = Eigen::AlignedBox2d;

constexpr Colour kTheory{0x50, 0x50, 0x50};  // lines that belong to no series

// Lengths in em of the text.
constexpr double kMargin = 0.8;
constexpr double kGap = 0.45;  // between a tick and its number, or a sample and its name
constexpr double kMarker = 0.3;
constexpr double kTick = 0.45;
constexpr double kMinorTick = 0.25;
constexpr double kFrameWidth = 0.055;
constexpr double kBarWidth = 0.07;
constexpr double kLineWidth = 0.09;
// Lengths in em of a text itself.
constexpr double kLineHeight = 1.3;
constexpr double kAscent = 0.93;
constexpr double kHalfCapital = 0.365;

// The part of a straight line in a box (Liang and Barsky 1984).
std::optional<std::array<Vec2, 2>> part_in(const Box& box, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  double first = 0.0, last = 1.0;
  for (int k = 0; k < 2; ++k) {
    if (along[k] == 0.0) {
      if (a[k] < box.min()[k] || a[k] > box.max()[k]) return {};
      continue;
    }
    const double low = (box.min()[k] - a[k]) / along[k], high = (box.max()[k] - a[k]) / along[k];
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  if (first > last) return {};
  return std::array<Vec2, 2>{first == 0.0 ? a : Vec2(a + first * along),
                             last == 1.0 ? b : Vec2(a + last * along)};
}

// An entry of the legend: a marker or a line, and its name.
struct ChartEntry {
  std::optional<std::size_t> marker;
  std::optional<ChartStroke> line;
  std::vector<std::string> name;
  Vec2 place{0.0, 0.0};  // upper left corner, from that of the legend
};

struct ChartLegend {
  std::vector<ChartEntry> entries;
  Vec2 extent{0.0, 0.0};
};

class ChartDrawing {
 public:
  ChartDrawing(const Chart& chart, Size size, ChartPen& pen)
      : chart_(chart),
        pen_(pen),
        page_(Vec2(0.0, 0.0), Vec2(size.width, size.height)),
        sizes_(chart_letter_sizes(size)),
        widths_(chart_letters(chart)) {
    find_scales();
    arrange();
  }

  void draw() const {
    const Vec2 corner(kMargin * em_, kMargin * em_);
    write(title_, corner, {title_size_});
    write(caption_, {corner.x(), page_.max().y() - corner.y() - height_of(caption_, number_size_)},
          {number_size_});
    for (const ChartLine& line : chart_.lines) draw_line(line);
    draw_axis(true);
    draw_axis(false);
    const Vec2 low = frame_.min(), high = frame_.max();
    const std::array<Vec2, 4> corners = {low, Vec2(high.x(), low.y()), high,
                                         Vec2(low.x(), high.y())};
    pen_.polygon(corners, {0, 0, 0, 0}, frame_stroke());
    for (std::size_t k = 0; k < chart_.series.size(); ++k) draw_bars(k);
    for (std::size_t k = 0; k < chart_.series.size(); ++k) {
      for (const ChartPoint& point : chart_.series[k].points) {
        if (shows(point)) draw_marker(k, place(point.x, point.y));
      }
    }
    for (const ChartEntry& entry : legend_.entries) draw_entry(entry);
  }

 private:
  bool shows(const ChartPoint& point) const { return x_.shows(point.x) && y_.shows(point.y); }

  static double bar_of(const ChartPoint& point) {
    return std::isfinite(point.error) && point.error > 0.0 ? point.error : 0.0;
  }

  void find_scales() {
    x_.logarithmic = chart_.x.logarithmic;
    y_.logarithmic = chart_.y.logarithmic;
    ChartExtent points_x, points_y, lines_x, lines_y;
    const auto include = [](const ChartScale& scale, ChartExtent& extent, double value) {
      if (scale.shows(value)) extent.include(scale.coordinate(value));
    };
    for (const ChartSeries& series : chart_.series) {
      for (const ChartPoint& point : series.points) {
        if (!shows(point)) continue;
        const double error = bar_of(point), low = point.y - error;
        include(x_, points_x, point.x);
        include(y_, points_y, point.y);
        include(y_, points_y, point.y + error);
        include(y_, points_y, y_.logarithmic ? std::max(low, 0.1 * point.y) : low);
      }
    }
    for (const ChartLine& line : chart_.lines) {
      for (const Vec2& point : line.points) {
        if (!x_.shows(point.x()) || !y_.shows(point.y())) continue;
        include(x_, lines_x, point.x());
        include(y_, lines_y, point.y());
      }
    }
    empty_ = points_x.empty() && lines_x.empty();
    x_ = chart_scale(points_x, lines_x, x_.logarithmic);
    y_ = chart_scale(points_y, lines_y, y_.logarithmic);
  }

  static double height_of(const std::vector<std::string>& lines, double size) {
    return kLineHeight * size * static_cast<double>(lines.size());
  }

  // Finds the places of the frame and the legend. The height of the label of x and the overhang of
  // its last number depend on the width of the frame, and this on them.
  void arrange() {
    const double width = page_.max().x() - 2.0 * kMargin * em_;
    title_ = widths_.lines(chart_.title, title_size_, width);
    caption_ = widths_.lines(chart_.caption, number_size_, width);
    double label_width = 0.8 * width, overhang = 0.0;
    constexpr int kPasses = 3;
    for (int pass = 0; pass < kPasses; ++pass) {
      arrange(label_width, overhang);
      const double middle = frame_.center().x();
      label_width = 2.0 * std::min(middle, page_.max().x() - middle) - 2.0 * kMargin * em_;
      for (const ChartTick& tick : x_ticks_) {
        const double beyond = 0.5 * widths_(tick.text, number_size_) -
                              (1.0 - x_.share(tick.value)) * frame_.sizes().x();
        overhang = std::max(overhang, beyond);
      }
    }
  }

  void arrange(double label_width, double overhang) {
    const double margin = kMargin * em_;
    x_label_ = widths_.lines(chart_.x.label, em_, label_width);
    double top = margin + height_of(title_, title_size_);
    if (!title_.empty()) top += 0.5 * em_;
    double bottom = page_.max().y() - margin - height_of(caption_, number_size_);
    if (!caption_.empty()) bottom -= 0.6 * em_;
    bottom -= height_of(x_label_, em_) + kLineHeight * number_size_ + kGap * em_;
    y_label_ = widths_.lines(chart_.y.label, em_, bottom - top);
    set_frame({0.0, top}, {1.0, bottom});  // its height determines the ticks of y
    y_ticks_ = fitting_ticks(y_, false);
    double left = margin + height_of(y_label_, em_) + kGap * em_, numbers = 0.0;
    for (const ChartTick& tick : y_ticks_) {
      numbers = std::max(numbers, widths_(tick.text, number_size_));
    }
    if (numbers > 0.0) left += numbers + kGap * em_;
    const double right = page_.max().x() - margin - std::max(0.5 * margin, overhang);
    set_frame({left, top}, {right, bottom});
    legend_ = make_legend(0.7 * (bottom - top), number_size_);
    if (!place_legend_inside()) {
      for (std::size_t size = 2; size < sizes_.size(); ++size) {
        legend_ = make_legend(bottom - top, sizes_[size]);
        if (legend_.extent.x() < 0.35 * page_.max().x()) break;
      }
      set_frame({left, top}, {right - legend_.extent.x() - margin, bottom});
      legend_corner_ = Vec2(frame_.max().x() + margin, top);
    }
    x_ticks_ = fitting_ticks(x_, true);
  }

  // Sets the frame, at least one pixel large, with the edges of its lines between pixels.
  void set_frame(const Vec2& low, const Vec2& high) {
    const double shift = std::fmod(frame_stroke().width, 2.0) / 2.0;
    const auto aligned = [&](const Vec2& place) {
      return Vec2((place.array() - shift).round() + shift);
    };
    frame_ = Box(aligned(low), aligned(high).cwiseMax(aligned(low) + Vec2(1.0, 1.0)));
  }

  // As many ticks as there is room for their numbers.
  std::vector<ChartTick> fitting_ticks(const ChartScale& scale, bool along_x) const {
    if (empty_) return {};
    const double length = along_x ? frame_.sizes().x() : frame_.sizes().y();
    const auto fit = [&](const std::vector<ChartTick>& ticks) {
      double end = -length;
      for (const ChartTick& tick : ticks) {
        if (tick.text.empty()) continue;
        const double extent = along_x ? widths_(tick.text, number_size_) : number_size_;
        const double at = scale.share(tick.value) * length;
        if (at - 0.5 * extent < end + 0.8 * number_size_) return false;
        end = at + 0.5 * extent;
      }
      return true;
    };
    constexpr int kFewest = 2, kMost = 7;
    int most = kMost;
    std::vector<ChartTick> ticks = chart_ticks(scale, most);
    while (most > kFewest && !fit(ticks)) ticks = chart_ticks(scale, --most);
    return ticks;
  }

  Vec2 place(double x, double y) const { return at_shares(x_.share(x), y_.share(y)); }
  Vec2 at_shares(double x, double y) const {
    // Finite numbers for lines that leave the frame by far.
    const auto bounded = [](double share) { return std::clamp(share, -1e9, 1e9); };
    return {frame_.min().x() + bounded(x) * frame_.sizes().x(),
            frame_.max().y() - bounded(y) * frame_.sizes().y()};
  }

  double sample_width(const ChartLegend& legend) const {
    const bool lines = std::ranges::any_of(
        legend.entries, [](const ChartEntry& entry) { return entry.line.has_value(); });
    return (lines ? 1.9 : 2.0 * kMarker) * em_;
  }

  ChartStroke stroke_of_line(const ChartLine& line) const {
    const bool own = !line.series || *line.series >= chart_.series.size();
    return {own ? kTheory : series_ink(*line.series), kLineWidth * em_, line.style};
  }

  // The entries in columns of at most this height.
  ChartLegend make_legend(double height, double name_size) {
    name_size_ = name_size;
    ChartLegend legend;
    const double widest = 0.3 * page_.max().x();
    const auto name_of = [&](const std::string& name) {
      return widths_.lines(name, name_size, widest);
    };
    for (std::size_t k = 0; k < chart_.series.size(); ++k) {
      auto name = name_of(chart_.series[k].name);
      if (!name.empty()) legend.entries.push_back({k, {}, std::move(name)});
    }
    for (const ChartLine& line : chart_.lines) {
      const ChartStroke stroke = stroke_of_line(line);
      const auto name = name_of(line.name);
      const auto known = std::ranges::find_if(legend.entries, [&](const ChartEntry& entry) {
        return entry.line && entry.line->style == line.style && entry.name == name;
      });
      if (known != legend.entries.end()) {
        // An entry that several series share is grey.
        if (known->line->colour != stroke.colour) known->line->colour = kTheory;
      } else if (!name.empty()) {
        legend.entries.push_back({{}, stroke, name});
      }
    }
    const double sample = sample_width(legend) + kGap * em_;
    Vec2 at(0.0, 0.0);
    for (ChartEntry& entry : legend.entries) {
      const double tall = height_of(entry.name, name_size);
      if (at.y() > 0.0 && at.y() + tall > height) at = Vec2(legend.extent.x() + em_, 0.0);
      entry.place = at;
      at.y() += tall;
      for (const std::string& line : entry.name) {
        const Vec2 end(at.x() + sample + widths_(line, name_size), at.y());
        legend.extent = legend.extent.cwiseMax(end);
      }
    }
    return legend;
  }

  // Puts the legend into the frame, nearest to a corner, where it covers nothing. False if there is
  // no such place.
  bool place_legend_inside() {
    const Vec2 room = frame_.sizes() - legend_.extent - Vec2(2.0, 2.0) * em_;
    if (room.minCoeff() < 0.0) return false;
    constexpr int kSteps = 16;
    for (int step = 0; step <= kSteps / 2; ++step) {
      const double near = static_cast<double>(step) / kSteps, far = 1.0 - near;
      for (const auto& [x, y] : {std::array{1.0, near},
                                 {near, 0.0},
                                 {far, 0.0},
                                 {1.0, far},
                                 {0.0, near},
                                 {near, 1.0},
                                 {far, 1.0},
                                 {0.0, far}}) {
        legend_corner_ = frame_.min() + Vec2(em_ + x * room.x(), em_ + y * room.y());
        const Vec2 edge(0.4 * em_, 0.4 * em_);
        if (is_free({legend_corner_ - edge, legend_corner_ + legend_.extent + edge})) return true;
      }
    }
    return false;
  }

  bool is_free(const Box& box) const {
    const double radius = 1.5 * kMarker * em_;
    for (const ChartSeries& series : chart_.series) {
      for (const ChartPoint& point : series.points) {
        if (!shows(point)) continue;
        const auto [low, high] = bar(point);
        const Vec2 edge(radius, radius);
        if (box.intersects(Box(high - edge, low + edge))) return false;
      }
    }
    for (const ChartLine& line : chart_.lines) {
      for (std::size_t k = 1; k < line.points.size(); ++k) {
        const auto part = visible_part(line.points[k - 1], line.points[k]);
        if (part && part_in(box, (*part)[0], (*part)[1])) return false;
      }
    }
    return true;
  }

  // The visible part of a piece of a line.
  std::optional<std::array<Vec2, 2>> visible_part(const Vec2& a, const Vec2& b) const {
    for (const Vec2& point : {a, b}) {
      if (!x_.shows(point.x()) || !y_.shows(point.y())) return {};
    }
    return part_in(frame_, place(a.x(), a.y()), place(b.x(), b.y()));
  }

  // The lower and upper end of an error bar, at most at the frame.
  std::array<Vec2, 2> bar(const ChartPoint& point) const {
    const auto end = [&](double y) {
      const double share = y_.shows(y) ? std::clamp(y_.share(y), 0.0, 1.0) : y > 1.0 ? 1.0 : 0.0;
      return at_shares(x_.share(point.x), share);
    };
    return {end(point.y - bar_of(point)), end(point.y + bar_of(point))};
  }

  ChartStroke frame_stroke() const {
    return {kChartInk, std::max(1.0, std::round(kFrameWidth * em_))};
  }

  // Ticks point inwards from both sides of the frame.
  void draw_axis(bool along_x) const {
    const ChartScale& scale = along_x ? x_ : y_;
    for (const ChartTick& tick : along_x ? x_ticks_ : y_ticks_) {
      const double length = (tick.text.empty() ? kMinorTick : kTick) * em_;
      const double share = scale.share(tick.value);
      const Vec2 inwards = along_x ? Vec2(0.0, -length) : Vec2(length, 0.0);
      const Vec2 low = along_x ? at_shares(share, 0.0) : at_shares(0.0, share);
      const Vec2 high = along_x ? at_shares(share, 1.0) : at_shares(1.0, share);
      pen_.line(std::array<Vec2, 2>{low, low + inwards}, frame_stroke());
      pen_.line(std::array<Vec2, 2>{high, high - inwards}, frame_stroke());
      if (tick.text.empty()) continue;
      if (along_x) {
        pen_.text(low + Vec2(0.0, kGap * em_ + kAscent * number_size_), tick.text,
                  {number_size_, TextAlign::Middle});
      } else {
        pen_.text(low + Vec2(-kGap * em_, kHalfCapital * number_size_), tick.text,
                  {number_size_, TextAlign::Right});
      }
    }
    const Vec2 middle = frame_.center();
    if (along_x) {
      const double numbers = kGap * em_ + kLineHeight * number_size_;
      write(x_label_, {middle.x(), frame_.max().y() + numbers}, {em_, TextAlign::Middle});
    } else {
      write(y_label_, {kMargin * em_, middle.y()}, {em_, TextAlign::Middle, true});
    }
  }

  // Writes lines with the upper end of the first at a place.
  void write(const std::vector<std::string>& lines, Vec2 place,
             const ChartLettering& lettering) const {
    const Vec2 down = lettering.upwards ? Vec2(lettering.size, 0.0) : Vec2(0.0, lettering.size);
    place += kAscent * down;
    for (const std::string& line : lines) {
      pen_.text(place, line, lettering);
      place += kLineHeight * down;
    }
  }

  void draw_line(const ChartLine& line) const {
    std::vector<Vec2> path;
    const auto finish = [&] {
      if (path.size() > 1) pen_.line(path, stroke_of_line(line));
      path.clear();
    };
    for (std::size_t k = 1; k < line.points.size(); ++k) {
      const auto part = visible_part(line.points[k - 1], line.points[k]);
      if (!part || path.empty() || path.back() != (*part)[0]) finish();
      if (!part) continue;
      if (path.empty()) path.push_back((*part)[0]);
      path.push_back((*part)[1]);
    }
    finish();
  }

  void draw_bars(std::size_t series) const {
    const ChartStroke stroke{series_ink(series), kBarWidth * em_};
    for (const ChartPoint& point : chart_.series[series].points) {
      if (!shows(point) || bar_of(point) == 0.0) continue;
      const std::array<Vec2, 2> ends = bar(point);
      pen_.line(ends, stroke);
      for (const Vec2& end : ends) {
        const bool cut = std::min(end.y() - frame_.min().y(), frame_.max().y() - end.y()) < 1e-6;
        if (cut) continue;
        const Vec2 half(0.8 * kMarker * em_, 0.0);
        pen_.line(std::array<Vec2, 2>{end - half, end + half}, stroke);
      }
    }
  }

  void draw_marker(std::size_t series, const Vec2& at) const {
    const double radius = kMarker * em_;
    const ChartStroke edge{series_ink(series), kBarWidth * em_};
    const std::vector<Vec2> corners = marker_corners(series, at, radius);
    if (corners.empty()) {
      pen_.circle(at, radius, marker_fill(series), edge);
    } else {
      pen_.polygon(corners, marker_fill(series), edge);
    }
  }

  void draw_entry(const ChartEntry& entry) const {
    const double width = sample_width(legend_);
    const Vec2 corner = legend_corner_ + entry.place;
    const Vec2 middle = corner + Vec2(0.5 * width, (kAscent - kHalfCapital) * name_size_);
    if (entry.marker) draw_marker(*entry.marker, middle);
    if (entry.line) {
      const Vec2 half(0.5 * width, 0.0);
      pen_.line(std::array<Vec2, 2>{middle - half, middle + half}, *entry.line);
    }
    write(entry.name, corner + Vec2(width + kGap * em_, 0.0), {name_size_});
  }

  const Chart& chart_;
  ChartPen& pen_;
  Box page_;
  std::array<double, kChartLetterSizes> sizes_;
  double title_size_ = sizes_[0], em_ = sizes_[1], number_size_ = sizes_[2];
  double name_size_ = number_size_;  // of the legend
  TextWidths widths_;
  bool empty_ = true;  // neither points nor lines
  ChartScale x_, y_;
  Box frame_;
  std::vector<std::string> title_, caption_, x_label_, y_label_;
  std::vector<ChartTick> x_ticks_, y_ticks_;
  ChartLegend legend_;
  Vec2 legend_corner_{0.0, 0.0};
};

}  // namespace

std::array<double, 2> ChartStroke::dashes() const {
  switch (style) {
    case LineStyle::Solid:
      break;
    case LineStyle::Dashed:
      return {5.0 * width, 3.0 * width};
    case LineStyle::Dotted:
      return {width, 2.0 * width};
  }
  return {0.0, 0.0};
}

std::array<double, kChartLetterSizes> chart_letter_sizes(Size size) {
  constexpr double kLeast = 4.0;
  const double em = std::max(kLeast, std::min<double>(size.width, 1.4 * size.height) / 42.0);
  return {1.15 * em, em, 0.88 * em, 0.76 * em, 0.65 * em, 0.55 * em};
}

std::string chart_letters(const Chart& chart) {
  std::string letters = "0123456789.−×⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
  letters += chart.title + chart.caption + chart.x.label + chart.y.label;
  for (const ChartSeries& series : chart.series) letters += series.name;
  for (const ChartLine& line : chart.lines) letters += line.name;
  return letters;
}

void draw_chart(const Chart& chart, Size size, ChartPen& pen) {
  ChartDrawing(chart, size, pen).draw();
}

}  // namespace clatter
