// A fault in mid session: what was measured before it is written and told, and the exit code is 3.
#include <gtest/gtest.h>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// The session has ended by a fault told with `words`; its result is that of all points on disk.
void expect_broken_off(Process& run, const ScratchFolder& scratch, const std::string& words) {
  EXPECT_EQ(run.exit_code(30s), 3) << run.out() << run.err();
  EXPECT_NE(run.err().find(words), std::string::npos) << run.err();
  for (const char* const path : {"result.json", "session/result.json"}) {
    const std::string json = read_whole(scratch / path);
    ASSERT_FALSE(json.empty()) << path << run.err();
    const nlohmann::json result = testing::parse_json(json);
    const std::size_t points = result.at("points").size();
    EXPECT_GE(points, 60U);
    EXPECT_LT(points, 200U);
    EXPECT_EQ(result.at("status"), "converged");
    EXPECT_NE(run.out().find("by a fault; what follows is of the " + std::to_string(points) + " points"),
              std::string::npos)
        << run.out();
  }
}

class RunBrokenOff : public ::testing::TestWithParam<Link> {};

TEST_P(RunBrokenOff, ByAMachineThatIsGoneForGood) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(GetParam(), GetParam() == Link::modbus_tcp ? "0" : scratch / "cmm",
                                           kFewPoints, {"--rate", "100"}));
  Process run(
      run_options(source_of(GetParam(), machine.address()), scratch / "session", scratch / "result.json", kUntilIdle));
  ASSERT_TRUE(wait_for_points(run, 60)) << run.err();
  machine.process().power_off();
  expect_broken_off(run, scratch, "the link is lost and did not come back");
}

INSTANTIATE_TEST_SUITE_P(Links, RunBrokenOff, ::testing::Values(Link::modbus_tcp, Link::modbus_rtu, Link::serial),
                         [](const auto& tested) {
                           std::string name = name_of(tested.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(RunBrokenOffOnce, ByAMachineThatNumbersItsPointsAnew) {
  const ScratchFolder scratch;
  std::optional<SimulatedMachine> machine(std::in_place,
                                          machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "100"}));
  const std::string port = std::to_string(machine->port());
  Process run(run_options(source_of(Link::modbus_tcp, machine->address()), scratch / "session", scratch / "result.json",
                          {"--headless", "--until-idle", "20"}));
  ASSERT_TRUE(wait_for_points(run, 60)) << run.err();
  machine->process().power_off();
  machine.emplace(machine_options(Link::modbus_tcp, port, kFewPoints, {"--rate", "100", "--run-id", "77"}));
  expect_broken_off(run, scratch, "started run 77");
}

}  // namespace
}  // namespace bladefit::hil
