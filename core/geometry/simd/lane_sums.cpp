#include "core/geometry/simd/lane_vector.hpp"

namespace bladefit {
namespace {

BLADEFIT_INLINE void add_to(LaneNumbers& sum, const Four& part) { store(sum, load(sum) + part); }

}  // namespace

void add_rows(const LaneRows& rows, const LaneTerms& terms, LaneSums& sums) {
  const Mask counts = load(terms.counts) != 0.0;
  const Four weight = load(terms.weight), slope = load(terms.slope), rest = load(terms.rest);
  const bool more = !none(rest != 0.0);
  Four gradient[6];
  for (int k = 0; k < 6; ++k) gradient[k] = counts ? load(rows.gradient[k]) : Four{};
  int entry = 0;
  for (int j = 0; j < 6; ++j) {
    const Four by_weight = weight * gradient[j], by_rest = rest * gradient[j];
    for (int i = 0; i <= j; ++i, ++entry) {
      add_to(sums.gauss[entry], by_weight * gradient[i]);
      const Four bend = counts ? load(rows.bend[entry]) : Four{};
      add_to(sums.bend[entry], slope * bend);
      if (more) add_to(sums.bend[entry], by_rest * gradient[i]);
    }
    add_to(sums.gradient[j], slope * gradient[j]);
  }
  add_to(sums.value, load(terms.value));
  add_to(sums.weight, weight);
}

}  // namespace bladefit
