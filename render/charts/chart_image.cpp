#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "render/charts/chart_layout.h"
#include "render/typography/fonts.h"
#include "render/typography/gui_layer.h"

namespace clatter {

namespace {

ImVec2 packed(const Vec2& place) {
  return {static_cast<float>(place.x()), static_cast<float>(place.y())};
}

class ImagePen final : public ChartPen {
 public:
  // The fonts are in the order of their sizes in pixels per em.
  ImagePen(ImDrawList& list, const std::vector<Font>& fonts,
           std::array<double, kChartLetterSizes> sizes)
      : list_(list), fonts_(fonts), sizes_(sizes) {}

  void line(std::span<const Vec2> path, const ChartStroke& stroke) override {
    const auto [dash, gap] = stroke.dashes();
    if (dash == 0.0) return solid(path, stroke, ImDrawFlags_None);
    std::vector<Vec2> piece = {path.front()};
    bool drawn = true;
    double left = dash;  // rest of the current dash or gap
    for (std::size_t k = 1; k < path.size(); ++k) {
      while ((path[k] - piece.back()).norm() > left) {
        const Vec2 end = piece.back() + left * (path[k] - piece.back()).normalized();
        piece.push_back(end);
        if (drawn) solid(piece, stroke, ImDrawFlags_None);
        piece = {end};
        drawn = !drawn;
        left = drawn ? dash : gap;
      }
      left -= (path[k] - piece.back()).norm();
      piece.push_back(path[k]);
    }
    if (drawn) solid(piece, stroke, ImDrawFlags_None);
  }

  void polygon(std::span<const Vec2> corners, Colour fill, const ChartStroke& edge) override {
    // A fan of triangles also fills a star. Their common sides must not be smoothed.
    const ImDrawListFlags flags = list_.Flags;
    list_.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    Vec2 centre(0.0, 0.0);
    for (const Vec2& corner : corners) centre += corner / static_cast<double>(corners.size());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      list_.AddTriangleFilled(packed(centre), packed(corners[k]),
                              packed(corners[(k + 1) % corners.size()]), clatter::packed(fill));
    }
    list_.Flags = flags;
    solid(corners, edge, ImDrawFlags_Closed);
  }

  void circle(Vec2 centre, double radius, Colour fill, const ChartStroke& edge) override {
    constexpr int kCorners = 48;
    const auto r = static_cast<float>(radius);
    list_.AddCircleFilled(packed(centre), r, clatter::packed(fill), kCorners);
    list_.AddCircle(packed(centre), r, clatter::packed(edge.colour), kCorners,
                    static_cast<float>(edge.width));
  }

  void text(Vec2 place, const std::string& text, const ChartLettering& lettering) override {
    const auto size = std::ranges::find(sizes_, lettering.size) - sizes_.begin();
    const Font& font = fonts_[static_cast<std::size_t>(size)];
    const double width = text_extent(font, text).x;
    const double before = lettering.align == TextAlign::Left     ? 0.0
                          : lettering.align == TextAlign::Middle ? 0.5 * width
                                                                 : width;
    place -= lettering.upwards ? Vec2(0.0, -before) : Vec2(before, 0.0);
    place = place.array().round();  // letters are sharp at whole pixels
    const int first = list_.VtxBuffer.Size;
    constexpr float kEverywhere = 1e6f;
    font.face->RenderText(&list_, font.size, packed(place - Vec2(0.0, font.ascent())),
                          clatter::packed(kChartInk),
                          ImVec4(-kEverywhere, -kEverywhere, kEverywhere, kEverywhere), text.data(),
                          text.data() + text.size());
    if (!lettering.upwards) return;
    for (int k = first; k < list_.VtxBuffer.Size; ++k) {
      ImVec2& corner = list_.VtxBuffer[k].pos;
      const Vec2 from = Vec2(corner.x, corner.y) - place;
      corner = packed(place + Vec2(from.y(), -from.x()));
    }
  }

 private:
  void solid(std::span<const Vec2> path, const ChartStroke& stroke, ImDrawFlags flags) {
    std::vector<ImVec2> points;
    for (const Vec2& point : path) points.push_back(packed(point));
    list_.AddPolyline(points.data(), static_cast<int>(points.size()),
                      clatter::packed(stroke.colour), flags, static_cast<float>(stroke.width));
  }

  ImDrawList& list_;
  const std::vector<Font>& fonts_;
  std::array<double, kChartLetterSizes> sizes_;
};

}  // namespace

Image chart_image(const Gl& gl, const Chart& chart, Size size) {
  const auto sizes = chart_letter_sizes(size);
  std::vector<Font> fonts;
  return gui_picture(
      gl, size, kChartPaper,
      [&](ImFontAtlas& atlas) { fonts = add_letters(atlas, chart_letters(chart), sizes); },
      [&](ImDrawList& list) {
        ImagePen pen(list, fonts, sizes);
        draw_chart(chart, size, pen);
      });
}

}  // namespace clatter
