#include "tools/results/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tools/batch/fit_options.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kQuotedCharacters = 40;
constexpr const char* kMend = "the file is damaged or foreign; run the session again with the same --session";

/// A value of the file together with the way to it, so that an error can name it.
class Field {
 public:
  Field(const Json& value, const std::string& file, std::string name)
      : value_(value), file_(file), name_(std::move(name)) {}

  [[nodiscard]] Field operator[](const char* key) const {
    const std::string inner = name_.empty() ? key : name_ + "." + key;
    if (!value_.is_object() || !value_.contains(key)) fail(inner, "is missing");
    return {value_.at(key), file_, inner};
  }

  [[nodiscard]] Field element(std::size_t index) const {
    return {value_.at(index), file_, fmt::format("{}[{}]", name_, index)};
  }

  /// The number of elements of a list.
  [[nodiscard]] std::size_t size() const {
    if (!value_.is_array()) fail(name_, "is not a list");
    return value_.size();
  }

  void need_size(std::size_t wanted) const {
    if (size() != wanted) fail(name_, fmt::format("has {} elements where {} belong", size(), wanted));
  }

  [[nodiscard]] bool has(const char* key) const { return value_.is_object() && value_.contains(key); }

  [[nodiscard]] bool is_null() const { return value_.is_null(); }

  [[nodiscard]] double number() const {
    if (!value_.is_number()) fail(name_, "is not a number");
    return value_.get<double>();
  }

  [[nodiscard]] std::uint32_t whole() const {
    constexpr std::uint64_t largest = std::numeric_limits<std::uint32_t>::max();
    if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > largest) fail(name_, "is not a whole number");
    return value_.get<std::uint32_t>();
  }

  [[nodiscard]] std::string text() const {
    if (!value_.is_string()) fail(name_, "is not a text");
    return value_.get<std::string>();
  }

  [[noreturn]] void refuse(const std::string& what) const { fail(name_, what); }

 private:
  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw ToolError(fmt::format("{}: field {} {}; {}", file_, name.empty() ? "(whole file)" : name, what, kMend));
  }

  const Json& value_;
  const std::string& file_;
  std::string name_;
};

Json parse(const std::string& path, const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text.size());
    const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw ToolError(fmt::format("{}:{}: is no JSON text; {}", path, lines + 1, kMend));
  }
}

double unit_of(const Field& units) {
  const std::string name = units.text();
  if (name == "mm") return 1.0;
  if (name == "in") return kMmPerInch;
  units.refuse(fmt::format("is '{}' where mm or in belongs", name.substr(0, kQuotedCharacters)));
}

void read_pose(const Field& pose, ReportedFit& fit) {
  const Field rotation = pose["rotation"], translation = pose["translation"], euler = pose["euler"];
  rotation.need_size(3);
  translation.need_size(3);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    rotation.element(row).need_size(3);
    for (std::size_t column = 0; column < 3; ++column)
      fit.pose.rotation(r, static_cast<Eigen::Index>(column)) = rotation.element(row).element(column).number();
    fit.pose.translation[r] = translation.element(row).number();
  }
  fit.euler = {euler["psi"].number(), euler["theta"].number(), euler["phi"].number()};
}

std::optional<std::array<double, 6>> read_standard_uncertainty(const Field& covariance) {
  if (covariance.is_null()) return std::nullopt;
  std::array<double, 6> standard{};
  covariance.need_size(standard.size());
  for (std::size_t row = 0; row < standard.size(); ++row) {
    covariance.element(row).need_size(standard.size());
    const double variance = covariance.element(row).element(row).number();
    if (variance < 0) covariance.element(row).element(row).refuse("is a negative variance");
    standard[row] = std::sqrt(variance);
  }
  return standard;
}

ReportRegion read_region(const Field& region) {
  const Field tolerance = region["tolerance"];
  return {.count = region["count"].whole(),
          .rms_before = region["rms_before"].number(),
          .rms_after = region["rms_after"].number(),
          .max_abs_after = region["max_abs_after"].number(),
          .tolerance = tolerance.is_null() ? std::numeric_limits<double>::infinity() : tolerance.number()};
}

/// Limits of a box, each within 0 to 1.
std::array<double, 2> read_limits(const Field& limits) {
  limits.need_size(2);
  const std::array<double, 2> values = {limits.element(0).number(), limits.element(1).number()};
  if (!(0.0 <= values[0] && values[0] <= values[1] && values[1] <= 1.0)) limits.refuse("is no interval within 0 to 1");
  return values;
}

std::vector<ParameterBox> read_boxes(const Field& leading_edge) {
  std::vector<ParameterBox> boxes;
  if (!leading_edge.has("boxes")) return boxes;
  const Field list = leading_edge["boxes"];
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto u = read_limits(list.element(k)["u"]), v = read_limits(list.element(k)["v"]);
    boxes.push_back({list.element(k)["patch"].whole(), u[0], u[1], v[0], v[1]});
  }
  return boxes;
}

void read_summary(const Field& summary, ReportedFit& fit) {
  fit.count = summary["count"].whole();
  fit.rms_before = summary["rms_before"].number();
  fit.rms_after = summary["rms_after"].number();
  fit.max_abs_before = summary["max_abs_before"].number();
  fit.max_abs_after = summary["max_abs_after"].number();
}

ResultPoint read_point(const Field& point) {
  const Field state = point["state"];
  const std::optional<PointState> value = value_of<PointState>(kStateWords, state.text());
  if (!value) state.refuse("is no state of a point");
  return {point["index"].whole(), *value};
}

}  // namespace

ResultContent parse_result(const std::string& path, const std::string& text) {
  const Json json = parse(path, text);
  const Field root(json, path, "");
  ResultContent content;
  ReportedFit& fit = content.fit;
  fit.status = root["status"].text();
  fit.mode = root["mode"].text();
  fit.mm_per_unit = unit_of(root["units"]);
  fit.units = root["units"].text();
  read_pose(root["pose"], fit);
  fit.standard_uncertainty = read_standard_uncertainty(root["covariance"]);
  read_summary(root["summary"], fit);
  fit.leading_edge = read_region(root["regions"]["leading_edge"]);
  fit.boxes = read_boxes(root["regions"]["leading_edge"]);
  fit.rest = read_region(root["regions"]["rest"]);
  const Field points = root["points"];
  content.points.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) content.points.push_back(read_point(points.element(k)));
  return content;
}

}  // namespace bladefit
