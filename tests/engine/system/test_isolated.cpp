#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/system/isolated.h"
#include "engine/system/platform.h"

namespace clatter::testing {

namespace {

constexpr WorkLimits kGenerous{.memory = 4'000'000'000, .processor_time = 100, .idle_time = 1000};

std::string bytes_after(const std::function<std::string()>& work) {
  const WorkOutcome outcome = run_isolated(work, kGenerous);
  CHECK(outcome.failure.empty());
  return outcome.bytes;
}

// Why work has no result.
std::string failure_of(const std::function<void()>& work, WorkLimits limits = kGenerous) {
  const WorkOutcome outcome = run_isolated(
      [&] {
        work();
        return std::string("a result");
      },
      limits);
  CHECK(outcome.bytes.empty() != outcome.failure.empty());
  return outcome.failure;
}

// Takes a frame of the stack for each of `depth` calls.
int deep(int depth) {
  volatile char frame[1000] = {};
  frame[depth % 1000] = 1;
  return depth == 0 ? 0 : deep(depth - 1) + frame[depth % 1000];
}

}  // namespace

TEST_CASE("Isolated work: all its bytes arrive, and its changes of memory do not") {
  CHECK(bytes_after([] { return std::string(); }).empty());
  std::string long_text(10'000'000, '\0');
  for (std::size_t k = 0; k < long_text.size(); ++k) long_text[k] = static_cast<char>(k % 251);
  int changed = 0;
  const std::string arrived = bytes_after([&] {
    changed = 1;
    return long_text;
  });
  CHECK((arrived == long_text));
  CHECK(changed == 0);
}

TEST_CASE("Isolated work: a crash is its outcome") {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGKILL}) {
    CAPTURE(signal);
    CHECK(failure_of([&] { raise(signal); }) == "crashed (" + std::string(strsignal(signal)) + ')');
  }
  CHECK(failure_of([] { throw 1; }) == "crashed (Aborted)");
  // A stack of 8 MB overflows. One without a limit exceeds the memory.
  CHECK(failure_of([] { deep(100'000'000); }) == "crashed (Segmentation fault)");
}

TEST_CASE("Isolated work: endless work is ended") {
  WorkLimits limits = kGenerous;
  limits.processor_time = 1;
  volatile bool endless = true;
  CHECK(failure_of(
            [&] {
              while (endless) continue;
            },
            limits) == "gave no answer within 1 seconds of CPU time");
  limits.idle_time = 1;
  CHECK(failure_of([] { pause(); }, limits) == "gave no answer within 1 seconds");
}

TEST_CASE("Isolated work: work that allocates without end is ended") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  MESSAGE("[skipped] a program with a sanitizer has no limit of the address space");
#else
  WorkLimits limits = kGenerous;
  limits.memory = 1'000'000'000;
  std::vector<std::string> kept;
  CHECK(failure_of(
            [&] {
              for (;;) kept.emplace_back(10'000'000, 'x');
            },
            limits) == "needs more than 1000 MB of memory");
  CHECK(failure_of([&] { kept.emplace_back(900'000'000, 'x'); }, kGenerous).empty());
#endif
}

TEST_CASE("Isolated work: an error keeps its parts") {
  const std::string problem = "a \"problem\"\n with 3 lines\n and a zero" + std::string(1, '\0');
  const UserError sent({"a file; 1.h5md", 12, 7}, problem, "");
  try {
    run_isolated([&]() -> std::string { throw sent; }, kGenerous);
    FAIL("no error");
  } catch (const UserError& error) {
    CHECK(error.place().file == "a file; 1.h5md");
    CHECK(error.place().line == 12);
    CHECK(error.place().column == 7);
    CHECK(error.problem() == problem);
    CHECK(error.advice().empty());
    CHECK(std::string(error.what()) == sent.what());
  }
  CHECK_THROWS_WITH_AS(
      run_isolated([]() -> std::string { throw RunError("a full disk"); }, kGenerous),
      "a full disk", RunError);
  CHECK_THROWS_WITH_AS(
      run_isolated([]() -> std::string { throw std::out_of_range("another"); }, kGenerous),
      "another", RunError);
  CHECK_THROWS_WITH_AS(run_isolated([]() -> std::string { _exit(0); }, kGenerous),
                       "a child process has ended with exit code 0", RunError);
}

TEST_CASE("Isolated work: buffered output of this program is written once") {
  std::optional<Pipe> pipe = make_pipe();
  REQUIRE(pipe);
  std::FILE* file = fdopen(dup(pipe->input.get()), "w");
  std::fputs("once", file);
  CHECK(bytes_after([] { return std::string("x"); }) == "x");
  std::fclose(file);
  pipe->input.close();
  char text[100] = {};
  CHECK(read(pipe->output.get(), text, sizeof text) == 4);
  CHECK(std::string(text) == "once");
  CHECK(read(pipe->output.get(), text, sizeof text) == 0);
}

// Inner work waits for ever. The outer work, which waits for it, is killed.
TEST_CASE("Isolated work: it ends with the process that started it") {
  if (std::isinf(machine_memory())) {
    MESSAGE("[skipped] POSIX alone cannot do this");
    return;
  }
  std::optional<Pipe> pipe = make_pipe();
  REQUIRE(pipe);
  WorkLimits limits = kGenerous;
  limits.idle_time = 1;
  const auto endless = []() -> std::string {
    for (;;) pause();
  };
  CHECK(failure_of([&] { run_isolated(endless, kGenerous); }, limits) ==
        "gave no answer within 1 seconds");
  pipe->input.close();
  char byte = 0;
  CHECK(read(pipe->output.get(), &byte, 1) == 0);  // no process has the other end
}

}  // namespace clatter::testing
