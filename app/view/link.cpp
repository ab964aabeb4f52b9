#include "app/view/link.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/embedded_file.h"
#include "engine/error.h"
#include "engine/scene/act_checks.h"
#include "engine/scene/scene_file.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
constexpr std::string_view kScene = "scene=";
constexpr const char* kFile = "link";  // name of the file in errors

[[noreturn]] void refuse_damaged() {
  throw UserError({kFile}, "the scene in this link is damaged", "copy the whole link again");
}

// RFC 4648, 5: base 64 for links, without padding.
std::string in_base64(std::string_view bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k <= count; ++k) text += kDigits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char letter : text) {
    const std::size_t digit = kDigits.find(letter);
    if (digit == kDigits.npos) refuse_damaged();
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

std::string compressed(std::string_view text) {
  constexpr int kBest = 12;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kBest), libdeflate_free_compressor);
  std::string bytes(libdeflate_zlib_compress_bound(compressor.get(), text.size()), '\0');
  bytes.resize(libdeflate_zlib_compress(compressor.get(), text.data(), text.size(), bytes.data(),
                                        bytes.size()));
  return bytes;
}

std::string decompressed(std::string_view bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  std::string text(kLargestScene, '\0');
  std::size_t length = 0;
  if (libdeflate_zlib_decompress(decompressor.get(), bytes.data(), bytes.size(), text.data(),
                                 text.size(), &length) != LIBDEFLATE_SUCCESS) {
    refuse_damaged();
  }
  text.resize(length);
  return text;
}

// The text behind escapes such as %5B (RFC 3986, 2.1).
std::string unescaped(std::string_view text) {
  constexpr std::string_view kHex = "0123456789ABCDEFabcdef";
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '%' && i + 2 < text.size() &&
                        kHex.find(text[i + 1]) != kHex.npos && kHex.find(text[i + 2]) != kHex.npos;
    if (escape) {
      plain += static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
      i += 2;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

std::vector<std::string_view> parts_of(std::string_view fragment) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = fragment.find('&');
    parts.push_back(fragment.substr(0, end));
    if (end == fragment.npos) return parts;
    fragment.remove_prefix(end + 1);
  }
}

SceneText gallery_scene(const std::string& name) {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_scenes()) {
    names.emplace_back(file.name.substr(0, file.name.rfind('.')));
    if (names.back() != name) continue;
    return {std::string(file.bytes), std::string(file.name), Origin::Gallery};
  }
  const std::string_view near = near_miss(name, names);
  throw UserError({kFile}, "there is no scene " + quoted_start(name),
                  near.empty() ? "press G for the gallery" : "try " + in_quotes(near));
}

std::uint64_t seed_of(const std::string& text) {
  const auto seed = whole_number<std::uint64_t>(text);
  if (!seed) throw UserError({kFile}, "the seed is no whole number", "write, say, &seed=3");
  return *seed;
}

// Files of a page are not those of the user, so only the gallery has start states.
void require_fitting(const Scene& scene, Origin origin) {
  if (origin == Origin::Folder && scene.particles.start.layout == Layout::File) {
    throw UserError({kFile}, "a link cannot name a file with a start state",
                    "give the scene another start");
  }
  if (final_count(scene) > kMostInLink) {
    throw UserError({kFile}, "a page opens at most " + std::to_string(kMostInLink) + " particles",
                    "use the program, or choose fewer");
  }
}

}  // namespace

LinkedScene read_link(std::string_view fragment) {
  const std::vector<std::string_view> parts = parts_of(fragment);
  const std::string name = unescaped(parts.front());
  SceneText text;
  if (name.starts_with(kScene)) {
    text = {decompressed(from_base64(std::string_view(name).substr(kScene.size()))), kFile};
  } else {
    text = gallery_scene(name.empty() ? "vibrated" : name);
  }
  LinkedScene linked;
  std::vector<Override> settings;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    // Some programs escape the sign between key and value too.
    const std::string part = unescaped(parts[i]);
    const std::size_t sign = part.find('=');
    const std::string key = part.substr(0, sign);
    if (sign == part.npos) {
      throw UserError({kFile}, quoted_start(key) + " has no value", "write &KEY=VALUE");
    }
    const std::string value = part.substr(sign + 1);
    if (key == "seed") {
      linked.seed = seed_of(value);
    } else {
      settings.push_back({key, value});
    }
  }
  const StartFile start = text.origin == Origin::Gallery ? StartFile::Read : StartFile::Skip;
  linked.scene = parse_scene(text, settings, start);
  require_fitting(linked.scene, text.origin);
  return linked;
}

std::string link_of(const Scene& scene, std::uint64_t seed) {
  if (scene.particles.start.layout == Layout::File) {
    throw UserError({kFile}, "a link cannot hold a start state", "save the scene instead");
  }
  return std::string(kScene) + in_base64(compressed(scene_to_toml(scene))) +
         "&seed=" + std::to_string(seed);
}

}  // namespace clatter
