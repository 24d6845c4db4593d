#include "core/programs/bounded_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/cholesky.hpp"
#include "core/programs/kkt_residuals.hpp"

namespace bladefit {
namespace {

/// Steps below this share of the reach are rounding; steps above the second must not raise the merit.
constexpr double kSettledBelow = 2e-11, kCheckedAbove = 1e-6;
/// Steps of another problem than before are trusted this share of the reach at least.
constexpr double kTrustAnew = 1e-2;
/// A merit may rise by this share and still count as the same.
constexpr double kMeritRounding = 1e-12;

/// A step of this share of the trust is as long as it may be; so many of these that keep little ask for a correction.
constexpr double kAtTrust = 0.99;
constexpr std::uint32_t kShortSteps = 8;

/// The penalty of broken bounds over the largest multiplier, and of broken limits over the sum of theirs.
constexpr double kPenalty = 10.0, kLimitPenalty = 2.0;

double sign_of(const ActiveSet::Entry& entry) { return entry.side == Side::upper ? 1.0 : -1.0; }

}  // namespace

void BoundedFit::begin(FitMode mode, std::uint32_t count, double reach) {
  mode_ = mode;
  rows_.begin(count, mode == FitMode::constrained);
  reach_ = trust_ = reach;
  active_ = ActiveSet();
  curvature_.setZero();
  penalty_ = 0;
  short_steps_ = 0;
  last_.taken = curved_ = false;
}

void BoundedFit::resume(std::uint32_t count) {
  rows_.resume(count);
  trust_ = reach_;
  curvature_.setZero();
  short_steps_ = 0;
  last_.taken = curved_ = false;
}

void BoundedFit::compare_anew() {
  last_.taken = false;
  trust_ = std::max(trust_, kTrustAnew * reach_);
}

void BoundedFit::set_basis(const MotionBasis& basis) {
  basis_ = basis;
  refused_ = false;
}

void BoundedFit::set_row(std::uint32_t i, const DistanceRow& row) {
  const Vec6 gradient = basis_.free == 6 ? row.gradient : Vec6(basis_.directions.transpose() * row.gradient);
  rows_.set(i, gradient, row.distance);
  for (int k = 0; k < active_.count; ++k) {
    const ActiveSet::Entry& entry = active_.entries[static_cast<std::size_t>(k)];
    if (entry.index == static_cast<int>(i)) {
      const Mat6& basis = basis_.directions;
      bend_[static_cast<std::size_t>(k)] = basis.transpose() * row.bend * basis;
      curvature_ += entry.multiplier * sign_of(entry) * bend_[static_cast<std::size_t>(k)];
    }
  }
}

/// The numbers of limits and of the bounds of a step change with the count: no active set knows them any more.
void BoundedFit::set_limits(std::uint32_t count) {
  if (count == rows_.limits()) return;
  int kept = 0;
  for (int k = 0; k < active_.count; ++k) {
    const ActiveSet::Entry& entry = active_.entries[static_cast<std::size_t>(k)];
    if (rows_.is_distance(entry.index)) active_.entries[static_cast<std::size_t>(kept++)] = entry;
  }
  active_.count = kept;
  rows_.set_limits(count);
}

void BoundedFit::set_limit(std::uint32_t k, double value, const Vec6& gradient) {
  rows_.set_limit(k, value, basis_.directions.transpose() * gradient);
}

double BoundedFit::value() const {
  if (mode_ != FitMode::range) return rows_.largest(mode_ != FitMode::minimax);
  const BoundRows::Extremes found = rows_.extremes();
  return found.most - found.least;
}

double BoundedFit::slack(std::uint32_t i) const {
  const double d = rows_.distance(i);
  if (std::isnan(d)) return kUnbounded;
  if (mode_ == FitMode::minimax) return value() - std::abs(d);
  if (mode_ != FitMode::range) return value() - std::abs(d) / rows_.weight(i).of(d);
  const BoundRows::Extremes found = rows_.extremes();
  return std::min(found.most - d, d - found.least);
}

double BoundedFit::merit(const QuadraticModel& model) const {
  if (refused_) return kUnbounded;
  if (mode_ == FitMode::constrained) return model.half_square + penalty_ * rows_.violation();
  return value() + penalty_ * rows_.broken_limit();
}

Constraints BoundedFit::constraints() const {
  Constraints c;
  c.variables = 6;
  c.rows = rows_.view();
  for (int k = 0; k < 6; ++k) {
    c.upper[k] = k < basis_.free ? trust_ : 0.0;
    c.lower[k] = -c.upper[k];
  }
  return c;
}

/// Adds the level or levels to the unknowns. Returns the gradient of the objective.
Vec8 BoundedFit::set_levels(Constraints& c) const {
  Vec8 gradient = Vec8::Unit(6);
  c.variables = 7;
  c.rows.lower_level = c.rows.upper_level = 6;
  if (mode_ == FitMode::min_tolerance) rows_.add_weights(c.rows);
  if (mode_ == FitMode::range) {
    c.variables = 8;
    c.rows.upper_level = 7;
    gradient[7] = 1.0;
  }
  return gradient;
}

/// A second-order correction (Fletcher 1982): the same program once more with the curvature of each active distance
/// over the step just found, which the program knows only in the sum. Without it a step along a curved ridge of the
/// largest distance keeps less than it promises however short it is, and the steps stay short.
ActiveSetResult BoundedFit::solve_corrected() {
  const ActiveSetResult first = solve_levels();
  if (short_steps_ < kShortSteps || !succeeded(first.status)) return first;
  const Vec6 x = first.x.head<6>();
  std::array<BoundRows::Bounds, kMaxVariables + 1> kept;
  for (int k = 0; k < active_.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto row = static_cast<std::uint32_t>(active_.entries[at].index);
    if (!rows_.is_distance(active_.entries[at].index)) continue;
    kept[at] = rows_.bounds(row);
    const double bent = 0.5 * x.dot(bend_[at] * x);
    rows_.set_bounds(row, {kept[at].lower - bent, kept[at].upper - bent});
  }
  ActiveSetResult second = solve_levels();
  for (int k = active_.count - 1; k >= 0; --k) {  // backwards: a row may be there with both sides
    const auto at = static_cast<std::size_t>(k);
    if (!rows_.is_distance(active_.entries[at].index)) continue;
    rows_.set_bounds(static_cast<std::uint32_t>(active_.entries[at].index), kept[at]);
  }
  if (!succeeded(second.status)) return first;
  Constraints c;
  second.objective = set_levels(c).dot(second.x);
  return second.objective < value() ? second : first;
}

/// min s with -v s <= d + J x <= w s, or min s_high - s_low with s_low <= d + J x <= s_high.
ActiveSetResult BoundedFit::solve_levels() const {
  Constraints c = constraints();
  const Vec8 gradient = set_levels(c);
  ActiveSetResult result = minimize_linear(gradient, c, Vec8::Zero(), active_);
  return curved_ && succeeded(result.status) ? solve_curved(result) : result;
}

/// The same with the curvature of the active distances, which decides where fewer than seven are active: Newton's step
/// on the Lagrangian. Squares of the active constraints, which vanish where these hold, make the program convex.
ActiveSetResult BoundedFit::solve_curved(const ActiveSetResult& linear) const {
  Constraints c = constraints();
  const Vec8 levels = set_levels(c);
  double weight = curvature_.norm();
  for (int attempt = 0; attempt < 4; ++attempt, weight *= 10.0) {
    Mat8 hessian = Mat8::Zero();
    hessian.topLeftCorner<6, 6>() = curvature_;
    for (int k = c.variables; k < kMaxVariables; ++k) hessian(k, k) = 1.0;
    Vec8 gradient = levels;
    for (int k = 0; k < active_.count; ++k) {
      const ActiveSet::Entry& entry = active_.entries[static_cast<std::size_t>(k)];
      if (!rows_.is_row(entry.index)) continue;
      const HalfSpace h = half_space(c, entry.index, entry.side);
      hessian += weight * h.normal * h.normal.transpose();
      gradient -= weight * h.offset * h.normal;
    }
    if (!CholeskyFactor<kMaxVariables>(hessian).positive_definite()) continue;
    ActiveSetResult result = minimize_quadratic(hessian, gradient, c, active_);
    if (!succeeded(result.status)) break;
    const Vec6 x = result.x.head<6>();
    result.objective = levels.dot(result.x) + 0.5 * x.dot(curvature_ * x);  // what the step promises
    if (result.objective > value()) break;  // the constraints of before are not those that matter
    result.residuals = kkt_residuals(nullptr, levels, c, result.x, result.active);
    return result;
  }
  return linear;
}

/// min of the model with the curvature of the active constraints, d + J x within its tolerances. Where that is not
/// convex the Gauss-Newton Hessian takes its place.
ActiveSetResult BoundedFit::solve_bounds(const QuadraticModel& model) const {
  Mat8 hessian = Mat8::Identity();
  Vec8 gradient = Vec8::Zero();
  const Mat6& basis = basis_.directions;
  gradient.head<6>() = basis.transpose() * model.gradient;
  const Mat6 gauss = basis.transpose() * model.gauss * basis;
  const Mat6 exact = basis.transpose() * (model.gauss + model.bend) * basis + curvature_;
  hessian.topLeftCorner<6, 6>() = Cholesky(exact).positive_definite() ? exact : gauss;
  return minimize_quadratic(hessian, gradient, constraints(), active_);
}

/// True where the last step raised the merit: a quarter of it, from where it started.
bool BoundedFit::retreat(double merit, Step& step) {
  const bool checked = last_.taken && (refused_ || last_.x.norm() > kCheckedAbove * reach_);
  if (!checked || merit <= last_.merit * (1.0 + kMeritRounding)) return false;
  last_.x *= 0.25;
  trust_ = last_.x.lpNorm<Eigen::Infinity>();
  curved_ = true;
  step.x = last_.x;
  step.from_last = true;
  return true;
}

/// Steps whose promise was kept may become longer, others shorter.
void BoundedFit::adapt_trust(double merit) {
  if (!last_.taken || mode_ == FitMode::constrained) return;
  const double kept = last_.merit - merit, promised = last_.merit - last_.promise;
  const double length = last_.x.lpNorm<Eigen::Infinity>();
  if (kept > 0.75 * promised) trust_ = std::min(reach_, std::max(trust_, 2.0 * length));
  const bool held_back = curved_ && kept <= 0.75 * promised && length >= kAtTrust * trust_;
  if (held_back && kept >= 0.25 * promised) ++short_steps_;
  if (kept >= 0.25 * promised || length <= kCheckedAbove * reach_) return;
  trust_ = 0.5 * length;
  curved_ = true;
}

BoundedFit::Step BoundedFit::step(const QuadraticModel& model) {
  Step step;
  const double present = merit(model);
  if (refused_ && !(last_.taken && last_.x.norm() > kSettledBelow * reach_)) {
    step.status = Status::infeasible;
    return step;
  }
  if (retreat(present, step)) {
    curvature_.setZero();
    return step;
  }
  adapt_trust(present);
  const ActiveSetResult result = mode_ == FitMode::constrained ? solve_bounds(model) : solve_corrected();
  curvature_.setZero();
  step.status = result.status;
  if (!succeeded(result.status)) return step;
  active_ = result.active;
  stationarity_ = result.residuals.stationarity;
  set_penalty();
  step.x = basis_.directions * result.x.head<6>();
  step.settled = step.x.norm() <= kSettledBelow * reach_;
  last_.taken = true;
  last_.merit = merit(model);
  last_.promise = result.objective;
  last_.x = step.x;
  return step;
}

/// Above the multipliers of what it punishes. That of limits falls again: steps along curved ones would stay short.
void BoundedFit::set_penalty() {
  double largest = 0.0, limits = 0.0;
  for (int k = 0; k < active_.count; ++k) {
    const ActiveSet::Entry& entry = active_.entries[static_cast<std::size_t>(k)];
    largest = std::max(largest, entry.multiplier);
    if (rows_.is_limit(entry.index)) limits += entry.multiplier;
  }
  const bool bounds = mode_ == FitMode::constrained;  // else a level gives way to the distances
  penalty_ = bounds ? std::max(penalty_, kPenalty * largest) : std::max(0.5 * penalty_, kLimitPenalty * limits);
}

std::uint32_t BoundedFit::active_limits() const {
  std::uint32_t count = 0;
  for (int k = 0; k < active_.count; ++k) {
    const ActiveSet::Entry& entry = active_.entries[static_cast<std::size_t>(k)];
    if (rows_.is_limit(entry.index) && entry.multiplier > 0.0) ++count;
  }
  return count;
}

ActiveRows BoundedFit::active_rows() const {
  ActiveRows out;
  for (int k = 0; k < active_.count && out.count < out.index.size(); ++k) {
    const ActiveSet::Entry& entry = active_.entries[static_cast<std::size_t>(k)];
    if (!rows_.is_distance(entry.index)) continue;  // a limit, or the bound of a step
    out.index[out.count] = static_cast<std::uint32_t>(entry.index);
    out.multiplier[out.count] = entry.multiplier;
    out.sign[out.count] = entry.side == Side::upper ? 1 : -1;
    ++out.count;
  }
  return out;
}

}  // namespace bladefit
