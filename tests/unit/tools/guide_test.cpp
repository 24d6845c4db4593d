// Every command of the guide is run, as it stands there.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fstream>
#include <sstream>

#include "tests/support/scratch_folder.hpp"
#include "tools/files/run_program.hpp"

namespace bladefit {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = fs::path(BLADEFIT_TEST_DATA).parent_path().parent_path();

/// The commands of the blocks marked `sh`, and `sh printer` where there is one, in their order.
std::string commands_of(const fs::path& document) {
  const bool printer = find_program("chromium").has_value();
  std::ifstream file(document);
  std::string commands;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```")) {
      inside = !inside && (line == "```sh" || (line == "```sh printer" && printer));
    } else if (inside) {
      commands += line + "\n";
    }
  }
  return commands;
}

class Guide : public ::testing::TestWithParam<const char*> {};

TEST_P(Guide, ItsCommandsRun) {
  const testing::ScratchFolder folder;
  for (const char* name : {"tests", "config"}) fs::create_directory_symlink(kRoot / name, folder.path() / name);
  fs::create_directory(folder.path() / "bin");
  fs::create_symlink(BLADEFIT_COMMAND, folder.path() / "bin" / "bladefit");
  const std::string commands = commands_of(kRoot / "tools" / "guide" / GetParam());
  ASSERT_NE(commands.find("bladefit "), std::string::npos);
  const std::string script = folder.write("commands.sh", "set -e\ncd '" + folder.path().string() + "'\n" + commands);
  const int status = std::system(("PATH='" + (folder.path() / "bin").string() + "':$PATH sh -x '" + script + "' > '" +
                                  (folder.path() / "out.txt").string() + "' 2>&1")
                                     .c_str());
  std::ifstream said(folder.path() / "out.txt");
  std::ostringstream text;
  text << said.rdbuf();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << text.str();
}

INSTANTIATE_TEST_SUITE_P(Documents, Guide,
                         ::testing::Values("tutorial.md", "wiring_a_cmm.md", "wiring_an_hmi.md",
                                           "reading_the_report.md"));

TEST(GuideDocuments, AllAreRun) {
  std::size_t documents = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "tools" / "guide"))
    documents += entry.path().extension() == ".md" && entry.path().filename() != "README.md" ? 1 : 0;
  EXPECT_EQ(documents, 4U);
}

}  // namespace
}  // namespace bladefit
