#pragma once
#include <Eigen/Core>
#include <random>

#include "core/algebra/matrix.hpp"

namespace bladefit::testing {

/// Random numbers whose seed a failure prints.
std::mt19937_64 drawn();

/// The largest entry in size.
double largest(const Eigen::MatrixXd& m);

/// A positive definite matrix whose condition number is at most `condition`.
Mat6 random_symmetric(std::mt19937_64& random, double condition);

}  // namespace bladefit::testing
