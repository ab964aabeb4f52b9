#include <fmt/format.h>

#include <cmath>

#include "engine/text.h"
#include "render/charts/chart_layout.h"

namespace clatter {

namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : printable(text)) {
    switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += letter;
    }
  }
  return result;
}

// A length with two decimals, without zeros at its end.
double short_number(double length) {
  return std::round(100.0 * length) / 100.0 + 0.0;
}

std::string colour_text(Colour colour) {
  if (colour.alpha == 0) return "none";
  return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

std::string points_text(std::span<const Vec2> path) {
  std::string text;
  for (const Vec2& point : path) {
    if (!text.empty()) text += ' ';
    text += fmt::format("{},{}", short_number(point.x()), short_number(point.y()));
  }
  return text;
}

std::string stroke_text(const ChartStroke& stroke) {
  std::string text = fmt::format("stroke=\"{}\" stroke-width=\"{}\"", colour_text(stroke.colour),
                                 short_number(stroke.width));
  const auto [dash, gap] = stroke.dashes();
  if (dash > 0.0) {
    text += fmt::format(" stroke-dasharray=\"{},{}\"", short_number(dash), short_number(gap));
  }
  return text;
}

class SvgPen final : public ChartPen {
 public:
  explicit SvgPen(Size size)
      : text_(fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                          "viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, sans-serif\" "
                          "stroke-linejoin=\"round\">\n"
                          "<rect width=\"{0}\" height=\"{1}\" fill=\"{2}\"/>\n",
                          size.width, size.height, colour_text(kChartPaper))) {}

  std::string file() const { return text_ + "</svg>\n"; }

  void line(std::span<const Vec2> path, const ChartStroke& stroke) override {
    text_ += fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", points_text(path),
                         stroke_text(stroke));
  }

  void polygon(std::span<const Vec2> corners, Colour fill, const ChartStroke& edge) override {
    text_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" {}/>\n", points_text(corners),
                         colour_text(fill), stroke_text(edge));
  }

  void circle(Vec2 centre, double radius, Colour fill, const ChartStroke& edge) override {
    text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" {}/>\n",
                         short_number(centre.x()), short_number(centre.y()), short_number(radius),
                         colour_text(fill), stroke_text(edge));
  }

  void text(Vec2 place, const std::string& text, const ChartLettering& lettering) override {
    const double x = short_number(place.x()), y = short_number(place.y());
    text_ +=
        fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"", x, y, short_number(lettering.size));
    if (lettering.align == TextAlign::Middle) text_ += " text-anchor=\"middle\"";
    if (lettering.align == TextAlign::Right) text_ += " text-anchor=\"end\"";
    if (lettering.upwards) text_ += fmt::format(" transform=\"rotate(-90 {} {})\"", x, y);
    text_ += fmt::format(" fill=\"{}\">{}</text>\n", colour_text(kChartInk), escaped(text));
  }

 private:
  std::string text_;
};

}  // namespace

std::string chart_svg(const Chart& chart, Size size) {
  SvgPen pen(size);
  draw_chart(chart, size, pen);
  return pen.file();
}

}  // namespace clatter
