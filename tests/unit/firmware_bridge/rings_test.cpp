// What joins the threads of the host, and the small counters beside it.
#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "firmware_bridge/host/threads/latency_histogram.hpp"
#include "firmware_bridge/host/threads/latest_value.hpp"
#include "firmware_bridge/host/threads/ring.hpp"
#include "firmware_bridge/host/threads/wakeup.hpp"

namespace bladefit {
namespace {

TEST(BridgeRing, HoldsExactlyItsCapacity) {
  Ring<int> ring(3);
  EXPECT_TRUE(ring.empty());
  for (int round = 0; round < 5; ++round) {
    EXPECT_EQ(ring.room(), 3U);
    for (int value = 0; value < 3; ++value) EXPECT_TRUE(ring.push(value));
    EXPECT_FALSE(ring.push(99));
    EXPECT_EQ(ring.room(), 0U);
    for (int value = 0; value < 3; ++value) {
      int taken = -1;
      EXPECT_TRUE(ring.pop(taken));
      EXPECT_EQ(taken, value);
    }
    int taken = -1;
    EXPECT_FALSE(ring.pop(taken));
  }
}

TEST(BridgeRing, KeepsTheOrderBetweenTwoThreads) {
  constexpr std::uint32_t kCount = 50000;
  Ring<std::array<std::uint32_t, 4>> ring(64);
  std::thread writer([&ring] {
    for (std::uint32_t value = 0; value < kCount; ++value) {
      while (!ring.push({value, value, value, value})) std::this_thread::yield();
    }
  });
  for (std::uint32_t expected = 0; expected < kCount; ++expected) {
    std::array<std::uint32_t, 4> taken{};
    while (!ring.pop(taken)) std::this_thread::yield();
    const std::array<std::uint32_t, 4> whole = {expected, expected, expected, expected};
    ASSERT_EQ(taken, whole);
  }
  writer.join();
}

TEST(BridgeLatestValue, GivesEachValueOnceAndWhole) {
  LatestValue<std::array<std::uint32_t, 8>> latest;
  std::array<std::uint32_t, 8> value{};
  EXPECT_FALSE(latest.take(value));
  constexpr std::uint32_t kCount = 20000;
  std::thread writer([&latest] {
    for (std::uint32_t number = 1; number <= kCount; ++number) {
      std::array<std::uint32_t, 8> whole;
      whole.fill(number);
      latest.publish(whole);
    }
  });
  std::uint32_t last = 0;
  while (last < kCount) {
    if (!latest.take(value)) {
      std::this_thread::yield();
      continue;
    }
    for (const std::uint32_t word : value) ASSERT_EQ(word, value[0]);
    ASSERT_GT(value[0], last);
    last = value[0];
  }
  writer.join();
  EXPECT_FALSE(latest.take(value));
}

TEST(BridgeWakeup, IsKeptForTheNextWait) {
  const Wakeup wakeup;
  wakeup.signal();
  wakeup.signal();
  const auto start = std::chrono::steady_clock::now();
  wakeup.wait(std::chrono::milliseconds(5000));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(4000));
  wakeup.wait(std::chrono::milliseconds(20));
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(20));
}

TEST(BridgeLatencyHistogram, FindsTheQuantileWithinABin) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.quantile_us(0.99), 0);
  for (int count = 0; count < 990; ++count) histogram.add(2000);
  for (int count = 0; count < 10; ++count) histogram.add(1'000'000);
  EXPECT_NEAR(histogram.quantile_us(0.99), 2.0, 0.2);
  EXPECT_NEAR(histogram.quantile_us(0.999), 1000, 100);
  histogram.add(-5);
  histogram.add(INT64_MAX);
  EXPECT_GT(histogram.quantile_us(1.0), 1e6);
}

}  // namespace
}  // namespace bladefit
