#include "config/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "config/toml_error.hpp"
#include "config/toml_guard.hpp"
#include "drivers/text/read_file.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kMaxFileSize = std::size_t{1} << 20U;

std::string type_name(const toml::node& node) {
  if (node.is_string()) return "a text";
  if (node.is_integer()) return "a whole number";
  if (node.is_floating_point()) return "a number";
  if (node.is_boolean()) return "true or false";
  if (node.is_array()) return "a list";
  if (node.is_table()) return "a table";
  return "a date or time";
}

/// What is wrong, without the middle of what it cites where that is long: the way out stands at the end.
std::string told(const std::string& what) {
  constexpr std::size_t kFront = 60, kBack = 130;
  if (what.size() <= kFront + kBack) return what;
  return what.substr(0, kFront) + "..." + what.substr(what.size() - kBack);
}

std::string joined(const std::vector<std::string>& words) {
  constexpr std::size_t kListed = 12;
  const std::size_t listed = std::min(words.size(), kListed);
  std::string text =
      fmt::format("{}", fmt::join(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(listed), ", "));
  if (words.size() > listed) text += fmt::format(" and {} more", words.size() - listed);
  return text;
}

/// Number of single-character changes between two words.
std::size_t edit_distance(std::string_view left, std::string_view right) {
  std::vector<std::size_t> row(right.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < left.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < right.size(); ++j) {
      const std::size_t change = diagonal + (left[i] == right[j] ? 0U : 1U);
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, change}));
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, word.size() / 2) + 1;
  for (const std::string& name : names) {
    const bool within =
        name.size() > 2 && (word.find(name) != std::string_view::npos || name.find(word) != std::string::npos);
    const std::size_t distance = within ? 1 : edit_distance(word, name);
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

TomlDocument read_toml(const std::string& path) {
  TomlDocument document;
  document.name = path;
  std::string text;
  if (const Failure failure = read_file(path, kMaxFileSize, text)) {
    document.error = {failure.kind, fmt::format("{}: {}", path, failure.message)};
    return document;
  }
  if (const std::string fault = toml_text_fault(text); !fault.empty()) {
    document.error = bad_input(fmt::format("{}:{}", path, fault));
    return document;
  }
  try {
    document.root = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    document.error = bad_input(fmt::format("{}:{}", path, toml_error_text(text, error)));
  }
  return document;
}

TableReader::TableReader(TomlDocument& document, const toml::table& table, std::string name)
    : document_(&document), table_(&table), name_(std::move(name)) {}

std::string TableReader::full_name(std::string_view key) const {
  return name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
}

void TableReader::fail(std::string_view key, const std::string& what) {
  if (document_->error) return;
  const toml::node* node = table_->get(key);
  const toml::source_position place = node == nullptr ? table_->source().begin : node->source().begin;
  document_->error =
      bad_input(fmt::format("{}:{}: key '{}': {}", document_->name, place.line, full_name(key), told(what)));
}

/// The value of a key; null where it is absent or an error was found before.
const toml::node* TableReader::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  return good() ? table_->get(key) : nullptr;
}

bool TableReader::has(std::string_view key) { return find(key) != nullptr; }

std::vector<std::string> TableReader::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : *table_) keys.emplace_back(key.str());
  return keys;
}

bool TableReader::has_text(std::string_view key) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_string();
}

bool TableReader::says_absent(std::string_view key) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_boolean() && !node->as_boolean()->get();
}

bool TableReader::read_text(std::string_view key, std::string& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  if (node->is_string()) {
    value = node->as_string()->get();
    return true;
  }
  fail(key, fmt::format("must be a text in quotes, not {}", type_name(*node)));
  return false;
}

/// Of the type, whatever its size.
bool TableReader::take_number(std::string_view key, double& number, bool whole) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  if (node->is_integer()) {
    number = static_cast<double>(node->as_integer()->get());
  } else if (node->is_floating_point() && !whole) {
    number = node->as_floating_point()->get();
  } else {
    fail(key, fmt::format("must be {}, not {}", whole ? "a whole number" : "a number", type_name(*node)));
    return false;
  }
  return true;
}

bool TableReader::read_number(std::string_view key, double& value, NumberRange range, bool whole) {
  double number = 0;
  if (!take_number(key, number, whole)) return false;
  const char* wanted = whole ? "a whole number" : "a number";
  if (!(number >= range.low && number <= range.high)) {
    if (range.high > 1e300) {
      fail(key, fmt::format("{} is out of range; it must be {} of at least {}", number, wanted, range.low));
    } else {
      fail(key, fmt::format("{} is out of range; it must be {} from {} to {}", number, wanted, range.low, range.high));
    }
    return false;
  }
  value = number;
  return true;
}

void TableReader::read_numbers(std::string_view key, std::vector<double>& values, NumberRange range) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  double number = 0;
  if (!node->is_array()) {
    if (read_number(key, number, range, true)) values.push_back(number);
    return;
  }
  for (const toml::node& item : *node->as_array()) {
    const std::optional<std::int64_t> whole = item.value_exact<std::int64_t>();
    if (!whole || static_cast<double>(*whole) < range.low || static_cast<double>(*whole) > range.high) {
      return fail(key, fmt::format("must be a list of whole numbers from {} to {}", range.low, range.high));
    }
    values.push_back(static_cast<double>(*whole));
  }
}

void TableReader::read(std::string_view key, bool& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) return fail(key, fmt::format("must be true or false, not {}", type_name(*node)));
  value = node->as_boolean()->get();
}

void TableReader::read(std::string_view key, std::string& value) { static_cast<void>(read_text(key, value)); }

void TableReader::read(std::string_view key, std::vector<std::string>& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_array()) return fail(key, fmt::format("must be a list of texts, not {}", type_name(*node)));
  std::vector<std::string> texts;
  for (const toml::node& item : *node->as_array()) {
    if (!item.is_string()) return fail(key, fmt::format("must be a list of texts; one of them is {}", type_name(item)));
    texts.push_back(item.as_string()->get());
  }
  value = std::move(texts);
}

void TableReader::read(std::string_view key, double& value) {
  double number = 0;
  if (take_number(key, number, false)) value = number;
}

void TableReader::read(std::string_view key, double& value, NumberRange range) {
  double number = 0;
  if (read_number(key, number, range, false)) value = number;
}

void TableReader::read(std::string_view key, Length& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_string()) {
    Length length;
    read(key, length.value);
    if (good()) value = length;
  } else if (const Failure error = parse_length(node->as_string()->get(), value)) {
    fail(key, error.message);
  }
}

std::string TableReader::from_folder(const std::string& path) const {
  if (path == "-") return path;
  return std::filesystem::path(document_->name).parent_path() / path;
}

void TableReader::read_path(std::string_view key, std::string& path) {
  std::string text;
  if (!read_text(key, text)) return;
  if (text.empty()) return fail(key, "is empty; give a path, or leave the key out");
  path = from_folder(text);
}

void TableReader::read_path(std::string_view key, std::optional<std::string>& path) {
  std::string present;
  read_path(key, present);
  if (!present.empty()) path = present;
}

std::optional<TableReader> TableReader::table(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (node->is_table()) return TableReader(*document_, *node->as_table(), full_name(key));
  fail(key, fmt::format("must be a table, not {}", type_name(*node)));
  return std::nullopt;
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
  std::vector<TableReader> tables;
  const toml::node* node = find(key);
  if (node == nullptr) return tables;
  const bool fits = node->is_array() && !node->as_array()->empty() &&
                    std::ranges::all_of(*node->as_array(), [](const toml::node& item) { return item.is_table(); });
  if (!fits) {
    fail(key, fmt::format("must be tables, each with [[{}]] above it", full_name(key)));
    return tables;
  }
  for (const toml::node& item : *node->as_array()) {
    tables.push_back(
        TableReader(*document_, *item.as_table(), fmt::format("{}[{}]", full_name(key), tables.size() + 1)));
  }
  return tables;
}

void TableReader::finish() {
  if (!good()) return;
  for (const auto& [key, node] : *table_) {
    const std::string_view word = key.str();
    if (std::find(asked_.begin(), asked_.end(), word) != asked_.end()) continue;
    const std::string nearest = nearest_name(word, asked_);
    const std::string fix = nearest.empty() ? "known keys: " + joined(asked_) : "did you mean '" + nearest + "'?";
    document_->error = bad_input(fmt::format("{}:{}: unknown key '{}'; {}", document_->name, key.source().begin.line,
                                             excerpt(full_name(word)), fix));
    return;
  }
}

}  // namespace bladefit
