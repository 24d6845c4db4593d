#include <algorithm>
#include <cmath>

#include "core/fit/active_set.hpp"

namespace bladefit {
namespace {

/// offset - normal'x, straight from the caller's numbers.
double violation(const Constraints& constraints, int index, Side side, const Vec8& x) {
  const HalfSpace h = half_space(constraints, index, side);
  return h.offset - h.normal.dot(x);
}

double largest_violation(const Constraints& constraints, const Vec8& x) {
  double largest = 0.0;
  const int count = constraints.rows.count + constraints.variables;
  for (int i = 0; i < count; ++i) {
    largest = std::max(largest, violation(constraints, i, Side::lower, x));
    largest = std::max(largest, violation(constraints, i, Side::upper, x));
  }
  return largest;
}

}  // namespace

KktResiduals kkt_residuals(const Mat8* hessian, const Vec8& gradient, const Constraints& constraints, const Vec8& x,
                           const ActiveSet& active) {
  KktResiduals out;
  const int n = constraints.variables;
  Vec8 sum = gradient, terms = gradient.cwiseAbs();
  for (int i = 0; hessian && i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      sum[i] += (*hessian)(i, j) * x[j];
      terms[i] += std::abs((*hessian)(i, j) * x[j]);
    }
  }
  for (int k = 0; k < active.count; ++k) {
    const ActiveSet::Entry& entry = active.entries[static_cast<std::size_t>(k)];
    const HalfSpace h = half_space(constraints, entry.index, entry.side);
    sum -= entry.multiplier * h.normal;
    terms += std::abs(entry.multiplier) * h.normal.cwiseAbs();
    out.complementarity += std::abs(entry.multiplier * (h.normal.dot(x) - h.offset));
    if (k == 0 || entry.multiplier < out.least_multiplier) out.least_multiplier = entry.multiplier;
  }
  const double scale = terms.head(n).maxCoeff();
  out.stationarity = scale > 0.0 ? sum.head(n).cwiseAbs().maxCoeff() / scale : 0.0;
  out.primal = largest_violation(constraints, x);
  return out;
}

}  // namespace bladefit
