#pragma once
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/process.hpp"

namespace bladefit::hil {

inline const std::string kFewPoints = data_file("dtmb4119/subsets/200.csv");

/// `bladefit simulate` with these options, up and serving.
class SimulatedMachine {
 public:
  explicit SimulatedMachine(const std::vector<std::string>& options)
      : process_(std::vector<std::string>{BLADEFIT_COMMAND, "simulate"} + options) {
    const std::optional<std::string> ready = process_.wait_for("simulate: serving ", 10s);
    if (!ready) throw std::runtime_error("the simulated machine did not start: " + process_.err());
    const std::size_t place = ready->find(" on ") + 4;
    address_ = ready->substr(place, ready->find(' ', place) - place);
  }

  /// HOST:PORT, or the path of the terminal.
  [[nodiscard]] const std::string& address() const { return address_; }
  [[nodiscard]] int port() const { return std::stoi(address_.substr(address_.find(':') + 1)); }
  [[nodiscard]] Process& process() { return process_; }

 private:
  Process process_;
  std::string address_;
};

}  // namespace bladefit::hil
