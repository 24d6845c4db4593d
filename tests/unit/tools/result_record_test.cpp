#include <gtest/gtest.h>

#include "tools/batch/batch_fit.hpp"
#include "tools/report/formats.hpp"
#include "tools/reproduce/study_case.hpp"
#include "tools/results/json_reader.hpp"
#include "tools/results/json_writer.hpp"
#include "tools/results/operator_summary.hpp"
#include "tools/results/verdicts_csv.hpp"

namespace bladefit {
namespace {

/// A blade in inches: there a length that is read back is rounded once more than it was when it was written.
const StudyCase& inch_blade() {
  static const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/arl_fan");
  return study;
}

Result fitted(const FitPlan& plan) {
  return fit_points(inch_blade().design, plan, read_subset_points(inch_blade(), "041"), "041.csv").result;
}

/// Plans that fill every part of the record between them: covariance, outliers, loss, locks, certificate, tolerances.
std::vector<FitPlan> all_kinds() {
  std::vector<FitPlan> plans(5, inch_blade().plan);
  plans[1].localizer.loss = Loss::tukey;
  plans[1].localizer.locked = 1;
  plans[2].localizer.mode = FitMode::minimax;
  plans[3].localizer.mode = FitMode::min_tolerance;
  plans[4].localizer.mode = FitMode::constrained;  // infeasible
  plans[4].localizer.tolerance.leading_edge_mm = 0.01;
  plans[4].localizer.tolerance.rest_mm = 0.1;
  return plans;
}

TEST(ResultRecord, ReadsBackToTheLastDigit) {
  for (const FitPlan& plan : all_kinds()) {
    const Result made = fitted(plan);
    const std::string json = result_json(made), verdicts = verdicts_csv(made.points);
    Result read = parse_result("result.json", json);
    EXPECT_EQ(read.text, json);
    read.points = parse_verdicts("verdicts.csv", verdicts);
    EXPECT_EQ(result_json(read), json) << word_of(plan.localizer.mode);
    EXPECT_EQ(verdicts_csv(read.points), verdicts) << word_of(plan.localizer.mode);
    EXPECT_EQ(exit_code_of(read), exit_code_of(made)) << word_of(plan.localizer.mode);
  }
}

TEST(ResultRecord, EveryFormatSaysTheSameOfAFitAndOfItsFiles) {
  const Result made = fitted(all_kinds()[4]);
  EXPECT_EQ(made.status, "infeasible");
  Result read = parse_result("result.json", result_json(made));
  read.points = parse_verdicts("verdicts.csv", verdicts_csv(made.points));
  read.name = made.name;
  for (const ReportFormat& format : kFormats) {
    if (format.name == "pdf") continue;  // the page of html, printed by a program that need not be there
    EXPECT_FALSE(format.text_of(made).empty()) << format.name;
    EXPECT_EQ(format.text_of(read), format.text_of(made)) << format.name;
  }
}

TEST(ResultRecord, ItsFilesAreSummedUpWithoutWhatTheyDoNotHold) {
  for (const FitPlan& plan : all_kinds()) {
    const Result made = fitted(plan);
    Result read = parse_result("result.json", result_json(made));
    read.points = parse_verdicts("verdicts.csv", verdicts_csv(made.points));
    ASSERT_FALSE(read.details);
    const std::string whole = operator_summary(made), told = operator_summary(read);
    EXPECT_EQ(told.substr(0, told.find('\n')), whole.substr(0, whole.find('\n')));
    EXPECT_NE(told.find(fmt::format(" of {} points, rms ", made.points.size())), std::string::npos) << told;
    EXPECT_EQ(told.find("degrees of freedom determined"), std::string::npos) << told;
  }
}

TEST(ResultRecord, FormatsAreFoundByTheirNames) {
  for (const ReportFormat& format : kFormats) EXPECT_EQ(&format_of(format.name), &format);
  EXPECT_THROW(static_cast<void>(format_of("docx")), ToolError);
  EXPECT_EQ(format_names(", ", " and "), "html, pdf, csv, json and qif");
}

}  // namespace
}  // namespace bladefit
