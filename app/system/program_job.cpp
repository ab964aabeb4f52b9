#include "app/system/program_job.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "engine/system/platform.h"

namespace clatter {

static std::vector<std::string> command_of(std::vector<std::string> arguments) {
  arguments.front() = this_program(arguments.front());
  return arguments;
}

ProgramJob::ProgramJob(std::vector<std::string> arguments)
    : process_(command_of(std::move(arguments)), Interrupts::Shared) {}

ProgramJob::~ProgramJob() {
  process_.interrupt();
  process_.wait();
}

void ProgramJob::read() {
  line_ += process_.new_words();
  for (std::size_t end; (end = line_.find('\n')) != std::string::npos;) {
    const std::string line = line_.substr(0, end);
    line_.erase(0, end + 1);
    const auto progress = nlohmann::json::parse(line, nullptr, /*allow_exceptions=*/false);
    if (progress.is_object()) {
      done_ = progress.value("done", done_);
    } else {
      message_ = line;
    }
  }
}

std::optional<int> ProgramJob::poll() {
  const std::optional<int> code = process_.poll();
  read();
  return code;
}

}  // namespace clatter
