#include "app/system/outputs.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "engine/error.h"
#include "engine/system/write_file.h"

namespace clatter {

[[noreturn]] static void throw_unwritable(const std::filesystem::path& path) {
  throw RunError("cannot write " + path.string() + ": " + std::strerror(errno));
}

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw_unwritable("stdout");
  }
}

void require_folder_of(const std::filesystem::path& path, const char* flag) {
  if (path.empty()) throw UserError({flag, 0, 0}, "the name is empty", "name a file or folder");
  // The path "frames/" names the folder frames.
  const std::filesystem::path name = path.has_filename() ? path : path.parent_path();
  const std::filesystem::path folder = name.has_parent_path() ? name.parent_path() : ".";
  std::error_code ignored;
  if (std::filesystem::is_directory(folder, ignored)) return;
  throw UserError({flag, 0, 0}, "there is no folder " + folder.string(),
                  "create it, or choose another folder");
}

void require_writable_file(const std::filesystem::path& path, const char* flag) {
  require_folder_of(path, flag);
  std::error_code ignored;
  if (!path.has_filename() || std::filesystem::is_directory(path, ignored)) {
    throw UserError({flag, 0, 0}, path.string() + " is a folder", "give a file in it");
  }
  require_writable(path);
}

void make_folder(const std::filesystem::path& folder, const char* flag) {
  require_folder_of(folder, flag);
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (error)
    throw RunError("cannot make the folder " + folder.string() + ": " + error.message() +
                   "; choose another folder");
  if (!may_write_in(folder)) throw_unwritable(folder);
  remove_leftovers(folder);
}

// The same text for all paths to one place.
static std::filesystem::path whole_name(const std::filesystem::path& path) {
  const std::filesystem::path name =
      std::filesystem::absolute(path.has_filename() ? path : path.parent_path());
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(target_of(name), error);
  return error ? name : whole;
}

void require_distinct(std::span<const Output> outputs,
                      std::span<const std::filesystem::path> inputs) {
  std::map<std::filesystem::path, std::string> names;
  std::error_code ignored;
  for (const auto& input : inputs) {
    if (!input.empty() && std::filesystem::exists(input, ignored)) {
      names.emplace(whole_name(input), "this command reads");
    }
  }
  for (const auto& [flag, path] : outputs) {
    if (path.empty() || is_special(path)) continue;
    const auto [other, first] = names.emplace(whole_name(path), std::string(flag) + " writes");
    if (first) continue;
    throw UserError({flag, 0, 0}, path.string() + " is the file that " + other->second,
                    "choose different names");
  }
}

}  // namespace clatter
