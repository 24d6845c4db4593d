#include "drivers/text/decimal_mark.hpp"

#include <optional>
#include <string>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kNoNumber = "is not a finite number; write it like -12.345";
constexpr std::string_view kThousands = "has separators of thousands; write numbers without them";
constexpr std::string_view kMixed =
    "the file has decimal points and decimal commas; write one of them in all its numbers";

/// Whether the comma could separate thousands: at most three digits before it, no zero in front, three after it.
bool could_be_thousands(std::string_view cell, std::size_t comma) {
  constexpr std::string_view kSigns = "+-";
  const std::size_t first = kSigns.find(cell[0]) == std::string_view::npos ? 0 : 1;
  const std::size_t before = comma - first, after = cell.size() - comma - 1;
  return before >= 1 && before <= 3 && cell[first] != '0' && after == 3;
}

}  // namespace

std::string_view DecimalMark::read(std::string_view cell, std::size_t line, double& value) {
  if (const std::size_t comma = cell.find(','); comma != std::string_view::npos)
    return read_comma(cell, comma, line, value);
  const std::optional<double> number = parse_finite(cell);
  if (!number) return kNoNumber;
  const bool point = cell.find('.') != std::string_view::npos;
  if (point && comma_) return kMixed;
  point_ = point_ || point;
  value = *number;
  return {};
}

std::string_view DecimalMark::read_comma(std::string_view cell, std::size_t comma, std::size_t line, double& value) {
  std::string pointed(cell);
  pointed[comma] = '.';
  const std::optional<double> number = parse_finite(pointed);
  if (!number) {
    constexpr std::string_view kOfNumbers = "+-0123456789.,";
    return cell.find_first_not_of(kOfNumbers) == std::string_view::npos ? kThousands : kNoNumber;
  }
  if (point_) return kMixed;
  comma_ = true;
  if (!could_be_thousands(cell, comma)) proven_ = true;
  if (doubtful_line_ == 0) doubtful_line_ = line;
  value = *number;
  return {};
}

}  // namespace bladefit
