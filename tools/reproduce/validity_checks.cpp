#include "tools/reproduce/validity_checks.hpp"

#include <fmt/format.h>

#include "tools/batch/batch_fit.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/nurbs/surface_samples.hpp"

namespace bladefit {
namespace {

/// Points sampled off the moved design, a window away from its edges.
constexpr std::uint32_t kGrid = 12;
constexpr double kWindow = 0.05;

Pose inverse(const Pose& pose) {
  Pose result;
  result.rotation = pose.rotation.transpose();
  result.translation = -(result.rotation * pose.translation);
  return result;
}

Pose product(const Pose& second, const Pose& first) {
  return {second.rotation * first.rotation, apply(second, first.translation)};
}

/// What a pose is off the one wanted, as a row of values.
std::vector<double> left_over(const Pose& found, const Pose& wanted, double mm_per_unit, const Result& fit) {
  const Pose rest = product(found, inverse(wanted));
  return {static_cast<double>(fit.all.count), rest.translation.norm() / mm_per_unit, rotation_log(rest.rotation).norm(),
          fit.all.rms_after / mm_per_unit};
}

/// The design moved by `pose`: its control points are.
std::vector<std::byte> moved_image(const StudyCase& study, const Pose& pose) {
  std::vector<NurbsSurface> surfaces = study.surfaces;
  for (NurbsSurface& surface : surfaces) {
    for (Eigen::Vector3d& point : surface.control_points) point = pose.rotation * point + pose.translation;
  }
  const auto unit = static_cast<DesignUnit>(study.design.header().design_unit);
  return write_image(surfaces, unit, study.outward);
}

}  // namespace

ReportTable check_table() {
  ReportTable table;
  table.title = "Checks of validity (thesis 5.3.1): what is left over of the motion";
  table.head = "Data";
  table.columns = {{"points", "Points", "", Figure::count},
                   {"translation", "Translation", "(in)", Figure::residual},
                   {"rotation", "Rotation", "(rad)", Figure::residual},
                   {"rms_after", "RMS Distance", "After (in)", Figure::residual}};
  table.notes.emplace_back(
      "zero motion: the points localized to the design moved by the inverse of their motion; what is found. same "
      "motion: points sampled off that moved design localized to the design itself; what is found, off the motion. "
      "The thesis reports the zero vector and the same transformation, without figures.");
  return table;
}

void add_validity_checks(const StudyCase& study, const std::string& subset, ReportTable& table) {
  const std::vector<ProbePoint> points = read_subset_points(study, subset);
  const double mm = study.plan.mm_per_unit;
  const Pose motion = fit_points(study.design, study.plan, points, subset).result.pose;
  const std::vector<std::byte> image = moved_image(study, inverse(motion));
  DesignImage moved;
  if (const Status status = DesignImage::open(image, moved); status != Status::ok) {
    throw ToolError(fmt::format("{}: the moved design: {}", study.name, status_text(status)));
  }
  const std::string label = fmt::format("{} {}", study.name, subset);
  const Result zero = fit_points(moved, study.plan, points, subset).result;
  table.rows.push_back({label, "zero motion", study.name, subset, left_over(zero.pose, Pose(), mm, zero)});

  SamplePlan plan;
  plan.count_u = plan.count_v = kGrid;
  plan.low = kWindow;
  plan.high = 1 - kWindow;
  const Result same = fit_points(study.design, study.plan, sample_surface(moved, plan), subset).result;
  table.rows.push_back({label, "same motion", study.name, subset, left_over(same.pose, motion, mm, same)});
}

}  // namespace bladefit
