#include "drivers/text/read_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

std::string refusal_of(const std::string& path, std::size_t largest = 100) {
  std::string text;
  const Failure failure = read_file(path, largest, text);
  EXPECT_NE(failure.kind, Failure::Kind::device);
  return failure.message;
}

TEST(ReadFile, TakesWhatIsWithinItsLimit) {
  const testing::ScratchFolder folder;
  std::string text = "before";
  EXPECT_FALSE(read_file(folder.write("a", "0123456789"), 10, text));
  EXPECT_EQ(text, "0123456789");
  EXPECT_NE(refusal_of(folder / "a", 9).find("is larger than"), std::string::npos);
}

TEST(ReadFile, RefusesALargeFileByItsSize) {
  const testing::ScratchFolder folder;
  const std::filesystem::path path = folder.write("sparse", "x");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40U);
  EXPECT_EQ(refusal_of(path, std::size_t{1} << 20U),
            "is larger than the 1 MiB that such a file may have; name another one, or divide it");
}

TEST(ReadFile, RefusesWhatIsNoFile) {
  const testing::ScratchFolder folder;
  EXPECT_EQ(refusal_of(folder / "none"), "no such file; check the name");
  EXPECT_EQ(refusal_of(folder.path()), "is a folder; name a file in it");
  EXPECT_EQ(refusal_of("/dev/zero"), "is a device, no file; name a file, or - for standard input");
}

TEST(ReadFile, ReadsAPipeToItsEnd) {
  const testing::ScratchFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&pipe] { std::ofstream(pipe) << "written late"; });
  std::string text;
  EXPECT_EQ(read_file(pipe, 100, text).message, "");
  writer.join();
  EXPECT_EQ(text, "written late");
}

}  // namespace
}  // namespace bladefit
