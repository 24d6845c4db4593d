#include "config/point_plan.hpp"

#include <fmt/format.h>

#include <optional>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

/// What somebody meant as a number, readable or not: digits with signs, marks and an exponent.
bool is_like_number(std::string_view text) {
  return text.find_first_not_of("0123456789+-.,eE") == std::string_view::npos;
}

}  // namespace

Failure parse_point_plan(std::string_view text, PointPlan& plan) {
  const std::optional<std::uint32_t> count = parse_whole<std::uint32_t>(text);
  if (count && *count > 0) {
    plan = {*count, ""};
    return {};
  }
  const bool has_digit = text.find_first_of("0123456789") != std::string_view::npos;
  if (text.empty() || (has_digit && is_like_number(text))) {
    return bad_input(
        fmt::format("'{}': give a number of points from 1 to 4294967295, or a CSV file of the points", text));
  }
  plan = {0, std::string(text)};
  return {};
}

}  // namespace bladefit
