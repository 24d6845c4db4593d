#pragma once
#include <string>
#include <vector>

#include "tests/hil/session.hpp"

namespace bladefit::hil {

/// What `bladefit doctor` has said.
struct Doctor {
  int exit_code = -1;
  std::string first_line;  ///< of standard output, its end included
  std::string all;         ///< both outputs
};

inline Doctor run_doctor(const std::vector<std::string>& options) {
  Process process(std::vector<std::string>{BLADEFIT_COMMAND, "doctor"} + options);
  Doctor doctor;
  doctor.exit_code = process.exit_code(30s).value_or(-1);
  const std::string out = process.out();
  doctor.first_line = out.substr(0, out.find('\n') + 1);
  doctor.all = out + process.err();
  return doctor;
}

}  // namespace bladefit::hil
