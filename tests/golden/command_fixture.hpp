#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace bladefit::testing {

/// How a command ended.
struct Outcome {
  int exit_code = -1;
  std::string output;  ///< standard output and error
};

/// Runs a command to its end.
inline Outcome run(const std::vector<std::string>& arguments) {
  std::string line;
  for (const std::string& argument : arguments) line += "'" + argument + "' ";
  FILE* pipe = popen((line + "2>&1").c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    outcome.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// A test with a folder of its own.
class CommandTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string scratch(const std::string& name) const { return scratch_ / name; }

 private:
  ScratchFolder scratch_;
};

}  // namespace bladefit::testing
