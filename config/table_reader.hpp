#pragma once
#include <toml++/toml.h>

#include <chrono>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/length.hpp"
#include "config/toml_error.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Limits of a number, both included.
struct NumberRange {
  double low = 0;
  double high = 0;
};

/// A TOML file with its name and the first error found in it.
struct TomlDocument {
  std::string name;
  toml::table root;
  Failure error;
};

/// Reads and parses a file. Errors: unreadable, syntax.
[[nodiscard]] TomlDocument read_toml(const std::string& path);

/// Reads the keys of one table. What is absent leaves its target as it is; the first thing wrong is kept in the
/// document's error, and from then on nothing more is read. finish() then reports a key that nobody asked for.
class TableReader {
 public:
  TableReader(TomlDocument& document, const toml::table& table, std::string name);

  void read(std::string_view key, bool& value);
  void read(std::string_view key, std::string& value);
  void read(std::string_view key, std::vector<std::string>& value);
  void read(std::string_view key, double& value);  ///< whatever number
  void read(std::string_view key, double& value, NumberRange range);
  void read(std::string_view key, Length& value);  ///< a number, or a text such as "0.1mm"

  /// A whole number within the range.
  template <typename Integer>
  void read_whole(std::string_view key, Integer& value, NumberRange range) {
    double number = 0;
    if (read_number(key, number, range, true)) value = static_cast<Integer>(number);
  }

  /// A whole number, or a list of them, each within the range.
  template <typename Integer>
  void read_wholes(std::string_view key, std::vector<Integer>& values, NumberRange range) {
    std::vector<double> numbers;
    read_numbers(key, numbers, range);
    for (const double number : numbers) values.push_back(static_cast<Integer>(number));
  }

  /// A text that must be one of `names`; `value` becomes the one of `values` with the same place.
  template <typename Value>
  void read_choice(std::string_view key, Value& value,
                   std::initializer_list<std::pair<std::string_view, Value>> choices) {
    read_choice<Value>(key, value, std::span(choices.begin(), choices.size()));
  }

  template <typename Value>
  void read_choice(std::string_view key, Value& value, std::span<const std::pair<std::string_view, Value>> choices) {
    std::string text;
    if (!read_text(key, text)) return;
    std::string names;
    for (const auto& [name, meaning] : choices) {
      if (name == text) {
        value = meaning;
        return;
      }
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
    fail(key, "'" + excerpt(text) + "' is none of: " + names);
  }

  /// A path, not empty; a relative one is taken from the folder of the file.
  void read_path(std::string_view key, std::string& path);
  void read_path(std::string_view key, std::optional<std::string>& path);

  /// A path of the file as one that can be used from the working directory.
  [[nodiscard]] std::string from_folder(const std::string& path) const;

  /// A duration given as a number of milliseconds.
  template <typename Duration>
  void read_ms(std::string_view key, Duration& value, NumberRange range) {
    double milliseconds = 0;
    if (!read_number(key, milliseconds, range, false)) return;
    value = std::chrono::duration_cast<Duration>(std::chrono::duration<double, std::milli>(milliseconds));
  }

  /// The same for what may be left open.
  template <typename Value, typename... Limits>
  void read(std::string_view key, std::optional<Value>& value, Limits... limits) {
    Value present{};
    if (!has(key)) return;
    read(key, present, limits...);
    if (good()) value = std::move(present);
  }

  /// Whether the key is there. It counts as asked for.
  [[nodiscard]] bool has(std::string_view key);

  /// All keys of the table, in alphabetical order.
  [[nodiscard]] std::vector<std::string> keys() const;

  /// Whether the key is there and holds a text.
  [[nodiscard]] bool has_text(std::string_view key);

  /// Whether the key is there and says `false`: something is absent in the device.
  [[nodiscard]] bool says_absent(std::string_view key);

  /// A table inside this one; nothing where it is absent or something is wrong.
  [[nodiscard]] std::optional<TableReader> table(std::string_view key);

  /// The tables of a list of them, [[key]], in their order; empty where it is absent or something is wrong.
  [[nodiscard]] std::vector<TableReader> tables(std::string_view key);

  /// Reports that the value of a key cannot be used.
  void fail(std::string_view key, const std::string& what);

  /// Reports a key that nobody asked for, with the nearest one that exists.
  void finish();

  [[nodiscard]] bool good() const { return !document_->error; }

 private:
  [[nodiscard]] const toml::node* find(std::string_view key);
  void read_numbers(std::string_view key, std::vector<double>& values, NumberRange range);
  [[nodiscard]] bool read_text(std::string_view key, std::string& value);
  [[nodiscard]] bool take_number(std::string_view key, double& number, bool whole);
  [[nodiscard]] bool read_number(std::string_view key, double& value, NumberRange range, bool whole);
  [[nodiscard]] std::string full_name(std::string_view key) const;

  TomlDocument* document_;
  const toml::table* table_;
  std::string name_;  ///< of the table; empty = the file's top
  std::vector<std::string> asked_;
};

/// The one of `names` that a misspelt word is nearest to; empty = none is near.
[[nodiscard]] std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

}  // namespace bladefit
