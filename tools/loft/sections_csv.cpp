#include "tools/loft/sections_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

#include "drivers/csv_text.hpp"
#include "drivers/text_number.hpp"
#include "tools/design/design_file.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 6> kColumns = {"section", "x", "y", "z", "index", "r_over_R"};
enum Column : std::size_t { section_column, x_column, y_column, z_column, index_column, radius_column };
constexpr std::size_t kNeeded = 4;
constexpr std::string_view kHeaderMend = "the first line must name the columns: section,x,y,z[,index][,r_over_R]";

[[noreturn]] void fail(const CsvPlace& place, std::string_view what) { throw DesignError(place.say(what)); }

/// Column of the file -> index in kColumns.
using Header = std::vector<std::size_t>;

Header parse_header(const CsvPlace& place, std::string_view line) {
  Header header;
  std::array<bool, kColumns.size()> seen{};
  for (const std::string_view cell : cells_of(line)) {
    std::size_t column = 0;
    while (column < kColumns.size() && kColumns[column] != cell) ++column;
    if (column == kColumns.size()) throw DesignError(unknown_column(place, cell, line, kHeaderMend));
    if (seen[column]) fail(place, fmt::format("column {} is named twice; {}", quoted(cell), kHeaderMend));
    seen[column] = true;
    header.push_back(column);
  }
  for (std::size_t column = 0; column < kNeeded; ++column) {
    if (!seen[column]) fail(place, fmt::format("column '{}' is missing; {}", kColumns[column], kHeaderMend));
  }
  return header;
}

/// One row of the file.
struct Row {
  std::string_view section;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::optional<double> index, radius;
};

Row parse_row(const CsvPlace& place, std::string_view line, const Header& header) {
  const std::vector<std::string_view> cells = cells_of(line);
  if (cells.size() != header.size()) {
    fail(place, fmt::format("{} columns where the first line names {}", cells.size(), header.size()));
  }
  Row row;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::size_t column = header[k];
    if (column == section_column) {
      row.section = cells[k];
      continue;
    }
    const std::optional<double> value = parse_finite(cells[k]);
    if (!value) {
      fail(place, fmt::format("column {}: {} is not a finite number; write it like -12.345", kColumns[column],
                              quoted(cells[k])));
    }
    if (column == index_column) row.index = value;
    if (column == radius_column) row.radius = value;
    if (column >= x_column && column <= z_column) row.point[static_cast<Eigen::Index>(column - x_column)] = *value;
  }
  if (row.section.empty()) fail(place, "column section: it is empty; give each section a name or a number");
  return row;
}

/// Collects rows into sections.
class SectionCollector {
 public:
  explicit SectionCollector(BladeSections& target) : target_(target) {}

  void take(const CsvPlace& place, const Row& row) {
    if (target_.sections.empty() || target_.sections.back().name != row.section) begin_section(place, row);
    BladeSection& section = target_.sections.back();
    if (row.radius != section.radius) {
      fail(place, fmt::format("column r_over_R: {} in section {}, which began with {}; give one radius a section",
                              *row.radius, section.name, *section.radius));
    }
    if (index_ && row.index && *row.index <= *index_) {
      fail(place, fmt::format("column index: {} after {} in section {}; write the points in their order on the section",
                              *row.index, *index_, section.name));
    }
    index_ = row.index;
    section.points.push_back(row.point);
    section.lines.push_back(place.line);
  }

 private:
  void begin_section(const CsvPlace& place, const Row& row) {
    const std::string name(row.section);
    if (!names_.insert(name).second) {
      fail(place, fmt::format("section {} goes on here after another one; write the rows of a section together", name));
    }
    target_.sections.push_back({name, row.radius, {}, {}});
    index_.reset();
  }

  BladeSections& target_;
  std::set<std::string> names_;
  std::optional<double> index_;
};

}  // namespace

BladeSections parse_sections_csv(std::string_view text, const std::string& name) {
  skip_byte_order_mark(text);
  if (const std::size_t line = binary_line(text); line != 0) {
    fail({name, line}, "a control character: this is no CSV text file; give a file with the columns section,x,y,z");
  }
  BladeSections result;
  result.file = name;
  SectionCollector collector(result);
  Header header;
  for (CsvPlace place{name, 1}; !text.empty(); ++place.line) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#') continue;
    if (header.empty()) {
      header = parse_header(place, line);
    } else {
      collector.take(place, parse_row(place, line, header));
    }
  }
  if (header.empty()) throw DesignError(fmt::format("{}: the file is empty; {}", name, kHeaderMend));
  if (result.sections.empty()) {
    throw DesignError(fmt::format("{}: there is no point in the file; add a line for each point", name));
  }
  return result;
}

BladeSections read_sections_csv(const std::string& path) { return parse_sections_csv(read_text(path), path); }

}  // namespace bladefit
