#include "app/bench/tables.h"

#include "render/context/context.h"
#include "render/output/png_sink.h"

namespace clatter {

void write_plot(const std::string& file, const Plot& plot) {
  const auto context = open_context(Backend::Auto);
  write_png(file, plot_image(context->gl(), plot, {1600, 1000}, kLightTheme));
}

}  // namespace clatter
