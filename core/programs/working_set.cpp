#include "core/programs/working_set.hpp"

#include <algorithm>

namespace bladefit {
namespace {

/// A rest this small against the whole is rounding.
constexpr double kNoRest = 1e-13;
/// A coefficient this small would leave a factor that is mostly rounding.
constexpr double kLeastPivot = 1e-12;

}  // namespace

double WorkingSet::least_own_part() const {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < size_; ++k) least = std::min(least, r_(k, k));
  return least;
}

int WorkingSet::find(int index, Side side) const {
  for (int k = 0; k < size_; ++k) {
    if (member(k).index == index && member(k).side == side) return k;
  }
  return -1;
}

bool WorkingSet::append(const Member& member, const Vec8& normal, double offset) {
  if (size_ == kMaxVariables) return false;
  const Projection p = project(normal);
  const double length = p.rest.norm();
  if (!(length > 0.0)) return false;
  members_[static_cast<std::size_t>(size_)] = member;
  normals_.col(size_) = normal;
  offsets_[size_] = offset;
  q_.col(size_) = p.rest / length;
  r_.col(size_) = p.within;
  r_(size_, size_) = length;
  ++size_;
  return true;
}

void WorkingSet::remove(int k) {
  const WorkingSet old = *this;
  size_ = k;
  for (int j = k + 1; j < old.size_; ++j) append(old.member(j), old.normals_.col(j), old.offsets_[j]);
}

WorkingSet::Projection WorkingSet::project(const Vec8& vector) const {
  Projection out;
  out.rest = vector;
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 0; k < size_; ++k) {
      const double part = q_.col(k).dot(out.rest);
      out.within[k] += part;
      out.rest -= part * q_.col(k);
    }
  }
  if (size_ == kMaxVariables || !(out.rest.norm() > kNoRest * vector.norm())) out.rest.setZero();
  return out;
}

Vec8 WorkingSet::solve(const Vec8& b) const {
  Vec8 x = Vec8::Zero();
  for (int i = size_ - 1; i >= 0; --i) {
    double sum = b[i];
    for (int k = i + 1; k < size_; ++k) sum -= r_(i, k) * x[k];
    x[i] = sum / r_(i, i);
  }
  return x;
}

Vec8 WorkingSet::solve_transposed(const Vec8& b) const {
  Vec8 x = Vec8::Zero();
  for (int i = 0; i < size_; ++i) {
    double sum = b[i];
    for (int k = 0; k < i; ++k) sum -= r_(k, i) * x[k];
    x[i] = sum / r_(i, i);
  }
  return x;
}

WorkingSet::Split WorkingSet::split(const Vec8& vector) const {
  const Projection p = project(vector);
  return {solve(p.within), p.rest};
}

WorkingSet::Minimum WorkingSet::minimum(const Vec8& pull) const {
  const Vec8 along = solve_transposed(offsets_);
  const Projection p = project(pull);
  Minimum out;
  out.y = p.rest;
  for (int k = 0; k < size_; ++k) out.y += along[k] * q_.col(k);
  out.multipliers = solve(along - p.within);
  return out;
}

WorkingSet::Ratio WorkingSet::first_to_leave(const Vec8& multipliers, const Vec8& coefficients, double norm) const {
  Ratio out;
  double pivot = 0.0;
  for (int k = 0; k < size_; ++k) {
    const double size = coefficients[k] * normals_.col(k).norm();
    if (!(size > kLeastPivot * norm)) continue;
    const double ratio = std::max(0.0, multipliers[k]) / coefficients[k];
    // Of equals the one with the largest pivot, for the sake of the factor.
    if (ratio > out.step || (ratio == out.step && size <= pivot)) continue;
    out = {ratio, k};
    pivot = size;
  }
  return out;
}

}  // namespace bladefit
