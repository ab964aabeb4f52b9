#include <doctest/doctest.h>
#include <libdeflate.h>
#include <stb_image.h>

#include <map>

#include "engine/error.h"
#include "render/output/image.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

using namespace testing;

namespace {

Image gradient(Size size) {
  Image image{size, {}};
  for (int i = 0; i < size.width * size.height; ++i) {
    for (int factor : {1, 3, 7, 11}) image.rgba.push_back(static_cast<unsigned char>(factor * i));
  }
  return image;
}

std::vector<unsigned char> decode(const std::vector<unsigned char>& png, Size& size) {
  int channels = 0;
  unsigned char* pixels = stbi_load_from_memory(png.data(), static_cast<int>(png.size()),
                                                &size.width, &size.height, &channels, 4);
  REQUIRE(pixels);
  CHECK(channels == 4);
  std::vector<unsigned char> result(pixels, pixels + 4 * size.width * size.height);
  stbi_image_free(pixels);
  return result;
}

std::uint32_t big_endian(const unsigned char* p) {
  return std::uint32_t{p[0]} << 24 | p[1] << 16 | p[2] << 8 | p[3];
}

// The contents of the chunks by type, in order. Checks every CRC.
std::vector<std::pair<std::string, std::string>> chunks(const std::vector<unsigned char>& png) {
  std::vector<std::pair<std::string, std::string>> result;
  for (std::size_t at = 8; at < png.size();) {
    const std::uint32_t length = big_endian(&png[at]);
    const auto* type = reinterpret_cast<const char*>(&png[at + 4]);
    CHECK(libdeflate_crc32(0, type, length + 4) == big_endian(&png[at + 8 + length]));
    result.emplace_back(std::string(type, 4), std::string(type + 4, length));
    at += length + 12;
  }
  return result;
}

}  // namespace

TEST_CASE("Image: a PNG gives the same pixels back") {
  for (Size size : {Size{1, 1}, {3, 2}, {257, 33}}) {
    const Image image = gradient(size);
    Size decoded;
    CHECK(decode(encode_png(image), decoded) == image.rgba);
    CHECK(decoded.width == size.width);
    CHECK(decoded.height == size.height);
  }
}

TEST_CASE("Image: texts are kept in a PNG, before the pixels, with right checksums") {
  const std::vector<PngText> texts = {{"Title", "Gas ρ"}, {"Comment", ""}};
  const auto found = chunks(encode_png(gradient({3, 2}), texts));
  REQUIRE(found.size() == 5);
  CHECK(found[0].first == "IHDR");
  CHECK(found[1].first == "iTXt");
  CHECK(found[1].second == std::string("Title\0\0\0\0\0Gas ρ", 16));
  CHECK(found[2].first == "iTXt");
  CHECK(found[3].first == "IDAT");
  CHECK(found[4].first == "IEND");
}

TEST_CASE("Image: a PNG file is there whole, or an error and nothing") {
  const TemporaryFolder folder;
  const Image image = gradient({16, 9});
  write_png(folder / "a.png", image);
  const std::vector<unsigned char> png = encode_png(image);
  CHECK(bytes_of(folder / "a.png") == std::string(png.begin(), png.end()));
  std::filesystem::remove(folder / "a.png");

  CHECK_THROWS_WITH_AS(write_png(folder / "missing/a.png", image),
                       doctest::Contains("No such file"), RunError);
  std::filesystem::create_directory(folder / "taken.png");
  CHECK_THROWS_AS(write_png(folder / "taken.png", image), RunError);
  std::filesystem::remove(folder / "taken.png");
  CHECK(folder.empty());
}

TEST_CASE("Image: a PNG file is whole only if no byte is absent, changed or too many") {
  const TemporaryFolder folder;
  const std::vector<unsigned char> png =
      encode_png(gradient({5, 4}), std::vector<PngText>{{"Title", "t"}});
  const std::string sound(png.begin(), png.end());
  const auto is_whole = [&](const std::string& bytes) {
    write_bytes(folder / "a.png", bytes);
    return is_whole_png(folder / "a.png");
  };
  CHECK(is_whole(sound));
  CHECK_FALSE(is_whole(sound + '\0'));
  CHECK_FALSE(is_whole_png(folder / "none.png"));
  for (std::size_t at = 0; at < sound.size(); ++at) {
    CAPTURE(at);
    CHECK_FALSE(is_whole(sound.substr(0, at)));
    for (const char flip : {'\1', '\x80'}) {
      std::string changed = sound;
      changed[at] = static_cast<char>(changed[at] ^ flip);
      CHECK_FALSE(is_whole(changed));
    }
  }
}

TEST_CASE("Image: a text in a PNG file is found by its key") {
  const TemporaryFolder folder;
  const Image image{{2, 2}, std::vector<unsigned char>(16, 7)};
  const std::string scene = "title = \"ψ, iTXtScene\"\n";
  write_png(folder / "a.png", image, std::vector<PngText>{{"Title", "t"}, {"Scene", scene}});
  CHECK(png_text(folder / "a.png", "Scene") == scene);
  CHECK(png_text(folder / "a.png", "Title") == "t");
  CHECK_FALSE(png_text(folder / "a.png", "Seed"));
  CHECK_FALSE(png_text(folder / "none.png", "Scene"));
  write_png(folder / "plain.png", image);
  CHECK_FALSE(png_text(folder / "plain.png", "Scene"));
}

TEST_CASE("Image: a PNG file with damaged texts is refused, whatever length it claims") {
  const TemporaryFolder folder;
  const Image image{{2, 2}, std::vector<unsigned char>(16, 7)};
  const std::vector<unsigned char> sound =
      encode_png(image, std::vector<PngText>{{"Scene", "title = 'a'"}});
  const auto text_of = [&](const std::vector<unsigned char>& bytes) {
    write_bytes(folder / "a.png", std::string(bytes.begin(), bytes.end()));
    return png_text(folder / "a.png", "Scene");
  };
  REQUIRE(text_of(sound) == "title = 'a'");
  constexpr std::size_t kLength = 33, kText = 55;  // of the chunk and of its text
  std::vector<unsigned char> bytes = sound;
  bytes[kText] ^= 1;
  CHECK_THROWS_WITH_AS(text_of(bytes), doctest::Contains("the picture is damaged: "), UserError);
  for (const unsigned char largest_byte : {0x00, 0x7f, 0xff}) {
    bytes = sound;
    bytes[kLength] = largest_byte;
    bytes[kLength + 1] = 0xff;
    CHECK_THROWS_AS(text_of(bytes), UserError);
  }
  bytes = sound;
  bytes.resize(kText);
  CHECK_THROWS_AS(text_of(bytes), UserError);
}

}  // namespace clatter
