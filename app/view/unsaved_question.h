#pragma once

#include <string>

#include "app/view/controls.h"

namespace clatter {

/// Answer to the question whether to save changes.
enum class Answer { None, Save, Discard, Cancel };

/// Draws the question whether to save the changes of the scene with this title, in the middle of
/// the window. It blocks all other widgets. Returns the answer: that of a button, or the one that
/// was `typed`.
Answer unsaved_question(Controls& controls, const std::string& title, Answer typed);

}  // namespace clatter
