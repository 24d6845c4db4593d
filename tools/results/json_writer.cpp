#include "tools/results/json_writer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "config/zone_settings.hpp"
#include "tools/results/words.hpp"
#include "tools/results/zone_counts.hpp"

namespace bladefit {
namespace {

using Json = nlohmann::ordered_json;

/// The key of a region's figures, and the word of it in a point.
std::string key_of(Region region) { return std::string(word_of(region)); }

Json length_or_null(double mm, double mm_per_unit) {
  return std::isfinite(mm) ? Json(mm / mm_per_unit) : Json(nullptr);
}

Json pose_json(const Pose& pose, double mm_per_unit) {
  Json rotation = Json::array(), translation = Json::array();
  for (int i = 0; i < 3; ++i) {
    rotation.push_back({pose.rotation(i, 0), pose.rotation(i, 1), pose.rotation(i, 2)});
    translation.push_back(pose.translation[i] / mm_per_unit);
  }
  const EulerAngles e = euler_angles(pose.rotation);
  return {{"rotation", rotation},
          {"translation", translation},
          {"euler", {{"psi", e.psi}, {"theta", e.theta}, {"phi", e.phi}}}};
}

/// sigma^2 (J'J)^-1 is that of the least-squares pose alone.
Json covariance_json(const std::optional<Mat6>& covariance, double mm_per_unit) {
  if (!covariance) return nullptr;
  Json rows = Json::array();
  for (int i = 0; i < 6; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 6; ++j)
      row.push_back((*covariance)(i, j) / ((i < 3 ? 1.0 : mm_per_unit) * (j < 3 ? 1.0 : mm_per_unit)));
    rows.push_back(row);
  }
  return rows;
}

Json region_json(const RegionDistances& sums, double mm_per_unit) {
  return {{"count", sums.count},
          {"rms_before", sums.rms_before / mm_per_unit},
          {"rms_after", sums.rms_after / mm_per_unit},
          {"max_abs_after", sums.max_after / mm_per_unit},
          {"tolerance", length_or_null(sums.tolerance, mm_per_unit)}};
}

Json boxes_json(const std::vector<ParameterBox>& boxes) {
  Json list = Json::array();
  for (const ParameterBox& box : boxes)
    list.push_back({{"patch", box.patch}, {"u", {box.u_min, box.u_max}}, {"v", {box.v_min, box.v_max}}});
  return list;
}

/// Each zone, and last what lies outside of all, with what its points came to.
Json zones_json(const Result& result) {
  Json list = Json::array();
  const std::vector<ResultZone> zones = zones_and_rest(result);
  const std::vector<ZoneCounts> counts = zone_counts(result);
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const ZoneCounts& points = counts[k];
    list.push_back({{"name", zones[k].name},
                    {"where", zones[k].where},
                    {"region", word_of(zones[k].region)},
                    {kPlusKey, length_or_null(zones[k].plus, result.mm_per_unit)},
                    {kMinusKey, length_or_null(zones[k].minus, result.mm_per_unit)},
                    {"count", points.points},
                    {word_of(PointState::in), points.in},
                    {word_of(Action::cut), points.cut},
                    {word_of(Action::weld), points.weld},
                    {"beyond", points.beyond},
                    {"open", points.open}});
  }
  return list;
}

Json certificate_json(const Certificate& certificate) {
  if (certificate.count == 0) return nullptr;
  Json points = Json::array(), multipliers = Json::array(), signs = Json::array();
  for (std::uint32_t k = 0; k < certificate.count; ++k) {
    points.push_back(certificate.sequence.at(k) - 1);
    multipliers.push_back(certificate.multiplier.at(k));
    signs.push_back(certificate.sign.at(k));
  }
  return {{"points", points}, {"multipliers", multipliers}, {"signs", signs}};
}

Json axis_json(const ShaftAxis& axis, double mm_per_unit) {
  Json point = Json::array(), direction = Json::array();
  for (int k = 0; k < 3; ++k) {
    point.push_back(axis.point[k] / mm_per_unit);
    direction.push_back(axis.direction[k]);
  }
  return {{"point", point}, {"direction", direction}};
}

Json outliers_json(const Outliers& outliers, double mm_per_unit) {
  if (!(outliers.limit > 0.0)) return nullptr;
  Json points = Json::array();
  for (const Outlier& p : outliers.points) {
    points.push_back(
        {{"index", p.sequence - 1}, {"distance", p.distance / mm_per_unit}, {"studentized", p.studentized}});
  }
  return {{"limit", outliers.limit}, {"scale", outliers.scale / mm_per_unit}, {"points", points}};
}

Json robust_json(const std::vector<std::uint32_t>& judged_otherwise) {
  Json points = Json::array();
  for (const std::uint32_t sequence : judged_otherwise) points.push_back(sequence - 1);
  return {{"judged_otherwise", points}};
}

Json loss_json(const std::optional<LossUsed>& loss, double mm_per_unit) {
  if (!loss) return nullptr;
  return {{"name", loss->name}, {"scale", loss->scale / mm_per_unit}};
}

Json verdict_json(const ResultVerdict& verdict) {
  Json reasons = Json::array(), lost = Json::array();
  for (const VerdictReason& reason : verdict.reasons)
    reasons.push_back({{"code", word_of(reason.code)}, {"text", reason.text}});
  for (const SequenceRange& range : verdict.lost) lost.push_back({range.first, range.last});
  return {{"state", word_of(verdict.state)},
          {"reasons", reasons},
          {"lost", lost},
          {"decision", word_of(verdict.decision)},
          {"coverage_factor", verdict.coverage_factor}};
}

Json point_json(const ResultPoint& point, double mm_per_unit) {
  return {{"index", point.sequence - 1},
          {"patch", point.patch},
          {"u", point.u},
          {"v", point.v},
          {"kind", word_of(point.kind)},
          {"region", word_of(point.region)},
          {"distance", length_or_null(point.distance, mm_per_unit)},
          {"distance_before", length_or_null(point.before, mm_per_unit)},
          {"tolerance", length_or_null(point.tolerance, mm_per_unit)},
          {"uncertainty", point.uncertainty / mm_per_unit},
          {"expanded_uncertainty", point.expanded / mm_per_unit},
          {"state", word_of(point.state)},
          {"action", word_of(point.action)},
          {"left_out", word_of(point.left_out)},
          {"beyond", point.beyond / mm_per_unit}};
}

/// A value as it stands `depth` levels below the top.
std::string indented(const Json& json, std::size_t depth) {
  const std::string text = json.dump(1);
  std::string out;
  for (const char character : text) {
    out += character;
    if (character == '\n') out.append(depth, ' ');
  }
  return out;
}

/// The list that ends the object, in the layout of dump(1).
void write_points(const Result& result, const Put& put) {
  put(",\n \"points\": [");
  const char* between = "\n  ";
  for (const ResultPoint& point : result.points) {
    put(between);
    Json json = point_json(point, result.mm_per_unit);
    if (!result.zones.empty()) json["zone"] = zone_name(result, point.zone);
    put(indented(json, 2));
    between = ",\n  ";
  }
  put(result.points.empty() ? "]\n}\n" : "\n ]\n}\n");
}

/// Everything but the points.
Json head_json(const Result& result) {
  const double unit = result.mm_per_unit;
  Json json;
  json["verdict"] = verdict_json(result.verdict);
  json["status"] = result.status;
  json["mode"] = result.mode;
  json["units"] = result.units;
  json["pose"] = pose_json(result.pose, unit);
  json["covariance"] = covariance_json(result.covariance, unit);
  json["summary"] = {{"count", result.all.count},
                     {"rms_before", result.all.rms_before / unit},
                     {"rms_after", result.all.rms_after / unit},
                     {"max_abs_before", result.all.max_before / unit},
                     {"max_abs_after", result.all.max_after / unit}};
  Json leading_edge = region_json(result.leading_edge, unit);
  leading_edge["boxes"] = boxes_json(result.boxes);
  json["regions"] = {{key_of(Region::leading_edge), leading_edge},
                     {key_of(Region::rest), region_json(result.rest, unit)}};
  if (!result.zones.empty()) json["zones"] = zones_json(result);
  json["tolerance_factor"] = result.tolerance_factor > 0.0 ? Json(result.tolerance_factor / unit) : Json(nullptr);
  json["certificate"] = certificate_json(result.certificate);
  json["further_starts"] = {{"count", result.further_starts}, {"same", result.same_optimum}};
  json["axis"] = axis_json(result.axis, unit);
  json["tip_radius"] = result.tip_radius > 0.0 ? Json(result.tip_radius / unit) : Json(nullptr);
  json["locked"] = result.locked;
  json["loss"] = loss_json(result.loss, unit);
  json["aberrant"] = outliers_json(result.outliers, unit);  // the key that readers of result.json know
  json["robust"] = robust_json(result.judged_otherwise);
  json["notes"] = result.notes;
  return json;
}

}  // namespace

std::string result_json(const Result& result) {
  std::string text;
  write_result_json(result, [&text](std::string_view piece) { text += piece; });
  return text;
}

void write_result_json(const Result& result, const Put& put) {
  std::string head = head_json(result).dump(1);
  head.erase(head.size() - 2);  // the line end and bracket that close the object
  put(head);
  write_points(result, put);
}

}  // namespace bladefit
