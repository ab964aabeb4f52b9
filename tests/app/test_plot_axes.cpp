// The axes of plots: their ranges, numbers and ticks.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/plots/plots.h"
#include "app/view/plots_panel.h"
#include "render/typography/fonts.h"
#include "render/typography/gui_context.h"
#include "tests/support/drawn_text.h"

namespace clatter {

TEST_CASE("Plots: axes contain their curves with a margin above, or go from decade to decade") {
  LivePlot plot{"", "", false, false, {{"", {}, {{-1.0, 2.0}, {3.0, 20.0}}}}, ""};
  auto [x, y] = scales_of(plot);
  CHECK(x.low == -1.0);
  CHECK(x.high == 3.0);
  CHECK(y.low == 0.0);
  CHECK(y.high == doctest::Approx(21.0));
  CHECK(x.share(0.0) == doctest::Approx(0.25));
  plot.log_y = true;
  plot.floor = 1e-3;
  plot.curves[0].points.emplace_back(9.0, 0.0);
  const auto [wide, logarithmic] = scales_of(plot);
  CHECK(wide.high == 9.0);
  CHECK(logarithmic.logarithmic);
  CHECK(logarithmic.low == doctest::Approx(-3.0));
  CHECK(logarithmic.place(0.0) == doctest::Approx(-3.0));
  CHECK(logarithmic.place(100.0) == doctest::Approx(2.0));
}

// Draws a plot without a window, and reads its texts.
class DrawnPlot {
 public:
  explicit DrawnPlot(const LivePlot& plot) {
    const CurrentContext current(context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(400.0f, 400.0f);
    fonts_ = add_fonts(*io.Fonts, 14.0f);
    io.FontDefault = fonts_.text.face;
    for (int picture = 0; picture < 2; ++picture) {
      ImGui::NewFrame();
      ImGui::SetNextWindowSize(io.DisplaySize);
      ImGui::Begin("plot", nullptr, ImGuiWindowFlags_NoTitleBar);
      draw_plot(plot, 250.0f);
      texts = testing::texts_in(*ImGui::GetWindowDrawList());
      for (const ImDrawVert& vertex : ImGui::GetWindowDrawList()->VtxBuffer) {
        if (vertex.col == packed(kMarked)) marks_.push_back(vertex.pos);
      }
      if (picture == 0) marks_.clear();
      ImGui::End();
      ImGui::EndFrame();
    }
  }

  // The centre of all marks of this colour, without the legend.
  Vec2 mark() const {
    ImVec2 low(1e9f, 1e9f), high(0.0f, 0.0f);
    for (const ImVec2& place : marks_) {
      if (place.y < legend()) continue;
      low = ImVec2(std::min(low.x, place.x), std::min(low.y, place.y));
      high = ImVec2(std::max(high.x, place.x), std::max(high.y, place.y));
    }
    return {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
  }
  bool has(const std::string& text) const {
    return std::ranges::any_of(texts, [&](const auto& drawn) { return drawn.text == text; });
  }
  const testing::DrawnText& text(const std::string& text) const {
    for (const auto& drawn : texts) {
      if (drawn.text == text) return drawn;
    }
    FAIL("no text " << text);
    return texts.front();
  }

  static constexpr Colour kMarked = {0x12, 0x34, 0x56};
  std::vector<testing::DrawnText> texts;

 private:
  float legend() const { return text("mark").bottom + 4.0f; }

  GuiContext context_ = make_gui_context();
  Fonts fonts_;
  std::vector<ImVec2> marks_;
};

TEST_CASE("Plots: numbers at the axes have the values of their positions") {
  LivePlot plot{"Title", "the x axis", false, false, {}, "unit of y"};
  plot.curves = {{"mark", DrawnPlot::kMarked, {{3.0, 50.0}}, false, true},
                 {"line", {1, 2, 3}, {{0.0, 0.0}, {4.0, 100.0}}}};
  const DrawnPlot drawn(plot);
  for (const char* text : {"Title", "unit of y", "mark", "line", "the x axis"}) {
    CAPTURE(text);
    CHECK(drawn.has(text));
  }
  // A mark at x = 3 and y = 50, at three quarters of the x axis.
  CHECK(drawn.mark().x() == doctest::Approx(drawn.text("3").middle_x()).epsilon(0.01));
  CHECK(drawn.mark().y() == doctest::Approx(drawn.text("50").middle_y()).epsilon(0.01));
  CHECK(drawn.text("1").middle_x() < drawn.text("3").middle_x());
  CHECK(drawn.text("100").middle_y() < drawn.text("50").middle_y());
  // The name of x is below its numbers. The numbers of y are to the left of the marks.
  CHECK(drawn.text("the x axis").top > drawn.text("3").bottom - 1.0f);
  CHECK(drawn.text("50").right < drawn.text("1").left);
  CHECK(drawn.text("Title").right < drawn.text("unit of y").left);
}

TEST_CASE("Plots: logarithmic axes have powers of ten where these are") {
  LivePlot plot{"Title", "x", true, true, {}, "y"};
  plot.curves = {{"mark", DrawnPlot::kMarked, {{100.0, 1e-2}}, false, true},
                 {"line", {1, 2, 3}, {{1.0, 1e-4}, {1e4, 1.0}}}};
  const DrawnPlot drawn(plot);
  CHECK(drawn.mark().x() == doctest::Approx(drawn.text("100").middle_x()).epsilon(0.01));
  CHECK(drawn.mark().y() == doctest::Approx(drawn.text("0.01").middle_y()).epsilon(0.01));
}

// An area of 200 x 100 pixels.
static PlotFrame frame_over(const PlotScale& x, const PlotScale& y) {
  return {ImVec2(50.0f, 20.0f), ImVec2(250.0f, 120.0f), x, y};
}

TEST_CASE("Plot: a place of its area is a point, and back") {
  const PlotFrame frame = frame_over({0.0, 4.0}, {-1.0, 1.0, true});
  const Vec2 point = frame.point(ImVec2(150.0f, 70.0f));
  CHECK(point.x() == doctest::Approx(2.0));
  CHECK(point.y() == doctest::Approx(1.0));
  const ImVec2 place = frame.at({3.0, 10.0});
  CHECK(place.x == doctest::Approx(200.0f));
  CHECK(place.y == doctest::Approx(20.0f));
}

TEST_CASE("Plot: a slope is a quotient, an exponent, a rate or a change per decade") {
  const PlotScale linear{0.0, 10.0}, decades{0.0, 3.0, true};
  CHECK(slope_text(frame_over(linear, linear), {1.0, 2.0}, {5.0, 8.0}) == "slope 1.5");
  // y = x^-2, and y = exp(-x / 2).
  CHECK(slope_text(frame_over(decades, decades), {1.0, 1.0}, {10.0, 0.01}) == "exponent -2");
  CHECK(slope_text(frame_over(linear, decades), {0.0, 1.0}, {4.0, std::exp(-2.0)}) == "rate -0.5");
  CHECK(slope_text(frame_over(decades, linear), {1.0, 2.0}, {100.0, 8.0}) == "3 per decade");
  CHECK(slope_text(frame_over(linear, linear), {1.0, 2.0}, {1.0, 8.0}).empty());
}

TEST_CASE("Plot: the values at a place are those of the nearest points") {
  LivePlot plot{"Temperature", "time t", false, false, {}};
  CHECK(readout(plot, frame_over({0.0, 4.0}, {0.0, 1.0}), ImVec2(150.0f, 70.0f)).empty());
  plot.curves = {{.name = "T", .colour = {}, .points = {{1.0, 0.5}, {2.25, 0.25}, {3.0, 0.125}}},
                 {.name = "", .colour = {}, .points = {{0.0, 7.0}}}};
  CHECK(readout(plot, frame_over({0.0, 4.0}, {0.0, 1.0}), ImVec2(150.0f, 70.0f)) ==
        "time t = 2\nT = 0.25\nTemperature = 7");
}

}  // namespace clatter
