#include <gtest/gtest.h>

#include <vector>

#include "drivers/modbus/ring_reader.hpp"
#include "drivers/source/crc16.hpp"
#include "tests/unit/drivers/collecting.hpp"

namespace bladefit {
namespace {

/// A ring reader with capacity 8 and what it needs.
struct Bench {
  ModbusSettings settings;
  SourceStatus status;
  RingReader ring{settings, status};

  explicit Bench(std::uint32_t after = 0) { ring.restart(after); }

  void show(std::uint32_t newest, std::uint16_t bits = 2, std::uint32_t run = 1, std::uint32_t capacity = 8) {
    ring.observe({1, bits, newest, capacity, 20, run, false, 0, {}, false});
  }

  /// Reads the next batch; the record `bad` of it has a wrong check sum.
  bool read(std::uint32_t bad = 0) {
    const RecordBatch batch = ring.next_batch();
    std::vector<std::uint16_t> words(std::size_t{batch.count} * 20);
    for (std::uint16_t index = 0; index < batch.count; ++index) {
      const std::span<std::uint16_t> record(words.data() + index * 20, 20);
      record[0] = static_cast<std::uint16_t>((batch.sequence + index) >> 16U);
      record[1] = static_cast<std::uint16_t>((batch.sequence + index) & 0xFFFFU);
      record[19] = crc16(std::span<const std::uint16_t>(record.first(19)));
      if (batch.sequence + index == bad) ++record[19];
    }
    return ring.accept(batch, words, 1);
  }

  Sequences take() { return take_sequences(ring.points()); }
};

TEST(RingReader, ReadsNothingBeforeAHeader) { EXPECT_EQ(Bench().ring.next_batch().count, 0); }

struct BatchCase {
  std::uint32_t after, newest, sequence;
  std::uint16_t count, address;
};

class RingBatches : public ::testing::TestWithParam<BatchCase> {};

TEST_P(RingBatches, StayInTheRingAndInOneRead) {
  Bench bench(GetParam().after);
  bench.show(GetParam().newest);
  const RecordBatch batch = bench.ring.next_batch();
  EXPECT_EQ(batch.count, GetParam().count);
  if (batch.count == 0) return;
  EXPECT_EQ(batch.sequence, GetParam().sequence);
  EXPECT_EQ(batch.address, GetParam().address);
}

INSTANTIATE_TEST_SUITE_P(All, RingBatches,
                         ::testing::Values(BatchCase{0, 0, 0, 0, 0}, BatchCase{0, 1, 1, 1, 100},
                                           BatchCase{0, 8, 1, 6, 100}, BatchCase{6, 9, 7, 2, 220},
                                           BatchCase{8, 9, 9, 1, 100}, BatchCase{15, 23, 16, 1, 240},
                                           BatchCase{9, 9, 0, 0, 0}, BatchCase{9, 3, 0, 0, 0}));

TEST(RingReader, DeliversEveryRecordOnceInOrder) {
  Bench bench;
  bench.show(8);
  EXPECT_TRUE(bench.read());
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), (Sequences{1, 2, 3, 4, 5, 6, 7, 8}));
  bench.show(7);
  EXPECT_EQ(bench.ring.next_batch().count, 0);
  EXPECT_EQ(bench.status.records, 8U);
  EXPECT_EQ(bench.status.losses, 0U);
}

TEST(RingReader, ReadsADamagedRecordAgainBeforeItCounts) {
  Bench bench;
  bench.show(4);
  EXPECT_FALSE(bench.read(3));
  EXPECT_EQ(bench.take(), (Sequences{1, 2}));
  EXPECT_TRUE(bench.status.behind);
  EXPECT_EQ(bench.status.damaged, 0U);
  EXPECT_EQ(bench.status.resends, 1U);
  EXPECT_FALSE(bench.read(3));
  EXPECT_EQ(bench.status.damaged, 1U);
  EXPECT_EQ(bench.status.consecutive_faults, 1U);
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), (Sequences{3, 4}));
  EXPECT_FALSE(bench.status.behind);
  EXPECT_EQ(bench.status.consecutive_faults, 0U);
}

TEST(RingReader, GivesUpARecordThatStaysDamaged) {
  Bench bench;
  bench.settings.record_tries = 3;
  bench.show(2);
  for (int look = 0; look < 3; ++look) EXPECT_FALSE(bench.read(1));
  EXPECT_GT(bench.status.losses, 0U);
  EXPECT_NE(bench.status.last_fault.find("point 1 is lost: damaged in 3 looks"), std::string::npos);
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), (Sequences{2}));
}

TEST(RingReader, BelievesInLossOnlyWhenTwoHeadersSaySo) {
  Bench bench;
  bench.show(20);
  EXPECT_EQ(bench.status.losses, 0U);
  EXPECT_EQ(bench.ring.next_batch().count, 0);
  bench.show(3);
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), (Sequences{1, 2, 3}));
  bench.show(20);
  bench.show(21);
  EXPECT_GT(bench.status.losses, 0U);
  EXPECT_NE(bench.status.last_fault.find("points 4..13 are lost"), std::string::npos) << bench.status.last_fault;
  EXPECT_EQ(bench.ring.next_batch().sequence, 14U);
}

/// Two headers that named too new a record are not the end: the device still holds what was given up.
TEST(RingReader, GoesBackWhenTheDeviceHasOverstated) {
  Bench bench;
  bench.show(3);
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), (Sequences{1, 2, 3}));
  bench.show(1000);
  bench.show(1000);
  EXPECT_EQ(bench.status.losses, 1U);
  for (int look = 0; look < 3; ++look) bench.show(5);
  EXPECT_EQ(bench.status.last, 3U) << "that is not given up for good";
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), (Sequences{4, 5}));
}

TEST(RingReader, GivesUpForGoodWhatTheDeviceStillKnowsOf) {
  Bench bench;
  bench.settings.record_tries = 3;
  bench.show(8);
  for (std::uint32_t record = 1; record <= 8; ++record) {
    for (int look = 0; look < 3; ++look) EXPECT_FALSE(bench.read(record));
  }
  EXPECT_EQ(bench.status.losses, 8U);
  for (int look = 0; look < 2; ++look) bench.show(8);
  EXPECT_EQ(bench.status.last, 0U) << "headers that named too new a record may have been wrong";
  bench.show(8);
  EXPECT_EQ(bench.status.last, 8U);
}

TEST(RingReader, StopsWhenTheNumberingRestartsWithoutAnotherRunId) {
  Bench bench;
  bench.show(8);
  EXPECT_TRUE(bench.read());
  EXPECT_TRUE(bench.read());
  bench.take();
  EXPECT_TRUE(bench.ring.knows(8));
  bench.show(3);
  EXPECT_FALSE(bench.ring.stopped()) << "one header may be an older one";
  EXPECT_FALSE(bench.ring.knows(3)) << "until it is clear nothing is acknowledged";
  bench.show(4);
  EXPECT_TRUE(bench.ring.stopped());
  EXPECT_NE(bench.status.stopped.find("newest record is 4 although record 8 was read before"), std::string::npos)
      << bench.status.stopped;
  bench.show(20);
  EXPECT_EQ(bench.ring.next_batch().count, 0);
}

TEST(RingReader, ADeviceThatWasToldToGoOnMayShowOlderRecordsAgain) {
  Bench bench;
  bench.show(8);
  EXPECT_TRUE(bench.read());
  EXPECT_TRUE(bench.read());
  bench.take();
  for (int look = 0; look < 3; ++look) bench.show(0);
  EXPECT_FALSE(bench.ring.stopped()) << "it was switched on again and waits";
  EXPECT_TRUE(bench.ring.holds_none());
  bench.ring.goes_on_behind(5);
  for (std::uint32_t newest = 6; newest <= 9; ++newest) bench.show(newest);
  EXPECT_FALSE(bench.ring.stopped());
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), Sequences{9});
}

constexpr std::uint32_t kLastNumber = 0xFFFFFFFFU;

TEST(RingReader, TakesTheLastRecordThatHasANumberAndNoFurtherOne) {
  Bench bench(kLastNumber - 3);
  bench.show(kLastNumber, 2 | 16);
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), (Sequences{kLastNumber - 2, kLastNumber - 1, kLastNumber}));
  for (int look = 0; look < 4; ++look) bench.show(kLastNumber, 2 | 16);
  EXPECT_EQ(bench.ring.next_batch().count, 0);
  EXPECT_EQ(bench.status.losses, 0U) << bench.status.last_loss;
  EXPECT_EQ(bench.status.last, kLastNumber);
  EXPECT_TRUE(bench.status.finished);
  for (int look = 0; look < 2; ++look) bench.show(1);
  EXPECT_TRUE(bench.ring.stopped());
  EXPECT_NE(bench.status.stopped.find("there is no number beyond that"), std::string::npos) << bench.status.stopped;
}

TEST(RingReader, TakesTheOverflowBitForAGap) {
  Bench bench;
  bench.show(1, 2 | 8);
  EXPECT_EQ(bench.status.losses, 0U);
  bench.show(1, 2 | 8);
  EXPECT_GT(bench.status.losses, 0U);
}

TEST(RingReader, TakesEveryOverflowForALossOfItsOwn) {
  Bench bench;
  const auto overflow = [&bench](int headers) {
    for (int look = 0; look < headers; ++look) bench.show(1, 2 | 8);
  };
  overflow(5);
  EXPECT_EQ(bench.status.losses, 1U) << "the bit stays set";
  bench.show(1);
  overflow(5);
  EXPECT_EQ(bench.status.losses, 1U) << "one header alone may be an older one";
  for (int look = 0; look < 2; ++look) bench.show(1);
  overflow(1);
  EXPECT_EQ(bench.status.losses, 1U);
  overflow(1);
  EXPECT_EQ(bench.status.losses, 2U);
}

TEST(RingReader, ALossOfAnotherKindDoesNotHideAnOverflow) {
  Bench bench;
  for (int look = 0; look < 2; ++look) bench.show(20);
  EXPECT_EQ(bench.status.losses, 1U);
  for (int look = 0; look < 2; ++look) bench.show(20, 2 | 8);
  EXPECT_EQ(bench.status.losses, 2U);
  EXPECT_NE(bench.status.last_loss.find("overflow"), std::string::npos) << bench.status.last_loss;
}

TEST(RingReader, FinishesWhenThreeHeadersSaySoAndAllIsDelivered) {
  Bench bench;
  bench.show(2, 16);
  for (int look = 0; look < 5; ++look) bench.show(2, 16);
  EXPECT_FALSE(bench.status.finished);
  EXPECT_TRUE(bench.read());
  for (int look = 0; look < 3; ++look) bench.show(2, 16);
  EXPECT_FALSE(bench.status.finished) << "not handed out yet";
  bench.take();
  bench.show(2, 16);
  EXPECT_TRUE(bench.status.finished);
  bench.show(3, 16);
  EXPECT_FALSE(bench.status.finished);
}

TEST(RingReader, IsNotMisledByAnOlderHeaderAtTheEnd) {
  Bench bench(5);
  bench.show(5, 16);
  bench.show(5, 16);
  bench.show(6, 16);
  EXPECT_FALSE(bench.status.finished);
}

TEST(RingReader, StopsWhenTheNumberingHasRestarted) {
  Bench bench;
  bench.show(2);
  EXPECT_TRUE(bench.read());
  bench.take();
  bench.show(1, 2, 9);
  EXPECT_FALSE(bench.ring.stopped()) << "one header alone may be damaged";
  EXPECT_EQ(bench.status.run_id, 1U);
  bench.show(1, 2, 9);
  EXPECT_TRUE(bench.ring.stopped());
  EXPECT_EQ(bench.status.run_id, 9U);
  EXPECT_FALSE(bench.status.finished);
  EXPECT_NE(bench.status.last_fault.find("another run (9 instead of 1)"), std::string::npos);
  bench.show(8, 2, 9);
  EXPECT_EQ(bench.ring.next_batch().count, 0);
}

TEST(RingReader, TakesANewRunAsItsOwnBeforeTheFirstRecord) {
  Bench bench;
  bench.show(0, 1, 1);
  bench.show(0, 2, 2);
  bench.show(1, 2, 2);
  EXPECT_FALSE(bench.ring.stopped());
  EXPECT_EQ(bench.status.run_id, 2U);
  EXPECT_TRUE(bench.read());
  EXPECT_EQ(bench.take(), (Sequences{1}));
}

TEST(RingReader, TellsAFaultOfTheDeviceOnce) {
  Bench bench;
  bench.show(0, 4);
  bench.show(0, 4);
  EXPECT_EQ(bench.status.consecutive_faults, 1U);
  EXPECT_NE(bench.status.last_fault.find("the device reports a fault"), std::string::npos);
}

}  // namespace
}  // namespace bladefit
