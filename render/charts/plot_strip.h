#pragma once

#include <optional>
#include <vector>

#include "render/charts/live_plot.h"
#include "render/gl/canvas.h"
#include "render/output/image.h"
#include "render/theme.h"
#include "render/typography/fonts.h"
#include "render/typography/gui_context.h"
#include "render/typography/gui_layer.h"

namespace clatter {

/// Draws the plots beside the gas in films.
class PlotStrip {
 public:
  /// A strip of `size` in pictures of `whole` size, which sets the size of the letters. With
  /// `transparent` the background is transparent. `gl` must outlive the strip.
  PlotStrip(const Gl& gl, Size size, Size whole, bool transparent);

  /// The picture of these plots, below each other in a high strip and else beside each other. The
  /// place of an absent plot is empty.
  Image draw(const std::vector<std::optional<LivePlot>>& plots, const ThemeColours& theme);

 private:
  const Gl* gl_;
  bool transparent_;
  Canvas canvas_;
  GuiLayer gui_;
  GuiContext context_;
  Fonts fonts_;
};

}  // namespace clatter
