#include "render/output/film_join.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <sstream>

#include "engine/error.h"
#include "engine/system/platform.h"
#include "engine/system/write_file.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

// The parts in a folder by the numbers of their first pictures.
std::map<long, std::filesystem::path> parts_in(const std::filesystem::path& folder,
                                               const std::string& extension) {
  std::map<long, std::filesystem::path> parts;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto first = whole_number<long>(entry.path().stem().string());
    if (first && entry.path().extension() == extension) parts[*first] = entry.path();
  }
  return parts;
}

// The parts that make a film of `count` pictures.
std::vector<FilmPart> complete_parts(const std::filesystem::path& folder,
                                     const std::string& extension, long count) {
  const std::map<long, std::filesystem::path> found = parts_in(folder, extension);
  std::vector<FilmPart> parts;
  long next = 0;
  for (auto part = found.begin(); part != found.end() && part->first == next; ++part) {
    parts.push_back({part->second, pictures_in(part->second)});
    next += std::max(0L, parts.back().count);
  }
  if (next == count && parts.size() == found.size()) return parts;
  const auto after = found.upper_bound(next);
  throw UserError({folder.string()},
                  next < count ? fmt::format("the parts lack frame {}", next)
                               : "the parts have more frames than the film",
                  next < count ? fmt::format("draw {0:06}{1} with --frames {0}:{2}", next,
                                             extension, after == found.end() ? count : after->first)
                               : "remove the parts of other films");
}

}  // namespace

std::string reason_of(const ChildProcess& encoder) {
  const std::string words = encoder.last_words();
  return words.empty() ? "it ended early and gave no reason" : words;
}

long pictures_in(const std::filesystem::path& film, const std::string& encoder) {
  std::error_code missing;
  if (std::filesystem::file_size(film, missing) == 0 || missing) return 0;
  std::istringstream list;
  try {
    ChildProcess reader(listing_command(encoder, film));
    reader.wait();
    list.str(reader.new_words());
  } catch (const RunError&) {
    return -1;
  }
  long pictures = 0;
  for (std::string line; std::getline(list, line);) pictures += line.starts_with("0,");
  return pictures;
}

std::filesystem::path PartsFolder::safe_name(const std::string& file) const {
  return std::filesystem::path(name_while_open(opened, path.string())) / file;
}

std::filesystem::path join_films(const PartsFolder& folder, const std::vector<FilmPart>& parts,
                                 double fps, const std::filesystem::path& texts,
                                 const MovieFormat& format, const std::string& encoder) {
  std::string list = "ffconcat version 1.0\n";
  long count = 0;
  for (const FilmPart& part : parts) {
    list += fmt::format("file {}\nduration {:.9f}\n",
                        list_entry(folder.safe_name(part.path.filename().string())),
                        static_cast<double>(part.count) / fps);
    count += part.count;
  }
  write_file(folder.path / kPartList, list);

  const std::filesystem::path joined = folder.path / ("joined" + format.extension);
  unlink(joined.c_str());
  const FileDescriptor file(open(joined.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (!file) throw RunError(std::strerror(errno));
  ChildProcess joiner(joining_command(encoder, format, folder.safe_name(texts.filename().string()),
                                      folder.safe_name(kPartList),
                                      name_while_open(file, joined.string())));
  if (!joiner.wait()) {
    unlink(joined.c_str());
    throw RunError(reason_of(joiner));
  }
  const long found = pictures_in(joined, encoder);
  if (found == count) return joined;
  unlink(joined.c_str());
  throw RunError(
      fmt::format("{} has {} of {} pictures; is the disk full?", joined.string(), found, count));
}

void join_parts(const std::filesystem::path& folder, long count, double fps,
                const std::filesystem::path& path) {
  const MovieFormat& format = *find_movie_format(path.extension());
  std::error_code ignored;
  if (std::filesystem::equivalent(folder, target_of(path).parent_path(), ignored)) {
    throw UserError({path.string()}, "is in the folder of the parts",
                    "write the film to another folder");
  }
  const FileDescriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened) {
    throw UserError({folder.string()}, std::strerror(errno), "name the folder of the parts");
  }
  // Two tasks that end together join the same parts, one after the other.
  flock(opened.get(), LOCK_EX);
  const std::vector<FilmPart> parts = complete_parts(folder, format.extension, count);
  try {
    const PartsFolder place{folder, opened};
    rename_synced(join_films(place, parts, fps, parts.back().path, format), target_of(path));
  } catch (const RunError& error) {
    throw RunError("cannot write " + path.string() + ": " + error.what());
  }
  unlink((folder / kPartList).c_str());
}

}  // namespace clatter
