#include "core/geometry/simd/lanes.hpp"

namespace bladefit {

bool lanes_available() {
#if defined(__x86_64__) && !defined(__clang__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

}  // namespace bladefit
