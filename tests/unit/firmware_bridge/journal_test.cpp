// The journal survives being cut and damaged anywhere.
#include <gtest/gtest.h>

#include "firmware_bridge/host/journal/journal.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using testing::read_whole;
using testing::ScratchFolder;
using testing::write_whole;

constexpr SessionIdentity kIdentity{0x12345678, 0xABCDEF0123456789};
constexpr std::uint32_t kRun = 42;

StreamEvent event(std::uint32_t sequence) {
  const double x = 0.1 * sequence;
  return {EventKind::point, {sequence, static_cast<std::uint16_t>(sequence / 3), {x, -x, x * x}, {0, 0, 1}, 17}};
}

void expect_same(const StreamEvent& left, const StreamEvent& right) {
  EXPECT_EQ(left.kind, right.kind);
  EXPECT_EQ(left.point.sequence, right.point.sequence);
  EXPECT_EQ(left.point.path, right.point.path);
  EXPECT_EQ(left.point.position, right.point.position);
  EXPECT_EQ(left.point.approach, right.point.approach);
  EXPECT_EQ(left.point.time_us, right.point.time_us);
}

/// Writes points 1..count and a mark that the program is finished, and returns the path.
std::string make_journal(const ScratchFolder& folder, std::uint32_t count) {
  const std::string path = folder / "journal.bin";
  Journal journal;
  EXPECT_FALSE(journal.open(path));
  EXPECT_FALSE(journal.start(kIdentity, kRun));
  for (std::uint32_t sequence = 1; sequence <= count; ++sequence) {
    EXPECT_FALSE(journal.append(std::vector<StreamEvent>{event(sequence)}));
  }
  EXPECT_FALSE(journal.append(std::vector<StreamEvent>{{EventKind::finished, {}}}));
  return path;
}

TEST(BridgeJournal, GivesBackWhatWasWritten) {
  const ScratchFolder folder;
  const std::string path = make_journal(folder, 10);
  JournalContent content;
  ASSERT_FALSE(read_journal(path, content));
  EXPECT_TRUE(content.exists);
  EXPECT_EQ(content.identity.design_crc, kIdentity.design_crc);
  EXPECT_EQ(content.identity.config_digest, kIdentity.config_digest);
  EXPECT_EQ(content.run_id, kRun);
  EXPECT_EQ(content.torn_bytes, 0U);
  ASSERT_EQ(content.events.size(), 11U);
  for (std::uint32_t sequence = 1; sequence <= 10; ++sequence) {
    expect_same(content.events[sequence - 1], event(sequence));
  }
  EXPECT_EQ(content.events.back().kind, EventKind::finished);
}

TEST(BridgeJournal, ATailTornAtAnyByteIsCutOffAndTheSessionGoesOn) {
  const ScratchFolder folder;
  const std::string whole = read_whole(make_journal(folder, 5));
  const std::string path = folder / "torn.bin";
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    write_whole(path, whole.substr(0, size));
    JournalContent content;
    ASSERT_FALSE(read_journal(path, content)) << size;
    ASSERT_EQ(content.exists, size >= sizeof(JournalHeader)) << size;
    if (!content.exists) continue;
    const std::size_t records = (size - sizeof(JournalHeader)) / sizeof(JournalRecord);
    ASSERT_EQ(content.events.size(), records) << size;
    ASSERT_EQ(content.torn_bytes, size - sizeof(JournalHeader) - records * sizeof(JournalRecord));
    {
      Journal journal;
      ASSERT_FALSE(journal.open(path));
      ASSERT_FALSE(journal.resume(records));
      ASSERT_FALSE(journal.append(std::vector<StreamEvent>{event(99)}));
    }
    ASSERT_FALSE(read_journal(path, content));
    ASSERT_EQ(content.events.size(), records + 1);
    expect_same(content.events.back(), event(99));
  }
}

TEST(BridgeJournal, ADamagedBitAnywhereIsFound) {
  const ScratchFolder folder;
  const std::string whole = read_whole(make_journal(folder, 3));
  const std::string path = folder / "damaged.bin";
  for (std::size_t byte = 0; byte < whole.size(); ++byte) {
    std::string bytes = whole;
    bytes[byte] = static_cast<char>(bytes[byte] ^ 0x10);
    write_whole(path, bytes);
    JournalContent content;
    const Failure error = read_journal(path, content);
    if (byte < sizeof(JournalHeader)) {
      ASSERT_EQ(error.kind, Failure::Kind::bad_input) << byte;
      ASSERT_NE(error.message.find(path), std::string::npos);
      continue;
    }
    // Every record was a group of its own: damage of the last one is a torn write, and what is before it counts.
    const std::size_t record = (byte - sizeof(JournalHeader)) / sizeof(JournalRecord);
    if (record < 3) {
      ASSERT_EQ(error.kind, Failure::Kind::bad_input) << byte;
      ASSERT_NE(error.message.find("record " + std::to_string(record + 1)), std::string::npos) << error.message;
      ASSERT_EQ(read_whole(path), bytes);
      continue;
    }
    ASSERT_FALSE(error) << byte;
    ASSERT_EQ(content.events.size(), 3U) << byte;
  }
}

/// The pages of one write reach the disk in any order.
TEST(BridgeJournal, DamageInTheLastGroupIsATornTail) {
  const ScratchFolder folder;
  const std::string path = make_journal(folder, 5);
  {
    Journal journal;
    ASSERT_FALSE(journal.open(path));
    ASSERT_FALSE(journal.resume(6));
    ASSERT_FALSE(journal.append(std::vector<StreamEvent>{event(6), event(7), event(8)}));
  }
  std::string bytes = read_whole(path);
  bytes[sizeof(JournalHeader) + 7 * sizeof(JournalRecord)] ^= 1;
  write_whole(path, bytes);
  JournalContent content;
  ASSERT_FALSE(read_journal(path, content));
  EXPECT_EQ(content.events.size(), 7U);
  EXPECT_EQ(content.torn_bytes, 2 * sizeof(JournalRecord));
}

TEST(BridgeJournal, DamageLongBeforeTheEndIsNoTornTail) {
  const ScratchFolder folder;
  const std::string path = folder / "journal.bin";
  {
    Journal journal;
    ASSERT_FALSE(journal.open(path));
    ASSERT_FALSE(journal.start(kIdentity, kRun));
    std::vector<StreamEvent> group;
    for (std::uint32_t sequence = 1; sequence <= 2 * kJournalGroup; ++sequence) {
      group.push_back(event(sequence));
      if (group.size() < kJournalGroup) continue;
      ASSERT_FALSE(journal.append(group));
      group.clear();
    }
  }
  std::string bytes = read_whole(path);
  bytes[sizeof(JournalHeader) + 16 * sizeof(JournalRecord) + 3] ^= 1;
  write_whole(path, bytes);
  JournalContent content;
  const Failure error = read_journal(path, content);
  EXPECT_EQ(error.kind, Failure::Kind::bad_input);
  EXPECT_NE(error.message.find("record 17"), std::string::npos) << error.message;
}

TEST(BridgeJournal, RefusesForeignFilesAndOtherVersions) {
  const ScratchFolder folder;
  const std::string path = folder / "journal.bin";
  JournalContent content;
  write_whole(path, std::string(100, 'x'));
  EXPECT_EQ(read_journal(path, content).kind, Failure::Kind::bad_input);
  JournalHeader header = make_journal_header(kIdentity, kRun);
  header.version = kJournalVersion + 1;
  write_whole(path, std::string(reinterpret_cast<const char*>(&header), sizeof header));
  EXPECT_NE(read_journal(path, content).message.find("this program reads versions 5 to 6"), std::string::npos);
  EXPECT_FALSE(read_journal(folder / "missing.bin", content));
  EXPECT_FALSE(content.exists);
}

TEST(BridgeJournal, ReadsTheVersionBefore) {
  const ScratchFolder folder;
  const std::string path = make_journal(folder, 3);
  std::string bytes = read_whole(path);
  JournalHeader header = make_journal_header(kIdentity, kRun, kOldestJournalVersion);
  write_whole(path, std::string(reinterpret_cast<const char*>(&header), sizeof header) + bytes.substr(sizeof header));
  JournalContent content;
  ASSERT_FALSE(read_journal(path, content));
  EXPECT_EQ(content.events.size(), 4U);
}

TEST(BridgeJournal, IsHeldByOneHostAtATime) {
  const ScratchFolder folder;
  const std::string path = folder / "journal.bin";
  Journal first, second;
  ASSERT_FALSE(first.open(path));
  EXPECT_EQ(second.open(path).kind, Failure::Kind::bad_input);
}

TEST(BridgeJournal, LeavesNothingBehindWithoutAHeader) {
  const ScratchFolder folder;
  const std::string path = folder / "journal.bin";
  {
    Journal journal;
    ASSERT_FALSE(journal.open(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace bladefit
