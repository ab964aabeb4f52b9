#include <doctest/doctest.h>

#include <ostream>
#include <string>

namespace clatter {

namespace {

std::string escaped(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? "\\|" : std::string(1, c);
  return cell;
}

// The name of a case is "<Subject>: <behaviour>".
struct Name {
  std::string subject, event;
};

Name parted(const std::string& name) {
  const std::size_t colon = name.find(": ");
  return {name.substr(0, colon), name.substr(colon + 2)};
}

/// Writes the cases as Markdown tables: each case, its condition (the description), and its results
/// (the messages).
class TableReporter : public doctest::IReporter {
 public:
  explicit TableReporter(const doctest::ContextOptions& options) : out_(*options.cout) {}

  void test_run_start() override {
    out_ << "# Stability at the extremes\n\n"
            "This page lists the cases of the test suite `extremes`, their conditions and their "
            "results.\n"
            "The suite writes the page:\n\n"
            "    cmake --build build/release --target extremes_table\n\n"
            "*Brute force* is a simple engine that checks all pairs of particles for the next "
            "collision.\n"
            "*Off by* precedes the deviation from the exact value. An overlap is in particle "
            "diameters.\n";
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
    const Name name = parted(test_->m_name);
    if (name.subject != subject_) {
      subject_ = name.subject;
      out_ << "\n## " << subject_ << "\n\n| case | condition | result |\n|---|---|---|\n";
    }
    const char* invariant = test_->m_description ? test_->m_description : "";
    out_ << "| " << escaped(name.event) << " | " << escaped(invariant) << " | "
         << (result.testCaseSuccess ? "" : "**fails**; ") << escaped(figures_) << " |" << std::endl;
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
  std::string subject_;
  std::string figures_;
};

}  // namespace

REGISTER_REPORTER("table", 1, TableReporter);

}  // namespace clatter
