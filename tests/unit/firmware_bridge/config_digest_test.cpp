// Two sessions with different settings are never taken for one: each field of the configuration is in its digest.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <type_traits>

#include "core/localizer/config_fields.hpp"
#include "firmware_bridge/host/journal/config_digest.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "firmware_bridge/host/journal/session_settings_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

LocalizerConfig config_with_boxes() {
  LocalizerConfig config;
  config.tolerance.box_count = 2;
  config.tolerance.leading_edge_mm = 0.1;
  config.tolerance.rest_mm = 1;
  return config;
}

template <typename Field>
void change(Field& field) {
  if constexpr (std::is_enum_v<Field>) {
    field = static_cast<Field>(static_cast<std::underlying_type_t<Field>>(field) + 1);
  } else if constexpr (std::is_same_v<Field, bool>) {
    field = !field;
  } else {
    field = static_cast<Field>(field + 1);
  }
}

TEST(ConfigDigest, EachFieldChangesIt) {
  const LocalizerConfig config = config_with_boxes();
  std::size_t fields = 0;
  for_each_field(config, [&fields](const char*, const auto&) { ++fields; });
  // 16 fields beside start, tolerance and decision, 12 numbers of the start pose, 5 of the tolerances, 5 a box, 4 of
  // the decision.
  EXPECT_EQ(fields, 16U + 12U + 5U + 2U * 5U + 4U);
  std::set<std::uint64_t> digests{config_digest(config, 0)};
  std::set<std::string> names;
  for (std::size_t wanted = 0; wanted < fields; ++wanted) {
    LocalizerConfig changed = config;
    std::size_t index = 0;
    std::string name;
    for_each_field(changed, [&](const char* field_name, auto& field) {
      if (index++ != wanted) return;
      change(field);
      name = field_name;
    });
    EXPECT_TRUE(digests.insert(config_digest(changed, 0)).second) << name;
    names.insert(name);
  }
  EXPECT_TRUE(names.contains("further_starts"));
  EXPECT_TRUE(digests.insert(config_digest(config, 1)).second) << "points of a refinement";
}

TEST(ConfigDigest, EachFieldOfAZoneChangesIt) {
  LocalizerConfig config = config_with_boxes();
  config.tolerance.zone_count = 2;
  for (std::uint32_t k = 0; k < 2; ++k) config.tolerance.zones[k] = {Region::rest, false, 10, 20, 0.1, 0.05};
  std::set<std::uint64_t> digests{config_digest(config, 0), config_digest(config_with_boxes(), 0)};
  std::size_t fields = 0;
  for_each_field(config, [&fields](const std::string& name, const auto&) {
    fields += name.starts_with("tolerance.zone") || name.starts_with("tolerance.axis") ? 1 : 0;
  });
  EXPECT_EQ(fields, 1U + 2U * 6U + 6U);
  for (std::size_t wanted = 0; wanted < fields; ++wanted) {
    LocalizerConfig changed = config;
    std::size_t index = 0;
    for_each_field(changed, [&](const std::string& name, auto& field) {
      if (!name.starts_with("tolerance.zone") && !name.starts_with("tolerance.axis")) return;
      if (index++ == wanted) change(field);
    });
    EXPECT_TRUE(digests.insert(config_digest(changed, 0)).second) << wanted;
  }
  config.tolerance.zones[2].plus_mm = 7;
  EXPECT_TRUE(digests.contains(config_digest(config, 0))) << "a zone that is not in use plays no part";
}

TEST(ConfigDigest, ASessionTellsWhichZoneWasAnother) {
  LocalizerConfig config = config_with_boxes();
  config.tolerance.zone_count = 2;
  for (std::uint32_t k = 0; k < 2; ++k) config.tolerance.zones[k] = {Region::rest, true, 10, 20, 0.1, 0.05};
  const testing::ScratchFolder folder;
  ASSERT_EQ(write_settings(folder.path(), settings_text(config, 0)).message, "");
  LocalizerConfig other = config;
  other.tolerance.zones[1].minus_mm = 0.07;
  EXPECT_EQ(differing_settings(folder.path(), config_digest(config, 0), settings_text(other, 0)),
            "tolerance.zones.minus_mm 2 was 0.05 and is 0.07");
}

TEST(ConfigDigest, BoxesThatAreNotInUsePlayNoPart) {
  LocalizerConfig config = config_with_boxes();
  const std::uint64_t digest = config_digest(config, 0);
  config.tolerance.boxes[2].patch = 7;
  EXPECT_EQ(config_digest(config, 0), digest);
}

/// A journal of version 4 does not tell of points that had no number when they were lost.
TEST(ConfigDigest, JournalsOfTheVersionBeforeAreRefusedInOneLine) {
  std::string folder = "/tmp/bladefit_digest_XXXXXX";
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const std::string path = folder + "/journal.bin";
  JournalHeader header = make_journal_header({1, 2}, 3);
  header.version = 4;
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(&header), sizeof header);
  JournalContent content;
  const Failure error = read_journal(path, content);
  EXPECT_EQ(error.kind, Failure::Kind::bad_input);
  EXPECT_FALSE(content.exists);
  EXPECT_EQ(error.message, path +
                               ": journal of format version 4, which does not tell of lost points; "
                               "this program reads versions 5 to 6: use the program that wrote it, or name another "
                               "session folder");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace bladefit
