#include "tools/design/iges/iges_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kParameterColumns = 64;
constexpr std::size_t kShownOfField = 40;

/// n of a string nHcharacters.
std::optional<std::size_t> string_length(const std::string& digits) {
  std::size_t length = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), length);
  const bool whole = error == std::errc() && !digits.empty() && stop == digits.data() + digits.size();
  return whole ? std::optional(length) : std::nullopt;
}

}  // namespace

std::optional<double> parse_iges_real(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  const char* begin = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (begin == end || error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

IgesParameters::IgesParameters(const IgesEntity& entity, const IgesDelimiters& delimiters, const std::string& file)
    : type_(entity.type), directory_number_(entity.directory_number), file_(file), fields_{{"", entity.first_line}} {
  std::size_t characters_left = 0;  // of a string, which may go on in the next record
  for (std::size_t k = 0; k < entity.parameters.size(); ++k) {
    const std::size_t line = entity.first_line + k;
    std::string record(entity.parameters[k].substr(0, kParameterColumns));
    record.resize(kParameterColumns, ' ');
    for (const char c : record) {
      if (characters_left > 0) {
        fields_.back().text.push_back(c);
        --characters_left;
      } else if (c == delimiters.record) {
        return;
      } else if (c == delimiters.parameter) {
        fields_.push_back({"", line});
      } else if ((c == 'H' || c == 'h') && string_length(fields_.back().text) && !fields_.back().is_string) {
        characters_left = *string_length(fields_.back().text);
        fields_.back() = {"", line, true};
      } else if (c != ' ' && c != '\t') {
        if (fields_.back().text.empty()) fields_.back().line = line;
        fields_.back().text.push_back(c);
      }
    }
  }
  fail("its parameters do not end with the record delimiter");
}

double IgesParameters::real(std::size_t index) const {
  if (index >= fields_.size()) fail(fmt::format("parameter {} is missing", index));
  const Field& field = fields_[index];
  if (const std::optional<double> value = parse_iges_real(field.text)) return *value;
  fail(fmt::format("parameter {} is \"{}\", which is not a finite number (line {})", index,
                   field.text.substr(0, kShownOfField), field.line));
}

int IgesParameters::integer(std::size_t index, const char* name, int lowest, int highest) const {
  if (index >= fields_.size()) fail(fmt::format("{} is missing", name));
  const Field& field = fields_[index];
  const std::optional<double> value = parse_iges_real(field.text);
  if (!value || *value != std::floor(*value) || *value < lowest || *value > highest) {
    fail(fmt::format("{} is \"{}\", which is not a whole number in {}..{} (line {})", name,
                     field.text.substr(0, kShownOfField), lowest, highest, field.line));
  }
  return static_cast<int>(*value);
}

std::optional<std::string> IgesParameters::string(std::size_t index) const {
  if (index >= fields_.size() || !fields_[index].is_string) return std::nullopt;
  return fields_[index].text;
}

void IgesParameters::check_words() const {
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const Field& field = fields_[k];
    if (!field.is_string && !field.text.empty() && !parse_iges_real(field.text)) (void)real(k);
  }
}

void IgesParameters::fail(const std::string& what) const {
  throw ToolError(
      fmt::format("{}: entity {} at D{}: {}; export the design again", file_, type_, directory_number_, what));
}

}  // namespace bladefit
