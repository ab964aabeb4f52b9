#include <doctest/doctest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "engine/error.h"
#include "engine/system/child_process.h"

namespace clatter::testing {

static int end_of(ChildProcess& process) {
  for (;;) {
    if (const std::optional<int> code = process.poll()) return *code;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// The output of the process up to this length.
static std::string words_of(ChildProcess& process, std::size_t length) {
  std::string words;
  while (words.size() < length) {
    words += process.new_words();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return words;
}

TEST_CASE("ChildProcess: reads its input, and reports success or failure") {
  ChildProcess process({"sh", "-c", "read line; echo got $line >&2; exit 7"});
  CHECK_FALSE(process.poll());
  const std::string line = "a line\n";
  CHECK(process.write({reinterpret_cast<const unsigned char*>(line.data()), line.size()}));
  CHECK_FALSE(process.wait());
  CHECK(process.poll() == 7);
  CHECK(process.last_words() == "got a line");
  ChildProcess good({"true"});
  CHECK(good.wait());
  CHECK_THROWS_WITH_AS(ChildProcess({"no-such-program"}),
                       "cannot start no-such-program: No such file or directory", RunError);
}

TEST_CASE("ChildProcess: its output is read once, and its end names a signal") {
  ChildProcess process({"sh", "-c", "echo one >&2; read line; echo two >&2; kill -KILL $$"});
  CHECK(words_of(process, 4) == "one\n");
  CHECK(process.new_words().empty());
  CHECK_FALSE(process.wait());
  CHECK(process.new_words() == "two\n");
  CHECK(process.last_words() == "one\ntwo");
  ChildProcess silent({"sh", "-c", "kill -KILL $$"});
  CHECK(end_of(silent) == 128);
  CHECK(silent.last_words() == "Killed");
}

TEST_CASE("ChildProcess: an interrupt ends it where it shares them") {
  ChildProcess shared({"sleep", "60"}, Interrupts::Shared);
  shared.interrupt();
  CHECK(end_of(shared) == 128);
}

TEST_CASE("ChildProcess: a shielded process outlives every signal that ends a run") {
  for (const int signal : kInterrupts) {
    CAPTURE(signal);
    ChildProcess child({"sh", "-c", "echo $$ >&2; read line; echo well >&2"});
    std::string words;
    while (words.find('\n') == words.npos) words += child.new_words();
    kill(std::stoi(words), signal);
    CHECK(child.wait());
    CHECK(child.new_words() == "well\n");
  }
}

// The pipe holds 64 kB.
TEST_CASE(
    "ChildProcess: after a stop request, a process that does not read its input is given up") {
  const auto stop = [] { return true; };
  for (const std::size_t bytes : {std::size_t{100}, std::size_t{1} << 20}) {
    CAPTURE(bytes);
    ChildProcess deaf({"sleep", "1000"}, Interrupts::Shielded, stop);
    CHECK(deaf.write(std::vector<unsigned char>(bytes)) == (bytes == 100));
    CHECK_FALSE(deaf.wait());
    CHECK(deaf.last_words() == "it does not read its input");
  }
  ChildProcess slow({"sh", "-c", "head -c 10 >/dev/null; sleep 0.3; cat >/dev/null; sleep 1.5"},
                    Interrupts::Shielded, stop);
  CHECK(slow.write(std::vector<unsigned char>(1 << 20)));
  CHECK(slow.wait());
}

}  // namespace clatter::testing
