#include "render/output/movie.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>

#include "engine/error.h"
#include "tests/render/output/temporary_folder.h"

namespace clatter {

namespace {

SinkOptions options() {
  return {{101, 75}, 25.0, {{"Title", "Gas ρ"}, {"Scene", "a \"comment\""}}, false, 2};
}

Image frame(int number) {
  Image image{options().size, std::vector<unsigned char>(101 * 75 * 4, 255)};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) image.rgba[i] = 10 * number;
  return image;
}

// What ffprobe says of the first stream: codec, size, frames counted by decoding; and the tags.
std::string probe(const std::filesystem::path& path) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
      "stream=codec_name,width,height,pix_fmt,nb_read_frames,r_frame_rate:format_tags=title,"
      "comment "
      "-of default=nokey=0:noprint_wrappers=1 '" +
      path.string() + "'";
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe)) output += buffer;
  pclose(pipe);
  return output;
}

void write_film(Movie& movie, int frames) {
  for (int i = 0; i < frames; ++i) movie.add(frame(i), 0.04 * i);
  movie.finish();
}

std::filesystem::path make_encoder(const std::filesystem::path& path, const std::string& script) {
  std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

}  // namespace

TEST_CASE("A film has its frames, its codec, even sides and its texts") {
  const TemporaryFolder folder;
  struct Kind {
    const char* name;
    const char* codec;
    const char* size;
  };
  for (const Kind& kind : {Kind{"film.mp4", "codec_name=h264\n", "width=102\nheight=76\n"},
                           Kind{"film.webm", "codec_name=vp9\n", "width=102\nheight=76\n"},
                           Kind{"film.mkv", "codec_name=ffv1\n", "width=101\nheight=75\n"},
                           Kind{"film.gif", "codec_name=gif\n", "width=101\nheight=75\n"}}) {
    CAPTURE(kind.name);
    Movie movie(folder / kind.name, options());
    CHECK_FALSE(std::filesystem::exists(folder / kind.name));
    write_film(movie, 20);
    const std::string facts = probe(folder / kind.name);
    CAPTURE(facts);
    CHECK(facts.find(kind.codec) != std::string::npos);
    CHECK(facts.find(kind.size) != std::string::npos);
    CHECK(facts.find("nb_read_frames=20\n") != std::string::npos);
    CHECK(facts.find("r_frame_rate=25/1\n") != std::string::npos);
    const std::string extension = std::filesystem::path(kind.name).extension();
    if (extension == ".mp4" || extension == ".webm") {
      CHECK(facts.find("pix_fmt=yuv420p\n") != std::string::npos);
    }
    if (extension != ".gif") {
      CHECK(facts.find("Gas ρ") != std::string::npos);
      CHECK(facts.find("a \"comment\"") != std::string::npos);
    }
    std::filesystem::remove(folder / kind.name);
    CHECK(folder.empty());
  }
}

TEST_CASE("An mkv has every bit of the pictures") {
  const TemporaryFolder folder;
  SinkOptions small = options();
  small.size = {3, 3};
  Image image{small.size, {}};
  for (int i = 0; i < 9; ++i) {
    const auto value = static_cast<unsigned char>(28 * i);
    image.rgba.insert(image.rgba.end(), {value, static_cast<unsigned char>(255 - value),
                                         static_cast<unsigned char>(value / 3), 255});
  }
  Movie movie(folder / "film.mkv", small);
  movie.add(image, 0.0);
  movie.finish();
  const std::string command = "ffmpeg -v error -i '" + (folder / "film.mkv").string() +
                              "' -f rawvideo -pix_fmt rgba - 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  std::vector<unsigned char> decoded(100);
  decoded.resize(std::fread(decoded.data(), 1, decoded.size(), pipe));
  pclose(pipe);
  CHECK(decoded == image.rgba);
}

TEST_CASE("An mp4 can play before it is loaded: its index comes first") {
  const TemporaryFolder folder;
  Movie movie(folder / "film.mp4", options());
  write_film(movie, 5);
  std::ifstream file(folder / "film.mp4", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  CHECK(bytes.find("moov") < bytes.find("mdat"));
  CHECK(bytes.find("moof") == std::string::npos);  // whole, no longer in fragments
}

TEST_CASE("Where an mp4 cannot be copied, it stays in fragments and plays") {
  const TemporaryFolder folder, programs;
  const auto encoder = make_encoder(
      programs / "encoder", "case \"$*\" in *'-c copy'*) exit 1 ;; esac; exec ffmpeg \"$@\"");
  {
    Movie movie(folder / "film.mp4", options(), encoder);
    write_film(movie, 20);
  }
  CHECK(probe(folder / "film.mp4").find("nb_read_frames=20\n") != std::string::npos);
  std::filesystem::remove(folder / "film.mp4");
  CHECK(folder.empty());
}

TEST_CASE("Names that look like options or protocols are names") {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  {
    Movie movie("-a:b %d.gif", options());
    CHECK_NOTHROW(write_film(movie, 2));
  }
  std::filesystem::current_path(before);
  CHECK(std::filesystem::exists(folder / "-a:b %d.gif"));
}

TEST_CASE("Without an encoder there is an error that says what to install, and no file") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(Movie(folder / "film.mp4", options(), "no-such-encoder"),
                       doctest::Contains("apt install ffmpeg"), RunError);
  CHECK(folder.empty());
}

TEST_CASE("An encoder that dies is an error with its last words, and no file") {
  const TemporaryFolder folder, programs;
  // The second reads everything, as one does that finds the disk full at the end.
  for (const char* script : {"head -c 1000 >/dev/null; echo 'disk is full' >&2; exit 1",
                             "cat >/dev/null; echo 'disk is full' >&2; exit 1"}) {
    const auto encoder = make_encoder(programs / "encoder", script);
    {
      Movie movie(folder / "film.mp4", options(), encoder);
      CHECK_THROWS_WITH_AS(write_film(movie, 100), doctest::Contains("disk is full"), RunError);
    }
    CHECK(folder.empty());
  }
}

TEST_CASE("A film that is given up leaves nothing, even while the encoder hangs") {
  const TemporaryFolder folder, programs;
  const auto encoder = make_encoder(programs / "encoder", "exec sleep 1000");
  {
    Movie movie(folder / "film.mp4", options(), encoder);
    for (int i = 0; i < 5; ++i) movie.add(frame(i), 0.0);
  }
  CHECK(folder.empty());
}

TEST_CASE("A film into a missing folder is refused at once") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(Movie(folder / "missing/film.mp4", options()),
                       doctest::Contains("No such file"), RunError);
}

}  // namespace clatter
