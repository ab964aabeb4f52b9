#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/view/controls.h"
#include "app/view/mouse_tools.h"
#include "app/view/session.h"

namespace clatter {

// The groups of the left panel. Each draws into the current ImGui window.

/// All groups of the gas, one below the other. `titles` are as in compare_panel(). Returns true if
/// a mouse tool was chosen.
bool gas_panels(Session& session, Controls& controls, MouseTools& tools,
                const std::vector<std::string>& titles);
/// Number of particles and their collision laws.
void gas_panel(Session& session, Controls& controls);
/// Particles of each species of a mixture, and the restitution of each two; nothing without
/// species.
void species_controls(Session& session, Controls& controls);
/// Gases in step with this one. `titles` are the names of all gases; empty: there is one.
void compare_panel(Session& session, Controls& controls, const std::vector<std::string>& titles);
/// Dimension, box, walls, gravity and bulk drive.
void box_panel(Session& session, Controls& controls);
/// The free piston, and the obstacles and partitions; nothing without any.
void fixture_panel(Session& session, Controls& controls);
/// Colours, heatmap, arrows and other layers of the picture.
void view_panel(Session& session, Controls& controls);
/// Settings that trade accuracy for speed, with their cost.
void accuracy_panel(Session& session, Controls& controls);
/// Direction of view, angle of view and slab of spheres. Returns true if the view changed.
bool space_controls(const Session& session, Controls& controls, View& view);
/// The heatmap of spheres as a volume. Returns true if the view changed.
bool choose_volume(const Session& session, Controls& controls, View& view);
/// Slices of the heatmap of spheres. Returns true if the view changed.
bool choose_slices(const Session& session, Controls& controls, View& view);
/// Ends of a colour range of the particles, symmetric for quantities of both signs: a round number
/// at or above twice the thermal speed; of depths, half the diagonal of the box.
std::array<double, 2> colour_ends(const Snapshot& snapshot, ColourBy colour_by);
/// Action of the record panel.
enum class Recording {
  None,
  Screenshot,
  SaveScene,
  RestoreScene,
  CopyLink,
  Film,
  StopFilm,
  FilmScreen,
  StopScreen
};
/// Films that the surroundings of the window can make: of the run in the background, or of the
/// screen from now on.
enum class Films { None, OfRun, OfScreen };
/// Buttons for pictures, scene files and films, and for links where no processes make films.
/// `filmed` belongs to the current film: its completed fraction 0..1, or its seconds if it is of
/// the screen; absent: no film. Returns the chosen action.
Recording record_panel(Controls& controls, Films films, std::optional<double> filmed);

}  // namespace clatter
