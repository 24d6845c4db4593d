#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/source/failure.hpp"
#include "drivers/text/csv_header.hpp"
#include "drivers/text/csv_text.hpp"
#include "drivers/text/decimal_mark.hpp"

namespace bladefit {

/// One line of values.
struct CsvRow {
  CsvPlace place;
  const CsvHeader* header = nullptr;
  std::vector<std::string_view> values;  ///< of each column of the format; empty where there is none
  DecimalMark* mark = nullptr;           ///< of the file
};

/// Hands every row of `text` to `take`, which returns what is wrong with it, or nothing. `name`: of the file.
///
/// The first line names the columns, in any order, unless `columns` does: names of the format with `-` for a column
/// that is not used. Cells are separated by ; tab , | or blanks, whichever gives the first line its columns, or as a
/// line `sep=;` says; they may stand in quotation marks. Lines without a value and those that begin with # are passed
/// over; a comment `# units: in` and a line of units below the names are obeyed. Where cells are not separated by
/// commas, or stand in quotation marks, numbers may have a decimal comma.
///
/// Returns the first failure: among them an encoding that is not read, a line that is too long or has another number of
/// cells than there are columns, a last line that is cut short, decimal commas that may be separators of thousands. A
/// file without a line of names is one, a file without rows is not.
[[nodiscard]] Failure read_csv_table(std::string_view text, std::string_view name, const CsvFormat& format,
                                     std::span<const std::string_view> columns, CsvHeader& header,
                                     const std::function<Failure(const CsvRow&)>& take);

/// Reads the number of a column of the format. bad_input where there is none; then `value` is as before.
[[nodiscard]] Failure finite_cell(const CsvRow& row, std::size_t column, const CsvFormat& format, double& value);

}  // namespace bladefit
