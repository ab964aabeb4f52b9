#include "app/film/film_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/measure/feature_cost.h"
#include "app/system/outputs.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/state_file.h"
#include "engine/system/read_file.h"
#include "engine/system/write_file.h"
#include "render/output/frame_sink.h"
#include "render/output/movie.h"

namespace clatter {

namespace {

constexpr const char* kStartState = "start.csv";

// Ranges of frames such as 000120:180, of about equal length. They begin at whole pieces, so that
// parts and whole film have the same pieces.
std::vector<std::string> parts_of(const FilmJob& job) {
  const long count = job.film.times.count;
  const long pieces = (count + FrameSink::kPiece - 1) / FrameSink::kPiece;
  const long parts = std::min<long>(job.tasks, pieces);
  const auto begin = [&](long part) {
    return std::min(count, part * pieces / parts * FrameSink::kPiece);
  };
  std::vector<std::string> words;
  for (long part = 0; part < parts; ++part) {
    words.push_back(fmt::format("{:06}:{}", begin(part), begin(part + 1)));
  }
  return words;
}

// The command of the whole film without its output, as words of an array in Bash.
std::string film_command(const FilmJob& job) {
  const FilmState& film = job.film;
  const FrameTimes& times = film.times;
  std::string words = fmt::format(
      "{} render \"$folder/scene.toml\" --quiet --seed={}\n"
      "  --from={} --to={} --speed={} --fps={} --size={} --supersample={} --shutter={}\n"
      "  --threads={} --backend={}",
      program_word(), job.seed, times.from, times.of(times.count), times.speed, times.fps,
      size_text(film.size), film.samples, film.shutter, job.threads, name_of(job.backend));
  if (!film.overlay) words += " --set=view.overlay=false";
  if (film.transparent) words += " --transparent";
  if (film.encoding != Encoding::Balanced) words += " --encoding=" + name_of(film.encoding);
  return words;
}

// The film or folder of the job as a word for the shell.
std::string out_word(const FilmJob& job) {
  return shell_word(std::filesystem::absolute(job.out).string());
}

// The lines of a task that draw its part, or nothing if the part is complete.
std::string drawing_lines(const FilmJob& job) {
  const bool film = Movie::knows(job.out.extension());
  const std::string extension = job.out.extension().string();
  std::string lines = "film=(" + film_command(job) + ")\n";
  if (film) {
    lines += fmt::format("is_complete() {{ [[ -e $folder/$1{0} && ! -e $folder/$1{0}.part ]]; }}\n",
                         extension);
  }
  const std::string out = film ? "$folder/$part" + extension : out_word(job);
  lines += fmt::format(R"(part=${{task%:*}}
checkpoint=$folder/$part.checkpoint
draw=("${{film[@]}}" --frames="$task" --out={} --checkpoint="$checkpoint")
if [[ -e $checkpoint ]]; then
  draw+=(--resume="$checkpoint")
else
  draw+=(--overwrite)
fi
)",
                       film ? '"' + out + '"' : out);
  if (film) lines += "is_complete $part && draw=(true)\n";
  return lines + "\"${draw[@]}\"";
}

// The task that ends last joins the parts.
std::string joining_lines(const FilmJob& job) {
  if (!Movie::knows(job.out.extension())) return "";
  return "for word in \"${tasks[@]}\"; do is_complete \"${word%:*}\" || exit 0; done\n"
         "\"${film[@]}\" --join=\"$folder\" --out=" +
         out_word(job) + "\ncode=$?\n";
}

// Megabytes of a task: the gas, the pictures on their way, and the encoder. The largest encoder,
// of WebM, needs 165 bytes per pixel.
double memory_of(const FilmJob& job) {
  constexpr double kPrograms = 250.0, kEncoder = 250.0, kSample = 16.0, kMargin = 1.5;
  const Size size = job.film.size;
  const double picture =
      (kEncoder + kSample * job.film.samples * job.film.samples) * size.width * size.height;
  return std::ceil(kPrograms + 1e-6 * (kMargin * memory_of(job.scene) + picture));
}

// The scene, with the start state in the folder of the job: the user may change the own file.
std::string scene_text(Scene scene) {
  if (scene.particles.start.layout == Layout::File) scene.particles.start.file = kStartState;
  return scene_to_toml(scene);
}

// Empty unless the particles start from a file.
std::string start_text(const Scene& scene) {
  const Start& start = scene.particles.start;
  if (start.layout != Layout::File) return "";
  return std::visit([&](const auto& state) { return state_to_csv(state, scene.species); },
                    start.state);
}

// Empty if the file does not exist.
std::string text_of(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return "";
  return read_file(file.string(), std::numeric_limits<int>::max(), "");
}

// A script without its options for Slurm, which do not change the film.
std::string without_options(const std::string& script) {
  const std::size_t begin = script.find("\ntasks=(");
  return begin == script.npos ? "" : script.substr(begin);
}

// Whether a path is a folder with files.
bool has_files(const std::filesystem::path& folder) {
  std::error_code error;
  const bool empty = std::filesystem::is_empty(folder, error);
  return !error && std::filesystem::is_directory(folder) && !empty;
}

// Whether a task writes this name: NUMBER.EXTENSION, its folder of pieces, or a checkpoint.
bool is_of_task(const std::string& name, const std::string& extension) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  const std::string rest = name.substr(digits);
  const bool checkpoint = rest == ".checkpoint" || rest == ".checkpoint.previous";
  const bool part = !extension.empty() && (rest == extension || rest == extension + ".part");
  return digits >= 6 && (part || checkpoint);
}

// Removes the parts and checkpoints of an earlier film.
void remove_parts(const std::filesystem::path& folder, const std::string& extension) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (is_of_task(entry.path().filename(), extension)) std::filesystem::remove_all(entry.path());
  }
}

// Throws the errors of the output before tasks wait in a queue.
void require_output(const std::filesystem::path& out) {
  if (Movie::knows(out.extension())) return require_writable_file(out, "--out");
  require_folder_format(out);
  if (std::filesystem::exists(out)) make_folder(out, "--out");
}

}  // namespace

std::filesystem::path write_film_job(const FilmJob& job) {
  require_output(job.out);
  std::filesystem::path out = target_of(job.out.has_filename() ? job.out : job.out.parent_path());
  ArrayJob array;
  array.folder = std::filesystem::absolute(out += ".slurm");
  array.tasks = parts_of(job);
  const std::optional<std::size_t> most = most_array_tasks();
  require_array_size(array, most, "--slurm", fmt::format("give at most {}", most.value_or(0)));
  array.body = drawing_lines(job);
  array.after = joining_lines(job);
  array.megabytes = memory_of(job);
  // A task draws and encodes at the same time.
  array.processors = Movie::knows(job.out.extension()) ? 2 : std::max(2, job.threads);
  array.limits = job.limits;
  const std::string script = batch_script(array), scene = scene_text(job.scene),
                    start = start_text(job.scene);
  const std::filesystem::path script_file = array.folder / "job.sh",
                              scene_file = array.folder / "scene.toml",
                              start_file = array.folder / kStartState;
  const bool same_film = without_options(text_of(script_file)) == without_options(script) &&
                         text_of(scene_file) == scene &&
                         (start.empty() || text_of(start_file) == start);
  if (!same_film && !job.overwrite) {
    if (has_files(array.folder)) {
      throw UserError({array.folder.string()}, "has the job of another film",
                      "replace it with --overwrite, or give another --out");
    }
    if (has_files(job.out)) {
      throw UserError({job.out.string()}, "has the pictures of another film",
                      "replace them with --overwrite, or give another --out");
    }
  }
  make_folder(array.folder, "--out");
  if (!same_film || job.overwrite) remove_parts(array.folder, job.out.extension());
  if (!start.empty()) write_file(start_file, start);
  write_file(scene_file, scene);
  write_file(script_file, script);
  return script_file;
}

}  // namespace clatter
