#pragma once

#include <optional>

#include "engine/scene/scene.h"

namespace clatter {

/// Changes of the fixtures of disks by a drag of the mouse from one place in the box to another.
/// Numbers have two digits behind the point. Each result is a scene whose obstacles or partitions
/// differ; the checks of scenes follow.

/// A new ball with its centre where the drag begins. A drag that begins in a ball moves it, and one
/// near its rim resizes it.
Scene with_ball(Scene scene, const Vec2& from, const Vec2& to);

/// A new partition along the drag, open beyond its ends; along a periodic axis closed everywhere. A
/// drag that begins on a partition cuts a hole if it goes along, and moves it otherwise.
Scene with_wall(Scene scene, const Vec2& from, const Vec2& to);

/// The scene without the obstacle or partition at a place; absent: there is none.
std::optional<Scene> without_fixture_at(Scene scene, const Vec2& place);

}  // namespace clatter
