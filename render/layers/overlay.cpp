#include "render/layers/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/enum_names.h"
#include "render/eye.h"
#include "render/layers/grid_layer.h"
#include "render/layers/wall_layer.h"
#include "render/tiling.h"
#include "render/typeset_number.h"
#include "render/typography/marked_line.h"

namespace clatter {

namespace {

// Lengths in units of the layout, see Fonts::unit().
constexpr float kEdge = 1.2f;     // from the edge of the picture to the text
constexpr float kColumn = 16.0f;  // width of the column
constexpr float kPlate = 0.4f;    // from a text to the edge of its plate

// Position of heading and figures: rows above and below the box, or a column at its left.
enum class Arrangement { Rows, Column };

struct Page {
  Arrangement arrangement = Arrangement::Rows;
  Fonts fonts;
  ThemeColours theme;
  Size size;             // size of the picture
  Margins margins;       // margins of the text
  float edge = 0.0f;     // from the upper and lower edge of the picture to the text, pixels
  float left = 0.0f;     // from the left edge of the picture to the text, pixels
  float wrap = 0.0f;     // longest line of the heading, pixels
  float heading = 0.0f;  // from the upper edge of the picture to the end of the heading, pixels
  float caption = 0.0f;  // from the upper edge of the picture to the caption, pixels
  // Upper left and lower right corner of the box with its walls and copies, pixels.
  ImVec2 box_low = {}, box_high = {};
};

float unit_for(Size size, const OverlayText& text) {
  const double usual = std::max(12.0, std::min(size.width, size.height) / 40.0);
  return static_cast<float>(std::round(std::max(text.letters * usual, text.least)));
}

// The text without the parts that the view hides. Title cards have the whole text.
OverlayText shown_text(OverlayText text, const View& view) {
  if (view.hides(OverlayPart::Title)) text.title.clear(), text.others.clear();
  if (view.hides(OverlayPart::Caption)) text.caption.clear();
  return text;
}

// Hidden particles without trails have no colours to explain.
Legends shown_legends(Legends legends, const View& view) {
  if (view.hides(OverlayPart::ColourBars)) return {};
  if (view.opacity == 0.0 && !view.trails) legends.disks.reset(), legends.species.reset();
  return legends;
}

// Whether there are figures or a scale bar below the box.
bool has_row(const View& view) {
  return !view.hides(OverlayPart::Time) || !view.hides(OverlayPart::Temperature) ||
         !view.hides(OverlayPart::Collisions) || !view.hides(OverlayPart::Walls) ||
         !view.hides(OverlayPart::ScaleBar);
}

Page arrange(Arrangement arrangement, const Fonts& fonts, const ThemeColours& theme, Size size,
             const View& view, const Legends& legends, const OverlayText& text) {
  const float unit = fonts.unit(), edge = std::round(kEdge * unit);
  const bool column = arrangement == Arrangement::Column;
  Page page{arrangement, fonts, theme, size,
            {},          edge,  edge,  column ? kColumn * unit : size.width - 2 * edge};
  float end = page.caption = edge;
  if (!text.title.empty()) {
    float height = text_extent(fonts.title, text.title, page.wrap).y;
    for (const std::string& title : text.others) {
      height = std::max(height, text_extent(fonts.title, title, page.wrap).y);
    }
    end += height;
    page.caption = end + std::round(0.35f * unit);
  }
  if (!text.caption.empty()) {
    end = page.caption + text_extent(fonts.text, text.caption, page.wrap).y;
  }

  page.heading = end > edge ? end : 0.0f;

  const float width = legend_width(legends, fonts);
  const double frame = edge + wall_thickness(size);
  page.margins = {frame, frame + (width > 0.0f ? unit + width : 0.0f), frame, frame};
  if (column) {
    page.margins.left += page.wrap + unit;
  } else {
    page.margins.top += end > edge ? end - edge + unit : 0.0f;
    page.margins.bottom += has_row(view) ? 2.0f * unit : 0.0f;
  }
  return page;
}

// Moves a column next to a box that leaves free width, so that both are in the middle.
void gather(Page& page, const Faces& faces) {
  const Camera camera = Camera::fit(faces.low, faces.high, page.size, page.margins);
  const double box = (faces.high - faces.low).x() * page.size.width / camera.width;
  const double free = page.size.width - page.margins.left - box - page.margins.right;
  const double each = std::floor(0.5 * std::max(0.0, free));
  page.left += static_cast<float>(each);
  page.margins.left += each;
  page.margins.right += each;
}

// The arrangement that shows the box larger. `whole`: the whole box is inside the margins.
Page arrange(const Snapshot& snapshot, const Fonts& fonts, const ThemeColours& theme, Size size,
             const View& view, const Legends& legends, const OverlayText& text, bool whole) {
  // A box of spheres may be turned: a square stands for it.
  const Faces faces =
      snapshot.box.size() == 2 ? outermost_faces(snapshot) : Faces{Vec2(0.0, 0.0), Vec2(1.0, 1.0)};
  auto shown_width = [&](const Page& page) {
    return Camera::fit(faces.low, faces.high, size, page.margins).width;
  };
  const Page rows = arrange(Arrangement::Rows, fonts, theme, size, view, legends, text);
  Page column = arrange(Arrangement::Column, fonts, theme, size, view, legends, text);
  if (!(shown_width(column) < shown_width(rows))) return rows;
  // Texts do not move with the camera of a film, nor with spheres that turn.
  if (whole && snapshot.box.size() == 2 && view.camera.empty()) gather(column, faces);
  return column;
}

// printf rather than libfmt, which formats 213 with "#.3g" as 213.0.
std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

ImU32 with_opacity(Colour colour, double opacity) {
  colour.alpha = static_cast<std::uint8_t>(std::lround(255.0 * opacity));
  return packed(colour);
}

// Whether the box, enlarged by the camera or repeated, extends below this area.
bool over_box(ImVec2 low, ImVec2 high, const Page& page) {
  return low.x < page.box_high.x && high.x > page.box_low.x && low.y < page.box_high.y &&
         high.y > page.box_low.y;
}

// Keeps a text over the box legible. `opacity` is that of the text.
void draw_plate(ImDrawList& list, ImVec2 low, ImVec2 high, const Page& page, double opacity = 1.0) {
  constexpr double kOpacity = 0.8;
  const float room = std::round(kPlate * page.fonts.unit());
  const ImVec2 from(low.x - room, low.y - room), to(high.x + room, high.y + room);
  if (!over_box(from, to, page)) return;
  list.AddRectFilled(from, to, with_opacity(page.theme.background, opacity * kOpacity), room);
}

void draw_heading(ImDrawList& list, const OverlayText& text, const Page& page) {
  const ImVec2 title = text_extent(page.fonts.title, text.title, page.wrap);
  const ImVec2 caption = text_extent(page.fonts.text, text.caption, page.wrap);
  if (!text.title.empty() || !text.caption.empty()) {
    const float end = text.caption.empty() ? page.edge + title.y : page.caption + caption.y;
    draw_plate(list, ImVec2(page.left, page.edge),
               ImVec2(page.left + std::max(title.x, caption.x), end), page);
  }
  draw_text(list, page.fonts.title, ImVec2(page.left, page.edge), page.theme.ink(), text.title,
            page.wrap);
  draw_text(list, page.fonts.text, ImVec2(page.left, page.caption), page.theme.faint_ink(),
            text.caption, page.wrap);
}

// Scale bar with its label above. `place` is its lower left corner, `length` in units a, `pixels`
// its length in pixels.
void draw_scale_bar(ImDrawList& list, ImVec2 place, double length, float pixels, const Page& page) {
  const Fonts& fonts = page.fonts;
  const ThemeColours& theme = page.theme;
  const float line = std::max(1.0f, std::round(fonts.unit() / 12.0f));
  const float cap = std::round(0.3f * fonts.unit()), right = std::round(place.x + pixels);
  const ImU32 colour = packed(theme.faint_text);
  const std::string label = formatted("%g a", length);
  const ImVec2 extent = text_extent(fonts.small, label);
  const float left = std::max(place.x, std::round(0.5f * (place.x + right - extent.x)));
  draw_plate(list, ImVec2(place.x, place.y - cap - extent.y),
             ImVec2(std::max(right, left + extent.x), place.y), page);
  list.AddRectFilled(ImVec2(place.x, place.y - line), ImVec2(right, place.y), colour);
  list.AddRectFilled(ImVec2(place.x, place.y - cap), ImVec2(place.x + line, place.y), colour);
  list.AddRectFilled(ImVec2(right - line, place.y - cap), ImVec2(right, place.y), colour);
  draw_text(list, fonts.small, ImVec2(left, place.y - cap - extent.y), theme.faint_ink(), label);
}

struct Figure {
  std::string text;
  std::string widest;  // reserved width, so that the next figure does not move with every digit
  Ink ink;
};

std::vector<Figure> figures_of(const Snapshot& snapshot, const View& view,
                               const ThemeColours& theme) {
  std::vector<Figure> figures;
  const auto add = [&](OverlayPart part, const Figure& figure) {
    if (!view.hides(part)) figures.push_back(figure);
  };
  add(OverlayPart::Time, {formatted("t = %.2f", snapshot.time), "t = 0000.00", theme.ink()});
  add(OverlayPart::Temperature, {typeset_number(formatted("T = %#.3g", snapshot.temperature)),
                                 "T = 0.0000", theme.faint_ink()});
  add(OverlayPart::Collisions,
      {grouped_digits(snapshot.collisions) + " collisions", "", theme.faint_ink()});
  return figures;
}

// The sides of the box with each kind of wall: "left, right: driven".
std::vector<std::string> wall_lines(const Snapshot& snapshot, const View& view) {
  std::vector<std::pair<std::string, std::string>> kinds;  // with their sides
  if (view.hides(OverlayPart::Walls)) return {};
  for (std::size_t side = 0; side < snapshot.walls.size(); ++side) {
    const auto& wall = snapshot.walls[side];
    if (!wall) continue;
    std::string kind(name_of(wall->kind, kWallKinds));
    if (wall->kind == WallKind::Thermal) {
      kind += ", " + typeset_number(formatted("T = %.3g", wall->temperature));
    }
    const std::string name(kSideNames[side]);
    const auto known = std::ranges::find(kinds, kind, &decltype(kinds)::value_type::first);
    if (known == kinds.end()) {
      kinds.emplace_back(kind, name);
    } else {
      known->second += ", " + name;
    }
  }
  std::vector<std::string> lines;
  for (const auto& [kind, sides] : kinds) lines.push_back(sides + ": " + kind);
  return lines;
}

// Figures in a row from the lower left corner, as far as they fit, and the scale bar at its end.
void draw_row(ImDrawList& list, const Snapshot& snapshot, const Projection& projection,
              const View& view, const Page& page) {
  const float unit = page.fonts.unit(), bottom = page.size.height - page.edge;
  const double length = scale_length(projection);
  const auto pixels = static_cast<float>(length * projection.scale());
  const float right = std::round(page.size.width - page.edge - std::max(pixels, 2.0f * unit));
  if (!view.hides(OverlayPart::ScaleBar)) {
    draw_scale_bar(list, ImVec2(right, bottom), length, pixels, page);
  }

  std::vector<Figure> figures = figures_of(snapshot, view, page.theme);
  for (const std::string& line : wall_lines(snapshot, view)) {
    figures.push_back({line, "", page.theme.faint_ink()});
  }
  float x = page.left;
  for (const Figure& figure : figures) {
    const float width = text_extent(page.fonts.text, figure.text).x;
    if (x + width > right - unit) return;
    draw_plate(list, ImVec2(x, bottom - unit), ImVec2(x + width, bottom), page);
    draw_text(list, page.fonts.text, ImVec2(x, bottom - unit), figure.ink, figure.text);
    const float widest = text_extent(page.fonts.text, figure.widest).x;
    x += std::round(std::max(width, widest) + 1.5f * unit);
  }
}

// Figures in a column in the lower left corner, and above them the scale bar and the kinds of
// walls, as far as they fit below the heading.
void draw_column(ImDrawList& list, const Snapshot& snapshot, const Projection& projection,
                 const View& view, const Page& page) {
  const float unit = page.fonts.unit(), line = std::round(1.5f * unit);
  const float room = static_cast<float>(page.size.height) - page.edge - page.heading;
  const auto all = figures_of(snapshot, view, page.theme);
  const auto fitting = static_cast<std::size_t>(std::max(0.0f, (room + 0.5f * unit) / line));
  const std::span<const Figure> figures(all.data(), std::min(fitting, all.size()));
  float y = page.size.height - page.edge - std::round(1.5f * unit * figures.size() - 0.5f * unit);
  float end = y - 1.5f * unit;  // of the room above the figures
  if (!view.hides(OverlayPart::ScaleBar) && end - 1.5f * unit > page.heading) {
    const double length = scale_length(projection);
    draw_scale_bar(list, ImVec2(page.left, end), length,
                   static_cast<float>(length * projection.scale()), page);
    end -= 3.0f * unit;
  }
  const std::vector<std::string> walls = wall_lines(snapshot, view);
  float top = end - static_cast<float>(walls.size()) * line + 0.5f * unit;
  if (top - unit > page.heading) {
    for (const std::string& text : walls) {
      const float width = text_extent(page.fonts.text, text).x;
      draw_plate(list, ImVec2(page.left, top), ImVec2(page.left + width, top + unit), page);
      draw_text(list, page.fonts.text, ImVec2(page.left, top), page.theme.faint_ink(), text);
      top += line;
    }
  }
  if (figures.empty()) return;
  float width = 0.0f;
  for (const Figure& figure : figures) {
    width = std::max(width, text_extent(page.fonts.text, figure.text).x);
  }
  draw_plate(list, ImVec2(page.left, y), ImVec2(page.left + width, page.size.height - page.edge),
             page);
  for (const Figure& figure : figures) {
    draw_text(list, page.fonts.text, ImVec2(page.left, y), figure.ink, figure.text);
    y += line;
  }
}

// The smallest rectangle around the box on the picture, in pixels from the lower left corner.
Faces box_area(const Snapshot& snapshot, const Projection& projection) {
  if (snapshot.box.size() == 2) {
    const Faces faces = outermost_faces(snapshot);
    return {projection.pixels(faces.low), projection.pixels(faces.high)};
  }
  const Eye eye(projection);
  Faces area{Vec2::Constant(HUGE_VAL), Vec2::Constant(-HUGE_VAL)};
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner = snapshot.box.cwiseProduct(Vec3(k & 1, k >> 1 & 1, k >> 2));
    const Vec3 seen = eye.seen(corner);
    // A corner behind the viewer: the box surrounds the picture.
    if (eye.w(seen) <= 0.0)
      return {Vec2::Zero(), Vec2(projection.size.width, projection.size.height)};
    area.low = area.low.cwiseMin(eye.pixels(seen));
    area.high = area.high.cwiseMax(eye.pixels(seen));
  }
  return area;
}

// Whether the width of the box is inside the margins, up to rounding.
bool is_inside(const Faces& box, const Page& page) {
  constexpr double kRounding = 1.0;  // pixel
  return box.low.x() > page.margins.left - kRounding &&
         box.high.x() < page.size.width - page.margins.right + kRounding;
}

// The area beside which legends are. A box of spheres may turn: it has the area inside the margins.
Faces legend_area(const Faces& box, const Snapshot& snapshot, const Page& page) {
  if (snapshot.box.size() == 2) return box;
  return {Vec2(page.margins.left, page.margins.bottom),
          Vec2(page.size.width - page.margins.right, page.size.height - page.margins.top)};
}

// Legends in a column at the right of the box, or at the edge of the picture if the box ends
// beyond.
void draw_legends(ImDrawList& list, const Legends& legends, const Faces& area,
                  const Projection& projection, const Page& page) {
  const float unit = page.fonts.unit();
  const double height = projection.size.height;
  const auto [low, high] = area;
  const double top = std::max(page.margins.top, height - high.y());
  const double bottom = std::min(height - page.margins.bottom, height - low.y());
  const double right = std::min(high.x(), projection.size.width - page.margins.right);
  const float x = static_cast<float>(std::round(right + wall_thickness(projection.size) + unit));

  const float gap = 1.5f * unit, least = 6.0f * unit;
  const float arrows = legends.arrows ? arrow_legend_height(page.fonts) + gap : 0.0f;
  const auto lowest = static_cast<float>(height - page.margins.bottom);
  const auto height_of_page = lowest - static_cast<float>(page.margins.top);
  std::optional<SpeciesLegend> species = legends.species;
  if (species) species = fitting(std::move(*species), page.fonts, height_of_page - arrows);
  const float fixed = arrows + (species ? species_legend_height(*species, page.fonts) + gap : 0.0f);
  const float page_room = height_of_page + gap - fixed;
  std::vector<Legend> bars = legends.bars();
  // A small picture drops legends from the last; the first one stays.
  while (bars.size() > (species ? 0u : 1u) && bars.size() * (least + gap) > page_room)
    bars.pop_back();
  const auto count = static_cast<float>(bars.size());
  const float room = (static_cast<float>(bottom - top) + gap - fixed) / count - gap;
  const float each = std::clamp(room, least, 18.0f * unit);
  // Legends taller than the box are centred on it, within the margins of the page.
  const float all = count * (each + gap) - gap + fixed;
  const double middle = top + 0.5 * std::min(0.0, bottom - top - all);
  auto y = static_cast<float>(
      std::round(std::max<double>(page.margins.top, std::min<double>(middle, lowest - all))));
  const float column = legend_width(legends, page.fonts);
  if (column > 0.0f) draw_plate(list, ImVec2(x, y), ImVec2(x + column, y + all), page);
  if (species) {
    draw_species_legend(list, *species, page.fonts, page.theme, ImVec2(x, y));
    y = std::round(y + species_legend_height(*species, page.fonts) + gap);
  }
  for (const Legend& legend : bars) {
    // Over the box, a translucent scale has the colours that it has on the background.
    const auto [from, to] = legend_bar(page.fonts, ImVec2(x, y), each);
    if (over_box(from, to, page)) list.AddRectFilled(from, to, packed(page.theme.background));
    draw_legend(list, legend, page.fonts, page.theme, ImVec2(x, y), each);
    y = std::round(y + each + gap);
  }
  if (legends.arrows) {
    draw_arrow_legend(list, *legends.arrows, page.fonts, page.theme,
                      ArrowShape::in(projection.size), ImVec2(x, y));
  }
}

// The captions of this time, below each other over the lower part of the gas.
void draw_captions(ImDrawList& list, const std::vector<Caption>& all, double time, double speed,
                   const Page& page) {
  struct Shown {
    std::vector<MarkedLine> lines;
    double opacity;
  };
  const auto width = static_cast<float>(page.size.width - page.margins.left - page.margins.right);
  const float gap = std::round(1.5f * page.fonts.unit());
  std::vector<Shown> captions;
  float height = 0.0f;
  for (const Caption& caption : all) {
    const double opacity = caption_opacity(caption, time, speed);
    if (opacity == 0.0) continue;
    captions.push_back(
        {marked_lines(caption.text, page.fonts.title, page.fonts.text, 0.9f * width), opacity});
    for (const MarkedLine& line : captions.back().lines) height += line.height;
    height += gap;
  }
  auto y = static_cast<float>(std::round(page.size.height - page.margins.bottom - height));
  const float middle = static_cast<float>(page.margins.left) + 0.5f * width;
  for (const auto& [lines, opacity] : captions) {
    float half = 0.0f, end = y;
    for (const MarkedLine& line : lines) {
      half = std::max(half, 0.5f * line.width);
      end += line.height;
    }
    draw_plate(list, ImVec2(middle - half, y), ImVec2(middle + half, end), page, opacity);
    Ink ink = page.theme.ink();
    ink.colour.alpha = static_cast<std::uint8_t>(std::lround(255.0 * opacity));
    for (const MarkedLine& line : lines) {
      draw_marked(list, line, ImVec2(std::round(middle - 0.5f * line.width), y), ink);
      y += line.height;
    }
    y += gap;
  }
}

// A line of text in the middle of the picture, with its upper edge at `y`.
void draw_centred(ImDrawList& list, const Font& font, float y, ImU32 colour,
                  const std::string& line, const Page& page) {
  const float x = std::round(0.5f * (page.size.width - text_extent(font, line).x));
  list.AddText(font.face, font.size, ImVec2(x, y), colour, line.c_str());
}

// A text broken between words into lines of at most `width` pixels.
std::vector<std::string> lines_of(const std::string& text, const Font& font, float width) {
  return broken_lines(text,
                      [&](const std::string& line) { return text_extent(font, line).x <= width; });
}

// Title card: title and caption in the middle, over the whole picture.
void draw_card(ImDrawList& list, const OverlayText& text, const Page& page) {
  const float unit = page.fonts.unit(), width = 0.8f * page.size.width;
  const auto titles = lines_of(text.title, page.fonts.card, width);
  const auto captions = lines_of(text.caption, page.fonts.title, width);
  const float title_line = 1.2f * page.fonts.card.size;
  const float caption_line = 1.3f * page.fonts.title.size;
  const float height = titles.size() * title_line + unit + captions.size() * caption_line;
  float y = std::round(0.5f * (page.size.height - height));
  list.AddRectFilled(ImVec2(0.0f, 0.0f), ImVec2(page.size.width, page.size.height),
                     with_opacity(page.theme.background, text.card));
  for (const std::string& line : titles) {
    draw_centred(list, page.fonts.card, y, with_opacity(page.theme.text, text.card), line, page);
    y += std::round(title_line);
  }
  y += std::round(unit);
  for (const std::string& line : captions) {
    draw_centred(list, page.fonts.title, y, with_opacity(page.theme.faint_text, text.card), line,
                 page);
    y += std::round(caption_line);
  }
}

}  // namespace

constexpr double kFade = 0.5;  // time in which a text appears or disappears, seconds

double card_opacity(double length, double time) {
  return std::clamp((length - time) / std::min(kFade, length), 0.0, 1.0);
}

double caption_opacity(const Caption& caption, double time, double speed) {
  double fade = kFade * speed;
  if (caption.to) fade = std::min(fade, (*caption.to - caption.from.value_or(0.0)) / 3.0);
  double opacity = 1.0;
  if (caption.from) opacity = std::min(opacity, (time - *caption.from) / fade);
  if (caption.to) opacity = std::min(opacity, (*caption.to - time) / fade);
  return std::max(opacity, 0.0);
}

Overlay::Overlay(const Gl& gl) : gui_(gl), context_(make_gui_context()) {}

const Fonts& Overlay::fonts_for(Size size, const OverlayText& text) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  const float unit = unit_for(size, text);
  const std::string& title = text.card > 0.0 ? text.title : loaded_title_;
  if (unit == fonts_.unit() && title == loaded_title_) return fonts_;
  atlas.Clear();
  loaded_title_ = title;
  fonts_ = add_fonts(atlas, unit, loaded_title_);
  gui_.upload(atlas);
  return fonts_;
}

Margins Overlay::margins(const Snapshot& snapshot, Size size, const View& view,
                         const Legends& legends, const OverlayText& text) {
  const CurrentContext current(context_.get());
  return arrange(snapshot, fonts_for(size, text), kDarkTheme, size, view,
                 shown_legends(legends, view), shown_text(text, view), true)
      .margins;
}

void Overlay::draw(const Snapshot& snapshot, const Projection& projection, const View& view,
                   const Legends& all_legends, const OverlayText& text) {
  const CurrentContext current(context_.get());
  const ThemeColours theme = theme_of(view);
  const Size size = projection.size;
  const Legends legends = shown_legends(all_legends, view);
  const OverlayText shown = shown_text(text, view);
  const Faces box = box_area(snapshot, projection);
  const Fonts& fonts = fonts_for(size, text);
  Page page = arrange(snapshot, fonts, theme, size, view, legends, shown, true);
  if (!is_inside(box, page)) {
    page = arrange(snapshot, fonts, theme, size, view, legends, shown, false);
  }
  const Tiling tiling = tiling_of(snapshot, projection, view);
  const Vec2 length = projection.scale() * snapshot.box.head<2>();
  const Vec2 low = box.low + length.cwiseProduct(Vec2(tiling.first[0], tiling.first[1]));
  const Vec2 high = box.high + length.cwiseProduct(Vec2(tiling.last[0], tiling.last[1]));
  const float wall = static_cast<float>(wall_thickness(size));
  page.box_low =
      ImVec2(static_cast<float>(low.x()) - wall, static_cast<float>(size.height - high.y()) - wall);
  page.box_high =
      ImVec2(static_cast<float>(high.x()) + wall, static_cast<float>(size.height - low.y()) + wall);
  ImGui::GetIO().DisplaySize = ImVec2(size.width, size.height);
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  draw_heading(list, shown, page);
  draw_legends(list, legends, legend_area(box, snapshot, page), projection, page);
  switch (page.arrangement) {
    case Arrangement::Rows:
      draw_row(list, snapshot, projection, view, page);
      break;
    case Arrangement::Column:
      draw_column(list, snapshot, projection, view, page);
      break;
  }
  if (!view.hides(OverlayPart::Captions)) {
    draw_captions(list, view.captions, snapshot.time, text.speed, page);
  }
  if (text.card > 0.0) draw_card(list, text, page);
  ImGui::Render();
  gui_.draw(*ImGui::GetDrawData());
}

}  // namespace clatter
