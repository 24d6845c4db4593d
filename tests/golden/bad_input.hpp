#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/golden/command_fixture.hpp"

/// Tables of bad input that are run whole.
namespace bladefit::testing {

/// What stands in the folder of the test before the command runs.
struct MadeFile {
  std::string name, content;
};

struct BadInput {
  std::string kind;
  std::vector<MadeFile> files;
  std::vector<std::string> arguments;  ///< DESIGN stands for a blade, DIR/ for the folder of the test
  int exit_code;
  std::string pattern;  ///< must be found in what the command says, no matter the case
};

inline std::string repeated(const std::string& text, std::size_t count) {
  std::string out;
  for (std::size_t k = 0; k < count; ++k) out += text;
  return out;
}

class BadInputs : public CommandTest {
 protected:
  BadInputs() { std::filesystem::create_directories(scratch("in")); }

  [[nodiscard]] std::string filled(std::string text) const {
    const auto fill = [&text](const std::string& word, const std::string& by) {
      const std::size_t place = text.find(word);
      if (place != std::string::npos) text.replace(place, word.size(), by);
    };
    fill("DESIGN", BLADEFIT_TEST_DATA "/dtmb4119/design.igs");
    fill("DIR/", scratch("in/"));
    return text;
  }

  /// A command that does not end is ended, and then it has failed.
  Outcome outcome_of(const BadInput& row) const {
    for (const MadeFile& file : row.files)
      std::ofstream(scratch("in/" + file.name), std::ios::binary) << filled(file.content);
    std::vector<std::string> arguments = {"timeout", "60", BLADEFIT_COMMAND};
    for (const std::string& argument : row.arguments) arguments.push_back(filled(argument));
    Outcome outcome = run(arguments);
    for (const MadeFile& file : row.files) std::filesystem::remove(scratch("in/" + file.name));
    return outcome;
  }

  /// Each row is told in a line of less than 300 characters, and leaves nothing behind.
  void expect_refused(const std::vector<BadInput>& rows) const {
    for (const BadInput& row : rows) {
      SCOPED_TRACE(row.kind);
      const Outcome outcome = outcome_of(row);
      EXPECT_EQ(outcome.exit_code, row.exit_code) << outcome.output;
      EXPECT_TRUE(std::regex_search(outcome.output, std::regex(row.pattern, std::regex::icase))) << outcome.output;
      const std::size_t begin = std::min(outcome.output.rfind("bladefit: "), outcome.output.size());
      EXPECT_LT(outcome.output.find('\n', begin) - begin, 300U) << outcome.output;
      EXPECT_TRUE(outcome.output.ends_with('\n'));
      EXPECT_TRUE(std::filesystem::is_empty(scratch("in"))) << "something was left behind";
    }
  }
};

}  // namespace bladefit::testing
