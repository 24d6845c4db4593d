#include "drivers/text/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "drivers/text/csv_cells.hpp"
#include "drivers/text/cut_line.hpp"
#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kLongestRow = 65536;

/// What a comment calls the unit of the lengths.
constexpr std::array<std::string_view, 5> kUnitKeys = {"unit", "units", "length unit", "length units",
                                                       "unit of length"};

using Cells = std::vector<std::string_view>;

/// A line without a value, with its separators or without.
bool is_empty(std::string_view line) { return line.find_first_not_of(" \t;,|\"") == std::string_view::npos; }

bool is_number(std::string_view cell) {
  DecimalMark mark;
  double value = 0;
  return mark.read(cell, 1, value).empty();
}

/// The cells of the line of names. A unit in brackets that blanks set apart belongs to the name before it.
std::string_view split_names(std::string_view line, char separator, Cells& cells) {
  const std::string_view wrong = split_cells(line, separator, cells);
  if (separator != kBlanks) return wrong;
  Cells joined;
  for (const std::string_view cell : cells) {
    const bool bracket = !joined.empty() && (cell.starts_with('[') || cell.starts_with('('));
    if (!bracket) {
      joined.push_back(cell);
      continue;
    }
    const char* const begin = joined.back().data();
    joined.back() = {begin, static_cast<std::size_t>(cell.data() + cell.size() - begin)};
  }
  cells = std::move(joined);
  return wrong;
}

/// Reads one file, line by line.
class TableReading {
 public:
  TableReading(std::string_view name, const CsvFormat& format, std::span<const std::string_view> columns,
               CsvHeader& header)
      : format_(format), given_(columns), header_(header) {
    row_.place = {name, 0};
    row_.header = &header;
    row_.mark = &mark_;
    header_ = {};
  }

  Failure read(std::string_view text, const std::function<Failure(const CsvRow&)>& take) {
    while (!text.empty()) {
      bool ended = true;
      const std::string_view line = take_line(text, &ended);
      ++row_.place.line;
      if (Failure failure = read_line(line, ended, take)) return placed(failure);
    }
    if (header_.columns.empty())
      return bad_input(fmt::format("{}: the file is empty; {}", row_.place.name, format_.fix));
    return check_commas();
  }

 private:
  /// Errors are phrases, except for those of `take`, which name the place.
  Failure read_line(std::string_view line, bool ended, const std::function<Failure(const CsvRow&)>& take) {
    if (line.size() > kLongestRow) {
      return bad_input(
          fmt::format("the line is longer than {} characters: this is not a table; {}", kLongestRow, format_.fix));
    }
    if (is_binary(line))
      return bad_input(fmt::format("a control character: this is not a CSV text file; {}", format_.fix));
    if (is_empty(line)) return {};
    if (const std::string_view content = trimmed(line); content.front() == '#') return take_comment(content.substr(1));
    if (header_.columns.empty()) {
      if (!separator_ && take_separator(line)) return {};
      bool is_row = false;
      if (Failure failure = take_names(line, is_row)) return failure;
      if (!is_row) return {};
    }
    if (const std::string_view wrong = split_cells(line, *separator_, cells_); !wrong.empty())
      return bad_input(std::string(wrong));
    if (Failure failure = assign_cells()) return failure;
    bool is_units = false;
    if (Failure failure = take_units(is_units); failure || is_units) return failure;
    if (Failure failure = cut_.check(cells_, ended)) return failure;
    ++rows_;
    if (Failure failure = take(row_)) {
      placed_ = true;
      return failure;
    }
    return {};
  }

  Failure placed(const Failure& failure) const {
    return placed_ ? failure : Failure{failure.kind, row_.place.say(failure.message)};
  }

  /// `# units: in`, above the rows.
  Failure take_comment(std::string_view comment) {
    const std::string text = lower_case(comment);
    const std::size_t sign = std::min(text.find_first_of(":="), text.size());
    const std::string_view key = trimmed(std::string_view(text).substr(0, sign));
    if (sign == text.size() || std::ranges::find(kUnitKeys, key) == kUnitKeys.end()) return {};
    std::string_view word = std::string_view(text).substr(sign + 1);
    word = trimmed(word.substr(0, word.find_last_not_of(",;") + 1));
    const std::optional<Unit> unit = parse_unit(without_brackets(word));
    if (!unit) {
      return bad_input(fmt::format("the unit {} is not known here; write mm, cm, m or in, or take the comment out",
                                   in_quotes(word)));
    }
    if (rows_ > 0 && header_.unit != unit)
      return bad_input("a unit is given below the first values; put this line above them");
    return merge_unit(header_, *unit);
  }

  /// `sep=;`, as spreadsheets write and read it.
  bool take_separator(std::string_view line) {
    const std::size_t quote = line.starts_with('"') ? 1 : 0;
    if (lower_case(line.substr(quote, 4)) != "sep=" || line.size() < quote + 5) return false;
    if (std::ranges::find(kSeparators, line[quote + 4]) == kSeparators.end()) return false;
    separator_ = line[quote + 4];
    return true;
  }

  /// The separator under which the first line fits: under which its columns are known, or which gives as many cells as
  /// there are names and numbers where numbers belong.
  Failure take_names(std::string_view line, bool& is_row) {
    const std::string_view candidates =
        separator_ ? std::string_view(&*separator_, 1) : std::string_view(kSeparators.data(), kSeparators.size());
    Failure told;
    bool cut = false;
    for (const char separator : candidates) {
      CsvHeader header;
      header.unit = header_.unit;
      const std::string_view wrong = split_names(line, separator, cells_);
      Failure failure = !wrong.empty() ? bad_input(std::string(wrong)) : name_cells(header, is_row);
      if (!failure) {
        separator_ = separator;
        header_ = std::move(header);
        row_.values.resize(format_.columns.size());
        return {};
      }
      // What does not cut the line at all has little to say of it.
      if (!told || (!cut && cells_.size() > 1)) told = std::move(failure);
      cut = cut || cells_.size() > 1;
    }
    return told;
  }

  Failure name_cells(CsvHeader& header, bool& is_row) {
    is_row = false;
    if (given_.empty()) {
      const auto number = std::ranges::find_if(cells_, is_number);
      Failure failure = read_names(cells_, format_, header);
      if (!failure || number == cells_.end()) return failure;
      return bad_input(
          fmt::format("a number, {}, stands where a column's name should; {}", in_quotes(*number), format_.fix));
    }
    while (cells_.size() > given_.size() && cells_.back().empty()) cells_.pop_back();
    if (cells_.size() != given_.size()) {
      return bad_input(fmt::format("the line has {} columns, but {} are named; name each, - for one that is not used",
                                   cells_.size(), given_.size()));
    }
    Failure failure = apply_names(given_, {}, format_, header);
    if (failure) return failure;
    std::size_t numbers = 0, wanted = 0;
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      if (!header.columns[cell] || *header.columns[cell] >= format_.needed) continue;
      ++wanted;
      numbers += is_number(cells_[cell]) ? 1 : 0;
    }
    is_row = numbers > 0;
    if (numbers == wanted) return {};
    if (is_row) return bad_input("numbers and words where coordinates belong; check the columns that are named");
    CsvHeader with_names;
    with_names.unit = header.unit;
    failure = apply_names(given_, cells_, format_, with_names);
    header = std::move(with_names);
    return failure;
  }

  /// Cells behind the last column must be empty; cells may be missing only where the column has no name.
  Failure assign_cells() {
    while (cells_.size() > header_.columns.size() && cells_.back().empty()) cells_.pop_back();
    std::size_t named = header_.columns.size();
    while (named > 0 && is_nameless(named - 1)) --named;
    if (cells_.size() > header_.columns.size() || cells_.size() < named) {
      return bad_input(fmt::format(
          "{} columns where {} are named; complete the line, and where the decimal mark is a comma separate by ';'",
          cells_.size(), named));
    }
    std::ranges::fill(row_.values, std::string_view());
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      if (header_.columns[cell]) row_.values[*header_.columns[cell]] = cells_[cell];
      if (is_nameless(cell) && !cells_[cell].empty()) {
        return bad_input(fmt::format("{} stands in column {}, which has no name; {}", in_quotes(cells_[cell]), cell + 1,
                                     format_.fix));
      }
    }
    return {};
  }

  [[nodiscard]] bool is_nameless(std::size_t cell) const { return given_.empty() && header_.nameless[cell]; }

  /// A line below the names that gives each length its unit.
  Failure take_units(bool& is_units) {
    if (rows_ > 0) return {};
    std::optional<Unit> unit;
    for (std::size_t column = 0; column < format_.columns.size(); ++column) {
      if (!header_.has[column] || !format_.is_length(column)) continue;
      const std::optional<Unit> own = parse_unit(without_brackets(lower_case(row_.values[column])));
      if (!own) return {};
      if (unit && *unit != *own) return bad_input("the lengths have different units; give them all in one");
      unit = own;
    }
    is_units = unit.has_value();
    return unit ? merge_unit(header_, *unit) : Failure{};
  }

  [[nodiscard]] Failure check_commas() const {
    const std::size_t line = mark_.doubtful_line();
    if (line == 0) return {};
    return bad_input(CsvPlace{row_.place.name, line}.say(
        "a number such as 1,234 may have a decimal comma or a separator of thousands, and no number in the file tells; "
        "write decimal points, or four decimals"));
  }

  const CsvFormat& format_;
  std::span<const std::string_view> given_;
  CsvHeader& header_;
  CsvRow row_;
  DecimalMark mark_;
  CutLine cut_;
  Cells cells_;
  std::optional<char> separator_;
  std::size_t rows_ = 0;
  bool placed_ = false;
};

}  // namespace

Failure read_csv_table(std::string_view text, std::string_view name, const CsvFormat& format,
                       std::span<const std::string_view> columns, CsvHeader& header,
                       const std::function<Failure(const CsvRow&)>& take) {
  if (const Failure failure = strip_marks(text)) return bad_input(fmt::format("{}: {}", name, failure.message));
  return TableReading(name, format, columns, header).read(text, take);
}

Failure finite_cell(const CsvRow& row, std::size_t column, const CsvFormat& format, double& value) {
  const std::string_view cell = row.values[column];
  const std::string_view wrong =
      cell.empty() ? "it is empty; write a number" : row.mark->read(cell, row.place.line, value);
  if (wrong.empty()) return {};
  return bad_input(row.place.say(fmt::format("column {}: {}{}{}", format.columns[column],
                                             cell.empty() ? "" : in_quotes(cell), cell.empty() ? "" : ": ", wrong)));
}

}  // namespace bladefit
