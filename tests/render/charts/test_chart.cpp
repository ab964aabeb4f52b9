#include <doctest/doctest.h>

#include <map>
#include <set>
#include <sstream>

#include "render/charts/chart.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Size kChartSize{1200, 900};
constexpr Colour kBlue{0x00, 0x72, 0xb2}, kVermilion{0xd5, 0x5e, 0x00};

// An element of an SVG file.
struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  // until the next tag, with its entities

  double number(const std::string& attribute) const { return std::stod(attributes.at(attribute)); }
  // The points of a polyline or polygon.
  std::vector<Vec2> points() const {
    std::vector<Vec2> points;
    std::istringstream words(attributes.at("points"));
    for (std::string word; words >> word;) {
      const std::size_t comma = word.find(',');
      points.emplace_back(std::stod(word.substr(0, comma)), std::stod(word.substr(comma + 1)));
    }
    return points;
  }
};

// Whether each & of a text begins an entity of XML.
bool has_only_entities(const std::string& text) {
  for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
    const std::string entity = text.substr(at, text.find(';', at) - at);
    if (!std::set<std::string>{"&amp", "&lt", "&gt", "&quot"}.contains(entity)) return false;
  }
  return true;
}

// The elements of an SVG file, which must be well-formed XML.
std::vector<Element> elements_of(const std::string& svg) {
  std::vector<Element> elements;
  std::vector<std::string> open;
  const std::size_t prolog = svg.find("?>");
  REQUIRE(svg.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>"));
  for (std::size_t at = svg.find('<', prolog); at != std::string::npos;) {
    const std::size_t end = svg.find('>', at), next = svg.find('<', at + 1);
    REQUIRE(end < next);
    std::string tag = svg.substr(at + 1, end - at - 1);
    const std::string text = svg.substr(end + 1, next == std::string::npos ? next : next - end - 1);
    REQUIRE(has_only_entities(text));
    at = next;
    if (tag.starts_with("/")) {
      REQUIRE(!open.empty());
      REQUIRE(open.back() == tag.substr(1));
      open.pop_back();
      continue;
    }
    const bool closed = tag.ends_with("/");
    if (closed) tag.pop_back();
    Element element{tag.substr(0, tag.find(' ')), {}, text};
    for (std::size_t k = tag.find(' '); k < tag.size();) {
      const std::size_t equal = tag.find("=\"", k), quote = tag.find('"', equal + 2);
      REQUIRE(quote != std::string::npos);
      const std::string name = tag.substr(k + 1, equal - k - 1);
      const std::string value = tag.substr(equal + 2, quote - equal - 2);
      REQUIRE(has_only_entities(value));
      REQUIRE(element.attributes.emplace(name, value).second);
      k = quote + 1;
    }
    if (!closed) open.push_back(element.name);
    elements.push_back(std::move(element));
  }
  REQUIRE(open.empty());
  return elements;
}

std::vector<Element> named(const std::vector<Element>& elements, const std::string& name) {
  std::vector<Element> found;
  for (const Element& element : elements) {
    if (element.name == name) found.push_back(element);
  }
  return found;
}

std::vector<Element> drawn(const Chart& chart) {
  return elements_of(chart_svg(chart, kChartSize));
}

Element text_of(const std::vector<Element>& elements, const std::string& text) {
  for (const Element& element : elements) {
    if (element.name == "text" && element.text == text) return element;
  }
  FAIL("no text ", text);
  return {};
}

// The pixel of a value between two numbers at the ticks of an axis.
double pixel_at(const std::vector<Element>& elements, const std::string& axis, double share,
                const std::string& first, const std::string& second) {
  const double a = text_of(elements, first).number(axis);
  return a + share * (text_of(elements, second).number(axis) - a);
}

// The lines of a colour along y, as upper and lower ends. Ticks are black.
std::vector<std::array<double, 2>> bars(const std::vector<Element>& elements) {
  std::vector<std::array<double, 2>> found;
  for (const Element& line : named(elements, "polyline")) {
    const auto points = line.points();
    if (line.attributes.at("stroke") == "#000000" || points[0].x() != points[1].x()) continue;
    found.push_back(
        {std::min(points[0].y(), points[1].y()), std::max(points[0].y(), points[1].y())});
  }
  return found;
}

// The upper left and lower right corner of the frame.
std::array<Vec2, 2> frame(const std::vector<Element>& elements) {
  for (const Element& polygon : named(elements, "polygon")) {
    if (polygon.attributes.at("fill") != "none") continue;
    const auto points = polygon.points();
    return {points[0], points[2]};
  }
  FAIL("no frame");
  return {};
}

Chart chart_of(std::vector<ChartPoint> points, bool logarithmic = false) {
  return {"", "", {"x", logarithmic}, {"y", logarithmic}, {{"", std::move(points)}}, {}};
}

}  // namespace

TEST_CASE("Chart: points of a linear chart are where its numbers say") {
  const auto elements = drawn(chart_of({{0.0, 10.0}, {0.73, 47.0}, {1.0, 50.0}}));
  const auto circles = named(elements, "circle");
  REQUIRE(circles.size() == 3);
  // The numbers along y are half a capital below the middle of their ticks: only differences count.
  CHECK(circles[1].number("cx") ==
        doctest::Approx(pixel_at(elements, "x", 0.73, "0.0", "1.0")).epsilon(1e-5));
  const double middle =
      pixel_at(elements, "y", 0.5, "10", "50") - pixel_at(elements, "y", 0.0, "10", "50");
  CHECK(circles[1].number("cy") - circles[0].number("cy") ==
        doctest::Approx(2.0 * middle * 37.0 / 40.0).epsilon(1e-4));
  CHECK(circles[0].number("cy") > circles[1].number("cy"));
  const auto [low, high] = frame(elements);
  CHECK(text_of(elements, "10").number("y") ==
        doctest::Approx(circles[0].number("cy")).epsilon(0.02));
  CHECK(low.x() < circles[0].number("cx"));
  CHECK(high.x() > circles[2].number("cx"));
}

TEST_CASE("Chart: points of a logarithmic chart are where its numbers say") {
  const auto elements = drawn(chart_of({{0.01, 1e-4}, {0.5, 0.003}, {10.0, 0.1}}, true));
  const auto circles = named(elements, "circle");
  REQUIRE(circles.size() == 3);
  const double x = (std::log10(0.5) + 2.0) / 3.0, y = (std::log10(0.003) + 4.0) / 3.0;
  CHECK(circles[1].number("cx") ==
        doctest::Approx(pixel_at(elements, "x", x, "0.01", "10")).epsilon(1e-5));
  CHECK(circles[1].number("cy") - circles[0].number("cy") ==
        doctest::Approx(pixel_at(elements, "y", y, "10⁻⁴", "10⁻¹") -
                        text_of(elements, "10⁻⁴").number("y"))
            .epsilon(1e-4));
}

TEST_CASE("Chart: an error bar is an error long on both sides, and none without a finite error") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto elements = drawn(
      chart_of({{0.0, 0.0}, {0.5, 5.0, 1.5}, {0.8, 7.0, none}, {0.9, 7.0, -1.0}, {1.0, 10.0}}));
  const auto found = bars(elements);
  REQUIRE(found.size() == 1);
  const double unit =
      0.1 * (text_of(elements, "0").number("y") - text_of(elements, "10").number("y"));
  const double y = named(elements, "circle")[1].number("cy");
  CHECK(y - found[0][0] == doctest::Approx(1.5 * unit).epsilon(1e-3));
  CHECK(found[0][1] - y == doctest::Approx(1.5 * unit).epsilon(1e-3));
}

TEST_CASE("Chart: an error bar beyond zero ends at the frame of a logarithmic chart") {
  const auto elements = drawn(chart_of({{1.0, 1.0, 2.0}, {10.0, 100.0, 50.0}}, true));
  const auto found = bars(elements);
  REQUIRE(found.size() == 2);
  const auto [low, high] = frame(elements);
  CHECK(found[0][1] == doctest::Approx(high.y()));
  CHECK(found[0][0] > low.y());
  CHECK(found[1][1] < high.y());
  // Ends within the frame have a cap: one of the first bar and two of the second.
  int caps = 0;
  for (const Element& line : named(elements, "polyline")) {
    const auto points = line.points();
    caps += line.attributes.at("stroke") != "#000000" && points[0].y() == points[1].y();
  }
  CHECK(caps == 3);
}

TEST_CASE("Chart: points that an axis cannot show are omitted") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  const std::vector<ChartPoint> points = {{1.0, 2.0},  {2.0, 3.0},     {0.0, 1.0},     {1.0, 0.0},
                                          {-1.0, 1.0}, {1.0, -1.0},    {none, 1.0},    {1.0, none},
                                          {3.0, 1.0},  {endless, 1.0}, {1.0, -endless}};
  for (const bool logarithmic : {false, true}) {
    Chart chart = chart_of(points, logarithmic);
    chart.lines.push_back({"line", {{0.0, 1.0}, {1.0, none}, {1.0, 1.0}, {2.0, 2.0}}});
    const std::string svg = chart_svg(chart, kChartSize);
    CHECK(named(elements_of(svg), "circle").size() == (logarithmic ? 3 : 7));
    for (const char* word : {"nan", "inf"}) CHECK(svg.find(word) == std::string::npos);
  }
}

TEST_CASE("Chart: texts of a chart are escaped, and wrapped at its width") {
  Chart chart = chart_of({{0.0, 0.0}, {1.0, 1.0}});
  chart.title = "<b>&\"";
  const std::string long_word(200, '.');
  chart.caption = long_word;
  chart.caption += " end\x01";
  for (int k = 0; k < 40; ++k) chart.caption += " word";
  chart.x.label = "a < b";
  chart.y.label = "\"n\" > 0";
  const auto elements = drawn(chart);
  text_of(elements, "&lt;b&gt;&amp;&quot;");
  text_of(elements, "a &lt; b");
  CHECK(text_of(elements, "&quot;n&quot; &gt; 0")
            .attributes.at("transform")
            .starts_with("rotate(-90"));
  text_of(elements, long_word);
  const auto texts = named(elements, "text");
  std::set<double> rows;
  for (const Element& text : texts) {
    if (text.text.find("word") == std::string::npos) continue;
    rows.insert(text.number("y"));
    CHECK(text.text.size() < 100);
    CHECK(text.number("y") < kChartSize.height);
  }
  CHECK(rows.size() > 1);
}

TEST_CASE("Chart: the legend has the names, each line style once, and covers no point") {
  Chart chart = chart_of({{0.0, 0.0}, {1.0, 1.0}});
  chart.series[0].name = "first";
  chart.series.push_back({"second", {{0.5, 0.4, 0.1}}});
  for (std::size_t k : {0, 1}) {
    chart.lines.push_back({"theory", {{0.0, 0.0}, {1.0, 0.9 + 0.1 * k}}, LineStyle::Dashed, k});
  }
  chart.lines.push_back({"", {{0.0, 0.1}, {1.0, 1.0}}, LineStyle::Dotted});
  const auto count = [](const std::vector<Element>& elements, const std::string& text) {
    return std::ranges::count_if(elements, [&](const Element& e) { return e.text == text; });
  };
  const auto free = drawn(chart);
  for (const char* name : {"first", "second", "theory"}) CHECK(count(free, name) == 1);
  // The upper left corner is free.
  const auto [low, high] = frame(free);
  const Element inside = text_of(free, "theory");
  CHECK(inside.number("x") < 0.5 * (low.x() + high.x()));
  CHECK(inside.number("y") < 0.5 * (low.y() + high.y()));
  // Points all over the frame move the legend beside it.
  for (int k = 0; k < 100; ++k)
    chart.series[1].points.push_back({0.1 * (k % 10), 0.1 * (k / 10), 0.0});
  const auto full = drawn(chart);
  const double right = frame(full)[1].x();
  CHECK(right < high.x());
  for (const char* name : {"first", "second", "theory"}) {
    CHECK(text_of(full, name).number("x") > right);
    CHECK(text_of(full, name).number("x") < kChartSize.width);
  }
}

TEST_CASE("Chart: lines have their dashes and the colours of their series, and end at the frame") {
  Chart chart = chart_of({{0.0, 0.0}, {1.0, 1.0}});
  chart.lines.push_back(
      {"", {{-9.0, -1e8}, {0.5, 0.5}, {0.6, 0.6}, {9.0, 1e8}}, LineStyle::Solid, 0});
  chart.lines.push_back({"", {{-9.0, 0.5}, {9.0, 0.5}}, LineStyle::Dashed});
  chart.lines.push_back({"", {{0.5, -9.0}, {0.5, 9.0}}, LineStyle::Dotted, 7});
  const auto elements = drawn(chart);
  const auto [low, high] = frame(elements);
  const auto lines = named(elements, "polyline");
  REQUIRE(lines.size() > 3);
  CHECK(lines[0].points().size() == 4);
  for (int k : {0, 1, 2}) {
    for (const Vec2& point : lines[k].points()) {
      CHECK(point.x() >= low.x() - 0.01);
      CHECK(point.x() <= high.x() + 0.01);
      CHECK(point.y() >= low.y() - 0.01);
      CHECK(point.y() <= high.y() + 0.01);
    }
  }
  CHECK(lines[1].points()[0].x() == doctest::Approx(low.x()));
  CHECK(lines[2].points()[1].y() == doctest::Approx(low.y()));
  CHECK_FALSE(lines[0].attributes.contains("stroke-dasharray"));
  CHECK(lines[1].attributes.at("stroke-dasharray") != lines[2].attributes.at("stroke-dasharray"));
  CHECK(lines[0].attributes.at("stroke") != lines[1].attributes.at("stroke"));
  // A line of a series that does not exist belongs to none.
  CHECK(lines[1].attributes.at("stroke") == lines[2].attributes.at("stroke"));
}

TEST_CASE("Chart: the markers of sixteen series differ in their shape or filling") {
  Chart chart = chart_of({});
  for (int k = 0; k < 15; ++k) chart.series.push_back({"", {}});
  for (ChartSeries& series : chart.series) series.points = {{1.0, 1.0}};
  std::set<std::string> seen;
  for (const Element& element : drawn(chart)) {
    if (element.name != "circle" && element.name != "polygon") continue;
    const bool hollow = element.attributes.at("fill") == "#ffffff";
    const bool circle = element.name == "circle";
    seen.insert((hollow ? "hollow " : "") + (circle ? "circle" : element.attributes.at("points")));
  }
  CHECK(seen.size() == 16 + 1);  // and the frame
}

TEST_CASE("Chart: a chart without points is an empty frame, also in a tiny picture") {
  for (const bool logarithmic : {false, true}) {
    for (const Size size : {kChartSize, Size{1, 1}, Size{30, 400}}) {
      Chart chart = chart_of({}, logarithmic);
      chart.title = "title";
      const std::string svg = chart_svg(chart, size);
      const auto elements = elements_of(svg);
      CHECK(named(elements, "polygon").size() == 1);
      CHECK(named(elements, "polyline").empty());
      for (const char* word : {"nan", "inf"}) CHECK(svg.find(word) == std::string::npos);
      chart.series[0].points = {{1.0, 1.0, 0.5}};
      CHECK(named(elements_of(chart_svg(chart, size)), "circle").size() == 1);
    }
  }
}

TEST_CASE("Chart: the picture has the markers, dashes and texts of the file") {
  const auto context = open_context(Backend::Auto);
  const Gl& gl = context->gl();
  Chart chart = chart_of({{0.0, 0.0}, {0.3, 0.8, 0.1}, {1.0, 1.0}});
  chart.series.push_back({"", {{0.8, 0.2}}});
  chart.lines.push_back({"", {{-1.0, 0.5}, {2.0, 0.5}}, LineStyle::Dashed});
  chart.x.label = "xxxxxxxx";
  const auto elements = drawn(chart);
  const Image image = chart_image(gl, chart, kChartSize);
  CHECK(image.size == kChartSize);
  CHECK(pixel(image, 2, 2) == Colour{255, 255, 255});
  const auto seen = [&](Vec2 place) {
    return pixel(image, static_cast<int>(place.x()), static_cast<int>(place.y()));
  };
  const auto circles = named(elements, "circle");
  REQUIRE(circles.size() == 3);
  for (const Element& circle : circles) {
    CHECK(seen({circle.number("cx"), circle.number("cy")}) == kBlue);
  }
  for (const Element& polygon : named(elements, "polygon")) {
    if (polygon.attributes.at("fill") != "#d55e00") continue;
    const auto corners = polygon.points();
    CHECK(seen(0.5 * (corners[0] + corners[2])) == kVermilion);
  }
  // Dashes are 5/8 of the line.
  const Element line = named(elements, "polyline")[0];
  const auto ends = line.points();
  int dark = 0, changes = 0;
  bool was_dark = true;
  for (double x = ends[0].x() + 2.0; x < ends[1].x() - 2.0; ++x) {
    const bool is_dark = seen({x, ends[0].y()}).red < 170;
    dark += is_dark;
    changes += is_dark != was_dark;
    was_dark = is_dark;
  }
  const double length = ends[1].x() - ends[0].x();
  CHECK(dark / length == doctest::Approx(5.0 / 8.0).epsilon(0.05));
  CHECK(changes ==
        doctest::Approx(2.0 * length / (8.0 * line.number("stroke-width"))).epsilon(0.05));
  // The label of x is in the middle of its place, with nothing below it.
  const auto ink_between = [&](double x0, double x1, double y0, double y1) {
    int count = 0;
    for (double y = y0; y < y1; ++y) {
      for (double x = x0; x < x1; ++x) count += seen({x, y}).red < 128;
    }
    return count;
  };
  const Element label = text_of(elements, chart.x.label);
  const double x = label.number("x"), y = label.number("y"), em = label.number("font-size");
  const int before = ink_between(x - 3.0 * em, x, y - 0.6 * em, y + 1.0);
  CHECK(before > 0.2 * em * em);
  CHECK(ink_between(x, x + 3.0 * em, y - 0.6 * em, y + 1.0) ==
        doctest::Approx(before).epsilon(0.1));
  CHECK(ink_between(0.0, kChartSize.width, y + 2.0, kChartSize.height) == 0);
  // The label of y is turned: its descender is to the right of its baseline.
  const Element turned = text_of(elements, "y");
  const double right = turned.number("x"), middle = turned.number("y");
  CHECK(ink_between(right + 1.0, right + 0.3 * em, middle - 0.5 * em, middle + 0.5 * em) > 0);
  CHECK(ink_between(right - 0.6 * em, right, middle - 0.4 * em, middle + 0.4 * em) >
        0.05 * em * em);
}

}  // namespace clatter
