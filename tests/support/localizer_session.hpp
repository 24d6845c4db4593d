#pragma once
#include <gtest/gtest.h>

#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {

/// Rotation [rad] and translation [mm] that lead from one pose to another, for C' = exp([w]x) C, t' = t + dt.
Vec6 pose_difference(const Pose& from, const Pose& to);

/// Distance between two poses in standard uncertainties of the second one's report (Mahalanobis).
double in_uncertainties(const Pose& pose, const FitReport& reference);

/// The batch fit of `points`.
inline FitReport batch_fit(const DesignImage& design, LocalizerConfig config, const std::vector<ProbePoint>& points) {
  config.capacity = static_cast<std::uint32_t>(points.size());
  OwnedLocalizer batch(design, config);
  for (const ProbePoint& point : points) EXPECT_EQ(batch->stage(point), Status::ok);
  batch->conclude();
  EXPECT_EQ(refine_fully(*batch), Status::ok);
  return batch->fit();
}

inline void push_all(Localizer& localizer, const std::vector<ProbePoint>& points) {
  Verdict verdict;
  for (const ProbePoint& point : points) EXPECT_TRUE(succeeded(localizer.push(point, verdict)));
}

/// dtmb4119 with all 2000 points and tolerances that leave some points out.
struct BladeSession {
  ReferenceCase reference = read_case("dtmb4119");
  const CompiledDesign& design = reference_design("dtmb4119");
  std::vector<ProbePoint> points = points_of(reference, "full");
  LocalizerConfig config = tolerant(config_of(reference, 2000));

  static LocalizerConfig tolerant(LocalizerConfig config) {
    config.tolerance.leading_edge_mm = 0.06;
    config.tolerance.rest_mm = 0.09;
    return config;
  }
};

bool same_bits(double a, double b);

/// The same bits in everything that a verdict or a report says.
bool identical(const Verdict& a, const Verdict& b);
bool identical(const FitReport& a, const FitReport& b);

}  // namespace bladefit::testing
