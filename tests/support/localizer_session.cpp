#include "tests/support/localizer_session.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace bladefit::testing {

Vec6 pose_difference(const Pose& from, const Pose& to) {
  Vec6 out;
  out << rotation_log(to.rotation * from.rotation.transpose()), to.translation - from.translation;
  return out;
}

double in_uncertainties(const Pose& pose, const FitReport& reference) {
  const Eigen::VectorXd difference = pose_difference(reference.pose, pose);
  const Eigen::VectorXd scale = reference.covariance.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      scale.cwiseInverse().asDiagonal() * Eigen::MatrixXd(reference.covariance) * scale.cwiseInverse().asDiagonal();
  const Eigen::VectorXd scaled = difference.cwiseQuotient(scale);
  return std::sqrt(std::max(0.0, scaled.dot(correlation.ldlt().solve(scaled))));
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool identical(const Verdict& a, const Verdict& b) {
  bool same = a.sequence == b.sequence && a.region == b.region && a.state == b.state && a.action == b.action &&
              a.revision == b.revision && a.foot.patch == b.foot.patch && a.foot.kind == b.foot.kind &&
              a.foot.border == b.foot.border && a.left_out == b.left_out && a.fitted == b.fitted;
  same = same && same_bits(a.foot.u, b.foot.u) && same_bits(a.foot.v, b.foot.v) &&
         same_bits(a.foot.distance, b.foot.distance) && same_bits(a.foot.beyond, b.foot.beyond) &&
         same_bits(a.tolerance_mm, b.tolerance_mm) && same_bits(a.uncertainty_mm, b.uncertainty_mm);
  for (int k = 0; k < 3; ++k) {
    same = same && same_bits(a.foot.point[k], b.foot.point[k]) && same_bits(a.foot.normal[k], b.foot.normal[k]);
  }
  return same;
}

bool identical(const FitReport& a, const FitReport& b) {
  const auto same_region = [](const RegionReport& x, const RegionReport& y) {
    return x.count == y.count && x.judged_out == y.judged_out && same_bits(x.rms_mm, y.rms_mm) &&
           same_bits(x.worst_mm, y.worst_mm) && x.worst_sequence == y.worst_sequence;
  };
  const auto same_doubles = [](const auto& x, const auto& y) {
    return std::memcmp(x.data(), y.data(), sizeof(double) * static_cast<std::size_t>(x.size())) == 0;
  };
  return a.status == b.status && same_doubles(a.pose.rotation, b.pose.rotation) &&
         same_doubles(a.pose.translation, b.pose.translation) && same_doubles(a.covariance, b.covariance) &&
         a.determined == b.determined && a.points == b.points && a.fitted == b.fitted && a.rejected == b.rejected &&
         same_bits(a.rms_mm, b.rms_mm) && same_bits(a.sigma_mm, b.sigma_mm) &&
         same_bits(a.smallest_eigenvalue, b.smallest_eigenvalue) && same_bits(a.gradient, b.gradient) &&
         same_region(a.leading_edge, b.leading_edge) && same_region(a.rest, b.rest) && a.revision == b.revision &&
         a.memory_full == b.memory_full;
}

}  // namespace bladefit::testing
