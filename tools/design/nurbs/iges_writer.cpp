#include "tools/design/nurbs/iges_writer.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/design/nurbs/length_unit.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kRecordColumns = 72, kParameterColumns = 64;
constexpr int kLargestRecordNumber = 9999999;
constexpr std::size_t kLongestFileName = 60;

/// The records of one section, numbered from 1.
class WrittenSection {
 public:
  explicit WrittenSection(char letter) : letter_(letter) {}

  void append(const std::string& text) { text_ += fmt::format("{:<72}{}{:>7}\n", text, letter_, ++count_); }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  char letter_;
  int count_ = 0;
  std::string text_;
};

/// Fields with commas between them and a semicolon at the end, packed into records; no field is broken over two.
std::vector<std::string> packed(const std::vector<std::string>& fields, std::size_t columns) {
  std::vector<std::string> records(1);
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const std::string field = fields[k] + (k + 1 < fields.size() ? "," : ";");
    if (records.back().size() + field.size() > columns) records.emplace_back();
    records.back() += field;
  }
  return records;
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    fields.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return fields;
}

/// A string as IGES writes it: its length, H, its characters. It is ASCII and fits into one record.
std::string hollerith(std::string text) {
  if (text.size() > kLongestFileName) text.erase(0, text.size() - kLongestFileName);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < 0x20 || c > 0x7E; }, '_');
  return fmt::format("{}H{}", text.size(), text);
}

/// The 26 fields of the global section (IGES 5.3, section 2.2.4.3); what a reader must know stands in `header`.
std::vector<std::string> global_fields(const IgesOutputHeader& header) {
  std::vector<std::string> fields{"1H,", "1H;", hollerith("blade"), hollerith(header.file_name), hollerith("bladefit")};
  fields.push_back(hollerith("1.0"));
  for (const char* digits : {"32", "38", "6", "308", "15"}) fields.emplace_back(digits);
  fields.insert(fields.end(), {hollerith("blade"), header.scale, header.units, "1", "0.01", hollerith(header.date)});
  fields.insert(fields.end(), {header.resolution, iges_real(header.largest_coordinate), hollerith("bladefit")});
  fields.insert(fields.end(), {hollerith("bladefit"), "11", "0", hollerith(header.date)});
  return fields;
}

/// The two directory records of an entity whose parameters are the records `first` .. `last`.
void append_entry(const IgesOutputEntity& entity, int first, int last, WrittenSection& directory) {
  directory.append(fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", entity.type, first, 0, 1, entity.level,
                               0, entity.matrix, 0, entity.status));
  directory.append(fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>24}{:>8}", entity.type, 0, 0, last - first + 1, entity.form,
                               entity.label, 0));
}

/// True where the surface begins and ends in control points that it passes through.
bool clamped(const SurfaceDirection& direction) {
  const auto degree = static_cast<std::size_t>(direction.degree);
  if (direction.knots.size() < 2 * degree + 2) return false;
  const std::size_t last = direction.knots.size() - 1;
  return direction.knots[0] == direction.knots[degree] && direction.knots[last - degree] == direction.knots[last] &&
         direction.start == direction.knots[0] && direction.end == direction.knots[last];
}

/// Property 1 or 2 of entity 128: the first and the last curve of control points are the same.
bool closed(const NurbsSurface& surface, bool along_u) {
  const auto count_u = static_cast<std::size_t>(surface.u.control_points);
  const auto count_v = static_cast<std::size_t>(surface.v.control_points);
  const std::size_t stride = along_u ? 1 : count_v;
  const std::size_t last = along_u ? (count_u - 1) * count_v : count_v - 1;
  for (std::size_t k = 0; k < (along_u ? count_v : count_u); ++k) {
    const std::size_t here = k * stride;
    if (surface.control_points[here] != surface.control_points[here + last]) return false;
    if (surface.weights[here] != surface.weights[here + last]) return false;
  }
  return clamped(along_u ? surface.u : surface.v);
}

/// The length that read_iges turns back into `mm`, bit for bit where there is one.
double in_unit(double mm, double mm_per_unit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nearest = mm / mm_per_unit;
  for (const double candidate : {nearest, std::nextafter(nearest, -kInfinity), std::nextafter(nearest, kInfinity)}) {
    if (candidate * mm_per_unit == mm) return candidate;
  }
  return nearest;
}

}  // namespace

std::string iges_real(double value) {
  std::string text = fmt::format("{}", value);
  if (std::ranges::count(text, '.') == 0) text.insert(std::ranges::find(text, 'e'), '.');
  std::replace(text.begin(), text.end(), 'e', 'D');
  return text;
}

std::string iges_surface_parameters(const NurbsSurface& surface) {
  const bool polynomial = std::all_of(surface.weights.begin(), surface.weights.end(),
                                      [&](double weight) { return weight == surface.weights.front(); });
  std::string text =
      fmt::format("128,{},{},{},{},{:d},{:d},{:d},0,0", surface.u.control_points - 1, surface.v.control_points - 1,
                  surface.u.degree, surface.v.degree, closed(surface, true), closed(surface, false), polynomial);
  const auto append = [&](double value) {
    text += ',';
    text += iges_real(value);
  };
  for (const double knot : surface.u.knots) append(knot);
  for (const double knot : surface.v.knots) append(knot);
  iges_order(surface, [&](std::size_t k) { append(surface.weights[k]); });
  iges_order(surface, [&](std::size_t k) {
    for (const double coordinate : surface.control_points[k]) append(coordinate);
  });
  for (const double end : {surface.u.start, surface.u.end, surface.v.start, surface.v.end}) append(end);
  return text;
}

std::string iges_file_text(const IgesOutputHeader& header, const std::vector<IgesOutputEntity>& entities) {
  WrittenSection start('S');
  WrittenSection global('G');
  WrittenSection directory('D');
  WrittenSection parameters('P');
  start.append(header.title);
  for (const std::string& record : packed(global_fields(header), kRecordColumns)) global.append(record);
  for (const IgesOutputEntity& entity : entities) {
    const int first = parameters.count() + 1;
    for (const std::string& record : packed(split_at_commas(entity.parameters), kParameterColumns)) {
      parameters.append(fmt::format("{:<64}{:>8}", record, directory.count() + 1));
    }
    append_entry(entity, first, parameters.count(), directory);
  }
  if (parameters.count() > kLargestRecordNumber || directory.count() > kLargestRecordNumber) {
    throw ToolError(fmt::format("{}: the design has too many control points for one IGES file; cut it into several",
                                header.file_name));
  }
  WrittenSection terminate('T');
  terminate.append(
      fmt::format("S{:>7}G{:>7}D{:>7}P{:>7}", start.count(), global.count(), directory.count(), parameters.count()));
  return start.text() + global.text() + directory.text() + parameters.text() + terminate.text();
}

std::string iges_design_text(std::vector<NurbsSurface> surfaces, DesignUnit unit, const std::string& file_name,
                             std::chrono::system_clock::time_point written) {
  IgesOutputHeader header;
  header.file_name = file_name;
  header.units = unit == DesignUnit::inch ? "1,2HIN" : "2,2HMM";
  header.date = fmt::format("{:%Y%m%d.%H%M%S}", fmt::gmtime(std::chrono::system_clock::to_time_t(written)));
  std::vector<IgesOutputEntity> entities;
  for (NurbsSurface& surface : surfaces) {
    for (Eigen::Vector3d& point : surface.control_points) {
      for (double& coordinate : point) coordinate = in_unit(coordinate, mm_per_unit(unit));
      header.largest_coordinate = std::max(header.largest_coordinate, point.cwiseAbs().maxCoeff());
    }
    entities.push_back(
        {kIgesSurfaceType, iges_surface_parameters(surface), 0, fmt::format("PATCH{}", entities.size() + 1)});
  }
  return iges_file_text(header, entities);
}

void write_iges_design(const std::filesystem::path& path, const std::vector<NurbsSurface>& surfaces, DesignUnit unit) {
  const std::string extension = lower_extension(path);
  if (extension != ".igs" && extension != ".iges") {
    throw ToolError(fmt::format("{}: the design is written as IGES; give a name that ends in .igs", path.string()));
  }
  const auto now = std::chrono::system_clock::now();
  OutputFile(path, iges_design_text(surfaces, unit, path.filename().string(), now)).commit();
}

}  // namespace bladefit
