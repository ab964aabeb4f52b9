#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace clatter {

/// An element of an XML file.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< without that of its children
  std::vector<XmlElement> children;
  int line = 0;             ///< of its tag
  std::size_t content = 0;  ///< place in the file behind its tag

  /// The value of an attribute; empty: absent.
  std::string attribute(const std::string& key) const;
  /// The first child of a name; null: absent.
  const XmlElement* child(std::string_view child_name) const;
  /// All children of a name.
  std::vector<const XmlElement*> all(std::string_view child_name) const;
};

/// The root element of a text of XML 1.0 in UTF-8, see https://www.w3.org/TR/xml. The text ends
/// behind the tag of an element `raw`, whose content may be anything. Throws UserError with the
/// line for a malformed text, and for declarations of types, which VTK's files lack.
XmlElement parse_xml(std::string_view text, std::string_view raw,
                     const std::filesystem::path& path);

}  // namespace clatter
