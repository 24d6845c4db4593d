// What the fit thread does with the events of a session.
#include "firmware_bridge/host/fit/fit_stream.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using testing::blade;
using testing::blade_config;
using testing::measured_points;

TEST(BridgeFitStream, ResetForgetsEverything) {
  const LocalizerConfig config = blade_config();
  std::vector<std::byte> memory(Localizer::memory_required(config) + 64);
  void* start = memory.data();
  std::size_t space = memory.size();
  std::align(64, Localizer::memory_required(config), start, space);
  Localizer* localizer = nullptr;
  ASSERT_EQ(Localizer::create({static_cast<std::byte*>(start), space}, blade(), config, localizer), Status::ok);
  FitStream stream(*localizer, 2048);
  const auto feed = [&stream] {
    Verdict verdict;
    for (const ProbePoint& point : measured_points(100)) {
      EXPECT_TRUE(stream.push(point, verdict));
      stream.end_path();
    }
    EXPECT_FALSE(stream.push(measured_points(100).back(), verdict)) << "a number that came before";
    stream.settle();
  };
  feed();
  const FitReport first = localizer->fit();
  stream.reset();
  EXPECT_EQ(localizer->fit().points, 0U);
  feed();
  EXPECT_EQ(std::bit_cast<std::uint64_t>(localizer->fit().rms_mm), std::bit_cast<std::uint64_t>(first.rms_mm));
}

}  // namespace
}  // namespace bladefit
