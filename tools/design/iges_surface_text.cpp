#include "tools/design/iges_surface_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/geometry/design_image.hpp"
#include "tools/design/design_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kParameterColumns = 64;
constexpr int kMaxIndex = 100000;
/// Entity type, K1, K2, M1, M2 and five properties stand before the first knot.
constexpr std::size_t kHeadFields = 10;

/// A parameter and where it stands.
struct Field {
  std::string text;
  std::size_t line;
};

[[noreturn]] void fail(const std::string& file, int directory_number, const std::string& what) {
  throw DesignError(fmt::format("{}: entity 128 at D{}: {}; export the design again", file, directory_number, what));
}

/// The fields up to the record delimiter. Blanks mean nothing in numbers, which is all an entity 128 has.
std::vector<Field> split_fields(const IgesParameters& parameters, const IgesDelimiters& delimiters) {
  std::vector<Field> fields{{"", parameters.first_line}};
  for (std::size_t k = 0; k < parameters.records.size(); ++k) {
    for (const char c : parameters.records[k].substr(0, kParameterColumns)) {
      if (c == delimiters.record) return fields;
      if (c == delimiters.parameter) {
        fields.push_back({"", parameters.first_line + k});
      } else if (c != ' ' && c != '\t') {
        if (fields.back().text.empty()) fields.back().line = parameters.first_line + k;
        fields.back().text.push_back(c);
      }
    }
  }
  return fields;
}

/// A real or integer of IGES; its exponent letter may be E or D. Nothing where it is not a finite number.
std::optional<double> parse_real(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  const char* begin = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (begin == end || error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

int integer_field(const std::vector<Field>& fields, std::size_t index, const char* name, int lowest, int highest,
                  const IgesParameters& parameters, const std::string& file) {
  const std::optional<double> value = index < fields.size() ? parse_real(fields[index].text) : std::nullopt;
  if (!value || *value != std::floor(*value) || *value < lowest || *value > highest) {
    fail(file, parameters.directory_number,
         fmt::format("{} is \"{}\", which is not a whole number in {}..{} (line {})", name,
                     index < fields.size() ? fields[index].text : "", lowest, highest,
                     index < fields.size() ? fields[index].line : parameters.first_line));
  }
  return static_cast<int>(*value);
}

}  // namespace

IgesSurfaceRange check_iges_surface(const IgesParameters& parameters, const IgesDelimiters& delimiters,
                                    const std::string& file) {
  const std::vector<Field> fields = split_fields(parameters, delimiters);
  const auto integer = [&](std::size_t index, const char* name, int lowest, int highest) {
    return integer_field(fields, index, name, lowest, highest, parameters, file);
  };
  integer(0, "entity type", kIgesSurfaceType, kIgesSurfaceType);
  const int last_u = integer(1, "upper index K1 in u", 1, kMaxIndex);
  const int last_v = integer(2, "upper index K2 in v", 1, kMaxIndex);
  const int degree_u = integer(3, "degree M1 in u", 1, static_cast<int>(kMaxDegree));
  const int degree_v = integer(4, "degree M2 in v", 1, static_cast<int>(kMaxDegree));
  const auto knots = static_cast<std::size_t>(last_u + degree_u + 2) + static_cast<std::size_t>(last_v + degree_v + 2);
  const std::size_t points = static_cast<std::size_t>(last_u + 1) * static_cast<std::size_t>(last_v + 1);
  const std::size_t needed = kHeadFields + knots + 4 * points + 4;
  if (fields.size() < needed) {
    fail(file, parameters.directory_number,
         fmt::format("{} parameters where its counts (K1 = {}, K2 = {}, M1 = {}, M2 = {}) ask for {}: number of knots "
                     "or control points not matching",
                     fields.size(), last_u, last_v, degree_u, degree_v, needed));
  }
  std::vector<double> values;
  for (std::size_t k = 0; k < needed; ++k) {
    const std::optional<double> value = parse_real(fields[k].text);
    if (!value) {
      fail(file, parameters.directory_number,
           fmt::format("parameter {} is \"{}\", which is not a finite number (line {})", k, fields[k].text,
                       fields[k].line));
    }
    values.push_back(*value);
  }
  const double* range = &values[needed - 4];
  return {parameters.directory_number, range[0], range[1], range[2], range[3]};
}

}  // namespace bladefit
