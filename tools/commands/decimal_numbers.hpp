#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Makes every number of every command a decimal one: 010 is ten, and 0x10 is refused. The parser takes the one for
/// octal and the other for hexadecimal. Call it once all options are there.
void take_decimal_numbers(CLI::App& app);

}  // namespace bladefit
