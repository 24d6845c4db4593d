// What the command line says of itself: suggestions, help, version, completion, manual pages.

#include <gtest/gtest.h>

#include "tests/support/process.hpp"
#include "tools/commands/progress_line.hpp"
#include "tools/commands/suggestion.hpp"

namespace bladefit {
namespace {

struct Said {
  std::optional<int> exit_code;
  std::string out, err;
};

Said say(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), BLADEFIT_COMMAND);
  hil::Process command(arguments);
  const std::optional<int> code = command.exit_code();
  return {code, command.out(), command.err()};
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(EditDistance, CountsLettersInsertedDroppedReplacedOrSwapped) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("design", "design"), 0U);
  EXPECT_EQ(edit_distance("desgn", "design"), 1U);
  EXPECT_EQ(edit_distance("desing", "design"), 1U);
  EXPECT_EQ(edit_distance("localize", "lokalise"), 2U);
}

TEST(Suggestion, IsTheNearestWordThatIsNear) {
  EXPECT_EQ(suggestion("tolerence", {"transition", "tolerance"}), " (did you mean tolerance?)");
  EXPECT_EQ(suggestion("quite-another", {"transition", "tolerance"}), "");
  EXPECT_EQ(suggestion("any", {}), "");
}

TEST(ProgressText, TellsWhatIsLeftWherePartsAreCounted) {
  using std::chrono::seconds;
  EXPECT_EQ(progress_text("fitting 9 points", 0, 0, seconds(3)), "fitting 9 points: 3 s");
  EXPECT_EQ(progress_text("reach", 0, 10, seconds(3)), "reach [....................] 0 %");
  EXPECT_EQ(progress_text("reach", 5, 10, seconds(3)), "reach [##########..........] 50 %, 3 s left");
  EXPECT_EQ(progress_text("reach", 1, 100, seconds(2)), "reach [....................] 1 %, 3 min 18 s left");
  EXPECT_EQ(progress_text("reach", 11, 10, seconds(3)), "reach [####################] 100 %, 0 s left");
}

TEST(CommandWords, MistypedOnesAreAnsweredWithTheNearest) {
  const Said command = say({"localise"});
  EXPECT_EQ(command.exit_code, 2);
  EXPECT_TRUE(holds(command.err, "'localise' is not a command (did you mean localize?)")) << command.err;
  const Said of_all = say({"--verson"});
  EXPECT_EQ(of_all.exit_code, 2);
  EXPECT_TRUE(holds(of_all.err, "'--verson' is not an option of bladefit (did you mean --version?)")) << of_all.err;
  const Said option = say({"localize", "--tolerence=0.1"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_TRUE(holds(option.err, "'--tolerence' is not an option of localize (did you mean --tolerance?)"))
      << option.err;
}

TEST(CommandWords, NoneAtAllAndHelpShowTheCommands) {
  const Said nothing = say({}), help = say({"help"}), of_command = say({"help", "compile"});
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_TRUE(holds(nothing.out, "  localize  ")) << nothing.out;
  EXPECT_EQ(nothing.out, help.out);
  EXPECT_EQ(of_command.exit_code, 0);
  EXPECT_EQ(of_command.out, say({"compile", "--help"}).out);
  EXPECT_EQ(say({"help", "cmpile"}).exit_code, 2);
}

TEST(CommandWords, VersionNamesCommitProcessorAndCadLibrary) {
  const Said version = say({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  for (const char* word : {"bladefit ", "commit ", "processor: ", "OpenCASCADE 7."}) {
    EXPECT_TRUE(holds(version.out, word)) << version.out;
  }
}

TEST(CommandWords, LocalizeTellsItsVerdictFirst) {
  const std::string data = BLADEFIT_TEST_DATA "/dtmb4119/";
  const std::vector<std::string> asked = {"localize", "--design",          data + "design.igs",
                                          "--points", data + "points.csv", "--tolerance",
                                          "0.1mm",    "--starts",          "curves"};
  const Said whole = say(asked);
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(whole.out.rfind("Verdict: in_tolerance\n", 0), 0U) << whole.out;
  for (const char* note : {"\noutward side: +", "\nno --leading-edge is given", "\nstarts: "})
    EXPECT_TRUE(holds(whole.out, note)) << whole.out;
  EXPECT_EQ(say(hil::operator+(asked, {"--quiet"})).out, "Verdict: in_tolerance\n");
  const Said timed = say(hil::operator+(asked, {"--verbose"}));
  EXPECT_EQ(timed.out, whole.out);
  EXPECT_TRUE(holds(timed.err, "points fitted and judged: ")) << timed.err;
}

TEST(CommandWords, ADesignComesAndGoesByPipes) {
  const testing::ScratchFolder folder;
  const std::string data = BLADEFIT_TEST_DATA "/dtmb4119/", bladefit = BLADEFIT_COMMAND;
  hil::Process piped({"bash", "-c",
                      "set -o pipefail; cat " + data + "design.igs | " + bladefit + " compile - -o - 2>" +
                          (folder / "words") + " | tee " + (folder / "blade.bfd") + " | " + bladefit +
                          " localize --design - --points " + data + "points.csv --tolerance 0.1mm --quiet"});
  EXPECT_EQ(piped.exit_code(), 0) << piped.err();
  EXPECT_EQ(piped.out(), "Verdict: in_tolerance\n");
  EXPECT_TRUE(holds(testing::read_whole(folder / "words"), "- -> - (")) << testing::read_whole(folder / "words");
  EXPECT_EQ(say({"compile", data + "design.igs", "-o", folder / "named.bfd"}).exit_code, 0);
  EXPECT_TRUE(testing::read_whole(folder / "blade.bfd") == testing::read_whole(folder / "named.bfd"));
  hil::Process step({"bash", "-c", "cat " + data + "design.stp | " + bladefit + " compile - --list"});
  EXPECT_EQ(step.exit_code(), 0) << step.err();
  hil::Process packed({"bash", "-c", "gzip -c " + data + "design.igs | " + bladefit + " compile - --list"});
  EXPECT_EQ(packed.exit_code(), 2);
  EXPECT_TRUE(holds(packed.err(), "standard input: the design is packed")) << packed.err();
  EXPECT_TRUE(holds(say({"compile", "-", "-", "-o", folder / "x.bfd"}).err, "standard input holds one design"));
}

TEST(CommandWords, ShellsCompleteWhatTheOptionsAre) {
  const Said bash = say({"completion", "bash"});
  ASSERT_EQ(bash.exit_code, 0) << bash.err;
  hil::Process asked({"/bin/bash", "-c",
                      bash.out + "COMP_WORDS=(bladefit localize --mode min); COMP_CWORD=3; _bladefit; echo "
                                 "${COMPREPLY[@]}; COMP_WORDS=(bladefit run --sessi); COMP_CWORD=2; _bladefit; echo "
                                 "${COMPREPLY[@]}"});
  EXPECT_EQ(asked.exit_code(), 0) << asked.err();
  EXPECT_EQ(asked.out(), "minimax min_tolerance\n--session\n");
  const Said zsh = say({"completion", "zsh"});
  EXPECT_TRUE(holds(zsh.out, "--mode) compadd least_squares minimax")) << zsh.out;
}

TEST(CommandWords, ManualPagesHaveEveryOption) {
  const Said page = say({"help", "localize", "--man"});
  EXPECT_EQ(page.exit_code, 0);
  EXPECT_EQ(page.out.rfind(".TH BLADEFIT\\-LOCALIZE 1", 0), 0U) << page.out;
  EXPECT_TRUE(holds(page.out, ".B \\-\\-leading\\-edge")) << page.out;
  EXPECT_TRUE(holds(say({"help", "--man"}).out, ".SH COMMANDS")) << page.out;
}

}  // namespace
}  // namespace bladefit
