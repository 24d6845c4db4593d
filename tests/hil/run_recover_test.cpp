// The good records of a damaged session: told, saved, and gone on with.
#include <gtest/gtest.h>

#include "firmware_bridge/host/journal/journal_format.hpp"
#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// A finished session of 200 points whose records `first` to `last` are damaged.
class DamagedSession {
 public:
  DamagedSession(std::size_t first, std::size_t last) {
    Process run(run_options("replay:" + kFewPoints, session, scratch / "result.json", {"--headless"}));
    const std::optional<int> exit_code = run.exit_code();
    if (!exit_code || *exit_code > 1) throw std::runtime_error("the session failed: " + run.err());
    const std::string path = session + "/journal.bin";
    std::string bytes = read_whole(path);
    for (std::size_t place = first; place <= last; ++place)
      bytes.at(sizeof(JournalHeader) + (place - 1) * sizeof(JournalRecord) + 20) ^= 1;
    testing::write_whole(path, bytes);
  }

  ScratchFolder scratch;
  std::string session = scratch / "session";
};

std::vector<std::string> recover(const DamagedSession& damaged, const std::vector<std::string>& more) {
  return std::vector<std::string>{BLADEFIT_COMMAND, "recover", damaged.session} + more;
}

TEST(RunRecover, TellsWhatIsWholeAndWhatIsLost) {
  const DamagedSession damaged(17, 20);
  Process run(recover(damaged, {}));
  EXPECT_EQ(run.exit_code(), 4) << run.err();
  EXPECT_NE(run.out().find("197 of 201 records are whole, with 196 points; the header is whole"), std::string::npos)
      << run.out();
  EXPECT_NE(run.out().find("Lost: records 17 to 20: points 17 to 20 lost; probe again\n"), std::string::npos)
      << run.out();
}

TEST(RunRecover, GivesThePointsAsAFileThatLocalizeReads) {
  const DamagedSession damaged(17, 20);
  const std::string points = damaged.scratch / "points.csv";
  Process run(recover(damaged, {"-o", points}));
  EXPECT_EQ(run.exit_code(), 4) << run.err();
  Process localize({BLADEFIT_COMMAND, "localize", "--design", kBlade, "--points", points, "--json", "-"});
  EXPECT_EQ(localize.exit_code(), 0) << localize.err();
  EXPECT_EQ(testing::parse_json(localize.out()).at("points").size(), 196U);
}

TEST(RunRecover, GivesASessionInWhichTheLostPointsStayKnown) {
  const DamagedSession damaged(17, 20);
  const std::string session = damaged.scratch / "again", json = damaged.scratch / "again.json";
  Process run(recover(damaged, {"-o", session}));
  EXPECT_EQ(run.exit_code(), 4) << run.err();
  Process resumed(run_options("replay:" + kFewPoints, session, json, {"--headless"}));
  ASSERT_TRUE(resumed.exit_code()) << resumed.err();
  const nlohmann::json verdict = testing::parse_json(read_whole(json)).at("verdict");
  EXPECT_EQ(verdict.at("lost"), nlohmann::json::parse("[[17, 20]]")) << resumed.err();
  Process itself(recover(damaged, {"-o", damaged.session}));
  EXPECT_EQ(itself.exit_code(), 2);
  EXPECT_NE(itself.err().find("is the damaged session itself; name a new folder"), std::string::npos) << itself.err();
  Process twice(recover(damaged, {"-o", session}));
  EXPECT_EQ(twice.exit_code(), 2);
  EXPECT_NE(twice.err().find("holds a session already"), std::string::npos) << twice.err();
}

TEST(RunRecover, AWholeSessionHasLostNothing) {
  const DamagedSession whole(1, 0);
  Process run(recover(whole, {"-o", "-"}));
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  EXPECT_EQ(run.out().substr(0, 24), "x,y,z,i,j,k,path,weight\n");
}

TEST(RunRecover, WhatIsNoSessionIsRefused) {
  const ScratchFolder scratch;
  Process run({BLADEFIT_COMMAND, "recover", scratch / "none"});
  EXPECT_EQ(run.exit_code(), 2);
  EXPECT_NE(run.err().find("give the folder of a session"), std::string::npos) << run.err();
}

}  // namespace
}  // namespace bladefit::hil
