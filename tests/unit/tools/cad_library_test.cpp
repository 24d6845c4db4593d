#include "tools/design/cad_library.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/process.hpp"

namespace bladefit {
namespace {

/// Runs the command where the module that reads CAD files is damaged.
hil::Process without_cad_library(const testing::ScratchFolder& folder, const std::vector<std::string>& arguments) {
  std::ofstream(folder.path() / kCadModuleFile) << "damaged";
  std::vector<std::string> all = {"/usr/bin/env", "LD_LIBRARY_PATH=" + folder.path().string(), BLADEFIT_COMMAND};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return hil::Process(all);
}

TEST(CadLibrary, IsNamedWhereItCannotBeLoaded) {
  const testing::ScratchFolder folder;
  hil::Process command = without_cad_library(
      folder, {"compile", BLADEFIT_TEST_DATA "/arl_fan/design.igs", "-o", (folder.path() / "design.bfd").string()});
  EXPECT_EQ(command.exit_code(), 3);
  EXPECT_NE(command.err().find("libbladefit_cad.so, which reads CAD files, cannot be loaded"), std::string::npos)
      << command.err();
  EXPECT_NE(command.err().find("or give a compiled design (.bfd)"), std::string::npos) << command.err();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "design.bfd"));
}

TEST(CadLibrary, IsNotLoadedForCompiledDesigns) {
  const testing::ScratchFolder folder;
  const std::string image = (folder.path() / "design.bfd").string();
  hil::Process compile({BLADEFIT_COMMAND, "compile", BLADEFIT_TEST_DATA "/arl_fan/design.igs", "-o", image});
  ASSERT_EQ(compile.exit_code(), 0) << compile.err();
  hil::Process localize = without_cad_library(
      folder, {"localize", "--design", image, "--points", BLADEFIT_TEST_DATA "/arl_fan/points.csv"});
  EXPECT_EQ(localize.exit_code(), 0) << localize.err();
}

}  // namespace
}  // namespace bladefit
