// Wrong use of loft, split and sample: one line that names the fix, exit code 2 or 3, and no file left behind.

#include <algorithm>
#include <fstream>

#include "tests/golden/command_fixture.hpp"

namespace bladefit::testing {
namespace {

const std::string kFan = BLADEFIT_TEST_DATA "/arl_fan/design.igs";
const std::string kThree = BLADEFIT_TEST_DATA "/arl_3patch/design.igs";
const std::string kPoints = BLADEFIT_TEST_DATA "/arl_fan/points.csv";
const std::string kSections = BLADEFIT_TEST_DATA "/pnsy_sub/sections.csv";

/// OUT stands for a file name in the test's own folder.
struct Refusal {
  std::vector<std::string> arguments;
  std::string wanted;
  int exit_code = 2;
};

void PrintTo(const Refusal& refusal, std::ostream* stream) {
  for (const std::string& argument : refusal.arguments) *stream << argument << " ";
}

class WorkflowRefusals : public CommandTest, public ::testing::WithParamInterface<Refusal> {};

TEST_P(WorkflowRefusals, InOneLine) {
  std::vector<std::string> arguments = {BLADEFIT_COMMAND};
  for (std::string argument : GetParam().arguments) {
    if (argument.rfind("OUT", 0) == 0) argument = scratch(argument);
    arguments.push_back(argument);
  }
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, GetParam().exit_code) << outcome.output;
  EXPECT_NE(outcome.output.find(GetParam().wanted), std::string::npos) << outcome.output;
  EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  EXPECT_TRUE(std::filesystem::is_empty(scratch("")));
}

INSTANTIATE_TEST_SUITE_P(Command, WorkflowRefusals,
                         ::testing::Values(Refusal{
                             {"lofty"},
                             "'lofty' is not a command (did you mean loft?); `bladefit --help` lists them"}));

INSTANTIATE_TEST_SUITE_P(
    Loft, WorkflowRefusals,
    ::testing::Values(
        Refusal{{"loft", kSections, "-o", "OUT.igs"}, "--units is required"},
        Refusal{{"loft", kSections, "-o", "OUT.igs", "--units", "cm"}, "--units"},
        Refusal{{"loft", kSections, "-o", "OUT.stp", "--units", "in"}, "OUT.stp: the design is written as IGES"},
        Refusal{{"loft", kSections, "-o", kSections, "--units", "in"}, "would overwrite the sections"},
        Refusal{{"loft", kPoints, "-o", "OUT.igs", "--units", "in"}, "points.csv:1: column 'section' is missing"},
        Refusal{{"loft", "nowhere.csv", "-o", "OUT.igs", "--units", "in"}, "nowhere.csv: no such file"},
        Refusal{{"loft", kSections, "-o", "OUT/a.igs", "--units", "in"}, "cannot be written", 3},
        Refusal{{"loft", kSections, "-o", "OUT.igs", "--units", "in", "--control-points", "181"},
                "section 0 has 180 points, too few for 181"}));

INSTANTIATE_TEST_SUITE_P(
    Split, WorkflowRefusals,
    ::testing::Values(
        Refusal{{"split", kFan, "-o", "OUT.igs"}, "--at is required"},
        Refusal{{"split", kFan, "-o", "OUT.igs", "--at", "w:0.5"}, "--at w:0.5: say [PATCH:]u:0.33"},
        Refusal{{"split", kFan, "-o", "OUT.igs", "--at", "u"}, "--at u: say"},
        Refusal{{"split", kFan, "-o", "OUT.igs", "--at", "u:1"}, "inside 0..1"},
        Refusal{{"split", kFan, "-o", "OUT.igs", "--at", "u:0.5", "--at", "u:0.5"}, "narrower than"},
        Refusal{{"split", kFan, "-o", "OUT.igs", "--at", "1:u:0.5"}, "1 patch(es), numbered from 0"},
        Refusal{{"split", kThree, "-o", "OUT.igs", "--at", "u:0.5"}, "say which one is cut, for example 0:u:0.5"},
        Refusal{{"split", kFan, "-o", "OUT.igs", "--at", "u:0.5", "--buffer", "0.3"}, "leaves nothing of a patch"},
        Refusal{{"split", kFan, "-o", "OUT.igs", "--at", "u:0.5", "--buffer", "-1"}, "--buffer -1"},
        Refusal{{"split", kFan, "-o", "OUT.igs", "--at", "u:0.5", "--points", kPoints}, "belong together"},
        Refusal{{"split", kFan, "-o", kFan, "--at", "u:0.5"}, "would overwrite the design"},
        Refusal{{"split", kFan, "-o", "OUT/a.igs", "--at", "u:0.5", "--points", kPoints, "--subset", "OUT.txt"},
                "cannot be written",
                3}));

INSTANTIATE_TEST_SUITE_P(
    Sample, WorkflowRefusals,
    ::testing::Values(
        Refusal{{"sample", kFan, "-o", "OUT.csv"}, "--grid is required"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "40"}, "for example 40x20"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "0x3"}, "for example 40x20"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "9000x9000"}, "make it coarser"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "4x4", "--window", "1:0"}, "--window"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "4x4", "--patch", "1"}, "numbered from 0"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "4x4", "--pose", "1,2,3"}, "give six numbers"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "4x4", "--pose", "1,2,3,4,5,6", "--move", "1,2,3,4,5,6"},
                "not both"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "4x4", "--noise", "-1"}, "--noise -1"},
        Refusal{{"sample", kFan, "-o", "OUT.csv", "--grid", "4x4", "--offset", "nan"},
                "--offset: 'nan' is not a number"},
        Refusal{{"sample", kFan, "-o", kFan, "--grid", "4x4"}, "would overwrite the design"},
        Refusal{{"sample", kFan, "-o", "OUT/a.csv", "--grid", "4x4"}, "cannot be written", 3}));

}  // namespace
}  // namespace bladefit::testing
