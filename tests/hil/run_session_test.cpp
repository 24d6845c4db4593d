// Whole sessions: what they find, how they end, and how they go on after a power cut.
#include <gtest/gtest.h>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

std::string place_for(Link link, const ScratchFolder& scratch) {
  return link == Link::modbus_tcp ? "0" : scratch / "cmm";
}

/// Where the same machine is to be started again.
std::string same_place(Link link, const SimulatedMachine& machine) {
  return link == Link::modbus_tcp ? std::to_string(machine.port()) : machine.address();
}

std::string test_name(const ::testing::TestParamInfo<Link>& tested) {
  std::string name = name_of(tested.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class RunSession : public ::testing::TestWithParam<Link> {};

void expect_agreement(const std::string& result, const std::string& truth) {
  const ScratchFolder scratch;
  std::ofstream(scratch / "result.json") << result;
  Process check({"python3", data_file("check.py"), data_file(truth), scratch / "result.json"});
  EXPECT_EQ(check.exit_code(), 0) << check.out() << check.err();
}

TEST_P(RunSession, AgreesWithTheIndependentTruth) {
  expect_agreement(clean_result(GetParam(), kFewPoints), "dtmb4119/truth/200.json");
  expect_agreement(clean_result(GetParam(), kAllPoints), "dtmb4119/truth/full.json");
}

TEST_P(RunSession, GoesOnAfterAPowerCutOfTheHost) {
  const std::string clean = clean_result(GetParam(), kFewPoints);
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(GetParam(), place_for(GetParam(), scratch), kFewPoints, {"--rate", "100"}));
  const std::vector<std::string> options =
      run_options(source_of(GetParam(), machine.address()), scratch / "session", scratch / "result.json", kUntilIdle);
  for (const std::uint32_t points : {30U, 90U}) {
    Process run(options);
    ASSERT_TRUE(wait_for_points(run, points)) << run.err();
    run.power_off();
    EXPECT_FALSE(std::filesystem::exists(scratch / "result.json"));
  }
  Process run(options);
  EXPECT_EQ(run.exit_code(), expected_exit(clean)) << run.err();
  EXPECT_TRUE(read_whole(scratch / "result.json") == clean) << run.out() << run.err();
}

TEST_P(RunSession, GoesOnAfterAPowerCutOfTheMachine) {
  const std::string clean = clean_result(GetParam(), kFewPoints);
  const ScratchFolder scratch;
  std::optional<SimulatedMachine> machine(
      std::in_place, machine_options(GetParam(), place_for(GetParam(), scratch), kFewPoints, {"--rate", "100"}));
  const std::string place = same_place(GetParam(), *machine);
  Process run(run_options(source_of(GetParam(), machine->address()), scratch / "session", scratch / "result.json",
                          {"--headless", "--until-idle", "8"}));
  ASSERT_TRUE(wait_for_points(run, 60)) << run.err();
  machine->process().power_off();
  machine.reset();
  std::this_thread::sleep_for(500ms);
  machine.emplace(machine_options(GetParam(), place, kFewPoints, {"--rate", "100"}));
  EXPECT_EQ(run.exit_code(), expected_exit(clean)) << run.err();
  EXPECT_TRUE(read_whole(scratch / "result.json") == clean) << run.out() << run.err();
}

TEST_P(RunSession, EndsCleanlyOnInterrupt) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(GetParam(), place_for(GetParam(), scratch), kAllPoints, {"--rate", "200"}));
  Process run(run_options(source_of(GetParam(), machine.address()), scratch / "session", scratch / "result.json"));
  ASSERT_TRUE(wait_for_points(run, 150)) << run.err();
  run.signal(SIGINT);
  const std::optional<int> exit_code = run.exit_code(10s);
  const std::string json = read_whole(scratch / "result.json");
  ASSERT_FALSE(json.empty()) << run.err();
  EXPECT_EQ(exit_code, expected_exit(json));
  const nlohmann::json result = testing::parse_json(json);
  EXPECT_EQ(result.at("status"), "converged");
  EXPECT_GE(result.at("points").size(), 150U);
  EXPECT_LT(result.at("points").size(), 2000U);
}

INSTANTIATE_TEST_SUITE_P(Links, RunSession, ::testing::Values(Link::modbus_tcp, Link::modbus_rtu, Link::serial),
                         test_name);

}  // namespace
}  // namespace bladefit::hil
