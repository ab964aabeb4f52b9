#include "engine/error.h"

#include "engine/text.h"

namespace clatter {

static std::string message(const Place& place, const std::string& what, const std::string& advice) {
  std::string text = place.file;
  if (place.line > 0) {
    text += ':' + std::to_string(place.line);
    if (place.column > 0) text += ':' + std::to_string(place.column);
  }
  if (!text.empty()) text += ": ";
  text += what;
  if (!advice.empty()) text += "; " + advice;
  return text;
}

UserError::UserError(const Place& place, const std::string& problem, const std::string& advice)
    : std::runtime_error(printable(message(place, problem, advice))),
      place_(place),
      problem_(problem),
      advice_(advice) {}

}  // namespace clatter
