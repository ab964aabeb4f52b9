#pragma once

#include <string>
#include <vector>

#include "app/plots/history.h"
#include "engine/observables/observable.h"
#include "render/charts/live_plot.h"
#include "render/theme.h"

namespace clatter {

/// Name of a table in plots: "wall hits, left, incoming".
std::string table_title(const ResultTable& table);

/// Plots of a table of an observable, one for each unit of its columns, with standard errors as
/// bands. The density of a histogram is over the middles of its bins. A table of slabs has a curve
/// for each slab. An axis is logarithmic if bins or lags are, or if values differ by more than a
/// factor of 100. On a logarithmic y axis, points with relative errors above 1/2 are not drawn.
/// Columns without an axis have the text colour of the theme. That of a
/// displacement or a velocity correlation stands for its gas where several are compared. In a
/// mixture a species has its colour. Its displacement and its velocity correlation are drawn over
/// all axes alone, with dashed theory (theory 12.23) of the history's scene.
std::vector<LivePlot> table_plots(const ResultTable& table, const Scene& scene,
                                  const History& history, const ThemeColours& theme);

}  // namespace clatter
