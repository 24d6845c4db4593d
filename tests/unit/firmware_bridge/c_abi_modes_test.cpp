// Modes beside least squares through the C interface.
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware_bridge/bladefit.h"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// The smallest tolerance of truth/full.json, with the points that prove it.
TEST(BridgeCAbiModes, TheSmallestToleranceIsFollowedAndProven) {
  const std::vector<ProbePoint> points = points_of(read_case("dtmb4119"), "full");
  bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
  config.capacity = 2000;
  config.mode = BLADEFIT_MIN_TOLERANCE;
  config.ratio = 0;
  config.box_count = 1;
  config.boxes[0] = {0.4, 0.6, 0.0, 1.0, 0, 0};
  const std::vector<std::byte>& design = reference_design("dtmb4119").bytes();
  const std::size_t size = bladefit_memory_required(&config, design.data(), design.size());
  ASSERT_GT(size, 0U);
  const AlignedBlock memory(size);
  bladefit_handle* handle = nullptr;
  ASSERT_EQ(bladefit_init(memory.bytes().data(), size, design.data(), design.size(), &config, &handle), BLADEFIT_OK);
  for (const ProbePoint& from : points) {
    bladefit_point point{sizeof(bladefit_point), from.sequence, 0, 0, {}, {}, 0};
    std::ranges::copy(from.position, point.position);
    std::ranges::copy(from.approach, point.approach);
    bladefit_verdict verdict{};
    verdict.struct_size = sizeof verdict;
    ASSERT_GE(bladefit_push(handle, &point, &verdict), 0);
  }
  bladefit_fit_report report{};
  report.struct_size = sizeof report;
  ASSERT_EQ(bladefit_fit(handle, &report), BLADEFIT_OK);
  EXPECT_NEAR(report.smallest_tolerance_mm, 0.02010, 2e-4);
  ASSERT_EQ(bladefit_conclude(handle), BLADEFIT_OK);
  ASSERT_EQ(bladefit_refine(handle, 10000000), BLADEFIT_OK);
  ASSERT_EQ(bladefit_fit(handle, &report), BLADEFIT_OK);
  EXPECT_NEAR(report.smallest_tolerance_mm, 0.02010, 1e-5);
  EXPECT_EQ(report.improving, 0U);
  ASSERT_EQ(report.certificate.count, 7U);
  EXPECT_LT(report.stationarity, 1e-9);
  for (std::uint32_t k = 0; k < report.certificate.count; ++k) {
    EXPECT_GE(report.certificate.sequence[k], 1U);
    EXPECT_GE(report.certificate.multiplier[k], 0.0);
  }
}

/// Fields of the modes that no fit can be made of.
TEST(BridgeCAbiModes, ContradictionsAreRefused) {
  const std::vector<std::byte>& design = reference_design("dtmb4119").bytes();
  const auto refused = [&](auto change) {
    bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
    change(config);
    return bladefit_memory_required(&config, design.data(), design.size()) == 0;
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto& c) { c.mode = 5; }));
  EXPECT_TRUE(refused([](auto& c) { c.regions = 2; }));
  EXPECT_TRUE(refused([](auto& c) { c.locked = 63; }));
  EXPECT_TRUE(refused([](auto& c) { c.loss = 3; }));
  EXPECT_TRUE(refused([](auto& c) { c.ratio = 0.5; }));
  EXPECT_TRUE(refused([](auto& c) { c.loss_scale_mm = -1; }));
  EXPECT_TRUE(refused([](auto& c) { c.mode = BLADEFIT_CONSTRAINED; }));  // no tolerance
  EXPECT_TRUE(refused([](auto& c) { c.mode = BLADEFIT_MINIMAX, c.loss = BLADEFIT_LOSS_HUBER; }));
}

}  // namespace
}  // namespace bladefit::testing
