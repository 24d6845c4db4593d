// Every mode answers on blades with defects: a short version of tests/golden/defects.cpp.

#include <gtest/gtest.h>

#include "tests/support/defect_fits.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

constexpr FitMode kBoundedModes[] = {FitMode::minimax, FitMode::range, FitMode::min_tolerance, FitMode::constrained};

void expect_answer(const CompiledDesign& design, const LocalizerConfig& config, const std::vector<ProbePoint>& points,
                   WayIn way, const std::string& text) {
  const DefectFit fit = fit_defects(design, config, points, way);
  EXPECT_TRUE(fit.answered()) << word_of(config.mode) << " ended " << word_of(fit.report.ended) << ": " << text;
  EXPECT_EQ(fit.complaint, "") << word_of(config.mode) << ": " << text;
  EXPECT_EQ(fit.report.ended == FitEnd::none, fit.answered());
  EXPECT_LT(fit.refine_s, 10.0) << word_of(config.mode) << ": " << text;
}

/// The blade of tools/demo.sh: three spots at its leading edge. Points with missing material lie inside the nose, where
/// the sheet that faces the probe changes with the pose.
TEST(DefectModes, AnswerOnTheDemonstrationsBlade) {
  const ReferenceCase c = read_case("dtmb4119");
  std::vector<ProbePoint> points = points_of(c, "full");
  const auto spot = [&](std::size_t first, std::size_t last, double height) {
    for (std::size_t n = first; n <= last; ++n) {
      for (std::size_t k = 0; k < 3; ++k) points[n - 1].position[k] -= height * points[n - 1].approach[k];
    }
  };
  spot(811, 816, 0.31);
  spot(1312, 1315, -0.27);
  spot(1688, 1689, 0.24);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].sequence = static_cast<std::uint32_t>(i + 1);
  LocalizerConfig config = config_of(c, points.size());
  config.tolerance.leading_edge_mm = 0.15;
  config.tolerance.rest_mm = 0.5;
  for (const FitMode mode : kBoundedModes) {
    config.mode = mode;
    expect_answer(reference_design("dtmb4119"), config, points, WayIn::batch, "demonstration");
  }
}

class DefectModesOn : public ::testing::TestWithParam<std::string> {};

TEST_P(DefectModesOn, AnswerOnRandomPatterns) {
  const ReferenceCase c = read_case(GetParam());
  const DefectPatterns patterns(c, "full");
  for (std::uint64_t seed = 1000; seed < 1004; ++seed) {
    const DefectPattern pattern = patterns.make(seed);
    LocalizerConfig config = config_of(c, pattern.points.size());
    config.mode = kBoundedModes[seed % 4];
    config.use_approach = seed % 2 == 0 || c.use_approach;
    config.tolerance.leading_edge_mm = pattern.leading_edge_mm;
    config.tolerance.rest_mm = pattern.rest_mm;
    expect_answer(reference_design(c.name), config, pattern.points, seed % 4 == 3 ? WayIn::stream : WayIn::batch,
                  pattern.text);
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, DefectModesOn, ::testing::ValuesIn(reference_case_names()),
                         [](const auto& one) { return one.param; });

/// Patterns whose programs once ended nowhere: along a curved ridge of the largest distance, from a least-squares fit
/// that feet on two sheets left no rest, after limits that a program rested on were gone, along a curved limit, from
/// one merit to the same for ever, and where a search found a held foot elsewhere.
TEST(DefectModes, AnswerWhereStepsWereShortAndFeetRestless) {
  struct Hard {
    std::uint64_t seed;
    FitMode mode;
    bool directed;
  };
  constexpr Hard kHard[] = {
      {67, FitMode::min_tolerance, false}, {251, FitMode::min_tolerance, true}, {107, FitMode::minimax, true},
      {107, FitMode::range, true},         {43, FitMode::minimax, true},        {131, FitMode::min_tolerance, true},
      {83, FitMode::minimax, true},        {499, FitMode::minimax, true},       {43, FitMode::min_tolerance, true}};
  const ReferenceCase c = read_case("dtmb4119");
  const DefectPatterns patterns(c, "full");
  for (const Hard& hard : kHard) {
    const DefectPattern pattern = patterns.make(hard.seed);
    LocalizerConfig config = config_of(c, pattern.points.size());
    config.mode = hard.mode;
    config.use_approach = hard.directed;
    config.tolerance.leading_edge_mm = pattern.leading_edge_mm;
    config.tolerance.rest_mm = pattern.rest_mm;
    expect_answer(reference_design(c.name), config, pattern.points, WayIn::batch, pattern.text);
  }
}

/// A constrained fit whose bounds the least-squares optimum meets is that optimum: no program runs.
TEST(DefectModes, ConstrainedIsTheLeastSquaresOptimumWhereThatMeetsTheBounds) {
  const ReferenceCase c = read_case("dtmb4119");
  const std::vector<ProbePoint> points = thinned(c, 0, 10);
  LocalizerConfig config = config_of(c, points.size());
  const auto fitted = [&] {
    OwnedLocalizer fit(reference_design("dtmb4119").image(), config);
    for (const ProbePoint& point : points) (void)fit->stage(point);
    fit->conclude();
    EXPECT_EQ(refine_fully(*fit), Status::ok);
    return fit->fit();
  };
  const FitReport squares = fitted();
  config.mode = FitMode::constrained;
  config.tolerance.leading_edge_mm = 1.01 * std::abs(squares.leading_edge.worst_mm);
  config.tolerance.rest_mm = 1.01 * std::abs(squares.rest.worst_mm);
  const FitReport within = fitted();
  EXPECT_EQ(within.status, FitStatus::converged);
  EXPECT_EQ(within.pose.translation, squares.pose.translation);
  EXPECT_EQ(within.smallest_tolerance_mm, 0.0) << "not sought";
  EXPECT_EQ(within.further_starts, 0U);
  EXPECT_EQ(within.certificate.count, 0U);
  config.tolerance.leading_edge_mm = 0.99 * std::abs(squares.leading_edge.worst_mm);
  const FitReport tighter = fitted();
  EXPECT_EQ(tighter.status, FitStatus::converged);
  EXPECT_NE(tighter.pose.translation, squares.pose.translation);
  EXPECT_GT(tighter.smallest_tolerance_mm, 0.0);
  EXPECT_GT(tighter.rms_mm, squares.rms_mm);
}

}  // namespace
}  // namespace bladefit::testing
