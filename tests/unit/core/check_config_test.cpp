// Which configurations the core refuses, by which field, and why.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <set>
#include <string>

#include "core/localizer/check_config.hpp"
#include "core/localizer/config_fields.hpp"

namespace bladefit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kPatches = 2;

LocalizerConfig config_with_box() {
  LocalizerConfig config;
  config.tolerance.box_count = 1;
  config.tolerance.boxes[0] = {1, 0.4, 0.6, 0, 1};
  return config;
}

struct Refused {
  const char* field;
  Status status;
  std::function<void(LocalizerConfig&)> change;
};

class CheckConfig : public ::testing::TestWithParam<Refused> {};

TEST_P(CheckConfig, NamesTheField) {
  LocalizerConfig config = config_with_box();
  ASSERT_FALSE(check_config(config, kPatches));
  GetParam().change(config);
  const ConfigFault fault = check_config(config, kPatches);
  ASSERT_TRUE(fault) << GetParam().field;
  EXPECT_STREQ(fault.field, GetParam().field);
  EXPECT_EQ(fault.status, GetParam().status) << fault.field;
  EXPECT_GT(std::string(fault.reason).size(), 5U);
  std::set<std::string> names;
  for_each_field(config, [&names](const char* name, const auto&) { names.insert(name); });
  EXPECT_TRUE(names.contains(fault.field)) << fault.field;
}

using C = LocalizerConfig;
constexpr Status kRange = Status::out_of_range, kFinite = Status::not_finite;

INSTANTIATE_TEST_SUITE_P(Sizes, CheckConfig,
                         ::testing::Values(Refused{"capacity", kRange, [](C& c) { c.capacity = 5; }},
                                           Refused{"capacity", kRange, [](C& c) { c.capacity = 16777217; }},
                                           Refused{"refresh_per_push", kRange, [](C& c) { c.refresh_per_push = 1; }},
                                           Refused{"refresh_per_push", kRange, [](C& c) { c.refresh_per_push = 65; }},
                                           Refused{"tolerance.box_count", kRange,
                                                   [](C& c) { c.tolerance.box_count = 129; }},
                                           Refused{"locked", kRange, [](C& c) { c.locked = 63; }},
                                           Refused{"further_starts", kRange, [](C& c) { c.further_starts = 13; }}));

INSTANTIATE_TEST_SUITE_P(
    Numbers, CheckConfig,
    ::testing::Values(Refused{"probe_radius_mm", kFinite, [](C& c) { c.probe_radius_mm = kInfinity; }},
                      Refused{"probe_radius_mm", kRange, [](C& c) { c.probe_radius_mm = -1; }},
                      Refused{"noise_floor_mm", kRange, [](C& c) { c.noise_floor_mm = 0; }},
                      Refused{"determined_mm", kFinite, [](C& c) { c.determined_mm = kInfinity; }},
                      Refused{"determined_mm", kRange, [](C& c) { c.determined_mm = -1; }},
                      Refused{"loss_scale_mm", kRange, [](C& c) { c.loss_scale_mm = -1; }},
                      Refused{"window_low", kRange, [](C& c) { c.window_low = -0.1; }},
                      Refused{"window_low", kRange, [](C& c) { c.window_low = c.window_high; }},
                      Refused{"window_high", kRange, [](C& c) { c.window_high = 1.1; }},
                      Refused{"start.translation", kFinite, [](C& c) { c.start.translation[1] = kNan; }},
                      Refused{"start.translation", kRange, [](C& c) { c.start.translation[2] = 1e13; }},
                      Refused{"probe_radius_mm", kRange, [](C& c) { c.probe_radius_mm = 1e300; }},
                      Refused{"loss_scale_mm", kRange, [](C& c) { c.loss_scale_mm = 1e300; }},
                      Refused{"start.rotation", kFinite, [](C& c) { c.start.rotation(2, 1) = kNan; }},
                      Refused{"start.rotation", kRange, [](C& c) { c.start.rotation *= 1.1; }},
                      Refused{"start.rotation", kRange, [](C& c) { c.start.rotation.col(0) *= -1; }}));

INSTANTIATE_TEST_SUITE_P(
    Tolerances, CheckConfig,
    ::testing::Values(Refused{"tolerance.leading_edge_mm", kFinite, [](C& c) { c.tolerance.leading_edge_mm = kNan; }},
                      Refused{"tolerance.leading_edge_mm", kRange, [](C& c) { c.tolerance.leading_edge_mm = 0; }},
                      Refused{"tolerance.rest_mm", kRange, [](C& c) { c.tolerance.rest_mm = -1; }},
                      Refused{"tolerance.transition", kRange, [](C& c) { c.tolerance.transition = -1; }},
                      Refused{"tolerance.boxes.patch", kRange, [](C& c) { c.tolerance.boxes[0].patch = 2; }},
                      Refused{"tolerance.boxes.u_min", kRange, [](C& c) { c.tolerance.boxes[0].u_min = 0.7; }},
                      Refused{"tolerance.boxes.v_min", kRange, [](C& c) { c.tolerance.boxes[0].v_max = -1; }},
                      Refused{"tolerance.boxes.v_max", kFinite, [](C& c) { c.tolerance.boxes[0].v_max = kInfinity; }}));

INSTANTIATE_TEST_SUITE_P(Modes, CheckConfig,
                         ::testing::Values(Refused{"ratio", kRange, [](C& c) { c.ratio = 0.99; }},
                                           Refused{"ratio", kFinite, [](C& c) { c.ratio = kNan; }},
                                           Refused{"tolerance.rest_mm", kRange,
                                                   [](C& c) { c.mode = FitMode::constrained; }},
                                           Refused{"loss", kRange, [](C& c) {
                                                     c.mode = FitMode::minimax;
                                                     c.loss = Loss::huber;
                                                   }}));

TEST(CheckConfigDesign, BoxesBeyondThoseInUseAreNotLookedAt) {
  LocalizerConfig config = config_with_box();
  config.tolerance.boxes[1] = {99, kNan, -1, 2, 1};
  EXPECT_FALSE(check_config(config, kPatches));
}

TEST(CheckConfigDesign, AnyPatchWillDoWhileTheDesignIsNotKnown) {
  LocalizerConfig config = config_with_box();
  config.tolerance.boxes[0].patch = 1000;
  EXPECT_FALSE(check_config(config, kAnyPatches));
  EXPECT_TRUE(check_config(config, kPatches));
}

}  // namespace
}  // namespace bladefit
