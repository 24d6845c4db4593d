#include "core/localizer/mode_program.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Weights of 0 are no bounds.
bool tighter_anywhere(const Limits& weight, const Limits& kept) {
  if (weight.farther() == 0.0) return false;
  const bool same = weight.plus() == kept.plus() && weight.minus() == kept.minus();
  return same || weight.plus() < kept.plus() || weight.minus() < kept.minus();
}

Limits tighter_of(const Limits& a, const Limits& b) {
  return {std::min(a.plus(), b.plus()), std::min(a.minus(), b.minus())};
}

}  // namespace

void ModeProgram::set_pose(const Pose& pose) {
  fit_.set_basis(free_motions(pose, problem_.config.locked, problem_.frame));
}

void ModeProgram::set_row(std::uint32_t index, const DistanceRow& row) {
  if (fit_.weight(index).farther() == 0.0) {
    fit_.skip_row(index);
  } else {
    fit_.set_row(index, row);
  }
}

void ModeProgram::report(const PointStore& store, ModeOptimum& optimum) const {
  const ModeRow& program = mode_row(fit_.mode());
  optimum.take(program, fit_.value() * plan_.unit(), certificate_of(fit_.active_rows(), store, plan_.unit()));
}

double ModeProgram::assign_regions(PointStore& store, VerdictBook& verdicts) {
  double change = 0.0;
  for (std::uint32_t i = 0; i < store.size(); ++i) {
    Limits weight = plan_.weight(store[i].foot);
    // A foot on the border of a region may be drawn over it by one bound and back by the other: it keeps the tighter,
    // on either side.
    const Limits kept = fit_.weight(i);
    if (region_rounds_ >= tuning::kFreeRegionRounds && kept.farther() > 0.0) {
      if (!tighter_anywhere(weight, kept)) continue;
      weight = tighter_of(weight, kept);
    }
    verdicts.assign_region(store[i]);
    change = std::max(change, fit_.set_weight(i, weight));
  }
  return change;
}

double ModeProgram::unit_of(std::uint32_t index, double distance) const {
  switch (mode_row(fit_.mode()).compared) {
    case ModeRow::Compared::by_range:
      return 0.5;
    case ModeRow::Compared::by_distance:
      return 1.0;
    case ModeRow::Compared::by_bound:
      break;
  }
  return fit_.weight(index).of(distance);
}

double ModeProgram::range() const {
  const BoundRows::Extremes found = fit_.extremes();
  return found.most - found.least;
}

bool ModeProgram::bounds_hold(const PointStore& store, const PointSelection& selection) const {
  for (std::uint32_t i = 0; i < store.size(); ++i) {
    const double distance = store[i].foot.distance, bound = fit_.weight(i).of(distance);
    if (bound == 0.0 || selection.left_out(store[i], store[i].foot)) continue;
    if (std::abs(distance) > bound * (1.0 + tuning::kFeasible)) return false;
  }
  return true;
}

ModeProgram::Regions ModeProgram::follow_feet(PointStore& store, VerdictBook& verdicts) {
  if (problem_.config.regions == RegionPolicy::fixed) return Regions::at_rest;
  const bool weighted = mode_row(fit_.mode()).compared == ModeRow::Compared::by_bound;
  if (assign_regions(store, verdicts) <= tuning::kWeightsAtRest || !weighted) return Regions::at_rest;
  return ++region_rounds_ >= tuning::kRegionRounds ? Regions::restless : Regions::changed;
}

}  // namespace bladefit
