#include <doctest/doctest.h>

#include <cctype>
#include <filesystem>
#include <ostream>
#include <string>

namespace clatter {

namespace {

std::string escaped(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? "\\|" : std::string(1, c);
  return cell;
}

// What a file of cases is about, as its name says: "few_particles" is "Few particles".
std::string heading_of(const char* file) {
  std::string name = std::filesystem::path(file).stem();
  for (char& c : name) c = c == '_' ? ' ' : c;
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

/// Writes what was run as tables in Markdown: each case, the invariant that it checks, which is its
/// description, and the figures that it reached, which are its messages.
class TableReporter : public doctest::IReporter {
 public:
  explicit TableReporter(const doctest::ContextOptions& options) : out_(*options.cout) {}

  void test_run_start() override {
    out_ << "# Stability at the extremes\n\n"
            "The cases of the test suite `extremes`, what must hold in each, and the figures that "
            "it\n"
            "reached. The suite itself wrote this page:\n\n"
            "    cmake --build build/release --target extremes_table\n";
  }
  void test_case_start(const doctest::TestCaseData& test) override {
    test_ = &test;
    figures_.clear();
  }
  void log_message(const doctest::MessageData& message) override {
    if (!figures_.empty()) figures_ += "; ";
    figures_ += message.m_string.c_str();
  }
  void test_case_end(const doctest::CurrentTestCaseStats& result) override {
    if (const std::string heading = heading_of(test_->m_file.c_str()); heading != heading_) {
      heading_ = heading;
      out_ << "\n## " << heading << "\n\n| case | holds when | reached |\n|---|---|---|\n";
    }
    const char* invariant = test_->m_description ? test_->m_description : "";
    out_ << "| " << escaped(test_->m_name) << " | " << escaped(invariant) << " | "
         << (result.testCaseSuccess ? "" : "**does not hold**; ") << escaped(figures_) << " |"
         << std::endl;
  }

  void report_query(const doctest::QueryData&) override {}
  void test_run_end(const doctest::TestRunStats&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  std::ostream& out_;
  const doctest::TestCaseData* test_ = nullptr;
  std::string heading_;
  std::string figures_;
};

}  // namespace

REGISTER_REPORTER("table", 1, TableReporter);

}  // namespace clatter
