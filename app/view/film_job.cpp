#include "app/view/film_job.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "engine/system/platform.h"

namespace clatter {

static std::vector<std::string> command_of(std::vector<std::string> arguments) {
  arguments.front() = this_program(arguments.front());
  return arguments;
}

FilmJob::FilmJob(std::vector<std::string> arguments, std::string file)
    : file_(std::move(file)), process_(command_of(std::move(arguments)), Interrupts::Shared) {}

FilmJob::~FilmJob() {
  process_.interrupt();
  process_.wait();
}

void FilmJob::read() {
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

std::optional<int> FilmJob::poll() {
  const std::optional<int> code = process_.poll();
  read();
  return code;
}

}  // namespace clatter
