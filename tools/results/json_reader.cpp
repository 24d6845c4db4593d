#include "tools/results/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "config/zone_settings.hpp"
#include "drivers/text/units.hpp"
#include "tools/results/json_field.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

double unit_of(const JsonField& units) {
  const std::string name = units.text();
  const auto* const found = std::ranges::find(kUnitWords, name);
  if (found == kUnitWords.end()) {
    units.refuse(
        fmt::format("is '{}' where {} belongs", name.substr(0, kQuotedCharacters), fmt::join(kUnitWords, ", ")));
  }
  return mm_per_unit(static_cast<Unit>(found - kUnitWords.begin()));
}

/// The number that is written as `value` when it is divided by `divisor`. The product alone is often that number's
/// neighbour, and its quotient another one than was read.
double times(double value, double divisor) {
  const double product = value * divisor, infinity = std::numeric_limits<double>::infinity();
  for (const double near : {product, std::nextafter(product, -infinity), std::nextafter(product, infinity)}) {
    if (near / divisor == value) return near;
  }
  return product;
}

double length_of(const JsonField& field, double mm_per_unit) { return times(field.number(), mm_per_unit); }

void read_pose(const JsonField& json, Result& result) {
  const JsonField rotation = json["rotation"], translation = json["translation"], euler = json["euler"];
  rotation.need_size(3);
  translation.need_size(3);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    rotation.element(row).need_size(3);
    for (std::size_t column = 0; column < 3; ++column)
      result.pose.rotation(r, static_cast<Eigen::Index>(column)) = rotation.element(row).element(column).number();
    result.pose.translation[r] = length_of(translation.element(row), result.mm_per_unit);
  }
  // They follow from the rotation; a file without them is damaged.
  for (const char* angle : {"psi", "theta", "phi"}) static_cast<void>(euler[angle].number());
}

std::optional<Mat6> read_covariance(const JsonField& json, double mm_per_unit) {
  if (json.is_null()) return std::nullopt;
  Mat6 covariance;
  json.need_size(6);
  for (std::size_t row = 0; row < 6; ++row) {
    const JsonField cells = json.element(row);
    cells.need_size(6);
    for (std::size_t column = 0; column < 6; ++column) {
      const double divisor = (row < 3 ? 1.0 : mm_per_unit) * (column < 3 ? 1.0 : mm_per_unit);
      covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          times(cells.element(column).number(), divisor);
    }
    if (cells.element(row).number() < 0) cells.element(row).refuse("is a negative variance");
  }
  return covariance;
}

void read_sums(const JsonField& json, double mm_per_unit, FitDistances& sums) {
  sums.count = json["count"].whole();
  sums.rms_before = length_of(json["rms_before"], mm_per_unit);
  sums.rms_after = length_of(json["rms_after"], mm_per_unit);
  sums.max_after = length_of(json["max_abs_after"], mm_per_unit);
}

void read_region(const JsonField& json, double mm_per_unit, RegionDistances& sums) {
  read_sums(json, mm_per_unit, sums);
  const JsonField tolerance = json["tolerance"];
  if (!tolerance.is_null()) sums.tolerance = length_of(tolerance, mm_per_unit);
}

/// Limits of a box, each within 0 to 1.
std::array<double, 2> read_limits(const JsonField& limits) {
  limits.need_size(2);
  const std::array<double, 2> values = {limits.element(0).number(), limits.element(1).number()};
  if (!(0.0 <= values[0] && values[0] <= values[1] && values[1] <= 1.0))
    limits.refuse("is not an interval within 0 to 1");
  return values;
}

std::vector<ParameterBox> read_boxes(const JsonField& leading_edge) {
  std::vector<ParameterBox> boxes;
  if (!leading_edge.has("boxes")) return boxes;
  const JsonField list = leading_edge["boxes"];
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto u = read_limits(list.element(k)["u"]), v = read_limits(list.element(k)["v"]);
    boxes.push_back({list.element(k)["patch"].whole(), u[0], u[1], v[0], v[1]});
  }
  return boxes;
}

double limit_of(const JsonField& field, double mm_per_unit) {
  return field.is_null() ? std::numeric_limits<double>::infinity() : length_of(field, mm_per_unit);
}

/// A member that is one of `words`.
template <typename Value, std::size_t count>
Value read_word(const JsonField& field, const std::array<std::string_view, count>& words) {
  const std::optional<Value> value = value_of<Value>(words, field.text());
  if (!value) field.refuse("is none of the words that belong here");
  return *value;
}

/// The last one stands for what lies outside of all.
void read_zones(const JsonField& list, Result& result) {
  if (list.size() < 2 || list.size() > ToleranceMap::kMaxZones + 1) list.refuse("is not a list of zones");
  for (std::size_t k = 0; k < list.size(); ++k) {
    const JsonField zone = list.element(k);
    result.zones.push_back({zone["name"].text(), zone["where"].text(), read_word<Region>(zone["region"], kRegionWords),
                            limit_of(zone[kPlusKey], result.mm_per_unit),
                            limit_of(zone[kMinusKey], result.mm_per_unit)});
  }
  result.rest_outside = result.zones.back().plus;
  result.zones.pop_back();
}

ResultVerdict read_verdict(const JsonField& json) {
  ResultVerdict verdict;
  verdict.state = read_word<BladeState>(json["state"], kBladeStateWords);
  verdict.decision = read_word<DecisionRule>(json["decision"], kDecisionRuleWords);
  verdict.coverage_factor = json["coverage_factor"].number();
  const JsonField reasons = json["reasons"], lost = json["lost"];
  for (std::size_t k = 0; k < reasons.size(); ++k) {
    const JsonField reason = reasons.element(k);
    verdict.reasons.push_back({read_word<Reason>(reason["code"], kReasonWords), reason["text"].text()});
  }
  for (std::size_t k = 0; k < lost.size(); ++k) {
    lost.element(k).need_size(2);
    verdict.lost.push_back({lost.element(k).element(0).whole(), lost.element(k).element(1).whole()});
  }
  return verdict;
}

Certificate read_certificate(const JsonField& json) {
  Certificate certificate;
  const JsonField points = json["points"], multipliers = json["multipliers"], signs = json["signs"];
  if (points.size() > certificate.sequence.size()) points.refuse("has more elements than a certificate");
  certificate.count = static_cast<std::uint32_t>(points.size());
  multipliers.need_size(points.size());
  signs.need_size(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    certificate.sequence.at(k) = points.element(k).whole() + 1;
    certificate.multiplier.at(k) = multipliers.element(k).number();
    certificate.sign.at(k) = signs.element(k).number() < 0 ? -1 : 1;
  }
  return certificate;
}

Outliers read_outliers(const JsonField& json, double mm_per_unit) {
  Outliers outliers;
  outliers.limit = json["limit"].number();
  outliers.scale = length_of(json["scale"], mm_per_unit);
  const JsonField points = json["points"];
  for (std::size_t k = 0; k < points.size(); ++k) {
    const JsonField point = points.element(k);
    outliers.points.push_back(
        {point["index"].whole() + 1, length_of(point["distance"], mm_per_unit), point["studentized"].number()});
  }
  return outliers;
}

ShaftAxis read_axis(const JsonField& json, double mm_per_unit) {
  ShaftAxis axis;
  const JsonField point = json["point"], direction = json["direction"];
  point.need_size(3);
  direction.need_size(3);
  for (std::size_t k = 0; k < 3; ++k) {
    axis.point[static_cast<Eigen::Index>(k)] = length_of(point.element(k), mm_per_unit);
    axis.direction[static_cast<Eigen::Index>(k)] = direction.element(k).number();
  }
  return axis;
}

/// What only some modes have, and what the files of earlier versions lack.
void read_optional(const JsonField& root, Result& result) {
  if (root.has("zones")) read_zones(root["zones"], result);
  if (root.has("tolerance_factor")) result.tolerance_factor = length_of(root["tolerance_factor"], result.mm_per_unit);
  if (root.has("certificate")) result.certificate = read_certificate(root["certificate"]);
  if (root.has("further_starts")) {
    result.further_starts = root["further_starts"]["count"].whole();
    result.same_optimum = root["further_starts"]["same"].whole();
  }
  if (root.has("axis")) result.axis = read_axis(root["axis"], result.mm_per_unit);
  if (root.has("tip_radius")) result.tip_radius = length_of(root["tip_radius"], result.mm_per_unit);
  if (root.has("locked")) {
    const JsonField locked = root["locked"];
    for (std::size_t k = 0; k < locked.size(); ++k) result.locked.push_back(locked.element(k).text());
  }
  if (root.has("loss")) {
    const JsonField loss = root["loss"];
    result.loss = LossUsed{loss["name"].text(), length_of(loss["scale"], result.mm_per_unit)};
  }
  if (root.has("robust")) {
    const JsonField points = root["robust"]["judged_otherwise"];
    for (std::size_t k = 0; k < points.size(); ++k) result.judged_otherwise.push_back(points.element(k).whole() + 1);
  }
  if (root.has("notes")) {
    const JsonField notes = root["notes"];
    for (std::size_t k = 0; k < notes.size(); ++k) result.notes.push_back(notes.element(k).text());
  }
  if (root.has("aberrant")) result.outliers = read_outliers(root["aberrant"], result.mm_per_unit);
}

ResultPoint read_point(const JsonField& json) {
  ResultPoint point;
  point.sequence = json["index"].whole() + 1;
  point.state = read_word<PointState>(json["state"], kStateWords);
  return point;
}

}  // namespace

Result parse_result(const std::string& path, const std::string& text) {
  const nlohmann::json json = parse_json(path, text);
  const JsonField root(json, path, "");
  Result result;
  result.text = text;
  result.verdict = read_verdict(root["verdict"]);
  result.status = root["status"].text();
  result.mode = root["mode"].text();
  result.mm_per_unit = unit_of(root["units"]);
  result.units = root["units"].text();
  read_pose(root["pose"], result);
  result.covariance = read_covariance(root["covariance"], result.mm_per_unit);
  read_sums(root["summary"], result.mm_per_unit, result.all);
  result.all.max_before = length_of(root["summary"]["max_abs_before"], result.mm_per_unit);
  const JsonField leading_edge = root["regions"][word_of(Region::leading_edge).data()];
  read_region(leading_edge, result.mm_per_unit, result.leading_edge);
  result.boxes = read_boxes(leading_edge);
  read_region(root["regions"][word_of(Region::rest).data()], result.mm_per_unit, result.rest);
  read_optional(root, result);
  const JsonField points = root["points"];
  for (std::size_t k = 0; k < points.size(); ++k) result.points.push_back(read_point(points.element(k)));
  return result;
}

}  // namespace bladefit
