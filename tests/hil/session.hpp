#pragma once
#include <bit>
#include <string>
#include <vector>

#include "tests/hil/raw_readers.hpp"
#include "tests/support/json_file.hpp"
#include "tests/support/process.hpp"

/// Sessions of `bladefit run` against `bladefit simulate`, both as real processes.
namespace bladefit::hil {

inline const std::string kBlade = data_file("dtmb4119/design.igs");
inline const std::string kAllPoints = data_file("dtmb4119/points.csv");

enum class Link { modbus_tcp, modbus_rtu, serial };

inline std::string name_of(Link link) {
  if (link == Link::modbus_tcp) return "modbus-tcp";
  return link == Link::modbus_rtu ? "modbus-rtu" : "serial";
}

/// Options of a simulated machine. `place` is where it is found again after a power cut: a port, or a path.
inline std::vector<std::string> machine_options(Link link, const std::string& place, const std::string& points,
                                                const std::vector<std::string>& more = {}) {
  return std::vector<std::string>{"--design", kBlade, "--points", points, "--transport", name_of(link)} +
         std::vector<std::string>{link == Link::modbus_tcp ? "--port" : "--device", place} + more;
}

/// The source of a session that takes its points from this machine.
inline std::string source_of(Link link, const std::string& address) {
  return name_of(link) + (link == Link::modbus_tcp ? "://" : ":") + address;
}

/// `bladefit run` with the tolerances of these tests and a panel at any free port.
inline std::vector<std::string> run_options(const std::string& source, const std::string& session,
                                            const std::string& json, const std::vector<std::string>& more = {}) {
  return std::vector<std::string>{BLADEFIT_COMMAND, "run", "--design", kBlade, "--source", source} +
         std::vector<std::string>{"--leading-edge", "u:0.4:0.6", "--tolerance", "0.05", "--ratio", "2"} +
         std::vector<std::string>{"--session", session, "--panel", "127.0.0.1:0", "--json", json} + more;
}

inline const std::vector<std::string> kUntilIdle = {"--headless", "--until-idle", "3"};

/// Port of the panel that a session has told.
inline int panel_port(const Process& run) {
  const std::optional<std::string> rest = run.wait_for("panel at 127.0.0.1:", 20s);
  if (!rest) throw std::runtime_error("no panel was told: " + run.out() + run.err());
  return std::stoi(*rest);
}

/// The panel, read by plain libmodbus.
class RawPanel {
 public:
  explicit RawPanel(int port) : client_(RawModbus::tcp(port)) {}

  [[nodiscard]] std::uint32_t number(int address) const {
    const std::vector<std::uint16_t> words = client_.inputs(address, 2);
    return words.empty() ? 0 : static_cast<std::uint32_t>(words[0]) << 16U | words[1];
  }
  [[nodiscard]] std::uint32_t points() const { return number(4); }

 private:
  RawModbus client_;
};

/// Waits until the panel counts at least `points`.
inline bool wait_for_points(const Process& run, std::uint32_t points) {
  const RawPanel panel(panel_port(run));
  return eventually([&] { return panel.points() >= points; }, 20s);
}

/// What a session that nothing disturbed makes of these points.
inline std::string clean_result(Link link, const std::string& points) {
  const ScratchFolder scratch;
  const std::string place = link == Link::modbus_tcp ? "0" : scratch / "cmm";
  SimulatedMachine machine(machine_options(link, place, points, {"--rate", "0"}));
  Process run(
      run_options(source_of(link, machine.address()), scratch / "session", scratch / "result.json", kUntilIdle));
  const std::optional<int> exit_code = run.exit_code();
  if (!exit_code || *exit_code > 1) throw std::runtime_error("the clean session failed: " + run.err());
  return read_whole(scratch / "result.json");
}

/// Exit code of a session with this result: that of its verdict, which a point that is out makes out of tolerance.
inline int expected_exit(const std::string& json) {
  const nlohmann::json result = testing::parse_json(json);
  for (const nlohmann::json& point : result.at("points")) {
    if (point.at("state") == "out") return 1;
  }
  return testing::exit_code_of_verdict(result);
}

}  // namespace bladefit::hil
