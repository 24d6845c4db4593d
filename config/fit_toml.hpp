#pragma once
#include <string>

namespace bladefit {

/// The text of the shipped config/fit.toml: each option with its help, its value or an example of one.
[[nodiscard]] std::string fit_toml();

}  // namespace bladefit
