#include "app/import/xml.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "engine/error.h"
#include "engine/text.h"

namespace clatter {

namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";
constexpr std::size_t kMostOpenElements = 100;

bool is_blank(std::string_view text) {
  return text.find_first_not_of(kXmlBlanks) == text.npos;
}

// The bytes of a character in UTF-8.
std::string utf8_of(unsigned code) {
  const auto byte = [](unsigned bits) { return static_cast<char>(bits); };
  const auto rest = [&](unsigned shift) { return byte(0x80u | ((code >> shift) & 0x3fu)); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xc0u | (code >> 6)), rest(0)};
  if (code < 0x10000) return {byte(0xe0u | (code >> 12)), rest(6), rest(0)};
  return {byte(0xf0u | (code >> 18)), rest(12), rest(6), rest(0)};
}

class XmlParser {
 public:
  XmlParser(std::string_view text, std::string_view raw, const std::filesystem::path& path)
      : text_(text), raw_(raw), path_(path) {}

  XmlElement parse() {
    if (rest().starts_with("\xef\xbb\xbf")) place_ += 3;  // a byte order mark
    do {
      add_text(taken_until("<"));
      place_ -= 1;
    } while (!take_markup());
    return std::move(root_);
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const std::string& advice) const {
    throw UserError({path_.string(), line_}, problem, advice);
  }
  [[noreturn]] void refuse_end() const {
    refuse("the file is cut off within its XML", "give a complete file");
  }

  std::string_view rest() const { return text_.substr(place_); }

  void move_to(std::size_t place) {
    line_ += static_cast<int>(std::ranges::count(text_.substr(place_, place - place_), '\n'));
    place_ = place;
  }

  // The text up to an end. Moves behind the end.
  std::string_view taken_until(std::string_view end) {
    const std::size_t found = text_.find(end, place_);
    if (found == text_.npos) refuse_end();
    const std::string_view taken = text_.substr(place_, found - place_);
    move_to(found + end.size());
    return taken;
  }

  void add_text(std::string_view text) {
    if (!open_.empty()) {
      open_.back().text += decoded(text);
    } else if (!is_blank(text)) {
      refuse("there is text before the first element", "give a file of XML");
    }
  }

  // Moves behind a tag, a comment or an instruction. Returns whether the root is complete.
  bool take_markup() {
    if (rest().starts_with("<!--")) {
      place_ += 4;
      taken_until("-->");
    } else if (rest().starts_with("<?")) {
      taken_until("?>");
    } else if (rest().starts_with("<![CDATA[") && !open_.empty()) {
      place_ += 9;
      open_.back().text += taken_until("]]>");
    } else if (rest().starts_with("<!")) {
      refuse("the file declares a type of documents", "give a file without <!DOCTYPE>");
    } else if (rest().starts_with("</")) {
      place_ += 2;
      return close(taken_end_name());
    } else {
      place_ += 1;
      return take_start();
    }
    return false;
  }

  std::string_view taken_name() {
    const std::size_t end = text_.find_first_of(" \t\r\n=/><\"'&", place_);
    if (end == text_.npos) refuse_end();
    const std::string_view name = text_.substr(place_, end - place_);
    if (name.empty()) refuse("a tag or an attribute has no name", "give a file of XML");
    place_ = end;
    return name;
  }

  void skip_blanks() {
    const std::size_t end = text_.find_first_not_of(kXmlBlanks, place_);
    if (end == text_.npos) refuse_end();
    move_to(end);
  }

  std::string_view taken_end_name() {
    const std::string_view name = taken_name();
    skip_blanks();
    if (text_[place_] != '>') refuse("the end tag " + quoted_start(name) + " has more", "end it");
    place_ += 1;
    return name;
  }

  // Takes a start tag with its attributes. Returns whether the root is complete.
  bool take_start() {
    XmlElement element;
    element.name = taken_name();
    element.line = line_;
    for (skip_blanks(); text_[place_] != '>' && text_[place_] != '/'; skip_blanks()) {
      take_attribute(element);
    }
    const bool closed = text_[place_] == '/';
    if (closed && !text_.substr(place_ + 1).starts_with('>')) {
      refuse("the tag " + quoted_start(element.name) + " does not end", "end it by />");
    }
    place_ += closed ? 2 : 1;
    element.content = place_;
    const std::string name = element.name;
    if (open_.size() == kMostOpenElements) {
      refuse("more than " + std::to_string(kMostOpenElements) + " elements are in each other",
             "give a file of VTK");
    }
    open_.push_back(std::move(element));
    if (closed) return close(name);
    if (name != raw_) return false;
    while (!close(open_.back().name)) {
    }
    return true;
  }

  void take_attribute(XmlElement& element) {
    const std::string key(taken_name());
    skip_blanks();
    if (text_[place_] != '=') refuse("the attribute " + quoted_start(key) + " has no value", kGive);
    place_ += 1;
    skip_blanks();
    const char quote = text_[place_];
    if (quote != '"' && quote != '\'') {
      refuse("the value of " + quoted_start(key) + " has no quotes", kGive);
    }
    place_ += 1;
    const std::string value = decoded(taken_until(std::string_view(&quote, 1)));
    if (!element.attributes.emplace(key, value).second) {
      refuse("the attribute " + quoted_start(key) + " occurs twice", "remove one of them");
    }
  }

  // Closes the last open element. Returns whether it is the root.
  bool close(std::string_view name) {
    if (open_.empty() || open_.back().name != name) {
      refuse("the end tag " + quoted_start(name) + " has no start tag", "give a complete file");
    }
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    if (open_.empty()) {
      root_ = std::move(element);
      return true;
    }
    open_.back().children.push_back(std::move(element));
    return false;
  }

  // The text with its references to characters replaced.
  std::string decoded(std::string_view text) const {
    std::string plain;
    while (true) {
      const std::size_t begin = text.find('&');
      plain += text.substr(0, begin);
      if (begin == text.npos) return plain;
      text.remove_prefix(begin + 1);
      const std::size_t end = text.find(';');
      if (end == text.npos) refuse("the character & has no end", "write &amp; for it");
      plain += character(text.substr(0, end));
      text.remove_prefix(end + 1);
    }
  }

  std::string character(std::string_view reference) const {
    if (reference.empty()) refuse("&; is no character", "write &amp; for &");
    static const std::map<std::string_view, std::string> kNamed = {
        {"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"apos", "'"}};
    if (const auto named = kNamed.find(reference); named != kNamed.end()) return named->second;
    const bool hexadecimal = reference.starts_with("#x");
    const std::string_view digits = reference.substr(hexadecimal ? 2 : 1);
    const char* const end = digits.data() + digits.size();
    unsigned code = 0;
    const auto read = std::from_chars(digits.data(), end, code, hexadecimal ? 16 : 10);
    const bool whole = reference.starts_with('#') && read.ec == std::errc() && read.ptr == end;
    if (whole && code > 0 && code <= 0x10ffff) return utf8_of(code);
    refuse("&" + std::string(reference.substr(0, 20)) + "; is no character", "write &amp; for &");
  }

  static constexpr const char* kGive = "write NAME=\"VALUE\"";

  std::string_view text_, raw_;
  const std::filesystem::path& path_;
  std::size_t place_ = 0;
  int line_ = 1;
  std::vector<XmlElement> open_;
  XmlElement root_;
};

}  // namespace

std::string XmlElement::attribute(const std::string& key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  const auto found = std::ranges::find(children, child_name, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

std::vector<const XmlElement*> XmlElement::all(std::string_view child_name) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& each : children) {
    if (each.name == child_name) found.push_back(&each);
  }
  return found;
}

XmlElement parse_xml(std::string_view text, std::string_view raw,
                     const std::filesystem::path& path) {
  return XmlParser(text, raw, path).parse();
}

}  // namespace clatter
