// Sections, chords and sides of DTMB 4119 against its published table, and what is made from them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/batch/batch_fit.hpp"
#include "tools/drawing/add_drawing.hpp"
#include "tools/drawing/chord_place.hpp"
#include "tools/drawing/measured_radii.hpp"
#include "tools/drawing/stations.hpp"
#include "tools/report/chord_table.hpp"
#include "tools/report/csv_report.hpp"
#include "tools/report/section_views.hpp"
#include "tools/report/tolerance_scale.hpp"
#include "tools/reproduce/study_case.hpp"

namespace bladefit {
namespace {

constexpr double kDiameter = 304.8;  // [mm]

/// DTMB 4119: r/R, chord and thickness over the diameter, pitch over the diameter. No skew, no rake.
struct PublishedSection {
  double ratio, chord, thickness, pitch;
};
constexpr PublishedSection kPublished[] = {{0.3, 0.3635, 0.0563, 1.102}, {0.4, 0.4048, 0.0478, 1.098},
                                           {0.5, 0.4392, 0.0396, 1.093}, {0.6, 0.4610, 0.0321, 1.088},
                                           {0.7, 0.4622, 0.0250, 1.084}, {0.8, 0.4347, 0.0183, 1.081},
                                           {0.9, 0.3613, 0.0120, 1.079}};

const Result& drawn_blade() {
  static const Result result = [] {
    static const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
    FitPlan plan = study.plan;
    plan.localizer.tolerance.leading_edge_mm = 0.05;
    plan.localizer.tolerance.rest_mm = 0.1;
    Result made = fit_points(study.design, plan, read_subset_points(study, "full"), "points.csv").result;
    add_drawing(study.design, made);
    return made;
  }();
  return result;
}

std::vector<SectionPiece> section_near(double radius) {
  static const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  const Surface surface(study.design);
  const ShaftFrame frame({}, surface.middle());
  return RadiusGrid(surface, frame, drawn_blade().boxes).cut(radius);
}

TEST(Drawing, ChordsAndPitchAreThoseOfThePublishedTable) {
  for (const PublishedSection& published : kPublished) {
    const double radius = published.ratio * kDiameter / 2;
    const UnrolledPlace chord = chord_of(station_at(drawn_blade().drawing->stations, radius));
    EXPECT_NEAR(chord.norm(), published.chord * kDiameter, 0.005 * published.chord * kDiameter) << published.ratio;
    const double pitch_angle = std::atan(published.pitch * kDiameter / (2 * std::numbers::pi * radius));
    EXPECT_NEAR(std::atan2(std::abs(chord.x()), std::abs(chord.y())), pitch_angle, 0.01) << published.ratio;
  }
}

TEST(Drawing, SectionsAreAsThickAsPublished) {
  for (const PublishedSection& published : kPublished) {
    const double radius = published.ratio * kDiameter / 2;
    const std::vector<SectionPiece> pieces = section_near(radius);
    const BladeStation station = station_of(pieces, radius).value();
    constexpr int kSlices = 50;
    std::vector<double> least(kSlices, 1e9), most(kSlices, -1e9);
    for (const SectionPiece& piece : pieces) {
      const ChordPlace place = on_chord(station, piece.from.x(), piece.from.y() / radius);
      const auto slice = static_cast<std::size_t>(std::clamp(place.along * kSlices, 0.0, kSlices - 1.0));
      least[slice] = std::min(least[slice], place.beside);
      most[slice] = std::max(most[slice], place.beside);
    }
    double thickness = 0;
    for (std::size_t k = 0; k < kSlices; ++k) thickness = std::max(thickness, most[k] - least[k]);
    EXPECT_NEAR(thickness, published.thickness * kDiameter, 0.05 * published.thickness * kDiameter) << published.ratio;
  }
}

/// The middle of each chord is on the generator, where along and angle are 0: the share of the chord follows from the
/// published chord and pitch alone.
TEST(Drawing, SharesOfTheChordFollowFromThePublishedTable) {
  const BladeDrawing& drawing = *drawn_blade().drawing;
  const BladeStation tip_half = station_at(drawing.stations, 0.5 * kDiameter / 2);
  const double middle_angle = (tip_half.leading_angle + tip_half.trailing_angle) / 2;
  const double sign = tip_half.leading_along > tip_half.trailing_along ? -1 : 1;
  const double turn = tip_half.leading_angle > tip_half.trailing_angle ? -1 : 1;
  std::size_t compared = 0;
  for (const PlacedPoint& place : drawing.points) {
    const double ratio = place.radius / (kDiameter / 2);
    for (std::size_t k = 0; k + 1 < std::size(kPublished); ++k) {
      const PublishedSection &a = kPublished[k], &b = kPublished[k + 1];
      if (ratio < a.ratio || ratio >= b.ratio) continue;
      const double share = (ratio - a.ratio) / (b.ratio - a.ratio);
      const double chord = a.chord + share * (b.chord - a.chord), pitch = a.pitch + share * (b.pitch - a.pitch);
      const double pitch_angle = std::atan(pitch * kDiameter / (2 * std::numbers::pi * place.radius));
      const double along = sign * place.along * std::sin(pitch_angle) +
                           turn * place.radius * (place.angle - middle_angle) * std::cos(pitch_angle);
      EXPECT_NEAR(place.chord, 0.5 + along / (chord * kDiameter), 0.015) << ratio;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100U);
}

TEST(Drawing, SidesOfPointsAreThoseOfTheirParameters) {
  const Result& result = drawn_blade();
  std::size_t index = 0, suction = 0, pressure = 0;
  for (const ResultPoint& point : result.points) {
    const PlacedPoint& place = result.drawing->points[index++];
    if (std::abs(point.u - 0.5) < 0.1) continue;
    // One side of the design has u below a half, the other above.
    (place.face == BladeSide::suction ? suction : pressure) += point.u > 0.5 ? 1 : 0;
    EXPECT_NE(place.face, BladeSide::unknown);
  }
  EXPECT_TRUE(suction == 0 || pressure == 0) << suction << " " << pressure;
}

TEST(ChordTable, EveryPointOutStandsInItOrAWorseOneDoes) {
  const Result& result = drawn_blade();
  const ToleranceScale scale = tolerance_scale_of(result);
  std::size_t filled = 0;
  for (const BladeSide side : {BladeSide::suction, BladeSide::pressure}) {
    const std::vector<ChordRow> rows = chord_rows(result, side);
    ASSERT_EQ(rows.size(), result.drawing->sections.size());
    for (std::size_t index = 0; index < result.points.size(); ++index) {
      const PlacedPoint& place = result.drawing->points[index];
      if (place.face != side) continue;
      std::size_t column = 0;
      for (std::size_t k = 1; k < kChordPercents.size(); ++k) {
        if (std::abs(kChordPercents[k] - 100 * place.chord) < std::abs(kChordPercents[column] - 100 * place.chord))
          column = k;
      }
      const std::ptrdiff_t there = rows[rows.size() - 1 - place.section][column];
      ASSERT_GE(there, 0);
      EXPECT_GE(std::abs(scale.share(result.points[static_cast<std::size_t>(there)])),
                std::abs(scale.share(result.points[index])));
    }
    for (const ChordRow& row : rows)
      filled += static_cast<std::size_t>(std::ranges::count_if(row, [](auto i) { return i >= 0; }));
  }
  const std::string html = chord_tables(result);
  std::size_t numbers = 0;
  for (std::size_t at = html.find("<td>"); at != std::string::npos; at = html.find("<td>", at + 1))
    numbers += html[at + 4] == '+' || html[at + 4] == '-' || html[at + 4] == '<' ? 1 : 0;
  EXPECT_GE(numbers, filled) << "blank cells are empty, others are not";
}

TEST(MeasuredRadii, AreTheClustersOfPassesAndElseNavalRadii) {
  std::vector<double> passes;
  for (const double radius : {30.0, 50.0, 80.0}) {
    for (int k = 0; k < 40; ++k) passes.push_back(radius + 0.01 * k);
  }
  EXPECT_EQ(measured_radii(passes, 100), (std::vector<double>{30.2, 50.2, 80.2}));
  std::vector<double> scattered;
  for (int k = 0; k < 1000; ++k) scattered.push_back(25 + 0.07 * k);
  EXPECT_EQ(measured_radii(scattered, 100), (std::vector<double>{25, 30, 40, 50, 60, 70, 80, 85, 90, 95}));
  EXPECT_TRUE(measured_radii({}, 100).empty());
}

TEST(SectionViews, FactorsAreRoundAndNeverAboveWhatIsWanted) {
  EXPECT_DOUBLE_EQ(round_factor(10, 0.1, 4), 20);
  EXPECT_DOUBLE_EQ(round_factor(9, 0.1, 4), 20);
  EXPECT_DOUBLE_EQ(round_factor(30, 0.1, 4), 50);
  EXPECT_DOUBLE_EQ(round_factor(5, 0.1, 4), 10);
  const std::string html = section_views(drawn_blade(), tolerance_scale_of(drawn_blade()));
  EXPECT_NE(html.find("distances x "), std::string::npos);
  EXPECT_NE(html.find("class=\"band\""), std::string::npos);
}

TEST(CsvReport, SaysWhereOnTheBladeEachPointLies) {
  const Result& result = drawn_blade();
  const std::string text = csv_report(result);
  EXPECT_NE(text.substr(0, text.find('\n')).find("distance_before_mm,side,radius_mm,r_over_R,chord_percent"),
            std::string::npos);
  const PlacedPoint& first = result.drawing->points[0];
  EXPECT_NE(text.find(fmt::format(",{},{},{}\n", first.radius, first.radius / result.tip_radius, 100 * first.chord)),
            std::string::npos);
}

}  // namespace
}  // namespace bladefit
