#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "tests/support/compile_case.hpp"
#include "tests/support/reference_design.hpp"
#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tests/unit/tools/design_image_reading.hpp"
#include "tools/design/image/c_array.hpp"
#include "tools/design/image/reach.hpp"
#include "tools/design/load_design.hpp"
#include "tools/files/output_file.hpp"

namespace bladefit {
namespace {

using testing::read_whole;
using testing::ScratchFolder;

/// Runs `bladefit compile ARGUMENTS` in `folder`; its output goes to out.txt there. Returns the exit code.
int run_compile(const ScratchFolder& folder, const std::string& arguments) {
  const std::string command =
      "cd '" + folder.path().string() + "' && '" BLADEFIT_COMMAND "' compile " + arguments + " > out.txt 2>&1";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::size_t count_files(const ScratchFolder& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) count += entry.exists() ? 1 : 0;
  return count;
}

void write_design(const ScratchFolder& folder) {
  const auto path =
      folder.write("blade.igs", testing::iges_file({testing::iges_surface(testing::random_surface({}, {}, true, 3))}));
  ASSERT_TRUE(std::filesystem::exists(path));
}

TEST(DesignCompile, WritesTheImageThatLoadDesignGivesAndItsReach) {
  const ScratchFolder folder;
  write_design(folder);
  ASSERT_EQ(run_compile(folder, "blade.igs -o blade.bfd --outward -"), 0) << read_whole(folder.path() / "out.txt");
  LoadedDesign design = load_design(folder.path() / "blade.igs", OutwardOption::minus);
  mark_reach(design.image);
  const std::string image = read_whole(folder.path() / "blade.bfd");
  EXPECT_EQ(image, std::string(reinterpret_cast<const char*>(design.image.data()), design.image.size()));
  const std::string output = read_whole(folder.path() / "out.txt");
  for (const char* part :
       {"1 patch, 16 Bezier spans", "degree 3 x 3", "unit of the design: mm", "reach: ", "outward side: -"}) {
    EXPECT_NE(output.find(part), std::string::npos) << part << " in\n" << output;
  }
  EXPECT_EQ(count_files(folder), 3U);
}

/// The designs that other tests open were compiled when the tests were built.
TEST(DesignCompile, ReferenceDesignsOnFileAreThoseCompiledNow) {
  for (const char* name : {"arl_fan", "pnsy_3patch"}) {
    std::vector<std::byte> image = testing::compile_case(testing::read_case(name));
    mark_reach(image);
    EXPECT_EQ(testing::reference_design(name).bytes(), image) << name;
  }
}

TEST(DesignCompile, CArrayHoldsTheImage) {
  const ScratchFolder folder;
  write_design(folder);
  ASSERT_EQ(run_compile(folder, "blade.igs -o blade.bfd --c-array 7-fan.c --outward +"), 0);
  const auto source =
      folder.write("main.c",
                   "#include <stddef.h>\n#include <stdint.h>\n#include <stdio.h>\n"
                   "extern const uint64_t blade_7_fan_design[];\nextern const size_t blade_7_fan_design_size;\n"
                   "int main(void) { return fwrite(blade_7_fan_design, 1, blade_7_fan_design_size, stdout) == 0; }\n");
  const std::string build = "cd '" + folder.path().string() +
                            "' && cc -std=c99 -pedantic -Wall -Wextra -Werror 7-fan.c " + source.string() +
                            " -o dump && ./dump > dumped";
  ASSERT_EQ(std::system(build.c_str()), 0);
  EXPECT_EQ(read_whole(folder.path() / "dumped"), read_whole(folder.path() / "blade.bfd"));
}

TEST(DesignCompile, BadInputLeavesNoFile) {
  const ScratchFolder folder;
  write_design(folder);
  EXPECT_EQ(run_compile(folder, "blade.igs -o blade.bfd"), 2);  // an open sheet does not tell its outward side
  EXPECT_NE(read_whole(folder.path() / "out.txt").find("--outward +"), std::string::npos);
  EXPECT_EQ(run_compile(folder, "missing.igs -o blade.bfd"), 2);
  EXPECT_EQ(run_compile(folder, "blade.igs -o blade.igs --outward +"), 2);
  EXPECT_EQ(run_compile(folder, "blade.igs -o a.c --c-array a.c --outward +"), 2);
  EXPECT_EQ(run_compile(folder, "blade.igs -o blade.bfd --outward up"), 2);
  EXPECT_EQ(run_compile(folder, "blade.igs -o blade.bfd --no-such-option"), 2);
  EXPECT_EQ(run_compile(folder, "blade.igs"), 2);
  EXPECT_EQ(count_files(folder), 2U);
}

TEST(DesignCompile, FailedOutputLeavesNoFile) {
  const ScratchFolder folder;
  write_design(folder);
  EXPECT_EQ(run_compile(folder, "blade.igs -o missing/blade.bfd --outward +"), 3);
  EXPECT_EQ(run_compile(folder, "blade.igs -o blade.bfd --c-array missing/blade.c --outward +"), 3);
  EXPECT_EQ(run_compile(folder, "blade.igs -o /dev/full --outward +"), 3);
  EXPECT_EQ(count_files(folder), 2U);
}

TEST(DesignCompile, OldOutputStaysUntilTheNewOneIsWhole) {
  const ScratchFolder folder;
  const auto path = folder.write("a.bfd", "old");
  { const OutputFile abandoned(path, "new"); }
  EXPECT_EQ(read_whole(path), "old");
  OutputFile output(path, "new");
  EXPECT_EQ(read_whole(path), "old");
  output.commit();
  EXPECT_EQ(read_whole(path), "new");
  EXPECT_EQ(count_files(folder), 1U);
}

TEST(DesignCompile, OutputThroughALinkKeepsTheLink) {
  const ScratchFolder folder;
  const auto path = folder.write("a.bfd", "old");
  std::filesystem::create_symlink("a.bfd", folder.path() / "link.bfd");
  OutputFile(folder.path() / "link.bfd", "new").commit();
  EXPECT_EQ(read_whole(path), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.bfd"));
}

TEST(DesignCompile, HelpTeaches) {
  const ScratchFolder folder;
  EXPECT_EQ(run_compile(folder, "--help"), 0);
  EXPECT_NE(read_whole(folder.path() / "out.txt").find("Examples:"), std::string::npos);
}

TEST(DesignCompile, CArrayNames) {
  EXPECT_EQ(c_array_name("out/fan.c"), "fan_design");
  EXPECT_EQ(c_array_name("4119 left.c"), "blade_4119_left_design");
}

}  // namespace
}  // namespace bladefit
