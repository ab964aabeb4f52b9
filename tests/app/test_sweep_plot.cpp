#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "app/sweep/sweep_plot.h"
#include "tests/support/shell.h"

namespace clatter {

using testing::refusal_of;

namespace {

using Json = nlohmann::ordered_json;

SweepTable table_of(const std::vector<Json>& rows) {
  SweepTable table;
  for (const auto& [name, value] : rows.front().items()) table.columns.push_back(name);
  table.rows = rows;
  table.points.resize(rows.size());
  table.profiles.resize(rows.size());
  return table;
}

// A point of two axes with a temperature.
Json point(double restitution, int count, double temperature) {
  return {{"particles.restitution", restitution},
          {"particles.count", count},
          {"temperature", temperature},
          {"temperature_standard_error", 0.01}};
}

const std::vector<std::string> kAxes = {"particles.restitution", "particles.count"};

using Points = std::vector<std::pair<double, double>>;

Points points_of(const ChartLine& line) {
  Points points;
  for (const Vec2& place : line.points) points.emplace_back(place[0], place[1]);
  return points;
}

// A sweep of two axes with results.
void measure(const Shell& shell) {
  shell.write("s.toml", R"(scene = "vibrated"
[set]
"measure.burn_in" = 5.0
"measure.duration" = 30.0
"measure.fields" = []
[axes]
"particles.restitution" = [0.8, 0.95]
"particles.count" = [60, 20]
)");
  const Outcome sweep = shell.run("clatter sweep s.toml --out d --quiet");
  CAPTURE(sweep.err);
  REQUIRE(sweep.code == 0);
}

}  // namespace

TEST_CASE("Sweep plot: quantities are columns and numbers joined by * and /") {
  const SweepTable table = table_of({{{"theory.psi", 4.0},
                                      {"theory.chi", 1.25},
                                      {"temperature", 3.0},
                                      {"temperature_standard_error", 0.06},
                                      {"pressure.left", -0.5},
                                      {"pressure.left_standard_error", 0.02}}});
  struct Case {
    std::string quantity;
    double value, error;
  };
  // Relative errors: 0.06/3 = 0.02 and 0.02/0.5 = 0.04; theories and numbers have none.
  const std::vector<Case> cases = {
      {"temperature", 3.0, 0.06},
      {"1/theory.psi/theory.chi", 0.2, 0.0},
      {"theory.psi*theory.chi/2", 2.5, 0.0},
      {" 2 * temperature / pressure.left ", -12.0, 12.0 * std::sqrt(0.02 * 0.02 + 0.04 * 0.04)},
      {"temperature*temperature", 9.0, 9.0 * std::sqrt(2.0) * 0.02},
      {"-2.5e-1*theory.psi", -1.0, 0.0}};
  for (const Case& one : cases) {
    CAPTURE(one.quantity);
    const Chart chart = chart_of(table, {}, {.x = "theory.psi", .y = one.quantity});
    REQUIRE(chart.series.size() == 1);
    REQUIRE(chart.series[0].points.size() == 1);
    const ChartPoint& found = chart.series[0].points[0];
    CHECK(found.x == 4.0);
    CHECK(found.y == doctest::Approx(one.value));
    CHECK(found.error == doctest::Approx(one.error));
    // The same quantity along x.
    const Chart turned = chart_of(table, {}, {.x = one.quantity, .y = "theory.psi"});
    CHECK(turned.series[0].points[0].x == doctest::Approx(one.value));
  }
}

TEST_CASE("Sweep plot: a cell without number gives no point and no error bar") {
  Json absent = point(0.9, 20, 2.0);
  absent.erase("temperature");
  Json text = point(0.95, 20, 2.0);
  text["temperature_standard_error"] = nullptr;
  const Chart chart = chart_of(table_of({point(0.8, 20, 1.0), absent, text}), kAxes,
                               {.x = "particles.restitution", .y = "temperature"});
  REQUIRE(chart.series.size() == 1);
  REQUIRE(chart.series[0].points.size() == 3);
  CHECK(chart.series[0].points[0].error == doctest::Approx(0.01));
  CHECK(std::isnan(chart.series[0].points[1].y));
  CHECK(chart.series[0].points[2].y == 2.0);
  CHECK(chart.series[0].points[2].error == 0.0);
}

TEST_CASE("Sweep plot: series are the values of the other axes, or of one column") {
  std::vector<Json> rows = {point(0.8, 50, 1.0), point(0.8, 20, 2.0), point(0.9, 50, 3.0),
                            point(0.9, 20, 4.0)};
  for (Json& row : rows) row["box.size"] = "[9.0, 7.0]";
  const SweepTable table = table_of(rows);
  const Chart chart = chart_of(table, kAxes, {.x = "particles.restitution", .y = "temperature"});
  CHECK(chart.series[1].points[0].x == 0.8);
  CHECK(chart.series[1].points[0].y == 2.0);
  CHECK(chart.series[1].points[1].x == 0.9);
  CHECK(chart.series[1].points[1].y == 4.0);
  struct Case {
    std::string x, by;
    std::vector<std::string> axes, names;
  };
  for (const auto& [x, by, axes, names] :
       {Case{"particles.restitution", "", kAxes, {"count 50", "count 20"}},
        // An axis that is a factor of x is no series.
        Case{"1/particles.count", "", kAxes, {"restitution 0.8", "restitution 0.9"}},
        Case{"temperature",
             "",
             kAxes,
             {"restitution 0.8, count 50", "restitution 0.8, count 20", "restitution 0.9, count 50",
              "restitution 0.9, count 20"}},
        Case{"temperature", "particles.restitution", kAxes, {"restitution 0.8", "restitution 0.9"}},
        Case{"temperature", "box.size", kAxes, {"size [9.0, 7.0]"}},
        // A single curve needs no name.
        Case{"particles.restitution", "", {"particles.restitution"}, {""}}}) {
    CAPTURE(x);
    CAPTURE(by);
    std::vector<std::string> found;
    for (const ChartSeries& series :
         chart_of(table, axes, {.x = x, .y = "temperature", .by = by}).series) {
      found.push_back(series.name);
    }
    CHECK(found == names);
  }
}

TEST_CASE("Sweep plot: labels are symbols with units, or texts of the user") {
  const SweepTable table =
      table_of({{{"temperature", 1.0}, {"theory.psi", 1.0}, {"events.disk_disk", 5}}});
  const auto label = [&](const std::string& quantity) {
    const Chart chart = chart_of(table, {}, {.x = quantity, .y = quantity, .log_y = true});
    CHECK(chart.x.label == chart.y.label);
    CHECK_FALSE(chart.x.logarithmic);
    CHECK(chart.y.logarithmic);
    return chart.x.label;
  };
  CHECK(label("temperature") == "temperature T (m a²/t²)");
  CHECK(label("theory.psi") == "ψ");
  CHECK(label("events.disk_disk") == "events.disk disk");
  CHECK(label("temperature/theory.psi") == "temperature/theory.psi");
  const Chart chart = chart_of(table, {},
                               {.x = "temperature",
                                .y = "theory.psi",
                                .log_x = true,
                                .x_label = "X",
                                .y_label = "Y",
                                .title = "title",
                                .caption = "caption"});
  CHECK((chart.x.logarithmic && !chart.y.logarithmic));
  CHECK(std::tuple(chart.x.label, chart.y.label, chart.title, chart.caption) ==
        std::tuple("X", "Y", "title", "caption"));
}

TEST_CASE("Sweep plot: keys of species, pairs and walls have units, and names in series") {
  const SweepTable table = table_of({{{"species.heavy_one.mass", 2.0},
                                      {"species.a.polydispersity.width", 0.2},
                                      {"pair.a.b.restitution", 0.8},
                                      {"pair.a.a.restitution", 0.9},
                                      {"walls.left.temperature", 3.0},
                                      {"walls.left.species.a.temperature", 4.0}}});
  for (const auto& [column, label, name] :
       std::vector<std::tuple<std::string, std::string, std::string>>{
           {"species.heavy_one.mass", "mass of heavy_one (m)", "mass of heavy_one 2"},
           {"species.a.polydispersity.width", "width of a", "width of a 0.2"},
           {"pair.a.b.restitution", "restitution of a+b", "restitution of a+b 0.8"},
           {"pair.a.a.restitution", "restitution of a+a", "restitution of a+a 0.9"},
           {"walls.left.temperature", "temperature (m a^2/t^2)", "temperature 3"},
           {"walls.left.species.a.temperature", "temperature of a at left (m a^2/t^2)",
            "temperature of a at left 4"}}) {
    CAPTURE(column);
    const Chart chart = chart_of(table, {}, {.x = column, .y = column, .by = column});
    CHECK(chart.x.label == label);
    CHECK(chart.series[0].name == name);
  }
}

TEST_CASE("Sweep plot: a theory has one line per series, or one for all if it depends on x only") {
  const std::string refined = "theory.temperature_refined", simple = "theory.temperature_simple";
  // Points in the order of a refinement: not sorted by x.
  std::vector<Json> rows = {point(0.8, 50, 1.0), point(0.95, 50, 2.0), point(0.9, 50, 3.0),
                            point(0.8, 20, 4.0), point(0.95, 20, 5.0), point(0.9, 20, 6.0)};
  const std::vector<double> of_x = {1.0, 4.0, 2.0, 1.0, 4.0, 2.0};
  const std::vector<double> of_both = {1.0, 4.0, 2.0, 10.0, 40.0, 20.0};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k][simple] = of_x[k];
    rows[k][refined] = of_both[k];
  }
  const SweepPlot plot = {.x = "particles.restitution", .y = "temperature", .theory = true};
  CHECK(chart_of(table_of(rows), kAxes, {.x = plot.x, .y = plot.y}).lines.empty());
  const Chart chart = chart_of(table_of(rows), kAxes, plot);
  REQUIRE(chart.lines.size() == 3);
  CHECK(chart.lines[0].name == "simple theory");
  CHECK(chart.lines[0].style == LineStyle::Dotted);
  CHECK_FALSE(chart.lines[0].series.has_value());
  CHECK(points_of(chart.lines[0]) ==
        Points{{0.8, 1.0}, {0.8, 1.0}, {0.9, 2.0}, {0.9, 2.0}, {0.95, 4.0}, {0.95, 4.0}});
  CHECK(chart.lines[1].name == "refined theory");
  CHECK(chart.lines[1].style == LineStyle::Dashed);
  CHECK(chart.lines[1].series == std::size_t{0});
  CHECK(points_of(chart.lines[1]) == Points{{0.8, 1.0}, {0.9, 2.0}, {0.95, 4.0}});
  CHECK(chart.lines[2].series == std::size_t{1});
  CHECK(points_of(chart.lines[2]) == Points{{0.8, 10.0}, {0.9, 20.0}, {0.95, 40.0}});

  // Further factors apply to the theory too. A point without theory is not part of the line.
  rows[1].erase(refined);
  const Chart scaled =
      chart_of(table_of(rows), kAxes, {.x = plot.x, .y = "temperature/2", .theory = true});
  REQUIRE(scaled.lines.size() == 3);
  CHECK(points_of(scaled.lines[1]) == Points{{0.8, 0.5}, {0.9, 1.0}});
  // No theory predicts 1/T times T, or another column.
  CHECK(chart_of(table_of(rows), kAxes, {.x = plot.x, .y = "1/temperature", .theory = true})
            .lines.empty());
}

TEST_CASE("Sweep plot: two theories at one x are two lines, even if both together increase") {
  std::vector<Json> rows = {point(0.8, 200, 1.0), point(0.8, 100, 1.0), point(0.9, 200, 1.0),
                            point(0.9, 100, 1.0)};
  const std::vector<double> theory = {1.0, 2.0, 3.0, 4.0};
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k]["theory.temperature_refined"] = theory[k];
  const Chart chart = chart_of(table_of(rows), kAxes,
                               {.x = "particles.restitution", .y = "temperature", .theory = true});
  REQUIRE(chart.lines.size() == 2);
  CHECK(points_of(chart.lines[0]) == Points{{0.8, 1.0}, {0.9, 3.0}});
  CHECK(points_of(chart.lines[1]) == Points{{0.8, 2.0}, {0.9, 4.0}});
}

TEST_CASE("Sweep plot: the ratio of spin and translation has its own theory") {
  std::vector<Json> rows = {point(0.8, 50, 2.0), point(0.9, 50, 4.0)};
  for (Json& row : rows) {
    row["spin_temperature"] = 1.0;
    row["theory.temperature_ratio"] = 0.25;
    row["theory.temperature_driven"] = 7.0;
  }
  const SweepTable table = table_of(rows);
  const auto lines = [&](const std::string& y) {
    return chart_of(table, kAxes, {.x = "particles.restitution", .y = y, .theory = true}).lines;
  };
  const std::vector<ChartLine> ratio = lines("spin_temperature/temperature");
  REQUIRE(ratio.size() == 1);
  CHECK(ratio[0].name == "kinetic theory");
  CHECK(points_of(ratio[0]) == Points{{0.8, 0.25}, {0.9, 0.25}});
  CHECK(points_of(lines("3*spin_temperature/temperature").at(0)) ==
        Points{{0.8, 0.75}, {0.9, 0.75}});
  CHECK(lines("spin_temperature").empty());
  CHECK(lines("temperature/spin_temperature").size() == 1);  // of the temperature
}

TEST_CASE("Sweep plot: unknown columns are refused, with a suggestion") {
  const SweepTable table = table_of({point(0.8, 50, 1.0)});
  const std::string count = "particles.count", heat = "temperature";
  for (const auto& [plot, words] : std::vector<std::pair<SweepPlot, std::string>>{
           {{.x = count, .y = "1/temprature"}, "did you mean 'temperature'?"},
           {{.x = count + "*", .y = heat}, "--x: the table has no column ''"},
           {{.x = count, .y = heat, .by = "particles.cuont"}, "did you mean 'particles.count'?"},
           // A quantity is no column.
           {{.x = heat, .y = heat, .by = "2*particles.count"}, "no column '2*particles.count'"}}) {
    CHECK(says(refusal_of([&] { chart_of(table, kAxes, plot); }), words));
  }
}

TEST_CASE("Sweep plot: the suffix of the file chooses PNG or SVG") {
  const Shell shell;
  measure(shell);
  const std::string plot =
      "clatter sweep plot d --x 1/theory.psi --y temperature --theory --title 'a < b & c' ";
  const Outcome svg = shell.run(plot + "--out c.svg && " CLATTER_READERS "read_texts.py c.svg");
  CAPTURE(svg.err);
  REQUIRE(svg.code == 0);
  CAPTURE(svg.out);
  for (const char* text :
       {"1/theory.psi", "temperature T (m a²/t²)", "a < b & c", "restitution 0.8, count 60",
        "restitution 0.95, count 20", "refined theory"}) {
    CAPTURE(text);
    CHECK(says('\n' + svg.out, '\n' + std::string(text) + '\n'));
  }
  const Outcome png = shell.run(plot + "--out c.png");
  CAPTURE(png.err);
  REQUIRE(png.code == 0);
  const std::string bytes = shell.read("c.png");
  CHECK(bytes.starts_with("\x89PNG\r\n\x1a\n"));
  CHECK(bytes.size() > 10000);

  REQUIRE(shell.run("clatter sweep s.toml --out empty --prepare").code == 0);
  for (const auto& [flags, words] : std::vector<std::pair<std::string, std::string>>{
           {"d --y temperature --out c.pdf", "--out: 'c.pdf' is no picture"},
           {"d --y temperature --out none/c.svg", "--out: there is no folder none"},
           {"d --y temperature --by temprature --out e.svg", "did you mean 'temperature'?"},
           {"d --y temperature --by 'replicas*2' --out e.svg", "--by: the table has no column"},
           {"d --y program --out e.svg", "d: the chart has no points"},
           {"d --y temperature/0 --out e.svg", "d: the chart has no points"},
           {"d --y 0*temperature --log --out e.svg", "d: the chart has no points"},
           {"none --y b --out e.svg", "none: this is not the folder of a sweep"},
           {"empty --y temperature --out e.svg", "empty: the sweep has no results"}}) {
    check_refused(shell, "clatter sweep plot --x particles.count " + flags, {words});
  }
}

TEST_CASE("Sweep plot: --log, --log-x and --log-y make axes logarithmic") {
  const Shell shell;
  measure(shell);
  const SweepFolder folder(shell.path("d"));
  const SweepTable table = read_table(folder);
  struct Axes {
    std::string flags;
    bool log_x, log_y;
  };
  for (const auto& [flags, log_x, log_y] :
       {Axes{"", false, false}, Axes{"--log-x", true, false}, Axes{"--log-y", false, true},
        Axes{"--log", true, true}, Axes{"--log-x --log-y", true, true}}) {
    CAPTURE(flags);
    const Outcome outcome =
        shell.run("clatter sweep plot d --x particles.count --y temperature --out c.svg " + flags);
    REQUIRE(outcome.code == 0);
    // The same table, drawn with the flags of chart_of().
    const SweepPlot plot = {
        .x = "particles.count", .y = "temperature", .log_x = log_x, .log_y = log_y};
    write_chart(shell.path("expected.svg"), chart_of(table, kAxes, plot));
    CHECK(shell.read("c.svg") == shell.read("expected.svg"));
  }
}

}  // namespace clatter
