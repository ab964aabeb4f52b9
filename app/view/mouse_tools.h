#pragma once

#include <imgui.h>

#include <array>
#include <optional>
#include <vector>

#include "app/view/controls.h"
#include "app/view/session.h"
#include "app/view/window_map.h"

namespace clatter {

/// The action of the left button on the gas.
enum class Tool { Heat, Cool, Kick, Throw, Add, Ball, Wall, Erase };

/// Texts of a tool.
struct ToolText {
  Tool tool;
  const char* key;   ///< name of its button in the script log
  const char* name;  ///< label of its button
  const char* help;  ///< tooltip of its button
  const char* hint;  ///< line on the picture before the first press
};

/// All tools, in the order of their buttons and of the keys 1 to 8.
inline constexpr std::array<ToolText, 8> kTools = {{
    {Tool::Heat, "tool.heat", "Heat",
     "Speeds in a circle at the mouse grow by a tenth, every 0.1 s while the button is held (1)",
     "press and hold to heat  ·  Esc ends"},
    {Tool::Cool, "tool.cool", "Cool",
     "Speeds in a circle at the mouse shrink by a tenth, every 0.1 s while the button is held (2)",
     "press and hold to cool  ·  Esc ends"},
    {Tool::Kick, "tool.kick", "Kick",
     "A dragged arrow adds a velocity to all particles in a circle. Its length is the distance in "
     "one "
     "second of playing (3)",
     "drag an arrow to kick  ·  Esc ends"},
    {Tool::Throw, "tool.throw", "Throw",
     "An arrow dragged from a particle sets its velocity. Its length is the distance in one second "
     "of "
     "playing (4)",
     "drag an arrow from a particle  ·  Esc ends"},
    {Tool::Add, "tool.add", "Add",
     "A click adds particles of the present temperature in a circle at the mouse, as many as find "
     "room (5)",
     "click to add particles  ·  Esc ends"},
    {Tool::Ball, "tool.ball", "Ball",
     "A dragged circle is an obstacle, from its centre to its rim. A drag of one moves it, and a "
     "drag of its rim resizes it. The gas starts again around it (6)",
     "drag a ball from its centre  ·  Esc ends"},
    {Tool::Wall, "tool.wall", "Wall",
     "A dragged line is a partition. A drag along one cuts a hole, and a drag away from it moves "
     "it. "
     "The gas starts again around it (7)",
     "drag a wall  ·  Esc ends"},
    {Tool::Erase, "tool.erase", "Erase",
     "A click removes an obstacle or a partition. The gas starts again (8)",
     "click on an obstacle or a partition  ·  Esc ends"},
}};

/// Whether a tool changes the fixtures of disks, not the gas.
constexpr bool draws_fixtures(Tool tool) {
  return tool >= Tool::Ball;
}

/// Tools that act on the gas at the mouse. Each action is a nudge or a puff, which the run records
/// as a [[change]]. Heat and Cool scale velocities in a circle, of spheres in a ball. Kick adds a
/// velocity there, and Throw sets the velocity of one particle. Add makes a puff of new particles.
/// Ball, Wall and Erase change the fixtures of disks, and start the gas again with its particles.
/// A press is one undo entry.
class MouseTools {
 public:
  /// Group with the buttons of the tools, and the sliders of the chosen one. Returns true if a tool
  /// was chosen.
  bool panel(const Scene& scene, Controls& controls);
  /// Sliders of the chosen tool: the radius of its circle, and the number of particles to add.
  void sliders(const Scene& scene, Controls& controls);
  /// Chooses a tool, or ends the same one.
  void toggle(Tool tool);
  /// Ends the tool.
  void leave() { tool_.reset(); }
  /// The chosen tool; absent: none.
  const std::optional<Tool>& tool() const { return tool_; }
  /// Whether the left button on the picture belongs to a tool.
  bool active() const { return tool_ || press_; }
  /// A hint on the chosen tool, before its first press; nullptr: none.
  const char* hint() const;

  /// Handles the left button. `over`: the mouse is over the viewport.
  void use(Session& session, const WindowMap& map, bool over);
  /// Draws the circle, or the ring of a particle, and the arrow.
  void mark(ImDrawList& list, const Frame& frame, const WindowMap& map) const;

 private:
  // The place of a tool's action.
  struct Target {
    VecX place;  // centre of the circle, or of the particle
    std::optional<std::size_t> particle = {};
  };
  // A press of the left button.
  struct Press {
    Tool tool;
    std::uint64_t run;  // of the frame
    ImVec2 place;       // of the mouse, window units
    bool dragged = false;
    std::optional<double> nudged = {};  // simulation time of the frame at the last nudge
    std::vector<Change> acts = {};      // so far
  };

  double radius(const Scene& scene) const;
  std::optional<Target> target_at(const Session& session, const WindowMap& map, Tool tool) const;
  void follow(const Snapshot& gas);
  void scale(Session& session);
  std::string species_of(const Scene& scene) const;
  void add(Session& session);
  void release(Session& session, const WindowMap& map);
  void edit_fixtures(Session& session, const WindowMap& map, const Press& press);
  VecX velocity(const Frame& frame, const WindowMap& map) const;
  void draw_arrow(ImDrawList& list, const Frame& frame, const WindowMap& map, ImU32 ink) const;

  static constexpr double kUsualCount = 20.0;

  std::optional<Tool> tool_;
  std::optional<double> radius_;  // absent: as usual for the box
  double count_ = kUsualCount;    // particles that a click adds
  int species_ = 0;               // number of their species in a mixture
  bool pressed_ = false;          // since the tool was chosen
  std::optional<Target> target_;  // absent: the mouse is elsewhere
  std::optional<Press> press_;    // while the button is down
};

}  // namespace clatter
