#include "tools/simulate/simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>

#include "drivers/modbus/cmm_map_v1.hpp"
#include "tools/files/message.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/simulate/stamps.hpp"
#include "tools/simulate/stop_signal.hpp"
#include "tools/simulate/transports.hpp"

namespace bladefit {
namespace simulate {
namespace {

constexpr std::uint32_t kLargestCapacity = (65536 - cmm_map_v1::kRecordsRegister) / cmm_map_v1::kRecordSize;
constexpr double kHighestRate = 1e6;
constexpr auto kFarewell = std::chrono::seconds(1);  ///< what a reader gets to say stop after its last acknowledge

void check(const SimulatorSettings& settings) {
  const auto refuse = [](std::string_view line) { throw ToolError(std::string(line)); };
  if (!(settings.rate >= 0 && settings.rate <= kHighestRate)) {
    refuse(fmt::format("--rate {}: give 0 to {} points/s (0 = as fast as acknowledged)", settings.rate, kHighestRate));
  }
  if (settings.capacity < 1 || settings.capacity > kLargestCapacity) {
    refuse(fmt::format("--capacity {}: give 1 to {} records, what the register map has room for", settings.capacity,
                       kLargestCapacity));
  }
  if (settings.port < 0 || settings.port > 65535) refuse(fmt::format("--port {}: give 0 to 65535", settings.port));
  if (settings.unit < 1 || settings.unit > 247) refuse(fmt::format("--unit {}: give 1 to 247", settings.unit));
}

/// Waits until a descriptor is ready or `until` has come.
void wait(std::vector<pollfd>& events, std::optional<Clock::time_point> until) {
  timespec timeout{};
  if (until) {
    const auto left = std::max(Clock::duration(0), *until - Clock::now());
    timeout.tv_sec = std::chrono::duration_cast<std::chrono::seconds>(left).count();
    timeout.tv_nsec = std::chrono::nanoseconds(left % std::chrono::seconds(1)).count();
  }
  if (ppoll(events.data(), events.size(), until ? &timeout : nullptr, nullptr) < 0 && errno != EINTR) {
    throw ToolError(fmt::format("waiting for readers failed: {}", std::strerror(errno)), ToolError::Kind::device);
  }
}

/// The loop of the machine: what is due becomes readable, what has come in is answered.
class Service {
 public:
  Service(const SimulatorSettings& settings, const FaultSettings& faults)
      : settings_(settings),
        log_(settings.verbose),
        machine_(read_points_file(settings.points, settings.points_format),
                 {settings.rate, settings.capacity, settings.run_id, faults.overflow}),
        stamps_(settings.stamps),
        transport_(make_transport(settings, faults, machine_, log_)) {}

  void run() {
    while (true) {
      announce();
      std::vector<pollfd> events = transport_->interests();
      events.push_back({stop_.descriptor(), POLLIN, 0});
      wait(events, next_wakeup());
      if (events.back().revents != 0) return;
      const Clock::time_point now = Clock::now();
      machine_.advance(now);
      transport_->publish(now);
      stamps_.note(machine_.available());
      transport_->service(events, now);
      if (is_done(now)) return;
    }
  }

 private:
  [[nodiscard]] std::optional<Clock::time_point> next_wakeup() const {
    std::optional<Clock::time_point> earliest = done_by_;
    for (const std::optional<Clock::time_point> other : {machine_.next_due(), transport_->next_wakeup()}) {
      if (other && (!earliest || *other < *earliest)) earliest = other;
    }
    return earliest;
  }

  /// Says where the machine is to be found: at first, and when a terminal without a link was replaced.
  void announce() {
    if (announced_ == transport_->address()) return;
    announced_ = transport_->address();
    const std::string rate = settings_.rate > 0 ? fmt::format("at {:g} points/s", settings_.rate) : "as fast as read";
    fmt::print("simulate: serving {} points {} {}\n", machine_.total(), announced_, rate);
    std::fflush(stdout);
  }

  [[nodiscard]] bool is_done(Clock::time_point now) {
    if (!settings_.exit_when_done || machine_.acknowledged() != machine_.total()) return false;
    if (!done_by_) done_by_ = now + kFarewell;
    return !transport_->has_reader() || *done_by_ <= now;
  }

  const SimulatorSettings& settings_;
  StopSignal stop_;
  Log log_;
  Machine machine_;
  Stamps stamps_;
  std::unique_ptr<Transport> transport_;
  std::string announced_;
  std::optional<Clock::time_point> done_by_;
};

}  // namespace
}  // namespace simulate

int run_simulator(const SimulatorSettings& settings) {
  try {
    simulate::check(settings);
    simulate::FaultSettings defaults;
    defaults.seed = settings.seed.value_or(defaults.seed);
    simulate::Service(settings, simulate::parse_faults(settings.faults, defaults)).run();
    return 0;
  } catch (const ToolError& failure) {
    fmt::print(stderr, "simulate: {}\n", one_line(failure.what()));
    return failure.exit_code();
  }
}

}  // namespace bladefit
