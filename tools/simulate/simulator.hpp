#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/replay/points_csv.hpp"

namespace bladefit {

/// What the simulated machine measures and how it is reached.
struct SimulatorSettings {
  std::string points;                    ///< points file
  PointsFormat points_format;            ///< of the points file; on the wire are always mm
  std::string transport = "modbus-tcp";  ///< a word of transport_words()
  int port = 1502;                       ///< Modbus TCP, on 127.0.0.1; 0 = any free one
  std::string device;                    ///< Modbus RTU and serial: link to the pseudo terminal; empty = its own name
  int unit = 1;                          ///< Modbus RTU address on the line, 1..247
  double rate = 200;                     ///< [points/s]; 0 = as fast as the reader acknowledges
  std::uint32_t capacity = 512;          ///< records in the machine's ring
  std::uint32_t run_id = 1;
  std::uint16_t map_version = 1;      ///< what register 0 says, to test readers
  std::string faults;                 ///< for example "drop=0.01,delay=0.05:200ms,seed=7"; empty = none
  std::optional<std::uint64_t> seed;  ///< of the faults, where they do not give one themselves
  std::string stamps;                 ///< file of sequence,nanoseconds of CLOCK_MONOTONIC when readable; empty = none
  bool exit_when_done = false;        ///< ends when the last record was acknowledged
  bool verbose = false;               ///< commands and faults on standard error
};

/// Runs a simulated CMM until SIGINT or SIGTERM, in one thread. One line on standard output says that it is ready.
/// Returns 0 done, 2 bad input, 3 device failure, with one line on standard error for the latter two.
[[nodiscard]] int run_simulator(const SimulatorSettings& settings);

}  // namespace bladefit
