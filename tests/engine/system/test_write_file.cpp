#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

#include "engine/error.h"
#include "engine/system/write_file.h"
#include "tests/support/temporary_folder.h"

namespace clatter::testing {

static std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename());
  }
  return names;
}

TEST_CASE("Written files: a file is there whole, and nothing beside it") {
  const TemporaryFolder folder;
  for (const std::string& bytes :
       {std::string(), std::string(100'000, 'a'), std::string("b\0c", 3)}) {
    write_file(folder / "file", bytes);
    CHECK(bytes_of(folder / "file") == bytes);
  }
  CHECK(names_in(folder / "") == std::set<std::string>{"file"});
}

TEST_CASE("Written files: the previous file is kept under another name if asked for") {
  const TemporaryFolder folder;
  write_file(folder / "file", "first", folder / "before");
  CHECK(names_in(folder / "") == std::set<std::string>{"file"});
  write_file(folder / "file", "second", folder / "before");
  CHECK(bytes_of(folder / "file") == "second");
  CHECK(bytes_of(folder / "before") == "first");
}

TEST_CASE("Written files: a link stays, and its target is replaced") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "results");
  write_file(folder / "results/file", "old");
  std::filesystem::create_symlink("results/file", folder / "link");
  write_file(folder / "link", "new");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(bytes_of(folder / "results/file") == "new");
  CHECK(names_in(folder / "") == std::set<std::string>{"link", "results"});
}

TEST_CASE("Written files: a link to a missing file stays, and the file is made") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("second", folder / "first");
  std::filesystem::create_symlink("file", folder / "second");
  write_file(folder / "first", "new");
  CHECK(bytes_of(folder / "file") == "new");
  CHECK(names_in(folder / "") == std::set<std::string>{"file", "first", "second"});
}

TEST_CASE("Written files: files with the names of temporary files stay") {
  const TemporaryFolder folder;
  const std::string temporary = ".file." + std::to_string(getpid()) + "-0";
  for (const std::string& name : {std::string("file.part"), temporary}) {
    write_bytes(folder / name, "precious");
  }
  write_file(folder / "file", "bytes");
  require_writable(folder / "file");
  CHECK(bytes_of(folder / "file.part") == "precious");
  CHECK(bytes_of(folder / temporary) == "precious");
  CHECK(names_in(folder / "") == std::set<std::string>{temporary, "file", "file.part"});
}

// A killed run leaves its hidden files without a lock.
TEST_CASE("Written files: hidden files that killed runs have left are removed") {
  const TemporaryFolder folder;
  std::filesystem::path left;
  {
    const NewFile part = new_file_beside(folder / "killed");
    REQUIRE(part.file);
    left = part.path;
  }
  write_bytes(left.string() + ".records", "frames");
  const NewFile used = new_file_beside(folder / "other");
  const std::set<std::string> others = {".hidden", ".a.clatter-7-0.txt", "b.clatter-7-0",
                                        ".clatter-7-0", used.path.filename()};
  for (const std::string& name : others) {
    if (folder / name != used.path) write_bytes(folder / name, "precious");
  }
  require_writable(folder / "file");
  CHECK(names_in(folder / "") == others);
  write_file(folder / "file", "bytes");
  CHECK(bytes_of(folder / "file") == "bytes");
}

TEST_CASE("Written files: a run is never taken for a killed one while it writes") {
  const TemporaryFolder folder;
  std::atomic<bool> done = false;
  std::jthread remover([&] {
    while (!done) remove_leftovers(folder / "");
  });
  for (int round = 0; round < 300; ++round) {
    CHECK_NOTHROW(write_file(folder / "file", std::to_string(round)));
    CHECK(bytes_of(folder / "file") == std::to_string(round));
  }
  done = true;
}

// As the superuser too, who may write every file.
TEST_CASE("Written files: a write-protected file is an error, and stays") {
  const TemporaryFolder folder;
  write_bytes(folder / "file", "precious");
  std::filesystem::create_symlink("file", folder / "link");
  std::filesystem::permissions(folder / "file", std::filesystem::perms::owner_read);
  for (const char* name : {"file", "link"}) {
    const std::string message =
        "cannot write " + (folder / name).string() + ": it is write-protected; make it writable";
    const auto contains = doctest::Contains(message.c_str());
    CHECK_THROWS_WITH_AS(write_file(folder / name, "bytes"), contains, RunError);
    CHECK_THROWS_WITH_AS(require_writable(folder / name), contains, RunError);
  }
  CHECK(bytes_of(folder / "file") == "precious");
}

TEST_CASE("Written files: several writers of one file at once leave one whole file") {
  const TemporaryFolder folder;
  std::atomic<int> failures = 0;
  {
    std::vector<std::jthread> writers;
    for (const char letter : {'a', 'b'}) {
      writers.emplace_back([&, bytes = std::string(100'000, letter)] {
        for (int round = 0; round < 100; ++round) {
          try {
            write_file(folder / "file", bytes, folder / "before");
          } catch (const RunError&) {
            ++failures;
          }
        }
      });
    }
  }
  CHECK(failures == 0);
  for (const char* name : {"file", "before"}) {
    const std::string bytes = bytes_of(folder / name);
    CHECK(bytes == std::string(100'000, bytes.front()));
  }
  CHECK(names_in(folder / "") == std::set<std::string>{"before", "file"});
}

TEST_CASE("Written files: names that cannot be written are known before") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  const std::string longest(255, 'a');
  CHECK_NOTHROW(require_writable(folder / longest));
  CHECK_NOTHROW(write_file(folder / longest, "bytes"));
  std::filesystem::remove(folder / longest);
  for (const auto& [name, reason] :
       {std::pair<std::string, const char*>{"loop", "Too many levels of symbolic links"},
        {longest + "a", "File name too long"},
        {"missing/file", "No such file or directory"},
        {"", "Is a directory"}}) {
    CAPTURE(name);
    CHECK_THROWS_WITH_AS(require_writable(folder / name), doctest::Contains(reason), RunError);
    CHECK_THROWS_WITH_AS(write_file(folder / name, "bytes"), doctest::Contains(reason), RunError);
  }
  CHECK_NOTHROW(require_writable(folder / "file"));
  CHECK(names_in(folder / "") == std::set<std::string>{"loop"});
}

TEST_CASE("Written files: a pipe is written into") {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(is_special(pipe));
  CHECK(is_special("/dev/null"));
  CHECK_FALSE(is_special(folder / ""));
  std::string read;
  std::thread reader([&] { read = bytes_of(pipe); });
  write_file(pipe, "bytes");
  reader.join();
  CHECK(read == "bytes");
  CHECK(is_special(pipe));
}

}  // namespace clatter::testing
