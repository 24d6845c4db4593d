#include "core/programs/kkt_residuals.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Row by row from the caller's numbers, apart from the search of constraint_rows.cpp.
double largest_row_violation(const ConstraintRows& rows, const Vec8& x) {
  double largest = 0.0;
  const double down = rows.lower_level < 0 ? 0.0 : x[rows.lower_level];
  const double up = rows.upper_level < 0 ? 0.0 : x[rows.upper_level];
  for (int i = 0; i < rows.count; ++i) {
    double value = 0.0;
    for (int j = 0; j < rows.width; ++j) value += rows.coefficients[j * rows.stride + i] * x[j];
    const bool leveled = i < rows.count - rows.plain;
    const double weight = !leveled ? 0.0 : rows.weight ? rows.weight[i] : 1.0;
    const double lower_weight = leveled && rows.lower_weight ? rows.lower_weight[i] : weight;
    if (rows.lower) largest = std::max(largest, rows.lower[i] - (value + lower_weight * down));
    if (rows.upper) largest = std::max(largest, value - weight * up - rows.upper[i]);
  }
  return largest;
}

double largest_violation(const Constraints& constraints, const Vec8& x) {
  double largest = largest_row_violation(constraints.rows, x);
  for (int j = 0; j < constraints.variables; ++j) {
    largest = std::max({largest, constraints.lower[j] - x[j], x[j] - constraints.upper[j]});
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

FarkasMargin farkas_margin(const Constraints& constraints, const ActiveSet& certificate) {
  FarkasMargin out;
  Vec8 sum = Vec8::Zero();
  for (int k = 0; k < certificate.count; ++k) {
    const ActiveSet::Entry& entry = certificate.entries[static_cast<std::size_t>(k)];
    const HalfSpace h = half_space(constraints, entry.index, entry.side);
    sum += entry.multiplier * h.normal;
    out.margin += entry.multiplier * h.offset;
    out.terms += std::abs(entry.multiplier * h.offset);
  }
  out.combination = sum.norm();
  return out;
}

}  // namespace bladefit
