#pragma once

#include <vector>

#include "app/view/window_input.h"

namespace clatter {

// Keys and pictures of Dear ImGui. Only gui_keys.cpp depends on its version: versions from 1.89 on
// have a queue of events, and version 1.86 has arrays of states. (1.87 and 1.88 are not supported.)

/// Prepares the current context of Dear ImGui for pass_key().
void prepare_keys();

/// Passes a key to Dear ImGui, by its code in GLFW. Keys that no text field needs are ignored.
void pass_key(int key, bool down);

/// Passes the state of Shift and Control to Dear ImGui.
void pass_modifiers(bool shift, bool ctrl);

/// Begins a picture. A key of `presses` is pressed in it, even if it has been released since.
void begin_picture(const std::vector<KeyPress>& presses);

}  // namespace clatter
