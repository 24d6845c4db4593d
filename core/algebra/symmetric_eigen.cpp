#include "core/algebra/symmetric_eigen.hpp"

#include <cmath>

namespace bladefit {
namespace {

constexpr int kMaxSweeps = 30;

/// Turns rows and columns p, q so that a(p, q) becomes 0.
void rotate(Mat6& a, Mat6& v, int p, int q) {
  const double theta = (a(q, q) - a(p, p)) / (2.0 * a(p, q));
  const double t = (theta < 0.0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  for (int k = 0; k < 6; ++k) {
    const double kp = a(k, p), kq = a(k, q);
    a(k, p) = c * kp - s * kq;
    a(k, q) = s * kp + c * kq;
  }
  for (int k = 0; k < 6; ++k) {
    const double pk = a(p, k), qk = a(q, k);
    a(p, k) = c * pk - s * qk;
    a(q, k) = s * pk + c * qk;
    const double vp = v(k, p), vq = v(k, q);
    v(k, p) = c * vp - s * vq;
    v(k, q) = s * vp + c * vq;
  }
}

void sort_ascending(SymmetricEigen& e) {
  for (int i = 0; i < 5; ++i) {
    int least = i;
    for (int k = i + 1; k < 6; ++k) {
      if (e.values[k] < e.values[least]) least = k;
    }
    if (least == i) continue;
    std::swap(e.values[i], e.values[least]);
    for (int k = 0; k < 6; ++k) std::swap(e.vectors(k, i), e.vectors(k, least));
  }
}

}  // namespace

SymmetricEigen symmetric_eigen(const Mat6& matrix) {
  Mat6 a = matrix;
  SymmetricEigen out{Vec6::Zero(), Mat6::Identity()};
  const double scale = a.diagonal().cwiseAbs().sum();
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double off = 0.0;
    for (int p = 0; p < 5; ++p) {
      for (int q = p + 1; q < 6; ++q) off += std::abs(a(p, q));
    }
    if (off <= 1e-300 + 1e-17 * scale) break;
    for (int p = 0; p < 5; ++p) {
      for (int q = p + 1; q < 6; ++q) {
        if (std::abs(a(p, q)) > 1e-20 * scale) rotate(a, out.vectors, p, q);
      }
    }
  }
  out.values = a.diagonal();
  sort_ascending(out);
  return out;
}

}  // namespace bladefit
