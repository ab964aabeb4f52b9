#include "render/theme.h"

namespace clatter {

static ThemeColours colours_of(Theme theme) {
  switch (theme) {
    case Theme::Dark:
      return kDarkTheme;
    case Theme::Light:
      return kLightTheme;
    case Theme::Projector:
      return kProjectorTheme;
  }
  return kDarkTheme;
}

ThemeColours theme_of(const View& view) {
  ThemeColours theme = colours_of(view.theme);
  if (view.background) {
    const auto& [red, green, blue] = *view.background;
    theme.background = {red, green, blue};
  }
  return theme;
}

}  // namespace clatter
