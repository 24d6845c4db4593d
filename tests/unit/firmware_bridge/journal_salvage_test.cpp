// What can still be read of a damaged journal.
#include <gtest/gtest.h>

#include "firmware_bridge/host/journal/journal.hpp"
#include "firmware_bridge/host/journal/journal_salvage.hpp"
#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using testing::read_whole;
using testing::ScratchFolder;
using testing::write_whole;

/// A journal of the points 1..10, each a group of its own.
std::string ten_points(const ScratchFolder& folder) {
  std::string path = folder / "journal.bin";
  Journal journal;
  EXPECT_FALSE(journal.open(path));
  EXPECT_FALSE(journal.start({1, 2}, 3));
  for (std::uint32_t sequence = 1; sequence <= 10; ++sequence) {
    StreamEvent event;
    event.point.sequence = sequence;
    EXPECT_FALSE(journal.append(std::span(&event, 1)));
  }
  return path;
}

void damage(const std::string& path, std::size_t byte) {
  std::string bytes = read_whole(path);
  bytes.at(byte) = static_cast<char>(bytes.at(byte) ^ 0x20);
  write_whole(path, bytes);
}

std::size_t byte_of_record(std::size_t place) {
  return sizeof(JournalHeader) + (place - 1) * sizeof(JournalRecord) + 9;
}

TEST(JournalSalvage, GivesTheRecordsOnBothSidesOfTheDamage) {
  const ScratchFolder folder;
  const std::string path = ten_points(folder);
  for (const std::size_t place : {4U, 5U, 8U}) damage(path, byte_of_record(place));
  Salvage salvage;
  ASSERT_FALSE(salvage_journal(path, salvage));
  EXPECT_TRUE(salvage.header_whole);
  EXPECT_EQ(salvage.run_id, 3U);
  EXPECT_EQ(salvage.records, 10U);
  EXPECT_EQ(salvage.events.size(), 7U);
  ASSERT_EQ(salvage.damaged.size(), 2U);
  EXPECT_EQ(salvage.damaged[0].first, 4U);
  EXPECT_EQ(salvage.damaged[0].last, 5U);
  EXPECT_EQ(salvage.damaged[0].point_before, 3U);
  EXPECT_EQ(salvage.damaged[0].point_after, 6U);
  EXPECT_EQ(salvage.damaged[1].point_after, 9U);
}

TEST(JournalSalvage, ADamagedHeaderLeavesTheRecords) {
  const ScratchFolder folder;
  const std::string path = ten_points(folder);
  damage(path, 9);
  Salvage salvage;
  ASSERT_FALSE(salvage_journal(path, salvage));
  EXPECT_FALSE(salvage.header_whole);
  EXPECT_EQ(salvage.events.size(), 10U);
}

TEST(JournalSalvage, DamageAtTheEndHasNoPointBehindIt) {
  const ScratchFolder folder;
  const std::string path = ten_points(folder);
  damage(path, byte_of_record(10));
  write_whole(path, read_whole(path) + "torn");
  Salvage salvage;
  ASSERT_FALSE(salvage_journal(path, salvage));
  ASSERT_EQ(salvage.damaged.size(), 1U);
  EXPECT_EQ(salvage.damaged[0].point_before, 9U);
  EXPECT_EQ(salvage.damaged[0].point_after, 0U);
  EXPECT_EQ(salvage.torn_bytes, 4U);
}

}  // namespace
}  // namespace bladefit
