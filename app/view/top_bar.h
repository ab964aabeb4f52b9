#pragma once

#include "app/view/controls.h"
#include "app/view/session.h"

namespace clatter {

/// The slim bar above all: scene, play and steps, speed, time, health. Whether the gallery, the
/// plots or the help are asked for is left in the flags.
void top_bar(Session& session, Controls& controls, bool& gallery, bool& plots, bool& help);

}  // namespace clatter
