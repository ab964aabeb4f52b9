#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/sweep/sweep_file.h"
#include "engine/system/file_descriptor.h"

namespace clatter {

/// One run of a sweep: a line of the manifest.
struct SweepRun {
  int id = 1;  ///< from 1
  SweepPoint settings;
  std::uint64_t seed = 1;
};

/// The reason why a run has no result.
struct SweepFailure {
  int code = 0;  ///< exit code, see exit_code.h
  std::string reason;

  /// Whether the same run would fail again: a physical stop. Other reasons may pass, such as a full
  /// disk or a missing start file.
  bool is_final() const;
};

/// The folder of a sweep. All programs that work on a sweep share it:
///   scene.toml      the scene that the sweep file names; beside it its start file
///   sweep.toml      the sweep file
///   manifest.jsonl  one line per run: id, settings, seed. Lines are only ever added.
///   results/ID.json complete results
///   failed/ID.json  exit code and reason of runs without result
///   runs/           locks, checkpoints and incomplete results
class SweepFolder {
 public:
  /// Opens the folder of a started sweep. Throws UserError if it is none.
  explicit SweepFolder(std::filesystem::path folder);

  /// Makes the folder for the text of a sweep file, or adds the new runs of the file to its folder.
  /// `file` is the name for errors, and its folder has the scene. Locks the sweep. Throws UserError
  /// if the folder belongs to another sweep or another process has the lock.
  static SweepFolder make(const std::string& text, const std::string& file,
                          const std::filesystem::path& folder);

  /// The path of the folder.
  const std::filesystem::path& path() const { return folder_; }
  /// The file of the scene.
  std::filesystem::path scene() const { return folder_ / "scene.toml"; }
  /// The result of a run.
  std::filesystem::path result(int id) const { return file("results", id, ".json"); }
  /// The result of a run before it is complete.
  std::filesystem::path part(int id) const { return file("runs", id, ".part"); }
  /// The checkpoint of a run.
  std::filesystem::path checkpoint(int id) const { return file("runs", id, ".checkpoint"); }

  /// The content of the sweep file.
  Sweep sweep() const;
  /// All runs. Run ID has the index ID - 1. Throws RunError if the manifest is damaged.
  std::vector<SweepRun> runs() const;
  /// The run of this number. Throws UserError if the manifest does not have it.
  SweepRun run(int id) const;
  /// Whether a run has a result. An empty file, as after a full disk, is none.
  bool has_result(int id) const;
  /// The numbers of the runs with a result, in order.
  std::vector<int> done() const;
  /// The numbers of the failed runs, in order.
  std::vector<int> failed() const { return ids_in("failed", ".json"); }
  /// The failure of a run. Absent if it has not failed.
  std::optional<SweepFailure> failure(int id) const;

  /// Adds the runs of these points with all seeds, except runs that the manifest has already.
  void add(const std::vector<SweepPoint>& points, const std::vector<std::uint64_t>& seeds) const;
  /// Turns the part of a run into its result, and removes all other files of the run.
  void publish(int id) const;
  /// Records a failure, and removes the part of the run.
  void fail(int id, const SweepFailure& failure) const;
  /// Removes the record of a failure before the run is repeated.
  void forget_failure(int id) const;

  /// Locks a run, or with id 0 the sweep, until unlock() or the end of this process. False if
  /// another process has the lock. Throws RunError if the folder is not writable or has no locks.
  bool lock(int id);
  /// Ends the lock of a run, or with id 0 of the sweep.
  void unlock(int id);

 private:
  SweepFolder() = default;
  std::filesystem::path file(const char* folder, int id, const char* suffix) const;
  std::vector<int> ids_in(const char* folder, const char* suffix) const;
  [[noreturn]] void fail_to_lock() const;

  std::filesystem::path folder_;
  FileDescriptor locks_;  // byte ID of this file is locked for run ID; none: not open yet
};

}  // namespace clatter
