#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/source/failure.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {

/// The columns that a kind of CSV file may have. Names are told apart without regard to case; others are not used.
struct CsvFormat {
  std::span<const std::string_view> columns;  ///< names that the file may have
  std::size_t needed = 0;                     ///< the first so many must be there,
  std::size_t together = 0;                   ///< and those from there to this one all or none
  std::size_t first_length = 0;               ///< lengths, whose names may carry a unit: the columns from here
  std::size_t lengths = 0;                    ///< and so many of them
  std::string_view fix;                       ///< what the first line must be, for messages

  [[nodiscard]] bool is_length(std::size_t column) const {
    return column >= first_length && column < first_length + lengths;
  }
};

/// What the columns of one file are.
struct CsvHeader {
  std::vector<std::optional<std::size_t>> columns;  ///< of each cell, as an index into CsvFormat::columns; none: unused
  std::vector<bool> nameless;                       ///< of each cell: the first line has no name for it
  std::vector<bool> has;                            ///< of each column of the format
  std::optional<Unit> unit;                         ///< of its lengths, where the file says it
  std::vector<std::string> unused;                  ///< names of the columns that are not used

  /// "columns not used: 'Point', 'Comment'"; empty where all are.
  [[nodiscard]] std::string unused_note() const;
};

/// The text between the brackets that it stands in, or the text.
[[nodiscard]] std::string_view without_brackets(std::string_view text);

/// Reads the names of the columns, such as `X`, `x [mm]` or `y_in`. Errors are phrases, without the place: a column
/// that is missing, named twice or of an unknown unit, units that contradict each other.
[[nodiscard]] Failure read_names(std::span<const std::string_view> names, const CsvFormat& format, CsvHeader& header);

/// Gives the cells the names that the user says, `-` for a column that is not used. The line of names that the file
/// may have of its own must not contradict them, and its units are obeyed; `own` is empty where there is none.
[[nodiscard]] Failure apply_names(std::span<const std::string_view> given, std::span<const std::string_view> own,
                                  const CsvFormat& format, CsvHeader& header);

/// The unit of the lengths of a file: that which the file says, else that which the user gives, else `otherwise`.
/// Error: the file says another one than the user.
[[nodiscard]] Failure choose_unit(const CsvHeader& header, std::optional<Unit> given, Unit otherwise, Unit& unit);

/// Takes over a unit that another part of the file says. Error: it contradicts the one known so far.
[[nodiscard]] Failure merge_unit(CsvHeader& header, Unit unit);

}  // namespace bladefit
