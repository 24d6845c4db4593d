// Where on the blade things are: sides, the strip of the leading edge, defects, where to probe next.
#include <gtest/gtest.h>

#include <set>

#include "firmware_bridge/host/blade/view_of_blade.hpp"
#include "firmware_bridge/host/panel/panel_map.hpp"
#include "tests/support/panel_state.hpp"
#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using testing::blade;
using testing::blade_config;

const BladeLayout& blade_layout() {
  static const BladeLayout layout(blade(), blade_config(), {}, 0);
  return layout;
}

/// A verdict at (u, v) of the blade.
Verdict verdict_at(std::uint32_t sequence, double u, double v, PointState state, double distance = 0) {
  const Surface surface(blade());
  const SurfacePlace at = surface.place_at(0, u, v);
  const SurfacePoint point = surface.evaluate(at);
  Verdict verdict;
  verdict.sequence = sequence;
  verdict.foot = {.u = u, .v = v, .point = point.s, .normal = surface.normal(at, point), .distance = distance};
  verdict.region = region_at(blade_config().tolerance, 0, u, v);
  verdict.tolerance_mm = 0.1;
  verdict.state = state;
  if (state == PointState::out) verdict.action = distance > 0 ? Action::cut : Action::weld;
  return verdict;
}

FitReport settled_report() {
  FitReport report;
  report.status = FitStatus::converged;
  report.determined = report.free = 6;
  return report;
}

TEST(BladeLayout, SuctionAndPressureSideLieOnEitherSideOfTheLeadingEdge) {
  const BladeLayout& layout = blade_layout();
  // In the file the section runs from the trailing edge over the pressure side to the leading edge, u = 0.5.
  for (const double v : {0.1, 0.5, 0.9}) {
    const auto side = [&](double u) {
      const Verdict place = verdict_at(1, u, v, PointState::in);
      return layout.side_of(place.foot.point, place.foot.normal, place.region);
    };
    EXPECT_EQ(side(0.25), BladeSide::pressure) << v;
    EXPECT_EQ(side(0.5), BladeSide::nose) << v;
    EXPECT_EQ(side(0.75), BladeSide::suction) << v;
  }
}

TEST(BladeLayout, NoSidesWithoutALeadingEdge) {
  LocalizerConfig config = blade_config();
  config.tolerance.box_count = 0;
  const BladeLayout layout(blade(), config, {}, 0);
  EXPECT_EQ(layout.edge_root_mm(), layout.edge_tip_mm());
  for (const BladePlace& place : layout.places()) EXPECT_EQ(place.side, BladeSide::unknown);
}

TEST(BladeLayout, CellsRunFromRootToTip) {
  const BladeLayout& layout = blade_layout();
  EXPECT_NEAR(layout.edge_root_mm(), 0.2 * layout.tip_radius_mm(), 0.05 * layout.tip_radius_mm());
  EXPECT_EQ(layout.cell_of(0), 0U);
  EXPECT_EQ(layout.cell_of(1e6), BladeView::kCells - 1);
  for (std::size_t cell = 0; cell < BladeView::kCells; ++cell) {
    EXPECT_EQ(layout.cell_of(layout.radius_of_cell(cell)), cell);
  }
}

TEST(BladeCounts, TheStripShowsTheWorstAndTakesBack) {
  BladeCounts counts(blade_layout());
  const Verdict in = verdict_at(1, 0.5, 0.5, PointState::in), cut = verdict_at(2, 0.5, 0.5, PointState::out, 0.3);
  const std::size_t cell = blade_layout().cell_of(blade_layout().axis().radius_of(in.foot.point));
  EXPECT_EQ(counts.edge_cell(cell), EdgeCell::not_probed);
  counts.count(in, 1);
  EXPECT_EQ(counts.edge_cell(cell), EdgeCell::in);
  counts.count(cut, 1);
  EXPECT_EQ(counts.edge_cell(cell), EdgeCell::cut);
  counts.count(cut, -1);
  EXPECT_EQ(counts.edge_cell(cell), EdgeCell::in);
  EXPECT_TRUE(counts.out().empty());
  counts.count(in, -1);
  EXPECT_EQ(counts.edge_cell(cell), EdgeCell::not_probed);
  EXPECT_LT(counts.information().norm(), 1e-12);
}

TEST(BladeCounts, SidesAreCountedOffTheLeadingEdge) {
  BladeCounts counts(blade_layout());
  const Verdict place = verdict_at(1, 0.75, 0.5, PointState::in);
  const std::size_t band = blade_layout().band_of(blade_layout().axis().radius_of(place.foot.point));
  counts.count(place, 1);
  counts.count(verdict_at(2, 0.5, 0.5, PointState::in), 1);
  EXPECT_EQ(counts.points(BladeSide::suction, band), 1U);
  EXPECT_EQ(counts.points(BladeSide::pressure, band), 0U);
  counts.count(verdict_at(3, 0.75, 0.5, PointState::rejected), 1);
  EXPECT_EQ(counts.points(BladeSide::suction, band), 1U) << "rejected points do not count";
}

TEST(BladeDefects, NeighboursOfTheSameActionAreOneWorstFirst) {
  BladeCounts counts(blade_layout());
  std::uint32_t sequence = 1;
  for (const double v : {0.30, 0.31, 0.32})
    counts.count(verdict_at(sequence++, 0.5, v, PointState::out, 0.2 + v / 10), 1);
  counts.count(verdict_at(sequence++, 0.5, 0.33, PointState::out, -0.15), 1);
  counts.count(verdict_at(sequence++, 0.5, 0.8, PointState::out, -0.5), 1);
  const BladeView view = view_of_blade(blade_layout(), counts, settled_report());
  ASSERT_EQ(view.defect_count, 3U);
  EXPECT_EQ(view.defects[0].sequence, 5U);
  EXPECT_EQ(view.defects[0].action, Action::weld);
  EXPECT_EQ(view.defects[0].length, 0.0F);
  const BladeDefect& joined = view.defects[1];
  EXPECT_EQ(joined.sequence, 3U) << "its worst point";
  EXPECT_EQ(joined.points, 3);
  EXPECT_EQ(joined.action, Action::cut);
  EXPECT_EQ(joined.region, Region::leading_edge);
  EXPECT_LT(joined.from_ratio, joined.to_ratio);
  const Vec3 first = verdict_at(1, 0.5, 0.30, PointState::in).foot.point;
  const Vec3 last = verdict_at(3, 0.5, 0.32, PointState::in).foot.point;
  EXPECT_NEAR(joined.length, (first - last).norm(), 1e-4);
  EXPECT_EQ(view.defects[2].sequence, 4U);
}

TEST(BladeDefects, AreToldInTheFrameOfTheMachine) {
  BladeCounts counts(blade_layout());
  const Verdict out = verdict_at(7, 0.5, 0.4, PointState::out, 0.25);
  counts.count(out, 1);
  FitReport report = settled_report();
  report.pose.rotation = rotation_of({0.1, -0.2, 0.3});
  report.pose.translation = Vec3(5, -6, 7);
  const BladeView view = view_of_blade(blade_layout(), counts, report);
  const auto& machine = view.defects[0].machine;
  const Vec3 back = apply(report.pose, Vec3(machine[0], machine[1], machine[2]));
  EXPECT_LT((back - (out.foot.point + 0.25 * out.foot.normal)).norm(), 1e-4);
}

TEST(NextPlace, GoesWhereTheLeadingEdgeHasNoPoint) {
  BladeCounts counts(blade_layout());
  std::uint32_t sequence = 1;
  for (double v = 0.005; v < 0.6; v += 0.005) counts.count(verdict_at(sequence++, 0.5, v, PointState::in), 1);
  const NextPlace next = view_of_blade(blade_layout(), counts, settled_report()).next;
  EXPECT_EQ(next.reason, NextReason::edge_not_probed);
  EXPECT_EQ(next.side, BladeSide::nose);
  EXPECT_GT(next.ratio, 0.7F);
  EXPECT_LT(next.ratio, 0.95F);
}

TEST(NextPlace, ThenWhereASideHasNone) {
  BladeCounts counts(blade_layout());
  std::uint32_t sequence = 1;
  for (double v = 0.0; v <= 1.0; v += 0.005) {
    counts.count(verdict_at(sequence++, 0.5, v, PointState::in), 1);
    counts.count(verdict_at(sequence++, 0.75, v, PointState::in), 1);
  }
  const BladeView view = view_of_blade(blade_layout(), counts, settled_report());
  EXPECT_EQ(view.next.reason, NextReason::rest_not_probed);
  EXPECT_EQ(view.next.side, BladeSide::pressure);
  EXPECT_EQ(view.pressure[5], 0);
  EXPECT_GT(view.suction[5], 0);
  EXPECT_EQ(view.pressure[0], BladeView::kNoSurface);
}

/// Points of one small spot leave turns open; the place that says most of them is far from it.
TEST(NextPlace, FirstWhereTheFitLearnsMost) {
  BladeCounts counts(blade_layout());
  for (std::uint32_t k = 0; k < 20; ++k) counts.count(verdict_at(1 + k, 0.7, 0.1 + 0.001 * k, PointState::pending), 1);
  FitReport report = settled_report();
  report.determined = 3;
  const NextPlace next = view_of_blade(blade_layout(), counts, report).next;
  EXPECT_EQ(next.reason, NextReason::fit_open);
  const Vec3 spot = verdict_at(1, 0.7, 0.1, PointState::in).foot.point;
  EXPECT_GT((Vec3(next.machine[0], next.machine[1], next.machine[2]) - spot).norm(), 0.5 * blade_layout().scale_mm());
}

TEST(BladeRegisters, AreReadBackAndBeginWhereTheMapSays) {
  for (const bool low_first : {false, true}) {
    const PanelState state = testing::known_state();
    const PanelImage image = encode_panel(state, {.low_word_first = low_first});
    const std::span<const std::uint16_t> all(image.registers);
    PanelState read;
    ASSERT_TRUE(decode_panel(all.first<kPanelRegisters>(), all.subspan(kExtensionBase, kExtensionRegisters),
                             all.subspan(kBladeBase, kBladeRegisters), read));
    EXPECT_TRUE(read.has_blade);
    EXPECT_EQ(read.texts[kSourceText], state.texts[kSourceText]);
    EXPECT_EQ(read.texts[kFaultText], state.texts[kFaultText]) << "longer than 80 characters";
    EXPECT_EQ(read.link_down_s, 75U);
    EXPECT_EQ(read.blade.defects[15].machine, state.blade.defects[15].machine);
    EXPECT_EQ(read.blade.next.ratio, 0.84F);
    EXPECT_EQ(read.blade.edge, state.blade.edge);
    EXPECT_EQ(image.registers[1020], 2) << "cut";
    EXPECT_EQ(image.registers[1000 + 40], 3) << "weld";
    EXPECT_EQ(image.registers[1130], 65535);
    EXPECT_EQ(image.registers[1520], 'm' << 8 | 'o');
  }
  PanelState old;
  const PanelImage image = encode_panel(testing::known_state(), {});
  const std::span<const std::uint16_t> all(image.registers);
  ASSERT_TRUE(decode_panel(all.first<kPanelRegisters>(), all.subspan(kExtensionBase, kExtensionRegisters), {}, old));
  EXPECT_FALSE(old.has_blade);
}

TEST(BladeRegisters, CanBeReadAndWhatLiesBetweenCannot) {
  EXPECT_TRUE(PanelImage::can_read(0, 600));
  EXPECT_TRUE(PanelImage::can_read(1000, 720));
  EXPECT_FALSE(PanelImage::can_read(599, 2));
  EXPECT_FALSE(PanelImage::can_read(600, 1));
  EXPECT_FALSE(PanelImage::can_read(999, 2));
  EXPECT_FALSE(PanelImage::can_read(1719, 2));
}

}  // namespace
}  // namespace bladefit
