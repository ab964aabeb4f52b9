#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "engine/system/platform.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

TEST_CASE("Platform: a nameless file keeps its bytes and is closed in child processes") {
  FileDescriptor file = nameless_file();
  REQUIRE(file);
  CHECK((fcntl(file.get(), F_GETFD) & FD_CLOEXEC) != 0);
  const std::string text = "two disks";
  CHECK(file.write_all(std::as_bytes(std::span(text))));
  std::array<char, 20> read{};
  CHECK(pread(file.get(), read.data(), read.size(), 0) == 9);
  CHECK(std::string(read.data()) == text);
}

TEST_CASE("Platform: a pipe passes bytes and is closed in child processes") {
  std::optional<Pipe> pipe = make_pipe();
  REQUIRE(pipe);
  for (const FileDescriptor* end : {&pipe->input, &pipe->output}) {
    CHECK((fcntl(end->get(), F_GETFD) & FD_CLOEXEC) != 0);
  }
  const std::string text = "collide";
  CHECK(pipe->input.write_all(std::as_bytes(std::span(text))));
  std::array<char, 20> got{};
  CHECK(read(pipe->output.get(), got.data(), got.size()) == 7);
  CHECK(std::string(got.data()) == text);
}

TEST_CASE("Platform: the name of an open file opens this file") {
  const testing::TemporaryFolder folder;
  const std::string path = (folder / "piece").string();
  FileDescriptor file(open(path.c_str(), O_RDWR | O_CREAT, 0666));
  REQUIRE(file);
  FileDescriptor again(open(name_while_open(file, path).c_str(), O_WRONLY));
  REQUIRE(again);
  const std::string text = "frame";
  CHECK(again.write_all(std::as_bytes(std::span(text))));
  std::array<char, 20> got{};
  CHECK(read(file.get(), got.data(), got.size()) == 5);
}

TEST_CASE("Platform: huge pages and the start of the peak memory change no data") {
  std::vector<char> memory(4 << 20, 'a');
  prefer_huge_pages(memory.data(), memory.size());
  restart_peak_memory();
  CHECK(memory.back() == 'a');
  CHECK(machine_memory() > 1e6);
  CHECK(machine_processors() >= 1);
}

}  // namespace clatter
