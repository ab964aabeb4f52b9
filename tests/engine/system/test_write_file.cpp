#include <doctest/doctest.h>
#include <sys/stat.h>

#include <set>
#include <thread>

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

TEST_CASE("Written files: a failure names the file and leaves the previous one") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(
      write_file(folder / "missing/file", "bytes"),
      ("cannot write " + (folder / "missing/file.part").string() + ": No such file or directory")
          .c_str(),
      RunError);
  std::filesystem::create_directory(folder / "file");
  CHECK_THROWS_AS(write_file(folder / "file", "bytes"), RunError);
  CHECK(names_in(folder / "") == std::set<std::string>{"file"});
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
