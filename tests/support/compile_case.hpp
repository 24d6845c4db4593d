#pragma once
#include <cstddef>
#include <vector>

#include "tests/support/reference_case.hpp"
#include "tools/design/load_design.hpp"

namespace bladefit::testing {

/// The image of a case's design, compiled now.
inline std::vector<std::byte> compile_case(const ReferenceCase& c) {
  return load_design(c.folder / "design.igs", c.normal_sign > 0 ? OutwardOption::plus : OutwardOption::minus).image;
}

}  // namespace bladefit::testing
