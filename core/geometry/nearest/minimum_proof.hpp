#pragma once

namespace bladefit {

/// Directions in which a piece has an extent: an edge of a patch has one, a corner none.
struct PieceShape {
  bool along_u = true, along_v = true;
};

struct ValueRange {
  double least = 0, most = 0;
};

/// Ranges of the first and second derivatives of a function over a piece. Units do not matter: only signs and the sign
/// of the Hessian's determinant are looked at.
struct DerivativeRanges {
  ValueRange u, v, uu, uv, vv;
};

/// The ranges that hold both.
[[nodiscard]] DerivativeRanges hull(const DerivativeRanges& a, const DerivativeRanges& b);

/// What ranges of derivatives prove about the minima of a function on a piece.
struct MinimumProof {
  int monotone_u = 0;  ///< +1 (-1): it rises (falls) with u everywhere; 0 = not proven
  int monotone_v = 0;
  bool no_minimum = false;  ///< its Hessian is nowhere positive semidefinite: no local minimum inside
  bool convex = false;      ///< it is strictly convex
};

/// Cost: some ten operations.
[[nodiscard]] MinimumProof prove(const DerivativeRanges& ranges, PieceShape shape);

}  // namespace bladefit
