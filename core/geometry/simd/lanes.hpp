#pragma once
#include <cstdint>

namespace bladefit {

/// Points that are walked at once, each in a lane of the machine's vector registers.
inline constexpr int kLanes = 4;

/// One number of each lane.
using LaneNumbers = double[kLanes];

/// Feet of up to kLanes points, each sought by Newton's method inside one bicubic span. The arithmetic of a lane is
/// that of newton_walk() to the last bit, whatever stands in the others. Plain numbers: this is what the kernels for
/// different processors share.
struct LaneWalk {
  const double* taylor[kLanes];          ///< Taylor forms of the spans
  alignas(32) LaneNumbers x, y;          ///< given: start; found: foot, in the parameters of the form
  alignas(32) LaneNumbers r[3];          ///< points [mm]
  alignas(32) LaneNumbers per_u, per_v;  ///< spans per unit of the patch's parameters
  double last_step = 0, slack = 0;       ///< as in newton_walk() [mm]
  /// Found: the surface at the foot, derivatives in the patch's parameters, and r - s.
  alignas(32) LaneNumbers s[3], s_u[3], s_v[3], s_uu[3], s_uv[3], s_vv[3], offset[3];
  bool converged[kLanes];  ///< false: a foot is to be sought in another way; the rest means nothing then
};

/// What rows of a fit are about, of all lanes.
struct LaneFrame {
  double pivot[3];
  double length;                    ///< pivot and length as in MotionFrame [mm]
  double x[6];                      ///< the motion at which rows are taken [mm]
  double probe_radius;              ///< [mm]
  alignas(32) LaneNumbers outward;  ///< of the lanes' patches: +1 or -1
};

/// Rows of converged lanes as distance_row() makes them, for interior feet.
struct LaneRows {
  alignas(32) LaneNumbers normal[3], distance, gradient[6];
  alignas(32) LaneNumbers bend[21];  ///< upper triangle, column by column
  bool regular[kLanes];              ///< false: the parametrisation is degenerate there, and there is no normal
};

/// What the rows of the lanes count for: the terms of the loss, times the weight of the point. All 0 where a lane does
/// not count, whatever stands in its row.
struct LaneTerms {
  alignas(32) LaneNumbers counts;         ///< 1 or 0
  alignas(32) LaneNumbers weight, slope;  ///< LossTerms::weight and slope [mm]
  alignas(32) LaneNumbers rest;           ///< LossTerms::curvature less its weight
  alignas(32) LaneNumbers value;          ///< LossTerms::value [mm^2]
};

/// Sums of rows taken at the reference of the sums, of each lane by itself: what a QuadraticModel holds of them.
struct LaneSums {
  alignas(32) LaneNumbers gauss[21], bend[21];  ///< upper triangles, column by column
  alignas(32) LaneNumbers gradient[6], value, weight;
};

/// True if the processor has AVX2 and the kernels were compiled for it (by GCC only).
[[nodiscard]] bool lanes_available();

/// Cost: some 40 ns a point from a neighbouring foot.
void walk_lanes(LaneWalk& walk);
/// Cost: some 15 ns a point.
void take_rows(const LaneWalk& walk, const LaneFrame& frame, LaneRows& rows);
/// Cost: some 370 instructions for four lanes. SweptRows::add() does the same for one.
void add_rows(const LaneRows& rows, const LaneTerms& terms, LaneSums& sums);

}  // namespace bladefit
