#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "render/layers/legend.h"
#include "render/typography/gui_context.h"
#include "tests/render/picture.h"
#include "tests/support/drawn_text.h"

namespace clatter {

using testing::DrawnText;

namespace {

// A draw list without a picture.
class Drawing {
 public:
  explicit Drawing(const std::function<void(ImDrawList&, const Fonts&)>& draw) {
    const CurrentContext current(context_.get());
    ImGui::GetIO().DisplaySize = ImVec2(400.0f, 400.0f);
    const Fonts fonts = add_fonts(*ImGui::GetIO().Fonts, 16.0f);
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    draw(list, fonts);
    // Halos are drawn first, below the text.
    for (const DrawnText& text : testing::texts_in(list)) {
      if ((text.colour >> IM_COL32_A_SHIFT) == 255) texts.push_back(text);
    }
    vertices.assign(list.VtxBuffer.begin(), list.VtxBuffer.end());
    ImGui::EndFrame();
  }

  // The colour of the single-coloured shape at a position.
  ImU32 colour_at(float x, float y) const {
    ImU32 colour = 0;
    for (std::size_t k = 0; k + 3 < vertices.size(); k += 4) {
      const ImVec2 low = vertices[k].pos, high = vertices[k + 2].pos;
      if (low.x <= x && x < high.x && low.y <= y && y < high.y) colour = vertices[k].col;
    }
    return colour;
  }

  std::vector<DrawnText> texts;
  std::vector<ImDrawVert> vertices;

 private:
  GuiContext context_ = make_gui_context();
};

double number_in(std::string text) {
  const std::string minus = "−";
  if (text.starts_with(minus)) return -std::stod(text.substr(minus.size()));
  return std::stod(text);
}

}  // namespace

TEST_CASE("Legend: beside each number of a colour bar is the colour of that number") {
  for (const auto& [low, high, sign] : {std::tuple(0.0, 3.0, Sign::Positive),
                                        {0.0, -4.0, Sign::Negative},
                                        {-2.0, 2.0, Sign::Either}}) {
    CAPTURE(low);
    CAPTURE(high);
    ColourScale scale{colour_map(Palette::Viridis), low, high};
    if (sign == Sign::Either)
      scale = {.map = diverging_map(), .low = low, .high = high, .about_zero = true};
    const Legend legend{{"stress σ", "xy", sign, "m/t²"}, scale, "locked"};
    const Drawing drawing([&](ImDrawList& list, const Fonts& fonts) {
      draw_legend(list, legend, fonts, kDarkTheme, ImVec2(20.0f, 30.0f), 250.0f);
    });
    REQUIRE(drawing.texts.size() > 5);
    CHECK(drawing.texts[0].text == "stress σ");
    CHECK(drawing.texts[1].text == "xy");
    CHECK(drawing.texts[1].left >= drawing.texts[0].right - 1.0f);
    CHECK(drawing.texts[2].text == "m/t² · locked");
    double least = 1e9, most = -1e9;
    for (std::size_t k = 3; k < drawing.texts.size(); ++k) {
      const DrawnText& text = drawing.texts[k];
      CAPTURE(text.text);
      const double value = number_in(text.text);
      least = std::min(least, value);
      most = std::max(most, value);
      // The bar begins at x = 20. The numbers at its ends are centred on the ends.
      const float y = std::clamp(text.middle_y(), 30.0f + 2.75f * 16.0f, 279.0f);
      const ImU32 colour = drawing.colour_at(24.0f, y);
      const Colour beside{static_cast<unsigned char>(colour >> IM_COL32_R_SHIFT),
                          static_cast<unsigned char>(colour >> IM_COL32_G_SHIFT),
                          static_cast<unsigned char>(colour >> IM_COL32_B_SHIFT), 255};
      CHECK(difference(beside, scale(value)) < 12);
      CHECK(text.left > 20.0f + 0.75f * 16.0f);
    }
    CHECK(least == std::min(low, high));
    CHECK(most == std::max(low, high));
  }
}

TEST_CASE("Legend: an arrow is as long as one of its value") {
  const ArrowLegend legend{{"heat flux q", "", Sign::Either, "m a/t³"}, 37.0};
  const ArrowShape shape = ArrowShape::in({1280, 720});
  const Drawing drawing([&](ImDrawList& list, const Fonts& fonts) {
    draw_arrow_legend(list, legend, fonts, kDarkTheme, shape, ImVec2(20.0f, 30.0f));
  });
  CHECK(drawing.texts.front().text == "heat flux q");
  // The round value whose arrow has a length of at most five text lines: 80 pixels.
  CHECK(drawing.texts.back().text == "2 m a/t³");
  float tip = 0.0f;
  for (std::size_t k = 0; k + 2 < drawing.vertices.size(); ++k) {
    const ImDrawVert& vertex = drawing.vertices[k];
    if (vertex.col == packed(kDarkTheme.text) && vertex.pos.y == 30.0f + 2.0f * 16.0f) {
      tip = std::max(tip, vertex.pos.x);
    }
  }
  // Its edge is antialiased over one pixel on each side.
  CHECK(std::fabs(tip - (20.0f + 2.0f * 37.0f)) < 1.5f);
}

TEST_CASE("Legend: bars stand in order, disks above the field, and the widest takes its width") {
  Legends legends;
  CHECK(legends.bars().empty());
  legends.disks = Legend{{"speed |v|", "", Sign::Positive, "a/t"}, {}, "auto"};
  legends.field = Legend{{"density ρ", "", Sign::Positive, "1/a²"}, {}, "given"};
  REQUIRE(legends.bars().size() == 2);
  CHECK(legends.bars()[0].label.name == "speed |v|");
  CHECK(legends.bars()[1].label.name == "density ρ");
  const Drawing drawing([&](ImDrawList&, const Fonts& fonts) {
    const float both = legend_width(legends, fonts);
    legends.arrows = ArrowLegend{{"a very long name of arrows, longer than all", "", {}, "a/t"}};
    CHECK(legend_width(legends, fonts) > both);
  });
}

TEST_CASE("Legend: species have their colours, names and sizes") {
  SpeciesLegend legend;
  legend.species = {species_of("small"), species_of("large", 4.0),
                    species_of("mixed-and-with-a-very-long-name", 2.0)};
  legend.species[2].polydispersity = Polydispersity{Spread::Uniform, 0.25};
  legend.colours = {{200, 10, 10}, {10, 200, 10}, {10, 10, 200}};
  const Drawing drawing([&](ImDrawList& list, const Fonts& fonts) {
    draw_species_legend(list, legend, fonts, kDarkTheme, ImVec2(20.0f, 30.0f));
    CHECK(species_legend_height(legend, fonts) > 100.0f);
    Legends all;
    all.species = legend;
    CHECK(legend_width(all, fonts) > 60.0f);
    CHECK(legend_width(all, fonts) < 200.0f);
    CHECK(fitting(legend, fonts, species_legend_height(legend, fonts)).species.size() == 3);
    CHECK(fitting(legend, fonts, species_legend_height(legend, fonts) - 1.0f).colours.size() == 2);
    CHECK(fitting(legend, fonts, 0.0f).species.size() == 1);
  });
  REQUIRE(drawing.texts.size() == 7);
  CHECK(drawing.texts[0].text == "species");
  CHECK(drawing.texts[1].text == "small");
  CHECK(drawing.texts[2].text == "d = 1 a");
  CHECK(drawing.texts[3].text == "large");
  CHECK(drawing.texts[4].text == "d = 4 a");
  CHECK(drawing.texts[5].text.starts_with("mixed-and"));
  CHECK(drawing.texts[5].text.ends_with("…"));
  CHECK(drawing.texts[6].text == "d = 1.5–2.5 a");
  // The widths of the disks, from their corners; their edges are antialiased over one pixel.
  const auto extent_of = [&](Colour colour) {
    float low = 1e9f, high = 0.0f;
    for (const ImDrawVert& vertex : drawing.vertices) {
      if (vertex.col != packed(colour)) continue;
      low = std::min(low, vertex.pos.x);
      high = std::max(high, vertex.pos.x);
    }
    CHECK(low >= 19.0f);
    CHECK(high < drawing.texts[1].left);
    return high - low;
  };
  const float large = extent_of(legend.colours[1]);
  CHECK(large > 20.0f);
  CHECK(std::fabs(extent_of(legend.colours[0]) - 0.25f * large) < 2.0f);
  CHECK(std::fabs(extent_of(legend.colours[2]) - 0.5f * large) < 2.0f);
}

}  // namespace clatter
