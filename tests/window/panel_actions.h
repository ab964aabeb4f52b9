#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.h"
#include "tests/window/panel_driver.h"

// Scenes and actions of the tests of panels.

namespace clatter {

/// Positions of values in a scene file, as in settings().
using Places = std::vector<std::string>;

/// A scene of disks in which all sliders have different values.
Scene uneven_disks();
/// The same gas as spheres, with the keys that only spheres have.
Scene uneven_spheres();

/// Shows all panels of the window, one below the other.
void all_panels(Session& session, Controls& controls);
/// The scene as changed by the panels: values by their positions in a scene file.
nlohmann::json settings(const PanelDriver& driver);
/// Positions of the values that differ.
Places changes(const nlohmann::json& before, const nlohmann::json& after);

/// All lines of the panel.
std::string text_of(PanelDriver& driver);
/// Opens a list and selects an item.
void choose(PanelDriver& driver, const std::string& key, const std::string& word);
/// Clicks a box to tick, or a button.
void tick(PanelDriver& driver, const std::string& key);
/// Points at widgets, and checks that each has a tooltip with these words.
void check_help(PanelDriver& driver,
                const std::vector<std::pair<std::string, std::string>>& words_of_widgets);
/// Points at widgets, and checks that each has a tooltip.
void check_explained(PanelDriver& driver, const std::vector<std::string>& widgets);
/// Checks that the lines are equal.
void check_lines(const std::vector<std::string>& lines, const std::vector<std::string>& expected);

}  // namespace clatter
