// The panel's registers, read by a program that knows nothing of bladefit, agree with the session's result.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// Input registers as `mbpoll` reads them.
class PolledPanel {
 public:
  PolledPanel(int port, int first, int count) {
    Process poll({"mbpoll", "-0", "-1", "-t", "3:hex", "-r", std::to_string(first), "-c", std::to_string(count), "-p",
                  std::to_string(port), "127.0.0.1"});
    if (poll.exit_code(10s) != 0) throw std::runtime_error("mbpoll failed: " + poll.out() + poll.err());
    std::istringstream lines(poll.out());
    for (std::string line; std::getline(lines, line);) {
      int address = 0;
      unsigned value = 0;
      if (std::sscanf(line.c_str(), "[%d]: %x", &address, &value) == 2) words_[address] = value;
    }
  }
  [[nodiscard]] std::uint32_t word(int address) const { return words_.at(address); }
  [[nodiscard]] std::uint32_t number(int address) const { return word(address) << 16U | word(address + 1); }
  [[nodiscard]] double real(int address) const { return static_cast<double>(std::bit_cast<float>(number(address))); }

 private:
  std::map<int, std::uint32_t> words_;
};

void expect_same(double shown, double expected) { EXPECT_NEAR(shown, expected, 1e-6 * std::abs(expected) + 1e-12); }

/// What the registers should show, gathered from the result.
struct RegionCounts {
  std::uint32_t points = 0, out = 0;
  double worst = 0;
  std::uint32_t worst_sequence = 0;
};

RegionCounts count_region(const nlohmann::json& result, const std::string& region) {
  RegionCounts counts;
  for (const nlohmann::json& point : result.at("points")) {
    if (point.at("region") != region) continue;
    ++counts.points;
    if (point.at("state") == "out") ++counts.out;
    const double distance = point.at("distance");
    if (point.at("kind") == "interior" && std::abs(distance) > std::abs(counts.worst)) {
      counts.worst = distance;
      counts.worst_sequence = point.at("index").get<std::uint32_t>() + 1;
    }
  }
  return counts;
}

/// The same points with x and i of the other sign.
std::string mirrored(const std::string& csv) {
  std::istringstream lines(csv);
  std::string text, line;
  for (bool header = true; std::getline(lines, line); header = false) {
    std::istringstream cells(line);
    for (int column = 0; std::getline(cells, line, ','); ++column) {
      const bool turned = !header && (column == 0 || column == 3);
      text += (column > 0 ? "," : "") + (turned ? std::to_string(-std::stod(line)) : line);
    }
    text += "\n";
  }
  return text;
}

void expect_pose(const PolledPanel& panel, const nlohmann::json& pose) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    expect_same(panel.real(26 + 2 * static_cast<int>(axis)), pose.at("translation").at(axis));
  }
  expect_same(panel.real(32), pose.at("euler").at("psi"));
  expect_same(panel.real(34), pose.at("euler").at("theta"));
  expect_same(panel.real(36), pose.at("euler").at("phi"));
}

void expect_regions(const PolledPanel& panel, const nlohmann::json& result) {
  const RegionCounts edge = count_region(result, "leading_edge");
  const RegionCounts rest = count_region(result, "rest");
  EXPECT_GT(edge.out, 0U) << "nothing to see: choose a smaller tolerance";
  EXPECT_EQ(panel.number(8), edge.out);
  EXPECT_EQ(panel.number(10), rest.out);
  EXPECT_EQ(panel.word(3) & 1U, edge.out > 0 ? 1U : 0U);
  EXPECT_EQ(panel.word(3) >> 1U & 1U, rest.out > 0 ? 1U : 0U);
  expect_same(panel.real(18), edge.worst);
  EXPECT_EQ(panel.number(20), edge.worst_sequence);
  expect_same(panel.real(22), rest.worst);
  EXPECT_EQ(panel.number(24), rest.worst_sequence);
}

/// The newest leading-edge points out of tolerance are such in the result, with the same distance.
void expect_newest(const PolledPanel& panel, const nlohmann::json& result) {
  for (int place = 60; place < 92; place += 4) {
    const std::uint32_t sequence = panel.number(place);
    if (sequence == 0) continue;
    const nlohmann::json& point = result.at("points").at(sequence - 1);
    EXPECT_EQ(point.at("index"), sequence - 1);
    EXPECT_EQ(point.at("state"), "out");
    EXPECT_EQ(point.at("region"), "leading_edge");
    expect_same(panel.real(place + 2), point.at("distance"));
  }
}

TEST(RunPanel, ShowsWhatTheResultSays) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "1000"}));
  Process run(
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json"));
  const int port = panel_port(run);
  const RawModbus watcher = RawModbus::tcp(port);
  ASSERT_TRUE(eventually(
      [&] {
        const std::vector<std::uint16_t> registers = watcher.inputs(0, 6);
        return !registers.empty() && registers[5] == 200 && registers[1] == 4;
      },
      20s));
  const PolledPanel panel(port, 0, 92);
  run.signal(SIGINT);
  ASSERT_TRUE(run.exit_code(10s));
  const nlohmann::json result = testing::read_json(scratch / "result.json");
  EXPECT_EQ(panel.word(0), 1U);
  EXPECT_EQ(panel.word(2), 2U);
  EXPECT_EQ(panel.word(3) & ~3U, 0U);
  EXPECT_EQ(panel.number(4), 200U);
  EXPECT_EQ(panel.number(6), result.at("regions").at("leading_edge").at("count"));
  EXPECT_EQ(panel.number(12), 0U);
  expect_same(panel.real(14), result.at("summary").at("rms_after"));
  expect_same(panel.real(16), result.at("regions").at("leading_edge").at("rms_after"));
  expect_regions(panel, result);
  expect_pose(panel, result.at("pose"));
  EXPECT_EQ(panel.number(38), 200U);
  expect_same(panel.real(45), static_cast<double>(0.05F));
  expect_same(panel.real(47), static_cast<double>(0.1F));
  EXPECT_EQ(panel.word(54), 6U);
  expect_newest(panel, result);
}

/// A session file says how many points will come; the command line wins over it.
TEST(RunPanel, TellsHowManyPointsAreToCome) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "1000"}));
  std::filesystem::copy_file(kFewPoints, scratch / "program.csv");
  const std::string config = scratch.write("session.toml", "plan = \"program.csv\"\n");
  const auto planned = [&](const std::vector<std::string>& more) {
    Process run(run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session",
                            scratch / "result.json", std::vector<std::string>{"--config", config} + more));
    const RawPanel panel(panel_port(run));
    EXPECT_TRUE(eventually([&] { return panel.number(287) != 0; }, 20s)) << run.err();
    return panel.number(287);
  };
  EXPECT_EQ(planned({}), 200U);
  EXPECT_EQ(planned({"--plan", "1234"}), 1234U);
}

/// What is wrong with the points as a whole is found when the session ends; the panel's last words say it too.
TEST(RunPanel, EndsWithTheVerdictOfTheResult) {
  const ScratchFolder scratch;
  std::ofstream(scratch / "mirrored.csv") << mirrored(read_whole(kFewPoints));
  Process run(run_options("replay:" + (scratch / "mirrored.csv"), scratch / "session", scratch / "result.json",
                          {"--headless"}));
  const RawPanel panel(panel_port(run));
  std::uint32_t last = 0;
  while (run.running()) {
    const std::uint32_t verdict = panel.number(281);
    if (verdict != 0) last = verdict;
  }
  EXPECT_EQ(run.exit_code(), 4) << run.out();
  const nlohmann::json verdict = testing::parse_json(read_whole(scratch / "result.json")).at("verdict");
  EXPECT_EQ(verdict.at("state"), "not_decided");
  EXPECT_EQ(last >> 16U, 3U) << "not decided";
  constexpr std::uint32_t kWrongWorld = 128, kAmbiguousOrFar = 256;
  EXPECT_NE(last & (kWrongWorld | kAmbiguousOrFar), 0U) << verdict.dump();
}

}  // namespace
}  // namespace bladefit::hil
