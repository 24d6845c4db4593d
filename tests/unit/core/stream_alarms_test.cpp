// No alarm that the end does not confirm: the points of a blade with three defects at its leading edge, one by one.

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// Material of a few touches, too much or too little [mm]: along the probing direction.
struct Spot {
  std::uint32_t first, last;
  double excess;
};
constexpr Spot kSpots[] = {{811, 816, 0.31}, {1312, 1315, -0.27}, {1688, 1689, 0.24}};

std::vector<ProbePoint> defective(std::vector<ProbePoint> points) {
  for (ProbePoint& point : points) {
    for (const Spot& spot : kSpots) {
      if (point.sequence < spot.first || point.sequence > spot.last) continue;
      for (std::size_t k = 0; k < 3; ++k) point.position[k] -= spot.excess * point.approach[k];
    }
  }
  return points;
}

/// When a point was told to be out, and which are out in the end.
struct Alarms {
  std::map<std::uint32_t, std::uint32_t>
      told;  ///< sequence of the point, that of the newest one when it was first told
  std::set<std::uint32_t> confirmed;
  FitReport report;
};

Alarms alarms_of(FitMode mode, bool directions) {
  const ReferenceCase reference = read_case("dtmb4119");
  const std::vector<ProbePoint> points = defective(points_of(reference, "full"));
  LocalizerConfig config = config_of(reference, points.size());
  config.use_approach = directions;
  config.mode = mode;
  config.tolerance.leading_edge_mm = 0.15;
  config.tolerance.rest_mm = 0.5;
  OwnedLocalizer localizer(reference_design("dtmb4119").image(), config);
  Alarms out;
  const auto note = [&out](const Verdict& verdict, std::uint32_t now) {
    if (verdict.state == PointState::out) out.told.emplace(verdict.sequence, now);
  };
  Verdict verdict;
  for (const ProbePoint& point : points) {
    EXPECT_TRUE(succeeded(localizer->push(point, verdict)));
    note(verdict, point.sequence);
    while (localizer->next_revision(verdict)) note(verdict, point.sequence);
  }
  localizer->conclude();
  EXPECT_EQ(refine_fully(*localizer), Status::ok);
  out.report = localizer->fit();
  for (const ProbePoint& point : points) {
    EXPECT_EQ(localizer->verdict_of(point.sequence, verdict), Status::ok);
    if (verdict.state == PointState::out) out.confirmed.insert(point.sequence);
  }
  return out;
}

class StreamAlarms : public ::testing::TestWithParam<FitMode> {};

TEST_P(StreamAlarms, AreAllConfirmedByTheEnd) {
  for (const bool directions : {true, false}) {
    const Alarms alarms = alarms_of(GetParam(), directions);
    std::uint32_t delay = 0, false_ones = 0;
    for (const auto& [sequence, at] : alarms.told) {
      if (!alarms.confirmed.contains(sequence)) ++false_ones;
      delay = std::max(delay, at - sequence);
    }
    EXPECT_EQ(false_ones, 0U) << (directions ? "with" : "without") << " directions";
    EXPECT_FALSE(alarms.confirmed.empty());
    RecordProperty(directions ? "delay_with_directions" : "delay_without", static_cast<int>(delay));
    std::printf("%s: %zu told, %u of them not confirmed, %zu confirmed, longest delay %u points\n",
                word_of(GetParam()).data(), alarms.told.size(), false_ones, alarms.confirmed.size(), delay);
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, StreamAlarms,
                         ::testing::Values(FitMode::least_squares, FitMode::minimax, FitMode::range,
                                           FitMode::min_tolerance, FitMode::constrained),
                         [](const auto& parameter) { return std::string(word_of(parameter.param)); });

}  // namespace
}  // namespace bladefit::testing
