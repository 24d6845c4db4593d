#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/source/failure.hpp"
#include "drivers/text/csv_text.hpp"

namespace bladefit {

/// A CSV file whose first line names its columns, in any order. Lines that begin with # and empty ones are passed over.
struct CsvFormat {
  std::span<const std::string_view> columns;  ///< names that the file may have
  std::size_t needed = 0;                     ///< the first so many must be there,
  std::size_t together = 0;                   ///< and those from there to this one all or none
  std::string_view fix;                       ///< what the first line must be, for messages
};

/// One line of values.
struct CsvRow {
  CsvPlace place;
  std::vector<std::size_t> columns;     ///< of each cell, as an index into CsvFormat::columns
  std::vector<std::string_view> cells;  ///< without blanks around them
};

/// Hands every row of `text` to `take`, which returns what is wrong with it, or nothing. `name`: of the file.
/// Returns the first failure; a file without a line of names is one, a file without rows is not.
[[nodiscard]] Failure read_csv_table(std::string_view text, std::string_view name, const CsvFormat& format,
                                     const std::function<Failure(const CsvRow&)>& take);

/// Reads the number in a cell. bad_input where there is none; then `value` is as before.
[[nodiscard]] Failure finite_cell(const CsvRow& row, std::size_t cell, const CsvFormat& format, double& value);

}  // namespace bladefit
