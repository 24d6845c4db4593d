#include "core/fit/swept_rows.hpp"

namespace bladefit {
namespace {

double folded(const LaneNumbers& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

}  // namespace

void SweptRows::clear() {
  sums_ = {};
  block_ = {};
  in_block_ = false;
  count_ = 0;
}

/// As add_rows() adds up.
void SweptRows::add(std::uint32_t lane, const DistanceRow& row, double w, const LossTerms& terms) {
  const double weight = w * terms.weight, slope = w * terms.slope, rest = w * terms.curvature - weight;
  int entry = 0;
  for (int j = 0; j < 6; ++j) {
    const double by_weight = weight * row.gradient[j], by_rest = rest * row.gradient[j];
    for (int i = 0; i <= j; ++i, ++entry) {
      sums_.gauss[entry][lane] += by_weight * row.gradient[i];
      sums_.bend[entry][lane] += slope * row.bend(i, j);
      if (rest != 0.0) sums_.bend[entry][lane] += by_rest * row.gradient[i];
    }
    sums_.gradient[j][lane] += slope * row.gradient[j];
  }
  sums_.value[lane] += w * terms.value;
  sums_.weight[lane] += weight;
  ++count_;
}

void SweptRows::count_in_block(std::uint32_t lane, double w, const LossTerms& terms) {
  const double weight = w * terms.weight;
  block_.counts[lane] = 1.0;
  block_.weight[lane] = weight;
  block_.slope[lane] = w * terms.slope;
  block_.rest[lane] = w * terms.curvature - weight;
  block_.value[lane] = w * terms.value;
  in_block_ = true;
  ++count_;
}

void SweptRows::add_block(const LaneRows& rows) {
  if (!in_block_) return;
  add_rows(rows, block_, sums_);
  block_ = {};
  in_block_ = false;
}

void SweptRows::move_to(QuadraticModel& model) {
  if (count_ == 0) return;
  int entry = 0;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i <= j; ++i, ++entry) {
      model.gauss(i, j) += folded(sums_.gauss[entry]);
      model.bend(i, j) += folded(sums_.bend[entry]);
      model.gauss(j, i) = model.gauss(i, j);
      model.bend(j, i) = model.bend(i, j);
    }
    model.gradient[j] += folded(sums_.gradient[j]);
  }
  model.half_square += folded(sums_.value);
  model.weight += folded(sums_.weight);
  model.count += count_;
  clear();
}

}  // namespace bladefit
