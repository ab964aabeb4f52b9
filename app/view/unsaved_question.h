#pragma once

#include <string>

#include "app/view/controls.h"

namespace clatter {

/// Answer to the question whether to save changes.
enum class Answer { None, Save, Discard, Cancel };

/// Draws the question whether to save the changes of the scene with this title, in the middle of
/// the window. It blocks all other widgets. Returns the answer.
Answer unsaved_question(Controls& controls, const std::string& title);

}  // namespace clatter
