// Readers of the feed, each at its own pace, have in the end what was written.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <thread>
#include <vector>

#include "firmware_bridge/host/feed/point_feed.hpp"

namespace bladefit {
namespace {

Verdict judged_at(std::uint32_t sequence, double distance, PointState state = PointState::in) {
  Verdict made;
  made.sequence = sequence;
  made.state = state;
  made.foot.distance = distance;
  made.foot.point = Vec3(1, 2, static_cast<double>(sequence));
  made.foot.normal = Vec3::UnitX();
  return made;
}

/// A page: what it has of the points by slot.
struct FeedReader {
  FeedPlace place;
  std::map<std::uint32_t, FedPoint> points;
  std::size_t afresh = 0, rows = 0;

  /// Reads one piece of up to `room` points; false where nothing more is there at once.
  bool read(const PointFeed& feed, std::size_t room) {
    std::vector<FedPoint> to(room);
    const FeedPiece piece = feed.read(place, to);
    if (piece.afresh) {
      points.clear();
      ++afresh;
    }
    for (std::size_t k = 0; k < piece.count; ++k) points[to[k].slot] = to[k];
    rows += piece.count;
    place = piece.next;
    return piece.more;
  }

  void read_all(const PointFeed& feed) {
    while (read(feed, 7)) {
    }
  }

  [[nodiscard]] std::map<std::uint32_t, float> distances() const {
    std::map<std::uint32_t, float> all;
    for (const auto& [slot, point] : points) all[point.verdict.sequence] = point.verdict.distance;
    return all;
  }
};

TEST(PointFeed, GivesEveryPointOnceAndThenWhatChanges) {
  PointFeed feed(100, 1000);
  for (std::uint32_t sequence = 1; sequence <= 20; ++sequence) feed.judged(judged_at(sequence, 0.1));
  FeedReader reader;
  reader.read_all(feed);
  EXPECT_EQ(reader.rows, 20U);
  feed.judged(judged_at(5, 0.2));
  feed.judged(judged_at(5, 0.3, PointState::out));
  feed.judged(judged_at(6, 0.1));  // as before
  feed.judged(judged_at(21, 0.4));
  reader.read_all(feed);
  EXPECT_EQ(reader.rows, 22U);
  EXPECT_EQ(reader.afresh, 1U);
  EXPECT_FLOAT_EQ(reader.distances().at(5), 0.3F);
  EXPECT_EQ(reader.distances().size(), 21U);
}

TEST(PointFeed, RemembersWhatAPointWasJudgedBefore) {
  PointFeed feed(100, 10);
  for (const double distance : {0.1, 0.2, 0.3}) feed.judged(judged_at(7, distance));
  std::array<FedVerdict, 5> history;
  ASSERT_EQ(feed.history(7, history), 3U);
  EXPECT_FLOAT_EQ(history[0].distance, 0.3F);
  EXPECT_FLOAT_EQ(history[2].distance, 0.1F);
  EXPECT_EQ(feed.history(8, history), 0U);
  // Others push what is old out of the memory.
  for (std::uint32_t sequence = 10; sequence < 18; ++sequence) feed.judged(judged_at(sequence, 0.1));
  ASSERT_EQ(feed.history(7, history), 2U);
  EXPECT_FLOAT_EQ(history[1].distance, 0.2F);
}

/// The same with a tolerance.
Verdict within(std::uint32_t sequence, double distance, double tolerance) {
  Verdict made = judged_at(sequence, distance);
  made.tolerance_mm = tolerance;
  return made;
}

TEST(PointFeed, ADistanceThatGoesOnWithThePoseIsToldWhereItLooksAnother) {
  PointFeed feed(100, 1000);
  for (std::uint32_t sequence = 1; sequence <= 9; ++sequence) feed.judged(within(sequence, 0.1, 0.64));
  FeedReader reader;
  reader.read_all(feed);
  feed.followed(within(3, 0.109, 0.64));  // less than a 64th of the tolerance
  feed.followed(within(4, 0.111, 0.64));
  feed.followed(within(77, 0.5, 0.64));  // nobody knows it
  reader.read_all(feed);
  EXPECT_EQ(reader.rows, 10U);
  EXPECT_FLOAT_EQ(reader.distances().at(3), 0.1F);
  EXPECT_FLOAT_EQ(reader.distances().at(4), 0.111F);
  // At rest it is told to the last digit.
  feed.judged(within(3, 0.109, 0.64));
  reader.read_all(feed);
  EXPECT_FLOAT_EQ(reader.distances().at(3), 0.109F);
}

TEST(PointFeed, WhatAPointWasJudgedIsNotPushedOutByItsDistances) {
  PointFeed feed(100, 1000);
  feed.judged(judged_at(7, 0.1));
  for (int step = 1; step <= 50; ++step) feed.followed(judged_at(7, 0.1 + 0.1 * step));
  feed.judged(judged_at(7, 5.1, PointState::out));
  for (int step = 1; step <= 50; ++step) feed.followed(judged_at(7, 5.1 + 0.1 * step, PointState::out));
  std::array<FedVerdict, 9> history;
  ASSERT_EQ(feed.history(7, history), 4U);
  EXPECT_FLOAT_EQ(history[0].distance, 10.1F);
  EXPECT_EQ(history[1].state, PointState::out);
  EXPECT_FLOAT_EQ(history[1].distance, 5.1F);
  EXPECT_FLOAT_EQ(history[3].distance, 0.1F);
}

TEST(PointFeed, TheOldestPointMakesRoom) {
  PointFeed feed(4, 100);
  FeedReader reader;
  for (std::uint32_t sequence = 1; sequence <= 6; ++sequence) {
    feed.judged(judged_at(sequence, 0.1));
    if (sequence == 4) reader.read_all(feed);
  }
  reader.read_all(feed);
  const std::map<std::uint32_t, float> distances = reader.distances();
  EXPECT_EQ(distances.size(), 4U);
  EXPECT_EQ(distances.begin()->first, 3U);
  EXPECT_EQ(reader.afresh, 1U);
}

TEST(PointFeed, WhoFellBehindBeginsAfresh) {
  PointFeed feed(100, 10);
  FeedReader reader;
  feed.judged(judged_at(1, 0.1));
  reader.read_all(feed);
  for (std::uint32_t sequence = 2; sequence <= 40; ++sequence) feed.judged(judged_at(sequence, 0.1));
  reader.read_all(feed);
  EXPECT_EQ(reader.afresh, 2U);
  EXPECT_EQ(reader.distances().size(), 40U);
}

TEST(PointFeed, AnyReaderHasInTheEndWhatWasWritten) {
  std::mt19937 random(20250918);
  for (int round = 0; round < 60; ++round) {
    PointFeed feed(16, 24);
    std::map<std::uint32_t, float> truth;  // of the newest 16 points
    std::vector<std::uint32_t> order;
    std::array<FeedReader, 3> readers;
    for (int step = 0; step < 400; ++step) {
      const auto what = static_cast<std::uint32_t>(random() % 100);
      if (what == 0) {
        feed.clear();
        truth.clear();
        order.clear();
      } else if (what < 60) {
        const auto sequence = static_cast<std::uint32_t>(1 + random() % 40);
        const double distance = static_cast<double>(random() % 1000) * 0.01;
        const bool known = truth.contains(sequence);
        if (known && what < 30)
          feed.followed(judged_at(sequence, distance));
        else
          feed.judged(judged_at(sequence, distance));
        if (!known) order.push_back(sequence);
        truth[sequence] = static_cast<float>(distance);
        if (order.size() > 16) {
          truth.erase(order.front());
          order.erase(order.begin());
        }
      } else {
        static_cast<void>(readers[random() % 3].read(feed, 1 + random() % 9));
      }
    }
    for (FeedReader& reader : readers) {
      reader.read_all(feed);
      ASSERT_EQ(reader.distances(), truth) << "round " << round;
      ASSERT_EQ(reader.place, feed.end()) << "round " << round;
    }
  }
}

TEST(PointFeed, ReadsWhileItIsWritten) {
  PointFeed feed(2000, 4000);
  FeedReader reader;
  std::thread writer([&feed] {
    for (int round = 1; round <= 5; ++round) {
      for (std::uint32_t sequence = 1; sequence <= 2000; ++sequence) feed.judged(judged_at(sequence, round));
    }
  });
  for (int turn = 0; turn < 300; ++turn) static_cast<void>(reader.read(feed, 512));
  writer.join();
  reader.read_all(feed);
  ASSERT_EQ(reader.distances().size(), 2000U);
  for (const auto& [sequence, distance] : reader.distances()) ASSERT_EQ(distance, 5.0F) << sequence;
}

}  // namespace
}  // namespace bladefit
