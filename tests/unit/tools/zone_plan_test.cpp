// Zones from their tables to the result: what is planned, what is refused, how points are judged, and what is told.

#include "tools/batch/zone_plan.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "config/zone_table.hpp"
#include "tests/support/reference_design.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/batch/batch_fit.hpp"
#include "tools/batch/tip_radius.hpp"
#include "tools/report/formats.hpp"
#include "tools/reproduce/study_case.hpp"
#include "tools/results/json_reader.hpp"
#include "tools/results/json_writer.hpp"
#include "tools/results/operator_summary.hpp"
#include "tools/results/verdicts_csv.hpp"
#include "tools/results/zone_counts.hpp"

namespace bladefit {
namespace {

const char* const kTwoZones =
    "[fit]\nrest_tolerance = 0.5\n"
    "[[zone]]\nname = \"tip, edge\"\nwhere = \"u:0.4:0.6 r/R 0.7:1.0\"\nplus = 0.1\nminus = 0.05\n"
    "[[zone]]\nname = \"outer <blade>\"\nwhere = \"r/R 0.7:1.0\"\nplus = 0.06\nminus = 0.12\n";

const StudyCase& zoned_blade() {
  static const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  return study;
}

FitSettings zone_settings(const std::string& toml) {
  const testing::ScratchFolder folder;
  FitSettings settings;
  EXPECT_EQ(load_fit(folder.write("fit.toml", toml), settings).message, "");
  return settings;
}

FitPlan planned(const std::string& toml) { return plan_fit(zone_settings(toml), zoned_blade().design); }

TEST(ZonePlan, TurnsTablesToZonesOfTheMap) {
  const FitPlan plan = planned(kTwoZones);
  const ToleranceMap& map = plan.localizer.tolerance;
  const double tip = tip_radius_of(Surface(zoned_blade().design), plan.axis);
  ASSERT_EQ(map.zone_count, 2U);
  EXPECT_EQ(map.box_count, 1U);
  EXPECT_EQ(map.boxes[0].zone, 1U);
  EXPECT_EQ(map.zones[0].region, Region::leading_edge);
  EXPECT_FALSE(map.zones[0].everywhere);
  EXPECT_DOUBLE_EQ(map.zones[0].radius_low_mm, 0.7 * tip);
  EXPECT_NEAR(map.zones[0].radius_high_mm, tip, 1e-6 * tip);
  EXPECT_EQ(map.zones[0].plus_mm, 0.1);
  EXPECT_EQ(map.zones[0].minus_mm, 0.05);
  EXPECT_EQ(map.zones[1].region, Region::rest);
  EXPECT_TRUE(map.zones[1].everywhere);
  EXPECT_EQ(map.rest_mm, 0.5);
  EXPECT_EQ(plan.zones.at(1).name, "outer <blade>");
  EXPECT_EQ(plan.note, "");
}

TEST(ZonePlan, FindsTheRidgeOfAutomaticZones) {
  const FitPlan plan = planned(
      "[fit]\nleading_edge_near = \"0,0,0\"\n[[zone]]\nname = \"edge\"\nwhere = \"auto:3% r/R 0.5:1.0\"\nplus = 0.1\n"
      "minus = 0.05\n");
  const ToleranceMap& map = plan.localizer.tolerance;
  ASSERT_GT(map.box_count, 1U);
  for (std::uint32_t k = 0; k < map.box_count; ++k) EXPECT_EQ(map.boxes.at(k).zone, 1U);
  EXPECT_NE(plan.note.find("outside of the zones nothing is judged"), std::string::npos) << plan.note;
}

struct RefusedTables {
  std::string toml;
  const char* words;
};

class ZonePlanRefusals : public ::testing::TestWithParam<RefusedTables> {};

TEST_P(ZonePlanRefusals, NameTheZoneAndTheFix) {
  try {
    static_cast<void>(planned(GetParam().toml));
    FAIL() << GetParam().words;
  } catch (const ToolError& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_EQ(std::string(error.what()).find(GetParam().words), 0U) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

std::string zone_toml(const char* name, const char* where, const char* plus = "0.1") {
  return std::string("[[zone]]\nname = \"") + name + "\"\nwhere = \"" + where + "\"\nplus = " + plus +
         "\nminus = 0.05\n";
}

INSTANTIATE_TEST_SUITE_P(
    All, ZonePlanRefusals,
    ::testing::Values(
        RefusedTables{"[fit]\nleading_edge = [\"u:0.4:0.6\"]\ntolerance = 0.1\n" + zone_toml("tip", "r/R 0.7:1"),
                      "[[zone]] tables and --leading-edge, --tolerance: the zones say where"},
        RefusedTables{"[fit]\nmode = \"constrained\"\n" + zone_toml("tip", "r/R 0.7:1"),
                      "--mode constrained: nothing is allowed outside of the zones, where points count in the fit too; "
                      "add --rest-tolerance"},
        RefusedTables{"[fit]\nmode = \"min_tolerance\"\n" + zone_toml("tip", "r/R 0.7:1"),
                      "--mode min_tolerance: nothing is allowed outside of the zones"},
        RefusedTables{zone_toml("hub", "r/R 0:0.1"), "zone[1] \"hub\".where: no point can fall in 'r/R 0:0.1'"},
        RefusedTables{zone_toml("beyond", "r/R 1.1:1.2"), "zone[1] \"beyond\".where: no point can fall"},
        RefusedTables{zone_toml("all", "r/R 0:1.2") + zone_toml("tip", "u:0.4:0.6 r/R 0.7:1"),
                      "zone[2] \"tip\".where: all of it lies in zone[1] \"all\", which comes first"},
        RefusedTables{zone_toml("tip", "7:u:0.4:0.6"), "zone[1] \"tip\".where: patch 7 is not there"},
        RefusedTables{"[fit]\nwindow = \"0.05:0.95\"\n" + zone_toml("root", "v:0:0.04"),
                      "zone[1] \"root\".where: 'v:0:0.04' lies outside of the design's faces or of --window"},
        RefusedTables{zone_toml("tip", "r/R 0.7:1", "1e6"), "zone[1] \"tip\".plus: 1e+06 mm is more than"}));

Result zoned_result() {
  FitPlan plan = planned(kTwoZones);
  plan.points = zoned_blade().plan.points;
  return fit_points(zoned_blade().design, plan, read_subset_points(zoned_blade(), "full"), "full.csv").result;
}

/// Each point by hand: its zone from its foot, its state from the two limits.
TEST(ZonedFit, JudgesEachPointByTheLimitsOfItsZone) {
  const Result result = zoned_result();
  ASSERT_TRUE(result.verdict.fit_decided());
  std::array<std::uint32_t, 3> met{};
  for (const ResultPoint& point : result.points) {
    if (point.state == PointState::rejected) continue;
    const double ratio = result.axis.radius_of(point.foot.value()) / result.tip_radius;
    const bool outer = ratio >= 0.7, edge = point.u >= 0.4 && point.u <= 0.6;
    const std::uint32_t zone = outer && edge ? 1 : outer ? 2 : 0;
    const double plus = zone == 1 ? 0.1 : zone == 2 ? 0.06 : 0.5, minus = zone == 1 ? 0.05 : zone == 2 ? 0.12 : 0.5;
    ++met.at(zone);
    EXPECT_EQ(point.zone, zone) << point.sequence;
    EXPECT_EQ(point.region, zone == 1 ? Region::leading_edge : Region::rest);
    EXPECT_EQ(point.tolerance, point.distance < 0 ? minus : plus);
    const bool out = point.distance > plus || point.distance < -minus;
    EXPECT_EQ(point.state, out ? PointState::out : PointState::in) << point.sequence;
    EXPECT_EQ(point.action, !out ? Action::none : point.distance > 0 ? Action::cut : Action::weld);
  }
  for (const std::uint32_t points : met) EXPECT_GT(points, 5U);
  const std::vector<ZoneCounts> counts = zone_counts(result);
  EXPECT_EQ(counts.at(0).points, met[1]);
  EXPECT_EQ(counts.at(1).points, met[2]);
  EXPECT_EQ(counts.at(2).points, met[0]);
}

TEST(ZonedFit, IsReadBackToTheLastDigit) {
  const Result made = zoned_result();
  Result read = parse_result("result.json", result_json(made));
  read.points = parse_verdicts("verdicts.csv", verdicts_csv(made.points));
  read.name = made.name;
  EXPECT_EQ(result_json(read), result_json(made));
  EXPECT_EQ(verdicts_csv(read.points), verdicts_csv(made.points));
  for (const ReportFormat& format : kFormats) {
    if (format.name == "pdf") continue;  // the page of html, printed by a program that need not be there
    EXPECT_EQ(format.text_of(read), format.text_of(made)) << format.name;
  }
}

TEST(ZonedFit, EveryFormatNamesTheZones) {
  const Result result = zoned_result();
  const nlohmann::json json = nlohmann::json::parse(result_json(result));
  ASSERT_EQ(json.at("zones").size(), 3U);
  EXPECT_EQ(json.at("zones")[0].at("name"), "tip, edge");
  EXPECT_EQ(json.at("zones")[0].at("plus"), 0.1);
  EXPECT_EQ(json.at("zones")[1].at("minus"), 0.12);
  EXPECT_EQ(json.at("zones")[2].at("name"), "rest");
  std::uint32_t named = 0;
  for (const auto& point : json.at("points")) named += point.at("zone") == "tip, edge" ? 1 : 0;
  EXPECT_EQ(named, json.at("zones")[0].at("count"));
  EXPECT_NE(format_of("csv").text_of(result).find(",\"tip, edge\"\n"), std::string::npos);
  const std::string html = format_of("html").text_of(result), qif = format_of("qif").text_of(result);
  EXPECT_NE(html.find("<td>outer &lt;blade&gt;</td><td>r/R 0.7:1.0</td><td>+0.0600</td><td>&minus;0.1200</td>"),
            std::string::npos);
  EXPECT_NE(html.find("<td>by zone</td>"), std::string::npos);
  EXPECT_NE(qif.find("<Name>tip, edge</Name><ToleranceValue>0.15"), std::string::npos);
  EXPECT_NE(qif.find("<UnequallyDisposedZone>0.025"), std::string::npos);
  EXPECT_NE(operator_summary(result).find("Zone tip, edge (u:0.4:0.6 r/R 0.7:1.0): +0.100 -0.050 mm; "),
            std::string::npos);
}

/// All limits of kTwoZones, times `scale`, in a mode whose bounds they are.
Result bounded_result(const std::string& mode, double scale) {
  FitPlan plan = planned(std::string("[fit]\nmode = \"") + mode + "\"\n" + std::string(kTwoZones).substr(6));
  plan.points = zoned_blade().plan.points;
  ToleranceMap& map = plan.localizer.tolerance;
  map.rest_mm *= scale;
  for (ToleranceZone& zone : map.zones) {
    zone.plus_mm *= scale;
    zone.minus_mm *= scale;
  }
  return fit_points(zoned_blade().design, plan, read_subset_points(zoned_blade(), "full"), "full.csv").result;
}

TEST(ZonedFit, TellsTheFactorThatCanJustBeMet) {
  const Result result = bounded_result("min_tolerance", 1.0);
  const ZoneShare share = zone_share(result);
  EXPECT_EQ(share.tightest, 0.05);
  EXPECT_EQ(share.region, Region::leading_edge);
  double largest = 0.0;
  for (const ResultPoint& point : result.points) {
    if (point.state != PointState::rejected) largest = std::max(largest, std::abs(point.distance) / point.tolerance);
  }
  EXPECT_NEAR(share.factor, largest, 1e-8);
  EXPECT_EQ(result.leading_edge.tolerance, result.tolerance_factor);
  const std::string words = operator_summary(result);
  const std::string told = fmt::format("the tolerances of the zones and the rest times {:.4f}", share.factor);
  EXPECT_NE(words.find("Smallest tolerances that can be met: " + told), std::string::npos) << words;
  EXPECT_NE(words.find("Proof: points "), std::string::npos);
  const std::string html = format_of("html").text_of(result);
  EXPECT_NE(html.find(fmt::format("once all are multiplied by {:.4f}", share.factor)), std::string::npos);
  EXPECT_EQ(result.verdict.state == BladeState::in_tolerance, share.factor <= 1.0);
}

TEST(ZonedFit, IsInToleranceWhereAConstrainedFitMeetsThem) {
  const double least = zone_share(bounded_result("min_tolerance", 1.0)).factor;
  const Result wide = bounded_result("constrained", 1.01 * least), tight = bounded_result("constrained", 0.99 * least);
  EXPECT_EQ(wide.verdict.state, BladeState::in_tolerance);
  EXPECT_EQ(zone_share(wide).factor, 0.0);
  EXPECT_EQ(tight.verdict.state, BladeState::out_of_tolerance);
  EXPECT_EQ(tight.status, "infeasible");
  EXPECT_NEAR(zone_share(tight).factor, 1.0 / 0.99, 1e-6);
  const std::string words = operator_summary(tight);
  EXPECT_NE(words.find("cannot be brought within the tolerances of their zones together; the least feasible are the "
                       "tolerances of the zones and the rest times 1.0101 (the tightest of the leading edge: "),
            std::string::npos)
      << words;
  Result read = parse_result("result.json", result_json(tight));
  EXPECT_NEAR(zone_share(read).factor, 1.0 / 0.99, 1e-6) << "from the file as well";
}

TEST(ZonedFit, AZoneWithoutAPointIsNamed) {
  FitPlan plan = planned(kTwoZones);
  plan.points = zoned_blade().plan.points;
  std::vector<ProbePoint> inner;
  const double limit = 0.65 * tip_radius_of(Surface(zoned_blade().design), plan.axis);
  for (const ProbePoint& point : read_subset_points(zoned_blade(), "full")) {
    if (plan.axis.radius_of(Vec3(point.position.data())) < limit) inner.push_back(point);
  }
  const Result result = fit_points(zoned_blade().design, plan, inner, "inner.csv").result;
  EXPECT_EQ(result.verdict.state, BladeState::not_decided);
  const std::string words = operator_summary(result);
  EXPECT_NE(words.find("zone_not_probed: a zone has fewer judged points than the 1 it needs: \"tip, edge\" (0), "
                       "\"outer <blade>\" (0)"),
            std::string::npos)
      << words;
}

}  // namespace
}  // namespace bladefit
