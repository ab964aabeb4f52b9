#include "render/output/film_join.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <span>
#include <sstream>

#include "engine/system/platform.h"
#include "engine/whole_number.h"

namespace clatter {

std::string with_install_advice(const RunError& error) {
  const std::string words = error.what();
  const bool missing = words.ends_with(std::strerror(ENOENT));
  return words + (missing ? "; films need ffmpeg (apt install ffmpeg)" : "");
}

namespace {

// A list of the pictures in a film.
struct Listing {
  long pictures = 0;
  std::string size;    // WIDTHxHEIGHT
  double first = 0.0;  // time of the first picture, in seconds
  double last = 0.0;   // time of the last picture, in seconds
  double tick = 0.0;   // precision of times, in seconds
};

// Throws RunError if the encoder cannot start.
Listing listing_of(const std::filesystem::path& film, const std::string& encoder) {
  Listing found;
  std::error_code missing;
  if (std::filesystem::file_size(film, missing) == 0 || missing) return found;
  ChildProcess reader(listing_command(encoder, film));
  reader.wait();
  std::istringstream list(reader.new_words());
  for (std::string line; std::getline(list, line);) {
    long ticks = 0, numerator = 0, denominator = 1;
    if (std::sscanf(line.c_str(), "#tb 0: %ld/%ld", &numerator, &denominator) == 2) {
      found.tick = static_cast<double>(numerator) / static_cast<double>(denominator);
    } else if (line.starts_with("#dimensions 0: ")) {
      found.size = line.substr(15);
    } else if (std::sscanf(line.c_str(), "0, %*d, %ld", &ticks) == 1) {
      const double time = static_cast<double>(ticks) * found.tick;  // in the order of encoding
      found.first = found.pictures == 0 ? time : std::min(found.first, time);
      found.last = std::max(found.last, time);
      ++found.pictures;
    }
  }
  return found;
}

// Whether the times of the pictures are multiples of 1/fps, up to their rounding.
bool has_rate(const Listing& part, double fps) {
  const double time = static_cast<double>(part.pictures - 1) / fps;
  return std::abs(part.last - part.first - time) <= 1.01 * part.tick;
}

// The parts in a folder by the numbers of their first pictures.
std::map<long, std::filesystem::path> parts_in(const std::filesystem::path& folder,
                                               const std::string& extension) {
  std::map<long, std::filesystem::path> parts;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto first = whole_number<long>(entry.path().stem().string());
    if (!first || entry.path().extension() != extension) continue;
    const auto [other, alone] = parts.emplace(*first, entry.path());
    if (alone) continue;
    const auto [before, after] =
        std::minmax({other->second.filename().string(), entry.path().filename().string()});
    throw UserError({folder.string()},
                    fmt::format("{} and {} begin at the same frame", before, after),
                    "remove one of them");
  }
  return parts;
}

void require_complete(const std::map<long, std::filesystem::path>& found,
                      const std::vector<FilmPart>& parts, long count,
                      const std::filesystem::path& folder, const std::string& extension) {
  long next = 0;
  for (const FilmPart& part : parts) next += part.count;
  if (next == count && parts.size() == found.size()) return;
  const auto after = found.upper_bound(next);
  throw UserError({folder.string()},
                  next < count ? fmt::format("the parts lack frame {}", next)
                               : "the parts have more frames than the film",
                  next < count ? fmt::format("draw {0:06}{1} with --frames {0}:{2}", next,
                                             extension, after == found.end() ? count : after->first)
                               : "remove the parts of other films");
}

void require_alike(const std::vector<FilmPart>& parts, const std::vector<Listing>& listings,
                   double fps) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string name = parts[i].path.string();
    if (listings[i].size != listings[0].size) {
      throw UserError({name},
                      fmt::format("its size is {}, and the size of {} is {}", listings[i].size,
                                  parts[0].path.filename().string(), listings[0].size),
                      "draw all parts with one --size");
    }
    if (!has_rate(listings[i], fps)) {
      throw UserError({name}, fmt::format("its frame rate is not {}", fps),
                      "give the --fps of the parts, or draw this part again");
    }
  }
}

// The parts that make a film of `count` pictures.
std::vector<FilmPart> complete_parts(const std::filesystem::path& folder,
                                     const std::string& extension, long count, double fps) {
  const std::map<long, std::filesystem::path> found = parts_in(folder, extension);
  std::vector<FilmPart> parts;
  std::vector<Listing> listings;
  long next = 0;
  for (auto part = found.begin(); part != found.end() && part->first == next; ++part) {
    try {
      listings.push_back(listing_of(part->second, "ffmpeg"));
    } catch (const RunError& error) {
      throw RunError(with_install_advice(error));
    }
    parts.push_back({part->second, listings.back().pictures});
    next += parts.back().count;
  }
  require_complete(found, parts, count, folder, extension);
  require_alike(parts, listings, fps);
  return parts;
}

// A new file, removed at the end unless it was renamed.
struct TemporaryFile : NewFile {
  explicit TemporaryFile(const std::filesystem::path& target) : NewFile(new_file_beside(target)) {
    if (!file) throw RunError(std::strerror(errno));
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

}  // namespace

std::string reason_of(const ChildProcess& encoder) {
  const std::string words = encoder.last_words();
  return words.empty() ? "it ended early and gave no reason" : words;
}

long pictures_in(const std::filesystem::path& film, const std::string& encoder) {
  try {
    if (const std::optional<long> pictures = pictures_in_gif(film)) return *pictures;
    return listing_of(film, encoder).pictures;
  } catch (const RunError&) {
    return -1;
  }
}

std::filesystem::path PartsFolder::safe_name(const std::string& file) const {
  return std::filesystem::path(name_while_open(opened, path.string())) / file;
}

// Joins films by the encoder, without encoding. Throws if the film lacks pictures.
static void copy_films(const PartsFolder& folder, const std::vector<FilmPart>& parts, double fps,
                       const std::filesystem::path& texts, const std::string& sound,
                       const MovieFormat& format, NewFile& list, const NewFile& joined,
                       const std::string& encoder) {
  long count = 0;
  std::string entries = "ffconcat version 1.0\n";
  for (const FilmPart& part : parts) {
    entries += fmt::format("file {}\nduration {:.9f}\n",
                           list_entry(folder.safe_name(part.path.filename().string())),
                           static_cast<double>(part.count) / fps);
    count += part.count;
  }
  if (!list.file.write_all(std::as_bytes(std::span(entries)))) {
    throw RunError(list.path.string() + ": " + std::strerror(errno));
  }
  ChildProcess joiner(joining_command(encoder, format, folder.safe_name(texts.filename().string()),
                                      sound.empty() ? "" : folder.safe_name(sound), list.path,
                                      name_while_open(joined.file, joined.path.string())));
  if (!joiner.wait()) throw RunError(reason_of(joiner));
  const long found = pictures_in(joined.path, encoder);
  if (found == count) return;
  throw RunError(fmt::format("{} has {} of {} pictures; is the disk full?", joined.path.string(),
                             found, count));
}

// The encoder would copy the heads of GIFs between their pictures.
void join_films(const PartsFolder& folder, const std::vector<FilmPart>& parts, double fps,
                const std::filesystem::path& texts, const std::string& sound,
                const MovieFormat& format, NewFile& list, NewFile& joined,
                const std::string& encoder) {
  try {
    if (format.muxer == "gif") {
      join_gifs(parts, fps, joined.file);
    } else {
      copy_films(folder, parts, fps, texts, sound, format, list, joined, encoder);
    }
  } catch (const RunError&) {
    std::error_code ignored;
    std::filesystem::remove(joined.path, ignored);
    throw;
  }
}

void require_no_device(const std::filesystem::path& path) {
  if (!is_special(path)) return;
  throw UserError({path.string()}, "this is not a regular file",
                  "give the name of a file, not of a device or a pipe");
}

void join_parts(const std::filesystem::path& folder, long count, double fps,
                const std::filesystem::path& path) {
  const MovieFormat& format = *find_movie_format(path.extension());
  const std::filesystem::path target = target_of(path);
  require_no_device(target);
  std::error_code ignored;
  if (std::filesystem::equivalent(folder, std::filesystem::absolute(target).parent_path(),
                                  ignored)) {
    throw UserError({path.string()}, "is in the folder of the parts",
                    "write the film to another folder");
  }
  const FileDescriptor opened = open_folder(folder);
  if (!opened) {
    throw UserError({folder.string()}, std::strerror(errno), "name the folder of the parts");
  }
  try {
    const std::vector<FilmPart> parts = complete_parts(folder, format.extension, count, fps);
    // Two tasks that end together write the same film to files of their own.
    TemporaryFile list(target), joined(target);
    join_films({folder, opened}, parts, fps, parts.back().path, "", format, list, joined);
    rename_synced(joined.path, target);
  } catch (const RunError& error) {
    throw RunError("cannot write " + path.string() + ": " + error.what());
  }
}

}  // namespace clatter
