// Lengths with units of their own, how much is told, and examples in the help, of the command as it is installed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

using hil::Process;
using testing::ScratchFolder;

const std::string kMeasuredBlade = std::string(BLADEFIT_TEST_DATA) + "/dtmb4119/";

struct Spoken {
  std::optional<int> exit_code;
  std::string out, err;
};

Spoken spoken_by(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), BLADEFIT_COMMAND);
  Process command(arguments);
  const std::optional<int> code = command.exit_code();
  return {code, command.out(), command.err()};
}

/// The first hundred points, judged.
Spoken judge_some(const ScratchFolder& scratch, const std::vector<std::string>& more) {
  std::string rows;
  for (int row = 0; row < 100; ++row) rows += std::to_string(20 * row) + "\n";
  std::ofstream(scratch / "rows.txt") << rows;
  std::vector<std::string> arguments = {"localize",
                                        "--design",
                                        kMeasuredBlade + "design.igs",
                                        "--points",
                                        kMeasuredBlade + "points.csv",
                                        "--subset",
                                        scratch / "rows.txt",
                                        "--leading-edge",
                                        "u:0.4:0.6"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return spoken_by(arguments);
}

TEST(CommandLengths, HaveAUnitOfTheirOwn) {
  const ScratchFolder scratch;
  const Spoken inches = judge_some(scratch, {"--tolerance", "0.004in", "--rest-tolerance", "0.05cm", "--json", "-"});
  const nlohmann::json result = nlohmann::json::parse(inches.out);
  EXPECT_NEAR(result.at("regions").at("leading_edge").at("tolerance"), 0.1016, 1e-12) << "in mm, as the design is";
  EXPECT_NEAR(result.at("regions").at("rest").at("tolerance"), 0.5, 1e-12);
  const Spoken wrong = judge_some(scratch, {"--tolerance", "0.1furlong"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("--tolerance: '0.1furlong' is not a number, nor one with its unit (mm, in, cm, m)"),
            std::string::npos)
      << wrong.err;
}

TEST(CommandLengths, OfSamplesAsWell) {
  const std::vector<std::string> sample = {
      "sample", kMeasuredBlade + "design.igs", "-o", "-", "--grid", "3x3", "--outward", "+", "--offset"};
  std::vector<std::string> mm = sample, cm = sample;
  mm.emplace_back("2");
  cm.emplace_back("0.2cm");
  EXPECT_EQ(spoken_by(mm).out, spoken_by(cm).out);
}

TEST(CommandVolume, QuietTellsTheVerdictAloneAndVerboseTheTimes) {
  const ScratchFolder scratch;
  const std::vector<std::string> judged = {"--tolerance", "0.1"};
  const Spoken usual = judge_some(scratch, judged);
  const Spoken quiet = judge_some(scratch, {"--tolerance", "0.1", "--quiet"});
  EXPECT_EQ(quiet.exit_code, usual.exit_code);
  EXPECT_EQ(quiet.out.find("Verdict: "), 0U) << quiet.out;
  EXPECT_EQ(std::ranges::count(quiet.out, '\n'), 1) << quiet.out;
  EXPECT_NE(usual.out.find(quiet.out), std::string::npos);
  const Spoken verbose = judge_some(scratch, {"--tolerance", "0.1", "--verbose"});
  EXPECT_NE(verbose.err.find("points fitted and judged: "), std::string::npos) << verbose.err;
  EXPECT_EQ(judge_some(scratch, {"--tolerance", "0.1", "--verbose", "--quiet"}).exit_code, 2);
}

TEST(CommandHelp, HasAnExampleForEachCommand) {
  for (const char* command : {"compile", "localize", "run", "panel", "simulate", "sample", "split", "loft", "show",
                              "report", "recover", "reproduce", "completion"}) {
    const Spoken help = spoken_by({command, "--help"});
    EXPECT_NE(help.out.find(std::string("bladefit ") + command + " "), std::string::npos) << help.out;
  }
}

}  // namespace
}  // namespace bladefit
