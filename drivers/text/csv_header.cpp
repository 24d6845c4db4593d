#include "drivers/text/csv_header.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/text/csv_text.hpp"
#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

/// What one name says.
struct ColumnName {
  std::optional<std::size_t> column;
  std::optional<Unit> unit;
  std::string unknown_unit;  ///< as it is written; empty = none
};

/// What stands behind the bare name, such as ` [mm]` or `_in`.
struct Addition {
  std::string_view text;
  bool in_brackets = false;
};

constexpr std::string_view kBetween = " \t_-/.:,";

/// Nothing where the name goes on, as in `index` for `i`.
std::optional<Addition> addition_of(std::string_view rest) {
  const std::size_t begin = std::min(rest.find_first_not_of(kBetween), rest.size());
  const std::string_view text = trimmed(rest.substr(begin));
  if (text.empty()) return Addition{};
  if (const std::string_view inner = without_brackets(text); inner.size() < text.size()) return Addition{inner, true};
  if (begin == 0) return std::nullopt;
  return Addition{text.starts_with("in ") ? trimmed(text.substr(3)) : text, false};
}

/// The unit behind a name that may be any, such as `x actual [mm]` or `x_act_in`.
std::optional<Unit> unit_at_end(std::string_view name) {
  constexpr std::string_view kClose = ")]}>", kBeforeUnit = " \t_-/.:,([{<";
  if (!name.empty() && kClose.find(name.back()) != std::string_view::npos) name.remove_suffix(1);
  const std::size_t before = trimmed(name).find_last_of(kBeforeUnit);
  return before == std::string_view::npos ? std::nullopt : parse_unit(trimmed(name).substr(before + 1));
}

/// The meaning of `name` if it is that of the column, else nothing.
std::optional<ColumnName> match(const std::string& name, std::size_t column, const CsvFormat& format) {
  const std::string bare = lower_case(format.columns[column]);
  if (!name.starts_with(bare)) return std::nullopt;
  const std::optional<Addition> addition = addition_of(std::string_view(name).substr(bare.size()));
  if (!addition) return std::nullopt;
  if (addition->text.empty()) return ColumnName{column, {}, {}};
  if (!format.is_length(column)) {
    const bool no_unit = addition->in_brackets && (addition->text == "-" || addition->text == "1");
    return no_unit ? std::optional(ColumnName{column, {}, {}}) : std::nullopt;
  }
  if (const std::optional<Unit> unit = parse_unit(addition->text)) return ColumnName{column, unit, {}};
  if (!addition->in_brackets) return std::nullopt;
  return ColumnName{column, {}, std::string(addition->text)};
}

ColumnName meaning_of(std::string_view cell, const CsvFormat& format) {
  const std::string name = lower_case(cell);
  for (std::size_t column = 0; column < format.columns.size(); ++column) {
    if (std::optional<ColumnName> found = match(name, column, format)) return *std::move(found);
  }
  return {};
}

Failure check_unit(const ColumnName& name, std::string_view cell) {
  if (name.unknown_unit.empty()) return {};
  return bad_input(
      fmt::format("column {}: {} is not a unit that is known here; give mm, cm, m or in, and the lengths in it",
                  in_quotes(cell), in_quotes(name.unknown_unit)));
}

Failure note_column(std::size_t column, const CsvFormat& format, CsvHeader& header) {
  if (header.has[column])
    return bad_input(fmt::format("column '{}' is named twice; {}", format.columns[column], format.fix));
  header.has[column] = true;
  return {};
}

/// A unit at one length stands for all of them only where it stands at all.
Failure check_all_units(std::span<const std::string_view> names, std::size_t with_unit, const CsvFormat& format,
                        const CsvHeader& header) {
  std::size_t lengths = 0;
  for (std::size_t column = 0; column < header.has.size(); ++column)
    lengths += header.has[column] && format.is_length(column) ? 1 : 0;
  if (with_unit == 0 || with_unit == lengths) return {};
  return bad_input(fmt::format("only {} of the {} lengths say their unit: {}; give it with each of them, or with none",
                               with_unit, lengths, quoted_list({names.begin(), names.end()})));
}

Failure check_columns(std::span<const std::string_view> names, const CsvFormat& format, const CsvHeader& header) {
  bool any = false;
  for (std::size_t column = format.needed; column < format.together; ++column) any = any || header.has[column];
  for (std::size_t column = 0; column < (any ? format.together : format.needed); ++column) {
    if (header.has[column]) continue;
    return bad_input(fmt::format("column '{}' is missing among {}; {}", format.columns[column],
                                 quoted_list({names.begin(), names.end()}), format.fix));
  }
  return {};
}

}  // namespace

std::string_view without_brackets(std::string_view text) {
  constexpr std::string_view kOpen = "([{<", kClose = ")]}>";
  const std::size_t bracket = text.size() < 2 ? std::string_view::npos : kOpen.find(text.front());
  if (bracket == std::string_view::npos || text.back() != kClose[bracket]) return text;
  return trimmed(text.substr(1, text.size() - 2));
}

std::string CsvHeader::unused_note() const {
  if (unused.empty()) return {};
  return fmt::format("columns not used: {}", quoted_list({unused.begin(), unused.end()}));
}

Failure choose_unit(const CsvHeader& header, std::optional<Unit> given, Unit otherwise, Unit& unit) {
  if (given && header.unit && *given != *header.unit) {
    return bad_input(
        fmt::format("the file gives its lengths in {}, but --units says {}; leave --units out, or correct the file",
                    word_of(*header.unit), word_of(*given)));
  }
  unit = header.unit.value_or(given.value_or(otherwise));
  return {};
}

Failure merge_unit(CsvHeader& header, Unit unit) {
  if (header.unit && *header.unit != unit) {
    return bad_input(fmt::format("the unit {} contradicts {}, which stands before it; correct one of the two",
                                 word_of(unit), word_of(*header.unit)));
  }
  header.unit = unit;
  return {};
}

Failure read_names(std::span<const std::string_view> names, const CsvFormat& format, CsvHeader& header) {
  header.has.assign(format.columns.size(), false);
  std::size_t with_unit = 0;
  for (const std::string_view cell : names) {
    const ColumnName name = meaning_of(cell, format);
    header.columns.push_back(name.column);
    if (Failure failure = check_unit(name, cell)) return failure;
    header.nameless.push_back(cell.empty());
    if (!name.column) {
      if (!cell.empty()) header.unused.emplace_back(cell);
      continue;
    }
    if (Failure failure = note_column(*name.column, format, header)) return failure;
    if (!name.unit) continue;
    ++with_unit;
    if (Failure failure = merge_unit(header, *name.unit)) return failure;
  }
  if (Failure failure = check_columns(names, format, header)) return failure;
  return check_all_units(names, with_unit, format, header);
}

Failure apply_names(std::span<const std::string_view> given, std::span<const std::string_view> own,
                    const CsvFormat& format, CsvHeader& header) {
  if (Failure failure = read_names(given, format, header)) return failure;
  header.unused.clear();
  std::size_t with_unit = 0;
  for (std::size_t cell = 0; cell < std::min(given.size(), own.size()); ++cell) {
    const std::optional<std::size_t> column = header.columns[cell];
    if (!column) {
      if (!own[cell].empty()) header.unused.emplace_back(own[cell]);
      continue;
    }
    const ColumnName name = meaning_of(own[cell], format);
    if (Failure failure = check_unit(name, own[cell])) return failure;
    if (name.column && name.column != column) {
      return bad_input(
          fmt::format("column {} is {} in the file, but {} in the names that are given; correct one of them", cell + 1,
                      in_quotes(own[cell]), in_quotes(given[cell])));
    }
    const std::optional<Unit> unit = format.is_length(*column) ? unit_at_end(lower_case(own[cell])) : std::nullopt;
    if (!unit) continue;
    ++with_unit;
    if (Failure failure = merge_unit(header, *unit)) return failure;
  }
  return check_all_units(own, with_unit, format, header);
}

}  // namespace bladefit
