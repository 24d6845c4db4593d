// Designs that come compressed: what is in them is read, what would grow without end is refused.
#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/read_design.hpp"
#include "tools/design/text/unpacked.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

using testing::ScratchFolder;

const NurbsSurface kPacked = testing::random_surface({3, 2}, {2, 2}, true, 31);

std::string packed_step_text() {
  int number = 100;
  return testing::step_file(testing::step_surface(kPacked, "PATCH1", number));
}

constexpr int kGzip = 16 + MAX_WBITS, kRaw = -MAX_WBITS;

std::string deflated(const std::string& text, int window) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, window, 9, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::string number(std::size_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 255U);
  return text;
}

struct ArchivedFile {
  std::string name, content;
  bool stored = false;
  int flags = 0;
};

std::string zip_of(const std::vector<ArchivedFile>& files) {
  std::string archive, directory;
  for (const ArchivedFile& file : files) {
    const std::string data = file.stored ? file.content : deflated(file.content, kRaw);
    const std::size_t sum =
        crc32(0, reinterpret_cast<const Bytef*>(file.content.data()), static_cast<uInt>(file.content.size()));
    const std::string common = number(20, 2) + number(static_cast<std::size_t>(file.flags), 2) +
                               number(file.stored ? 0 : 8, 2) + number(0, 4) + number(sum, 4) + number(data.size(), 4) +
                               number(file.content.size(), 4) + number(file.name.size(), 2) + number(0, 2);
    directory += "PK\1\2" + number(20, 2) + common + number(0, 10) + number(archive.size(), 4) + file.name;
    archive += "PK\3\4" + common + file.name + data;
  }
  const std::string end = "PK\5\6" + number(0, 4) + number(files.size(), 2) + number(files.size(), 2) +
                          number(directory.size(), 4) + number(archive.size(), 4) + number(0, 2);
  return archive + directory + end;
}

std::string packed_refusal(const std::string& content, std::size_t most = kMostUnpacked) {
  try {
    const std::string text = unpacked(content, "a.stpz", most);
    return "accepted " + text.substr(0, 20);
  } catch (const ToolError& error) {
    return error.what();
  }
}

void expect_packed_refused(const std::string& content, const std::string& why) {
  const std::string said = packed_refusal(content);
  EXPECT_NE(said.find(why), std::string::npos) << said;
  EXPECT_EQ(said.find("a.stpz: "), 0U) << said;
}

TEST(DesignPacked, AStepFileIsReadOutOfGzipAndZipWhateverItsName) {
  const std::string step = packed_step_text(), gzip = deflated(step, kGzip);
  const std::string zip = zip_of({{"readme.txt", "a blade"}, {"parts/blade.STP", step}});
  const ScratchFolder folder;
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"a.stpz", gzip},
                                      {"b.stpz", zip},
                                      {"c.stp.gz", gzip},
                                      {"d.STEP.GZ", gzip},
                                      {"e.stp", gzip},
                                      {"f.stpz", step},
                                      {"g.stpz", zip_of({{"blade.p21", step, true}})}}) {
    const DesignFile design = read_design(folder.write(name, content));
    ASSERT_EQ(design.surfaces.size(), 1U) << name;
    EXPECT_EQ(design.surfaces[0].control_points, kPacked.control_points) << name;
  }
}

TEST(DesignPacked, JoinedGzipFilesAreOneAndWhatFollowsIsNotReadOn) {
  EXPECT_EQ(unpacked(deflated("one ", kGzip) + deflated("two", kGzip), "a", 100), "one two");
  EXPECT_EQ(unpacked(deflated("one", kGzip) + "trailing", "a", 100), "one");
  EXPECT_EQ(unpacked(deflated("", kGzip), "a", 100), "");
  EXPECT_EQ(unpacked("plain", "a", 100), "plain");
}

TEST(DesignPacked, WhatGrowsTooLargeIsRefused) {
  const std::string text(5 << 20U, 'x');
  for (const std::string& packed : {deflated(text, kGzip), zip_of({{"a.stp", text}})}) {
    EXPECT_LT(packed.size(), 20000U);
    EXPECT_NE(packed_refusal(packed, (5 << 20U) - 1).find("grows to more than 4 MB"), std::string::npos);
    EXPECT_EQ(unpacked(packed, "a", 5 << 20U), text);
  }
}

/// 1 MB of a kind that grows a thousandfold, ten thousand times over: 10 GB if it were unpacked.
TEST(DesignPacked, ABombIsRefusedBeforeItTakesMemory) {
  const std::string member = deflated(std::string(1 << 20U, '\0'), kGzip);
  std::string bomb;
  for (int k = 0; k < 1000; ++k) bomb += member;
  expect_packed_refused(bomb, "grows to more than 512 MB");
}

TEST(DesignPacked, DamagedEncryptedAndAmbiguousOnesAreRefused) {
  const std::string step = packed_step_text(), gzip = deflated(step, kGzip);
  expect_packed_refused(gzip.substr(0, gzip.size() / 2), "damaged or cut off");
  std::string wrong = gzip;
  wrong[wrong.size() / 2] = static_cast<char>(wrong[wrong.size() / 2] ^ 0x55);
  expect_packed_refused(wrong, "damaged or cut off");
  const std::string zip = zip_of({{"a.stp", step}});
  for (std::size_t size = 4; size < zip.size(); size += 61)
    expect_packed_refused(zip.substr(0, size), "damaged or cut off");
  expect_packed_refused(zip_of({{"a.stp", step}, {"b.igs", "x"}}), "holds 2 CAD files; unpack it");
  expect_packed_refused(zip_of({{"a.txt", "x"}}), "holds no file named .stp");
  expect_packed_refused(zip_of({{"a.stp", step, false, 1}}), "is encrypted");
  std::string changed = zip_of({{"a.stp", step, true}});
  changed[changed.find("MILLI")] = 'm';
  expect_packed_refused(changed, "check sum of a.stp is wrong");
  std::string beyond = zip;
  beyond.replace(beyond.rfind("PK\5\6") + 16, 4, "\xFF\xFF\xFF\x7F");
  expect_packed_refused(beyond, "damaged");
}

}  // namespace
}  // namespace bladefit
