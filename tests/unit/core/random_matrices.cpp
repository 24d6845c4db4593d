#include "tests/unit/core/random_matrices.hpp"

#include <rapidcheck.h>

#include <Eigen/QR>
#include <cmath>

#include "tests/support/random_places.hpp"

namespace bladefit::testing {

std::mt19937_64 drawn() { return std::mt19937_64(*rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>())); }

double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

Mat6 random_symmetric(std::mt19937_64& random, double condition) {
  Eigen::MatrixXd basis = Eigen::MatrixXd::NullaryExpr(6, 6, [&] { return uniform(random, -1, 1); });
  basis = Eigen::HouseholderQR<Eigen::MatrixXd>(basis).householderQ();
  Eigen::VectorXd values(6);
  for (int k = 0; k < 6; ++k) values[k] = std::pow(condition, -uniform(random, 0, 1));
  const Eigen::MatrixXd m = basis * values.asDiagonal() * basis.transpose();
  return 0.5 * (m + m.transpose());
}

}  // namespace bladefit::testing
