#pragma once
#include <Eigen/Core>

namespace bladefit {

// Unaligned, so that records which hold them can stand anywhere in the caller's memory.
using Vec3 = Eigen::Matrix<double, 3, 1, Eigen::DontAlign>;
using Mat3 = Eigen::Matrix<double, 3, 3, Eigen::DontAlign>;
using Vec6 = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;
using Mat6 = Eigen::Matrix<double, 6, 6, Eigen::DontAlign>;

}  // namespace bladefit
