#include "core/geometry/nearest/minimum_proof.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Determinants nearer to 0 than this share of their terms have no sign.
constexpr double kDeterminantRounding = 1e-9;

int sign_of(const ValueRange& range) { return range.least > 0.0 ? 1 : range.most < 0.0 ? -1 : 0; }

ValueRange hull(const ValueRange& a, const ValueRange& b) {
  return {std::min(a.least, b.least), std::max(a.most, b.most)};
}

/// Sylvester's criterion in the worst case of the ranges.
bool strictly_convex(const DerivativeRanges& h, PieceShape shape) {
  if (!shape.along_u) return !shape.along_v || h.vv.least > 0.0;
  if (!shape.along_v) return h.uu.least > 0.0;
  const double uv = std::max(std::abs(h.uv.least), std::abs(h.uv.most));
  return h.uu.least > 0.0 && h.vv.least > 0.0 && h.uu.least * h.vv.least > uv * uv * (1.0 + kDeterminantRounding);
}

/// A second derivative or the determinant is negative everywhere.
bool nowhere_convex(const DerivativeRanges& h, PieceShape shape) {
  if ((shape.along_u && h.uu.most < 0.0) || (shape.along_v && h.vv.most < 0.0)) return true;
  if (!shape.along_u || !shape.along_v) return false;
  const double uv = h.uv.least > 0.0 ? h.uv.least : h.uv.most < 0.0 ? -h.uv.most : 0.0;
  return uv * uv > h.uu.most * h.vv.most * (1.0 + kDeterminantRounding);
}

}  // namespace

DerivativeRanges hull(const DerivativeRanges& a, const DerivativeRanges& b) {
  return {hull(a.u, b.u), hull(a.v, b.v), hull(a.uu, b.uu), hull(a.uv, b.uv), hull(a.vv, b.vv)};
}

MinimumProof prove(const DerivativeRanges& ranges, PieceShape shape) {
  MinimumProof proof;
  if (shape.along_u) proof.monotone_u = sign_of(ranges.u);
  if (shape.along_v) proof.monotone_v = sign_of(ranges.v);
  proof.convex = strictly_convex(ranges, shape);
  proof.no_minimum = nowhere_convex(ranges, shape);
  return proof;
}

}  // namespace bladefit
