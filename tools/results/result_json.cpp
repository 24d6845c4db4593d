#include <cmath>
#include <nlohmann/json.hpp>

#include "core/fit/pose.hpp"
#include "tools/batch/batch_fit.hpp"

namespace bladefit {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(FootKind kind) {
  return kind == FootKind::interior ? "interior" : kind == FootKind::edge ? "edge" : "corner";
}

const char* name_of(PointState state) {
  switch (state) {
    case PointState::pending:
      return "pending";
    case PointState::in:
      return "in";
    case PointState::out:
      return "out";
    case PointState::rejected:
      return "rejected";
  }
  return "";
}

const char* name_of(Action action) { return action == Action::none ? "none" : action == Action::cut ? "cut" : "weld"; }

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
Json covariance_json(const FitReport& report, FitMode mode, double mm_per_unit) {
  if (mode != FitMode::least_squares || report.determined < 6 || report.fitted <= 6) return nullptr;
  Json rows = Json::array();
  for (int i = 0; i < 6; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 6; ++j)
      row.push_back(report.covariance(i, j) / ((i < 3 ? 1.0 : mm_per_unit) * (j < 3 ? 1.0 : mm_per_unit)));
    rows.push_back(row);
  }
  return rows;
}

Json region_json(const BeforeAfter& sums, double tolerance_mm, double mm_per_unit) {
  return {{"count", sums.count},
          {"rms_before", sums.rms_before / mm_per_unit},
          {"rms_after", sums.rms_after / mm_per_unit},
          {"max_abs_after", sums.max_after / mm_per_unit},
          {"tolerance", length_or_null(tolerance_mm, mm_per_unit)}};
}

Json boxes_json(const ToleranceMap& tolerance) {
  Json boxes = Json::array();
  for (std::uint32_t k = 0; k < tolerance.box_count; ++k) {
    const ParameterBox& box = tolerance.boxes.at(k);
    boxes.push_back({{"patch", box.patch}, {"u", {box.u_min, box.u_max}}, {"v", {box.v_min, box.v_max}}});
  }
  return boxes;
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

Json aberrant_json(const AberrantPoints& aberrant, double mm_per_unit) {
  Json points = Json::array();
  for (const AberrantPoint& p : aberrant.points) {
    points.push_back(
        {{"index", p.sequence - 1}, {"distance", p.distance_mm / mm_per_unit}, {"studentized", p.studentized}});
  }
  return {{"limit", aberrant.limit}, {"scale", aberrant.scale_mm / mm_per_unit}, {"points", points}};
}

Json loss_json(const FitReport& report, Loss loss, double mm_per_unit) {
  if (loss == Loss::none) return nullptr;
  return {{"name", word_of(loss)}, {"scale", report.loss_scale_mm / mm_per_unit}};
}

Json points_json(const std::vector<Verdict>& verdicts, double mm_per_unit) {
  Json points = Json::array();
  for (const Verdict& v : verdicts) {
    points.push_back({{"index", v.sequence - 1},
                      {"patch", v.foot.patch},
                      {"u", v.foot.u},
                      {"v", v.foot.v},
                      {"kind", name_of(v.foot.kind)},
                      {"region", v.region == Region::leading_edge ? "leading_edge" : "rest"},
                      {"distance", v.foot.distance / mm_per_unit},
                      {"uncertainty", v.uncertainty_mm / mm_per_unit},
                      {"state", name_of(v.state)},
                      {"action", name_of(v.action)}});
  }
  return points;
}

}  // namespace

std::string result_json(const FitResult& result, const FitPlan& plan) {
  const double unit = plan.mm_per_unit;
  Json json;
  json["status"] = result.status;
  json["mode"] = word_of(plan.localizer.mode);
  json["units"] = plan.units;
  json["pose"] = pose_json(result.report.pose, unit);
  json["covariance"] = covariance_json(result.report, plan.localizer.mode, unit);
  json["summary"] = {{"count", result.all.count},
                     {"rms_before", result.all.rms_before / unit},
                     {"rms_after", result.all.rms_after / unit},
                     {"max_abs_before", result.all.max_before / unit},
                     {"max_abs_after", result.all.max_after / unit}};
  const ToleranceMap& tolerance = plan.localizer.tolerance;
  const double factor = result.report.tolerance_factor_mm;
  const bool found = plan.localizer.mode == FitMode::min_tolerance && factor > 0.0;
  json["regions"] = {
      {"leading_edge", region_json(result.leading_edge, found ? factor : tolerance.leading_edge_mm, unit)},
      {"rest", region_json(result.rest, found ? plan.localizer.ratio * factor : tolerance.rest_mm, unit)}};
  json["regions"]["leading_edge"]["boxes"] = boxes_json(tolerance);
  json["tolerance_factor"] = factor > 0.0 ? Json(factor / unit) : Json(nullptr);
  json["certificate"] = certificate_json(result.report.certificate);
  json["further_starts"] = {{"count", result.report.further_starts}, {"same", result.report.same_optimum}};
  json["locked"] = names_of_locked(plan.localizer.locked);
  json["loss"] = loss_json(result.report, plan.localizer.loss, unit);
  json["aberrant"] = result.aberrant.limit > 0.0 ? aberrant_json(result.aberrant, unit) : Json(nullptr);
  json["points"] = points_json(result.verdicts, unit);
  return json.dump(1) + "\n";
}

}  // namespace bladefit
