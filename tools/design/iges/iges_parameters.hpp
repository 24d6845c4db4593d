#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/design/iges/iges_text.hpp"

namespace bladefit {

/// What separates the parameters of a file, and what ends an entity's.
struct IgesDelimiters {
  char parameter = ',', record = ';';
};

/// A number of IGES, whose exponent letter may be E or D. Nothing where `text` is not a finite number.
std::optional<double> parse_iges_real(std::string text);

/// The parameters of an entity, read one by one. Every error is a ToolError that names file, entity, parameter and
/// line.
class IgesParameters {
 public:
  IgesParameters(const IgesEntity& entity, const IgesDelimiters& delimiters, const std::string& file);

  /// Number of parameters, the entity type included.
  [[nodiscard]] std::size_t size() const { return fields_.size(); }
  /// Parameter `index`, counted from 0, where the entity type stands.
  [[nodiscard]] double real(std::size_t index) const;
  /// The same as a whole number in lowest..highest; `name` is used in messages.
  [[nodiscard]] int integer(std::size_t index, const char* name, int lowest, int highest) const;
  /// The same as a string; nothing where it is none.
  [[nodiscard]] std::optional<std::string> string(std::size_t index) const;
  /// The text as it stands, without blanks.
  [[nodiscard]] const std::string& text(std::size_t index) const { return fields_.at(index).text; }
  /// Every parameter is a number, a string, or left out.
  void check_words() const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Field {
    std::string text;
    std::size_t line = 0;  ///< of the file
    bool is_string = false;
  };

  int type_, directory_number_;
  std::string file_;
  std::vector<Field> fields_;
};

}  // namespace bladefit
