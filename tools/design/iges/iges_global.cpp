#include "tools/design/iges/iges_global.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>

#include "drivers/text/units.hpp"
#include "tools/design/nurbs/iges_writer.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kScaleField = 13, kUnitFlagField = 14, kUnitNameField = 15, kResolutionField = 19;

/// Units of IGES 5.3, section 2.2.4.3.14; the flag is the place in the table, counted from 1.
struct IgesUnit {
  const char* code;
  const char* name;
  double mm;
};
constexpr int kNamedUnitFlag = 3;
constexpr std::array<IgesUnit, 11> kUnits = {{{"IN", "inch", kMmPerInch},
                                              {"MM", "millimetre", 1.0},
                                              {"", "", 0.0},
                                              {"FT", "foot", 304.8},
                                              {"MI", "mile", 1609344.0},
                                              {"M", "metre", 1000.0},
                                              {"KM", "kilometre", 1e6},
                                              {"MIL", "mil", 0.0254},
                                              {"UM", "micrometre", 1e-3},
                                              {"CM", "centimetre", 10.0},
                                              {"UIN", "microinch", 25.4e-6}}};

/// Takes the fields of the section one by one: numbers, or strings written as count, H, characters.
class FieldReader {
 public:
  explicit FieldReader(std::string text) : text_(std::move(text)) {}

  /// The next field without its delimiter; strings without their count. Empty behind the last one.
  std::string next(IgesDelimiters delimiters) {
    while (place_ < text_.size() && text_[place_] == ' ') ++place_;
    std::string field = next_string().value_or("");
    while (place_ < text_.size() && text_[place_] != delimiters.parameter) {
      if (text_[place_] == delimiters.record) {
        place_ = text_.size();
        break;
      }
      if (text_[place_] != ' ') field.push_back(text_[place_]);
      ++place_;
    }
    if (place_ < text_.size()) ++place_;
    return field;
  }

 private:
  std::optional<std::string> next_string() {
    std::size_t count = 0;
    const char* begin = text_.data() + place_;
    const char* end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(begin, end, count);
    if (error != std::errc() || stop == end || (*stop != 'H' && *stop != 'h')) return std::nullopt;
    const auto first = static_cast<std::size_t>(stop - text_.data()) + 1;
    count = std::min(count, text_.size() - first);
    place_ = first + count;
    return text_.substr(first, count);
  }

  std::string text_;
  std::size_t place_ = 0;
};

struct GlobalFields {
  IgesDelimiters delimiters;
  std::array<std::string, kResolutionField + 1> fields;  ///< fields[k] is field k, from 3 on
};

/// The first two fields define the delimiters of themselves and of all others; left out they are "," and ";".
GlobalFields split_fields(const std::vector<std::string_view>& records) {
  std::string text;
  for (const std::string_view record : records) text += record;
  GlobalFields global;
  FieldReader reader(text.substr(text.substr(0, 2) == "1H" ? 3 : 0));
  if (text.substr(0, 2) == "1H") global.delimiters.parameter = text[2];
  reader.next(global.delimiters);
  const std::string record = reader.next({global.delimiters.parameter, '\0'});
  if (!record.empty()) global.delimiters.record = record.front();
  for (std::size_t k = 3; k < global.fields.size(); ++k) global.fields[k] = reader.next(global.delimiters);
  return global;
}

std::optional<LengthUnit> unit_named(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
  if (name == "INCH") name = "IN";
  for (const IgesUnit& unit : kUnits) {
    if (!name.empty() && name == unit.code) return LengthUnit{unit.mm, unit.name};
  }
  return std::nullopt;
}

/// Field 14 (flag) and, where the flag says so, field 15 (name).
LengthUnit read_unit(const std::string& flag_text, const std::string& name, IgesGlobal& global,
                     const std::string& file) {
  int flag = 0;
  const auto [stop, error] = std::from_chars(flag_text.data(), flag_text.data() + flag_text.size(), flag);
  const bool number = error == std::errc() && stop == flag_text.data() + flag_text.size();
  const std::optional<LengthUnit> named = unit_named(name);
  if (flag == kNamedUnitFlag && named) return *named;
  if (flag == kNamedUnitFlag) {
    throw ToolError(
        fmt::format("{}: global section: unknown unit name \"{}\" in field 15; export the design in mm "
                    "or inches",
                    file, name));
  }
  if (!number || flag < 1 || flag > static_cast<int>(kUnits.size())) {
    throw ToolError(
        fmt::format("{}: global section: unknown unit flag \"{}\" in field 14; export the design in mm "
                    "or inches",
                    file, flag_text));
  }
  const IgesUnit& unit = kUnits[static_cast<std::size_t>(flag - 1)];
  if (named && named->mm != unit.mm) {
    global.warnings.push_back(
        fmt::format("the unit flag {} ({}) contradicts the unit name {}; the flag is followed", flag, unit.name, name));
  }
  return {unit.mm, unit.name};
}

double read_scale(const std::string& text, const std::string& file) {
  if (text.empty()) return 1.0;
  const std::optional<double> scale = parse_iges_real(text);
  if (scale && *scale > 0) return *scale;
  throw ToolError(
      fmt::format("{}: global section: model space scale \"{}\" in field 13 is not a number above 0; "
                  "export the design at scale 1",
                  file, text));
}

}  // namespace

IgesGlobal read_iges_global(const std::vector<std::string_view>& records, const std::string& file) {
  const GlobalFields fields = split_fields(records);
  IgesGlobal global;
  global.delimiters = fields.delimiters;
  global.unit = read_unit(fields.fields[kUnitFlagField], fields.fields[kUnitNameField], global, file);
  const auto flag = std::ranges::find(kUnits, global.unit.mm, &IgesUnit::mm);
  global.unit_flag = static_cast<int>(flag - kUnits.begin()) + 1;
  if (const auto resolution = parse_iges_real(fields.fields[kResolutionField]); resolution && *resolution > 0) {
    global.resolution = iges_real(*resolution);
  }
  global.model_scale = read_scale(fields.fields[kScaleField], file);
  if (const std::string note = shown_unit_note(global.unit); !note.empty()) global.warnings.push_back(note);
  if (global.model_scale != 1.0) {
    global.warnings.push_back(fmt::format("model space scale {}: coordinates are divided by it", global.model_scale));
  }
  return global;
}

}  // namespace bladefit
