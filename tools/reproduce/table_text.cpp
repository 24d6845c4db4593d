#include "tools/reproduce/table_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/reproduce/thesis_figures.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kLineWidth = 110;

std::string time_text(double seconds, bool thesis) {
  if (!thesis) return fmt::format("{:.2f} ms", 1e3 * seconds);
  const int whole = static_cast<int>(seconds);
  return fmt::format("{} min {} sec", whole / 60, whole % 60);
}

std::string cell_text(double value, Figure figure, bool thesis) {
  if (std::isnan(value)) return "n/a (scan)";
  if (std::isinf(value)) return "-";
  switch (figure) {
    case Figure::length:
      return fmt::format("{:.5f}", value);
    case Figure::bound:
      return fmt::format("{:.6g}", value);
    case Figure::motion:
      return fmt::format("{:.4f}", value);
    case Figure::percent:
      return fmt::format("{:+.1f}", value);
    case Figure::time:
      return time_text(value, thesis);
    case Figure::residual:
      return fmt::format("{:.1e}", value);
    case Figure::count:
      return fmt::format("{:.0f}", value);
  }
  return {};
}

using Lines = std::vector<std::vector<std::string>>;

/// Two lines of headings and one a row; a label stands in the first of its rows only.
Lines cells_of(const ReportTable& table) {
  Lines lines{{table.over, ""}, {table.head, ""}};
  for (const TableColumn& column : table.columns) {
    lines[0].push_back(column.over);
    lines[1].push_back(column.head);
  }
  std::string last;
  for (const TableRow& row : table.rows) {
    std::vector<std::string> line{row.label == last ? "" : row.label, row.source};
    for (std::size_t k = 0; k < row.values.size(); ++k) {
      line.push_back(cell_text(row.values[k], table.columns[k].figure, row.source == kThesisSource));
    }
    lines.push_back(line);
    last = row.label;
  }
  return lines;
}

/// Labels and sources to the left, figures to the right.
void append_aligned(const Lines& lines, std::string& text) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
  }
  for (const auto& line : lines) {
    std::string out = " ";
    for (std::size_t k = 0; k < line.size(); ++k) {
      out += k < 2 ? fmt::format(" {:<{}}", line[k], widths[k]) : fmt::format("  {:>{}}", line[k], widths[k]);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    text += out + "\n";
  }
}

/// `note` in lines of kLineWidth characters, broken at spaces.
void append_wrapped(const std::string& note, std::string& text) {
  std::string line = "  *";
  for (std::size_t begin = 0; begin < note.size();) {
    const std::size_t end = std::min(note.find(' ', begin), note.size());
    if (line.size() + 1 + (end - begin) > kLineWidth) {
      text += line + "\n";
      line = "   ";
    }
    line.append(" ").append(note, begin, end - begin);
    begin = end + 1;
  }
  text += line + "\n";
}

}  // namespace

std::string table_text(const ReportTable& table) {
  std::string text = table.label.empty() ? table.title + "\n" : fmt::format("{}  {}\n", table.label, table.title);
  append_aligned(cells_of(table), text);
  for (const std::string& note : table.notes) append_wrapped(note, text);
  return text;
}

}  // namespace bladefit
