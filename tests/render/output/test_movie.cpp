#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "engine/error.h"
#include "render/output/movie.h"
#include "render/output/movie_format.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

using namespace testing;

namespace {

SinkOptions options() {
  return {{101, 75}, 25.0, {{"Title", "Gas ρ"}, {"Scene", "a \"comment\""}}};
}

Image frame(int number) {
  Image image{options().size, std::vector<unsigned char>(101 * 75 * 4, 255)};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) image.rgba[i] = 10 * number;
  return image;
}

// The standard output of a command line.
std::string output_of(const std::string& command) {
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    output.append(buffer.data(), size);
  }
  pclose(pipe);
  return output;
}

// Data of the first stream from ffprobe: codec, size, number of decoded frames; and the tags.
std::string probe(const std::filesystem::path& path) {
  return output_of(
      "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
      "stream=codec_name,width,height,pix_fmt,nb_read_frames,r_frame_rate:format_tags=title,"
      "comment "
      "-of default=nokey=0:noprint_wrappers=1 '" +
      path.string() + "'");
}

// Number of decoded frames.
long frames_of(const std::filesystem::path& path) {
  const std::string facts = probe(path);
  const auto at = facts.find("nb_read_frames=");
  return at == std::string::npos ? -1 : std::stol(facts.substr(at + 15));
}

// Adds the frames with these numbers, and ends the film.
void add_frames(Movie& movie, long begin, long end, Ending ending = Ending::Whole) {
  for (long i = begin; i < end; ++i) movie.add(frame(static_cast<int>(i)), {});
  movie.finish(ending);
}

void write_film(Movie& movie, int frames) {
  add_frames(movie, 0, frames);
}

SinkOptions overwriting() {
  SinkOptions changed = options();
  changed.overwrite = true;
  return changed;
}

std::string decoded(const std::filesystem::path& film, const std::string& decoder = "") {
  return output_of("ffmpeg -v error " + decoder + "-i '" + film.string() +
                   "' -f rawvideo -pix_fmt rgba - 2>&1");
}

std::filesystem::path make_encoder(const std::filesystem::path& path, const std::string& script) {
  write_bytes(path, "#!/bin/sh\n" + script + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

}  // namespace

TEST_CASE("Movie: a film has its frames, its codec, even sides and its texts") {
  const TemporaryFolder folder;
  struct Kind {
    const char* name;
    const char* codec;
    const char* size;
  };
  for (const Kind& kind : {Kind{"film.mp4", "codec_name=h264\n", "width=102\nheight=76\n"},
                           Kind{"film.webm", "codec_name=vp9\n", "width=102\nheight=76\n"},
                           Kind{"film.mov", "codec_name=prores\n", "width=101\nheight=75\n"},
                           Kind{"film.mkv", "codec_name=ffv1\n", "width=101\nheight=75\n"},
                           Kind{"film.gif", "codec_name=gif\n", "width=101\nheight=75\n"}}) {
    CAPTURE(kind.name);
    Movie movie(folder / kind.name, options());
    CHECK_FALSE(std::filesystem::exists(folder / kind.name));
    write_film(movie, 20);
    const std::string facts = probe(folder / kind.name);
    CAPTURE(facts);
    CHECK(says(facts, kind.codec));
    CHECK(says(facts, kind.size));
    CHECK(says(facts, "nb_read_frames=20\n"));
    CHECK(says(facts, "r_frame_rate=25/1\n"));
    const std::string extension = std::filesystem::path(kind.name).extension();
    if (extension == ".mp4" || extension == ".webm") {
      CHECK(says(facts, "pix_fmt=yuv420p\n"));
    }
    if (extension != ".gif") {
      CHECK(says(facts, "Gas ρ"));
      CHECK(says(facts, "a \"comment\""));
    }
    std::filesystem::remove(folder / kind.name);
    CHECK(folder.empty());
  }
}

TEST_CASE("Movie: an mkv has every bit of the pictures") {
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
  movie.add(image, {});
  movie.finish(Ending::Whole);
  CHECK(decoded(folder / "film.mkv") == std::string(image.rgba.begin(), image.rgba.end()));
}

// Firefox decodes VP9 with alpha by the matrix of BT.601, whatever the film says.
TEST_CASE("Movie: decoded by its tag, a film has the colours of its pictures") {
  const TemporaryFolder folder;
  struct Kind {
    const char* name;
    bool transparent;
    const char* matrix;
    const char* decoder;
  };
  for (const Kind& kind :
       {Kind{"film.mp4", false, "bt709", ""}, Kind{"film.webm", false, "bt709", ""},
        Kind{"film.mov", true, "bt709", ""},
        Kind{"film.webm", true, "smpte170m", "-c:v libvpx-vp9 "}}) {
    CAPTURE(kind.name);
    CAPTURE(kind.transparent);
    SinkOptions flat = options();
    flat.size = {32, 32};
    flat.transparent = kind.transparent;
    const std::array<unsigned char, 4> colour = {192, 48, 112, 255};
    Image image{flat.size, {}};
    for (int i = 0; i < 32 * 32; ++i) {
      image.rgba.insert(image.rgba.end(), colour.begin(), colour.end());
    }
    {
      Movie movie(folder / kind.name, flat);
      movie.add(image, {});
      movie.finish(Ending::Whole);
    }
    const std::string file = " '" + (folder / kind.name).string() + "' ";
    CHECK(output_of("ffprobe -v error -show_entries stream=color_space -of csv=p=0" + file) ==
          std::string(kind.matrix) + "\n");
    const std::string pixels = decoded(folder / kind.name, kind.decoder);
    REQUIRE(pixels.size() == image.rgba.size());
    int off = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      off = std::max(off, std::abs(static_cast<unsigned char>(pixels[i]) - image.rgba[i]));
    }
    CHECK(off <= 3);
  }
}

TEST_CASE("Movie: the pictures of a GIF keep their pixels in all its pieces") {
  const TemporaryFolder folder;
  Movie movie(folder / "film.gif", options());
  constexpr int kFrames = FrameSink::kPiece + 3;
  std::string expected;
  for (int i = 0; i < kFrames; ++i) {
    // Colours and places that differ from picture to picture.
    Image image = frame(i % 25);
    for (std::size_t k = 0; k < 400; ++k) image.rgba[16 * static_cast<std::size_t>(i) + k] ^= 0x55;
    for (std::size_t k = 3; k < image.rgba.size(); k += 4) image.rgba[k] = 255;
    expected.append(image.rgba.begin(), image.rgba.end());
    movie.add(image, {});
  }
  movie.finish(Ending::Whole);
  CHECK((decoded(folder / "film.gif") == expected));
}

TEST_CASE("Movie: an mp4 can play before it is loaded: its index comes first") {
  const TemporaryFolder folder;
  Movie movie(folder / "film.mp4", options());
  write_film(movie, 5);
  const std::string bytes = bytes_of(folder / "film.mp4");
  CHECK(bytes.find("moov") < bytes.find("mdat"));
  CHECK_FALSE(says(bytes, "moof"));  // complete, no longer in fragments
}

TEST_CASE("Movie: pieces that cannot be joined stay, and the error names them") {
  const TemporaryFolder folder, programs;
  const auto encoder = make_encoder(
      programs / "encoder",
      "case \"$*\" in *'-f concat'*) echo 'no room' >&2; exit 1 ;; esac; exec ffmpeg \"$@\"");
  {
    Movie movie(folder / "film.mp4", options(), encoder);
    const std::string named =
        "no room; earlier pictures are in " + (folder / "film.mp4.part").string();
    CHECK_THROWS_WITH_AS(write_film(movie, FrameSink::kPiece + 20),
                         doctest::Contains(named.c_str()), RunError);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "film.mp4"));
  CHECK(frames_of(folder / "film.mp4.part/000000.mp4") == FrameSink::kPiece);
  CHECK(frames_of(folder / "film.mp4.part/000060.mp4") == 20);
}

TEST_CASE("Movie: a film that was cut and resumed is the same film, to the byte") {
  const TemporaryFolder folder;
  constexpr long kFrames = 2 * FrameSink::kPiece + 7, kCut = FrameSink::kPiece + 30;
  for (const std::string extension : {".mp4", ".mov", ".webm", ".gif", ".mkv"}) {
    CAPTURE(extension);
    const auto whole = folder / ("whole" + extension), cut = folder / ("cut" + extension);
    {
      Movie movie(whole, options());
      write_film(movie, kFrames);
    }
    {
      Movie movie(cut, options());
      add_frames(movie, 0, kCut, Ending::Cut);
    }
    CHECK(frames_of(cut) == kCut);
    SinkOptions on = options();
    on.goes_on = true;
    on.next = FrameSink::kPiece;
    {
      Movie movie(cut, on);
      add_frames(movie, FrameSink::kPiece, kFrames);
    }
    CHECK(frames_of(cut) == kFrames);
    CHECK(bytes_of(cut) == bytes_of(whole));
    std::filesystem::remove(cut);
    std::filesystem::remove(whole);
    CHECK(folder.empty());
  }
}

// Pieces end at the same numbers in every film.
TEST_CASE("Movie: a part that begins within a piece has all its pictures, also if it was cut") {
  const TemporaryFolder folder;
  constexpr long kBegin = 37, kEnd = 2 * FrameSink::kPiece + 7;
  const auto whole = folder / "whole.mkv", cut = folder / "cut.mkv";
  SinkOptions part = options();
  part.begin = part.next = kBegin;
  {
    Movie movie(whole, part);
    add_frames(movie, kBegin, kEnd);
  }
  CHECK(frames_of(whole) == kEnd - kBegin);
  {
    Movie movie(cut, part);
    add_frames(movie, kBegin, kEnd - 3, Ending::Cut);
  }
  CHECK(frames_of(cut) == kEnd - 3 - kBegin);
  part.goes_on = true;
  part.next = 2 * FrameSink::kPiece;
  {
    Movie movie(cut, part);
    add_frames(movie, part.next, kEnd);
  }
  CHECK(bytes_of(cut) == bytes_of(whole));
}

TEST_CASE("Movie: the format follows the given name, also of a link to a name without extension") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("store", folder / "film.mkv");
  for (int film = 0; film < 2; ++film) {
    Movie movie(folder / "film.mkv", options());
    write_film(movie, 3 + film);
    CHECK(std::filesystem::is_symlink(folder / "film.mkv"));
    CHECK(frames_of(folder / "store") == 3 + film);
  }
  CHECK(std::distance(std::filesystem::directory_iterator(folder / ""), {}) == 2);
  CHECK(bytes_of(folder / "store").starts_with("\x1a\x45\xdf\xa3"));  // a Matroska file

  std::filesystem::create_symlink("/dev/null", folder / "device.gif");
  REQUIRE(mkfifo((folder / "pipe.mp4").c_str(), 0600) == 0);
  for (const char* name : {"device.gif", "pipe.mp4"}) {
    CHECK_THROWS_WITH_AS(Movie(folder / name, options()),
                         doctest::Contains("not of a device or a pipe"), UserError);
  }
}

TEST_CASE("Movie: the pieces of a film that was cut are not overwritten unless asked") {
  const TemporaryFolder folder;
  {
    Movie movie(folder / "film.mp4", options());
    add_frames(movie, 0, 1, Ending::Cut);
  }
  CHECK_THROWS_WITH_AS(Movie(folder / "film.mp4", options()), doctest::Contains("--resume"),
                       UserError);
  SinkOptions later = options();
  later.next = 2 * FrameSink::kPiece;
  later.goes_on = true;
  CHECK_THROWS_WITH_AS(Movie(folder / "film.mp4", later), doctest::Contains("000060.mp4"),
                       UserError);
  Movie movie(folder / "film.mp4", overwriting());
  write_film(movie, 3);
  CHECK(frames_of(folder / "film.mp4") == 3);
  CHECK_FALSE(std::filesystem::exists(folder / "film.mp4.part"));
}

TEST_CASE("Movie: only files of films are removed from the folder of the pieces") {
  const TemporaryFolder folder;
  const auto part = folder / "film.mp4.part";
  std::filesystem::create_directory(part);
  std::filesystem::create_directory(part / "more");
  const std::vector<std::string> others = {"notes.txt", "1.mp4", "000000.png", "more/000000.mp4"};
  const std::vector<std::string> own = {"000060.mp4", "1000020.mp4", "joined.mp4",
                                        "texts.txt",  "pieces.txt",  ".texts.txt.7-0"};
  for (const auto* names : {&others, &own}) {
    for (const std::string& name : *names) write_bytes(part / name, "precious");
  }
  {
    Movie movie(folder / "film.mp4", overwriting());
    write_film(movie, 3);
  }
  CHECK(frames_of(folder / "film.mp4") == 3);
  for (const std::string& name : others) CHECK(bytes_of(part / name) == "precious");
  for (const std::string& name : own) CHECK_FALSE(std::filesystem::exists(part / name));
}

TEST_CASE("Movie: pieces are not written through a link in the place of their folder") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "mine");
  write_bytes(folder / "mine/000000.mp4", "precious");
  std::filesystem::create_symlink("mine", folder / "film.mp4.part");
  CHECK_THROWS_WITH_AS(Movie(folder / "film.mp4", overwriting()), doctest::Contains("is a link"),
                       UserError);
  CHECK(bytes_of(folder / "mine/000000.mp4") == "precious");
}

TEST_CASE("Movie: names that look like options or protocols are names") {
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

TEST_CASE("Movie: without an encoder an error names the package, and there is no file") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(Movie(folder / "film.mp4", options(), "no-such-encoder"),
                       doctest::Contains("apt install ffmpeg"), RunError);
  CHECK(folder.empty());
}

TEST_CASE(
    "Movie: the death of an encoder is an error with its last words, and leaves no empty film") {
  const TemporaryFolder folder, programs;
  // The second script reads everything, like an encoder that finds a full disk at the end.
  for (const auto& [script, reason] :
       {std::pair("head -c 1000 >/dev/null; echo 'disk is full' >&2; exit 1", "disk is full"),
        {"cat >/dev/null; echo 'disk is full' >&2; exit 1", "disk is full"},
        {"cat >/dev/null; kill -9 $$", ": Killed"},
        {"exit 0", "gave no reason"}}) {
    CAPTURE(script);
    const auto encoder = make_encoder(programs / "encoder", script);
    {
      Movie movie(folder / "film.mp4", options(), encoder);
      CHECK_THROWS_WITH_AS(write_film(movie, 100), doctest::Contains(reason), RunError);
    }
    CHECK(folder.empty());
  }
}

TEST_CASE("Movie: an encoder that loses pictures and succeeds is an error") {
  const TemporaryFolder folder, programs;
  const auto encoder =
      make_encoder(programs / "encoder",
                   "case \"$*\" in *rawvideo*) exec cat >/dev/null ;; esac; exec ffmpeg \"$@\"");
  {
    Movie movie(folder / "film.mp4", options(), encoder);
    CHECK_THROWS_WITH_AS(write_film(movie, 100), doctest::Contains("has 0 of 60 pictures"),
                         RunError);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

TEST_CASE("Movie: a joined film that lacks pictures is an error, and the pieces stay") {
  const TemporaryFolder folder, programs;
  // As on a full disk: ffmpeg succeeds although the end of the film was not written.
  const auto encoder = make_encoder(programs / "encoder",
                                    "ffmpeg \"$@\" || exit 1\n"
                                    "for last; do :; done\n"
                                    "case \"$*\" in *'-f concat'*) truncate -s 3000 "
                                    "\"${last#file:}\" ;; esac");
  for (const std::string name : {"film.mp4", "film.webm", "film.mkv"}) {
    CAPTURE(name);
    {
      Movie movie(folder / name, options(), encoder);
      const std::string named = " of 80 pictures; is the disk full?; earlier pictures are in " +
                                (folder / (name + ".part")).string();
      CHECK_THROWS_WITH_AS(write_film(movie, 80), doctest::Contains(named.c_str()), RunError);
    }
    CHECK_FALSE(std::filesystem::exists(folder / name));
    const std::string extension = std::filesystem::path(name).extension();
    CHECK(frames_of(folder / (name + ".part/000000" + extension)) == 60);
    CHECK(frames_of(folder / (name + ".part/000060" + extension)) == 20);
    CHECK_FALSE(std::filesystem::exists(folder / (name + ".part/joined" + extension)));
  }
}

TEST_CASE("Movie: an earlier piece that was cut is an error that names it") {
  const TemporaryFolder folder;
  Movie movie(folder / "film.mp4", options());
  for (int i = 0; i < 70; ++i) movie.add(frame(i), {});
  const auto piece = folder / "film.mp4.part/000000.mp4";
  std::filesystem::resize_file(piece, std::filesystem::file_size(piece) / 2);
  const std::string named = piece.string() + " is not the piece that was drawn";
  CHECK_THROWS_WITH_AS(movie.finish(Ending::Whole), doctest::Contains(named.c_str()), RunError);
  CHECK_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

TEST_CASE("Movie: a film does not continue from a changed piece") {
  const TemporaryFolder folder;
  SinkOptions resumed = options();
  {
    Movie movie(folder / "film.mp4", options());
    for (int i = 0; i < 70; ++i) movie.add(frame(i), {});
    resumed.checksums = movie.checksums();
    movie.finish(Ending::Cut);
  }
  CHECK(resumed.checksums.size() == 1);
  resumed.next = 60;
  resumed.goes_on = true;
  CHECK_NOTHROW(Movie(folder / "film.mp4", resumed));
  const auto piece = folder / "film.mp4.part/000000.mp4";
  std::filesystem::resize_file(piece, 0);
  const std::string named =
      piece.string() + " is not the piece that was drawn; draw the film again";
  CHECK_THROWS_WITH_AS(Movie(folder / "film.mp4", resumed), doctest::Contains(named.c_str()),
                       DamagedPiece);
}

TEST_CASE("Movie: two films of one name at once are refused") {
  const TemporaryFolder folder;
  Movie first(folder / "film.mp4", options());
  CHECK_THROWS_WITH_AS(Movie(folder / "film.mp4", overwriting()),
                       doctest::Contains("another program"), UserError);
  write_film(first, 3);
  CHECK(frames_of(folder / "film.mp4") == 3);
  CHECK_NOTHROW(Movie(folder / "film.mp4", overwriting()));
}

TEST_CASE("Movie: the list of pieces has quoted URLs") {
  CHECK(list_entry("/a?b/it's.mp4") == R"('file:/a?b/it'\''s.mp4')");
}

TEST_CASE("Movie: names may have any character, and texts any length") {
  const TemporaryFolder folder;
  SinkOptions with_texts = options();
  const std::string scene(300'000, '#');
  with_texts.texts = {{"Title", "a=b;c#d\\e"}, {"Scene", scene + "\nend = 1\n"}};
  const auto film = folder / "a?b#c%d e:f.mp4";
  Movie movie(film, with_texts);
  write_film(movie, 70);
  CHECK(frames_of(film) == 70);
  const std::string facts = probe(film);
  CHECK(facts.find("TAG:title=a=b;c#d\\e\n") != std::string::npos);
  CHECK(facts.find("Scene: " + scene + "\nend = 1\n") != std::string::npos);
}

TEST_CASE("Movie: an encoder that dies later leaves the pieces before, and those are named") {
  const TemporaryFolder folder, programs;
  const auto encoder =
      make_encoder(programs / "encoder",
                   "for last; do :; done\n"
                   "case $(readlink -f \"${last#file:}\") in *000060*) exit 1 ;; esac\n"
                   "exec ffmpeg \"$@\"");
  {
    Movie movie(folder / "film.webm", options(), encoder);
    const std::string named = "earlier pictures are in " + (folder / "film.webm.part").string();
    CHECK_THROWS_WITH_AS(write_film(movie, 100), doctest::Contains(named.c_str()), RunError);
  }
  CHECK(frames_of(folder / "film.webm.part/000000.webm") == FrameSink::kPiece);
  CHECK_FALSE(std::filesystem::exists(folder / "film.webm.part/000060.webm"));
}

TEST_CASE("Movie: a film that is given up leaves nothing, even while the encoder hangs") {
  const TemporaryFolder folder, programs;
  const auto encoder = make_encoder(programs / "encoder",
                                    "case \"$*\" in *rawvideo*) exec sleep 1000 ;; esac; exit 1");
  {
    Movie movie(folder / "film.mp4", options(), encoder);
    for (int i = 0; i < 5; ++i) movie.add(frame(i), {});
  }
  CHECK(folder.empty());
}

TEST_CASE("Movie: a film into a missing folder is refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(Movie(folder / "missing/film.mp4", options()),
                       doctest::Contains("No such file"), RunError);
}

}  // namespace clatter
