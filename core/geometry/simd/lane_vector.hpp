// For the files of the kernels, which are compiled for processors with AVX2: to be included first. Nothing that they
// call may be shared with other files, lest those be given code of theirs: no library, everything local.
#pragma once
#include "core/geometry/simd/lanes.hpp"

#if defined(__x86_64__) && !defined(__clang__)
#pragma GCC target("avx2")
#endif

namespace bladefit {
namespace {

using Four = double __attribute__((vector_size(32)));
using Unaligned = double __attribute__((vector_size(32), aligned(8)));
using Mask = decltype(Four() < Four());

#define BLADEFIT_INLINE [[gnu::always_inline]] inline

/// A vector of space or of the parameters of a motion, of each lane.
struct Four3 {
  Four x, y, z;
};

BLADEFIT_INLINE Four load(const LaneNumbers& a) { return *reinterpret_cast<const Four*>(a); }
BLADEFIT_INLINE void store(LaneNumbers& a, const Four& v) { *reinterpret_cast<Four*>(a) = v; }
BLADEFIT_INLINE Four3 load3(const LaneNumbers (&a)[3]) { return {load(a[0]), load(a[1]), load(a[2])}; }
BLADEFIT_INLINE void store3(LaneNumbers (&a)[3], const Four3& v) {
  store(a[0], v.x);
  store(a[1], v.y);
  store(a[2], v.z);
}
BLADEFIT_INLINE Four3 operator+(const Four3& a, const Four3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
BLADEFIT_INLINE Four3 operator-(const Four3& a, const Four3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
BLADEFIT_INLINE Four3 operator*(const Four& f, const Four3& a) { return {f * a.x, f * a.y, f * a.z}; }
/// As homogeneous_dot() of span_newton.cpp adds up.
BLADEFIT_INLINE Four dot(const Four3& a, const Four3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// As Eigen adds up three products.
BLADEFIT_INLINE Four eigen_dot(const Four3& a, const Four3& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
BLADEFIT_INLINE Four3 cross(const Four3& a, const Four3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
BLADEFIT_INLINE Four root(const Four& a) {
#if defined(__AVX__)
  return __builtin_ia32_sqrtpd256(a);
#else
  return Four{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]), __builtin_sqrt(a[3])};
#endif
}
BLADEFIT_INLINE bool none(const Mask& m) {
#if defined(__AVX__)
  return __builtin_ia32_movmskpd256(reinterpret_cast<const Four&>(m)) == 0;
#else
  return (m[0] | m[1] | m[2] | m[3]) == 0;
#endif
}
BLADEFIT_INLINE void keep(Four3& to, const Mask& where, const Four3& from) {
  to.x = where ? from.x : to.x;
  to.y = where ? from.y : to.y;
  to.z = where ? from.z : to.z;
}

}  // namespace
}  // namespace bladefit
