#include "tools/results/json_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tools/files/tool_error.hpp"
#include "tools/results/words.hpp"

namespace bladefit {

JsonField JsonField::operator[](const char* key) const {
  const std::string inner = name_.empty() ? key : name_ + "." + key;
  if (!value_.is_object() || !value_.contains(key)) fail(inner, "is missing");
  return {value_.at(key), file_, inner};
}

bool JsonField::has(const char* key) const {
  return value_.is_object() && value_.contains(key) && !value_.at(key).is_null();
}

JsonField JsonField::element(std::size_t index) const {
  return {value_.at(index), file_, fmt::format("{}[{}]", name_, index)};
}

std::size_t JsonField::size() const {
  if (!value_.is_array()) fail(name_, "is not a list");
  return value_.size();
}

void JsonField::need_size(std::size_t wanted) const {
  if (size() != wanted) fail(name_, fmt::format("has {} elements where {} belong", size(), wanted));
}

double JsonField::number() const {
  if (!value_.is_number()) fail(name_, "is not a number");
  return value_.get<double>();
}

std::uint32_t JsonField::whole() const {
  constexpr std::uint64_t largest = std::numeric_limits<std::uint32_t>::max();
  if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > largest) fail(name_, "is not a whole number");
  return value_.get<std::uint32_t>();
}

std::string JsonField::text() const {
  if (!value_.is_string()) fail(name_, "is not a text");
  return value_.get<std::string>();
}

void JsonField::fail(const std::string& name, const std::string& what) const {
  throw ToolError(
      fmt::format("{}: field {} {}; {}", file_, name.empty() ? "(whole file)" : name, what, kDamagedFileRemedy));
}

nlohmann::json parse_json(const std::string& path, const std::string& text) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text.size());
    const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw ToolError(fmt::format("{}:{}: is not JSON text; {}", path, lines + 1, kDamagedFileRemedy));
  }
}

}  // namespace bladefit
