#pragma once

#include <string>
#include <string_view>

namespace clatter {

/// Replaces the part of a Markdown page between the lines `<!-- NAME -->` and `<!-- end of NAME
/// -->` by a text that ends with a new line. `file` names the page in errors. Throws UserError if
/// the page has no part of this name.
void replace_part(std::string& page, const std::string& file, const std::string& name,
                  std::string_view text);

}  // namespace clatter
