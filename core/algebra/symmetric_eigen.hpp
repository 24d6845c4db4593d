#pragma once
#include "core/algebra/matrix.hpp"

namespace bladefit {

/// Eigenvalues, ascending, and unit eigenvectors (columns) of a symmetric 6 x 6 matrix.
struct SymmetricEigen {
  Vec6 values;
  Mat6 vectors;
};

/// Cyclic Jacobi: no memory but the stack, at most 30 sweeps (4 to 7 are usual), small eigenvalues as exact as large
/// ones allow. Cost: about 5 us.
[[nodiscard]] SymmetricEigen symmetric_eigen(const Mat6& matrix);

}  // namespace bladefit
