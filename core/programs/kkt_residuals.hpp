#pragma once
#include "core/programs/active_set.hpp"

namespace bladefit {

/// The conditions at x for any claim; `hessian` null: 0. Cost: one pass over the rows, 2 variables flops a side.
[[nodiscard]] KktResiduals kkt_residuals(const Mat8* hessian, const Vec8& gradient, const Constraints& constraints,
                                         const Vec8& x, const ActiveSet& active);

/// What a certificate of infeasibility proves: every x in all its half spaces has |x| >= margin / combination.
struct FarkasMargin {
  double margin = 0;       ///< sum lambda_k d_k
  double combination = 0;  ///< |sum lambda_k c_k|, rounding
  double terms = 0;        ///< sum |lambda_k d_k|
};
[[nodiscard]] FarkasMargin farkas_margin(const Constraints& constraints, const ActiveSet& certificate);

}  // namespace bladefit
