// Zones through the C interface: a session run from C, and every bad argument.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/owned_localizer.hpp"
#include "tests/unit/firmware_bridge/c_abi_fixture.hpp"

namespace bladefit::testing {
namespace {

constexpr std::uint32_t kZonedPoints = 2000;

struct ZonedSession {
  bladefit_status status = BLADEFIT_OK;
  bladefit_fit_report report{};
  std::uint32_t zones[3] = {};
};

/// In the memory that the constant gives.
ZonedSession zoned_session(std::uint32_t mode) {
  std::vector<double> numbers;
  for (const ProbePoint& point : measured_points(kZonedPoints)) {
    numbers.insert(numbers.end(), point.position.begin(), point.position.end());
    numbers.insert(numbers.end(), point.approach.begin(), point.approach.end());
  }
  const std::size_t size = BLADEFIT_MEMORY_BYTES(4096, mode);
  const Memory memory = take_memory(size);
  const std::vector<std::byte>& design = blade_bytes();
  ZonedSession out;
  out.status = c_zoned_session(memory.get(), size, design.data(), design.size(), numbers.data(), kZonedPoints, mode,
                               &out.report, out.zones);
  return out;
}

/// The same fit by the core.
FitReport zoned_by_core(std::uint32_t mode) {
  LocalizerConfig config;
  config.capacity = 4096;
  config.mode = static_cast<FitMode>(mode);
  ToleranceMap& map = config.tolerance;
  map.boxes[0] = {0, 0.4, 0.6, 0.0, 1.0, 1};
  map.box_count = 1;
  const double infinite = std::numeric_limits<double>::infinity();
  map.zones[0] = {Region::leading_edge, false, 0.0, infinite, 0.06, 0.03};
  map.zones[1] = {Region::rest, true, 100.0, infinite, 0.3, 0.15};
  map.zone_count = 2;
  map.rest_mm = 0.25;
  OwnedLocalizer localizer(blade(), config);
  Verdict verdict;
  for (ProbePoint point : measured_points(kZonedPoints)) {
    point.path = 0;
    EXPECT_TRUE(succeeded(localizer->push(point, verdict)));
  }
  localizer->conclude();
  EXPECT_EQ(refine_fully(*localizer), Status::ok);
  return localizer->fit();
}

TEST(BridgeCAbiZones, EveryModeRunsFromC) {
  for (const std::uint32_t mode : {BLADEFIT_LEAST_SQUARES, BLADEFIT_MIN_TOLERANCE, BLADEFIT_CONSTRAINED}) {
    const ZonedSession session = zoned_session(mode);
    ASSERT_EQ(session.status, BLADEFIT_OK) << mode;
    EXPECT_GT(session.zones[0], 0U);
    EXPECT_GT(session.zones[1], 0U);
    EXPECT_GT(session.zones[2], 0U);
    const FitReport core = zoned_by_core(mode);
    EXPECT_EQ(session.report.status, static_cast<std::uint32_t>(core.status)) << mode;
    EXPECT_NEAR(session.report.rms_mm, core.rms_mm, 1e-9) << mode;
    EXPECT_NEAR(session.report.smallest_tolerance_mm, core.smallest_tolerance_mm, 1e-9) << mode;
    EXPECT_EQ(session.report.leading_edge.count, core.leading_edge.count) << mode;
  }
}

/// A fit without points, and zones that it takes.
class BridgeCAbiZonesRefused : public BridgeCAbi {
 protected:
  void SetUp() override {
    BridgeCAbi::SetUp();
    ASSERT_EQ(bladefit_reset(handle_), BLADEFIT_OK);
    zone_ = {sizeof zone_, BLADEFIT_LEADING_EDGE, &box_, 1, 0, 0.0, INFINITY, 0.1, 0.05};
    axis_ = {sizeof axis_, 0, {0, 0, 0}, {1, 0, 0}};
  }
  bladefit_status set() { return bladefit_set_zones(handle_, &zone_, 1, &axis_); }
  /// The limit of the newest point's side, which tells which tolerances hold.
  double tolerance() {
    bladefit_verdict verdict = empty_verdict();
    const bladefit_point point = point_at(++pushed_);
    EXPECT_GE(bladefit_push(handle_, &point, &verdict), 0);
    return verdict.tolerance_mm;
  }

  bladefit_box box_ = {0, 1, 0, 1, 0, 0};
  bladefit_zone zone_{};
  bladefit_axis axis_{};
  std::uint32_t pushed_ = 0;
};

TEST_F(BridgeCAbiZonesRefused, ForEveryWrongField) {
  const auto refused = [this](bladefit_status status, const std::function<void()>& change) {
    const bladefit_zone zone = zone_;
    const bladefit_axis axis = axis_;
    const bladefit_box box = box_;
    change();
    EXPECT_EQ(set(), status);
    zone_ = zone;
    axis_ = axis;
    box_ = box;
  };
  refused(BLADEFIT_BAD_SIZE, [this] { --zone_.struct_size; });
  refused(BLADEFIT_BAD_SIZE, [this] { ++axis_.struct_size; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { zone_.region = 2; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { zone_.reserved = 1; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { axis_.reserved = 1; });
  refused(BLADEFIT_NULL_ARGUMENT, [this] { zone_.boxes = nullptr; });
  refused(BLADEFIT_MISALIGNED,
          [this] { zone_.boxes = reinterpret_cast<const bladefit_box*>(reinterpret_cast<const char*>(&box_) + 1); });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { zone_.box_count = BLADEFIT_MAX_ZONE_BOXES + 1; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { box_.reserved = 1; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { box_.patch = 1000; });
  refused(BLADEFIT_NOT_FINITE, [this] { box_.u_min = NAN; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { zone_.plus_mm = 0; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { zone_.minus_mm = -0.1; });
  refused(BLADEFIT_NOT_FINITE, [this] { zone_.plus_mm = NAN; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { zone_.radius_low_mm = -1; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { zone_.radius_high_mm = 0; });
  refused(BLADEFIT_OUT_OF_RANGE, [this] { axis_.direction[0] = 2; });
  refused(BLADEFIT_NOT_FINITE, [this] { axis_.point[2] = INFINITY; });
  EXPECT_EQ(tolerance(), INFINITY) << "as it was configured";
}

TEST_F(BridgeCAbiZonesRefused, ForEveryWrongPointerCountAndTime) {
  const bladefit_zone many[BLADEFIT_MAX_ZONES + 1] = {};
  EXPECT_EQ(bladefit_set_zones(nullptr, &zone_, 1, &axis_), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_set_zones(handle_, nullptr, 1, &axis_), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_set_zones(handle_, &zone_, 0, &axis_), BLADEFIT_OUT_OF_RANGE);
  EXPECT_EQ(bladefit_set_zones(handle_, many, BLADEFIT_MAX_ZONES + 1, &axis_), BLADEFIT_OUT_OF_RANGE);
  std::uint32_t zone = 7;
  EXPECT_EQ(bladefit_zone_of(handle_, 1, &zone), BLADEFIT_NOT_FOUND);
  EXPECT_EQ(bladefit_zone_of(handle_, 1, nullptr), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_zone_of(nullptr, 1, &zone), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(zone, 7U);
  EXPECT_EQ(tolerance(), INFINITY);
  EXPECT_EQ(set(), BLADEFIT_TOO_LATE);
  EXPECT_EQ(tolerance(), INFINITY);
}

TEST_F(BridgeCAbiZonesRefused, NoMoreWhereTheyAreGood) {
  ASSERT_EQ(set(), BLADEFIT_OK);
  zone_.plus_mm = 0.2;
  zone_.minus_mm = 0.3;
  EXPECT_EQ(bladefit_set_zones(handle_, &zone_, 1, nullptr), BLADEFIT_OK) << "in place of those before";
  const double tolerance_now = tolerance();
  EXPECT_TRUE(tolerance_now == 0.2 || tolerance_now == 0.3);
  std::uint32_t zone = 0;
  EXPECT_EQ(bladefit_zone_of(handle_, 1, &zone), BLADEFIT_OK);
  EXPECT_EQ(zone, 1U);
  ASSERT_EQ(bladefit_reset(handle_), BLADEFIT_OK);
  EXPECT_EQ(tolerance(), tolerance_now) << "zones stay";
}

/// Bounds need a limit everywhere.
TEST_F(BridgeCAbiZonesRefused, WithoutALimitOnTheRestInTheModesOfBounds) {
  config_.mode = BLADEFIT_MIN_TOLERANCE;
  size_ = bladefit_memory_required(&config_, design_.data(), design_.size());
  memory_ = take_memory(size_);
  ASSERT_EQ(init(), BLADEFIT_OK);
  EXPECT_EQ(set(), BLADEFIT_OUT_OF_RANGE);
  config_.rest_tolerance_mm = 0.3;
  ASSERT_EQ(init(), BLADEFIT_OK);
  EXPECT_EQ(set(), BLADEFIT_OK);
  zone_.minus_mm = INFINITY;
  EXPECT_EQ(set(), BLADEFIT_OUT_OF_RANGE) << "on one side alone";
}

}  // namespace
}  // namespace bladefit::testing
