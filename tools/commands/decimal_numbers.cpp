#include "tools/commands/decimal_numbers.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace bladefit {
namespace {

/// Returns what is wrong, and takes the zeros away that begin a whole number.
std::string made_decimal(std::string& text) {
  constexpr std::string_view kOfOtherBases = "xXpPbB";
  if (text.empty() || text.find_first_of(kOfOtherBases) != std::string::npos) return "'" + text + "' is not a number";
  const std::size_t sign = text.front() == '-' || text.front() == '+' ? 1 : 0;
  const std::size_t digits = text.size() - sign;
  const std::size_t zeros = std::min(text.find_first_not_of('0', sign), text.size()) - sign;
  const bool whole = text.find_first_not_of("0123456789", sign) == std::string::npos;
  if (whole && zeros > 0) text.erase(sign, zeros == digits ? zeros - 1 : zeros);
  return "";
}

}  // namespace

void take_decimal_numbers(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    for (CLI::Option* option : command->get_options()) {
      const std::string type = option->get_type_name();
      if (type == "FLOAT" || type == "INT" || type == "UINT" || type == "T1,T2,...")
        option->transform(CLI::Validator(made_decimal, ""));
    }
  }
}

}  // namespace bladefit
