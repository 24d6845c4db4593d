#include "tools/design/loft/sections_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

#include "drivers/text/csv_table.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 6> kColumns = {"section", "x", "y", "z", "index", "r_over_R"};
enum Column : std::size_t { section_column, x_column, y_column, z_column, index_column, radius_column };
constexpr std::size_t kNeeded = 4;
constexpr std::string_view kHeaderMend = "the first line must name the columns: section,x,y,z[,index][,r_over_R]";

constexpr CsvFormat kFormat{
    .columns = kColumns, .needed = kNeeded, .together = 0, .first_length = x_column, .lengths = 3, .fix = kHeaderMend};

[[noreturn]] void fail(const CsvPlace& place, std::string_view what) { throw ToolError(place.say(what)); }

/// One row of the file.
struct Row {
  std::string_view section;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::optional<double> index, radius;
};

Row parse_row(const CsvRow& cells) {
  Row row;
  row.section = cells.values[section_column];
  for (std::size_t column = x_column; column < kColumns.size(); ++column) {
    if (!cells.header->has[column]) continue;
    double value = 0;
    if (const Failure failure = finite_cell(cells, column, kFormat, value)) throw ToolError(failure);
    if (column == index_column) row.index = value;
    if (column == radius_column) row.radius = value;
    if (column >= x_column && column <= z_column) row.point[static_cast<Eigen::Index>(column - x_column)] = value;
  }
  if (row.section.empty()) fail(cells.place, "column section: it is empty; give each section a name or a number");
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
  BladeSections result;
  result.file = name;
  SectionCollector collector(result);
  CsvHeader header;
  const Failure failure = read_csv_table(text, name, kFormat, {}, header, [&](const CsvRow& row) {
    collector.take(row.place, parse_row(row));
    return Failure();
  });
  if (failure) throw ToolError(failure);
  result.unit = header.unit;
  result.note = header.unused_note();
  if (result.sections.empty()) {
    throw ToolError(fmt::format("{}: there is no point in the file; add a line for each point", name));
  }
  return result;
}

BladeSections read_sections_csv(const std::string& path) {
  return parse_sections_csv(read_text(path, "sections"), path);
}

}  // namespace bladefit
