#include "core/programs/active_set.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/cholesky.hpp"
#include "core/programs/kkt_residuals.hpp"
#include "core/programs/working_set.hpp"

namespace bladefit {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Proximal points; one or two are usual.
constexpr int kMaxPasses = 20;
/// After so many a multiplier that comes out below 0 again and again is taken for 0 where rounding could be why.
constexpr int kUsualPasses = 5;
/// The first proximal step against the distance to the worst row, and the growth where it was too short.
constexpr double kFirstStep = 1e4, kStepGrowth = 1e3;
/// A multiplier, or what is left of a gradient, this small against the whole is rounding.
constexpr double kRounding = 1e-12;
/// What cancelling terms leave, as a share of them.
constexpr double kCancelled = 64.0 * kEpsilon;

/// 0 for none.
double smallest(const Vec8& values, int count) { return count > 0 ? values.head(count).minCoeff() : 0.0; }

/// One problem: about a centre, in the variables y = L'(x - centre) with H = L L', the objective is 1/2 |y + v|^2.
/// Linear objectives have L = 1 and v = step g.
class Solver {
 public:
  Solver(const Mat8* hessian, const CholeskyFactor<kMaxVariables>* factor, const Vec8& gradient,
         const Constraints& constraints, const ActiveSetOptions& options, const Vec8& largest)
      : hessian_(hessian),
        factor_(factor),
        gradient_(gradient),
        constraints_(constraints),
        options_(options),
        largest_(largest) {}

  ActiveSetResult run(const Vec8& start, const ActiveSet& warm) {
    centre_ = start;
    begin(warm);
    Status status = Status::iteration_cap;
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const int before = changes_;
      recentre();
      let_go();
      status = satisfy_all();
      if (status != Status::ok) break;
      if (settled()) {
        recentre();
        if (least_multiplier() >= (pass < kUsualPasses ? -rounding() : -negligible())) break;
      }
      if (changes_ == before && falls_for_ever()) {
        status = Status::unbounded;
        break;
      }
      status = Status::iteration_cap;
      step_ *= kStepGrowth;
    }
    return finish(status);
  }

 private:
  [[nodiscard]] Vec8 normal_of(const HalfSpace& h) const {
    return factor_ ? Vec8(factor_->solve_lower(h.normal)) : h.normal;
  }
  [[nodiscard]] double offset_of(const HalfSpace& h) const { return h.offset - h.normal.dot(centre_); }
  [[nodiscard]] Vec8 x() const { return centre_ + (factor_ ? Vec8(factor_->solve_upper(now_.y)) : now_.y); }
  /// Rounding of a row at x.
  [[nodiscard]] double tolerance() const {
    return options_.feasibility + 16.0 * kEpsilon * largest_.dot(x().cwiseAbs());
  }

  /// One pass over the rows; what it finds waits to enter.
  void scan() {
    ++scans_;
    waiting_ = most_violated(constraints_, x(), tolerance());
  }

  /// The working set of a similar problem, and the length of the first proximal step.
  void begin(const ActiveSet& warm) {
    for (int k = 0; k < std::min(warm.count, kMaxVariables); ++k) {
      const ActiveSet::Entry& entry = warm.entries[static_cast<std::size_t>(k)];
      const HalfSpace h = half_space(constraints_, entry.index, entry.side);
      if (h.offset > -kUnbounded) set_.append({entry.index, entry.side}, normal_of(h), offset_of(h));
    }
    const double g = gradient_.norm();
    if (hessian_ || !(g > 0.0)) return;
    scan();
    double distance = 0.0;
    for (int k = 0; k < waiting_.count; ++k) {
      const Violations::Entry& entry = waiting_.entries[static_cast<std::size_t>(k)];
      distance = std::max(distance, entry.amount / entry.half_space.normal.norm());
    }
    const bool measured = distance > 0.0 && distance < kUnbounded;
    step_ = (measured ? kFirstStep * distance : 1.0 + centre_.norm()) / g;
  }

  /// Takes x as the centre, so that a second solve refines the first.
  void recentre() {
    centre_ = x();
    v_ = hessian_ ? factor_->solve_lower(Vec8(*hessian_ * centre_ + gradient_)) : Vec8(step_ * gradient_);
    for (int k = 0; k < set_.size(); ++k) {
      const WorkingSet::Member m = set_.member(k);
      set_.set_offset(k, offset_of(half_space(constraints_, m.index, m.side)));
    }
    now_ = set_.minimum(-v_);
  }

  /// A multiplier this small is rounding of the others.
  [[nodiscard]] double rounding() const { return kRounding * now_.multipliers.cwiseAbs().maxCoeff(); }

  /// One this small may be rounding of the terms that cancel in the gradient at the centre.
  [[nodiscard]] double negligible() const {
    if (!hessian_) return rounding();
    const Vec8 terms = hessian_->cwiseAbs() * centre_.cwiseAbs() + gradient_.cwiseAbs();
    return std::max(rounding(), kCancelled * factor_->solve_lower(terms).norm() / set_.least_own_part());
  }

  [[nodiscard]] double least_multiplier() const { return smallest(now_.multipliers, set_.size()); }

  /// What pushes the wrong way leaves, until nothing does: at most 8 times.
  void let_go() {
    while (least_multiplier() < 0.0) {
      int least = 0;
      (void)now_.multipliers.head(set_.size()).minCoeff(&least);
      leave(least, -v_);
    }
  }

  void leave(int k, const Vec8& pull) {
    set_.remove(k);
    ++changes_;
    now_ = set_.minimum(pull);
  }

  /// Rows enter until a pass finds none violated. Each turn changes the working set or ends, so that the cap on changes
  /// is one on turns.
  Status satisfy_all() {
    for (;;) {
      const bool stale = waiting_.count > 0;
      if (!stale) scan();
      if (waiting_.count == 0) return Status::ok;
      const int before = changes_;
      const Status status = work_off();
      waiting_.count = 0;
      if (status != Status::ok) return status;
      // What a new pass found and is in the working set already, is violated by rounding.
      if (changes_ == before && !stale) return Status::ok;
    }
  }

  /// The worst of the waiting rows enters, again and again.
  Status work_off() {
    for (;;) {
      if (changes_ >= options_.max_changes) return Status::iteration_cap;
      const Vec8 at = x();
      double worst = tolerance();
      int choice = -1;
      for (int k = 0; k < waiting_.count; ++k) {
        const Violations::Entry& entry = waiting_.entries[static_cast<std::size_t>(k)];
        const double amount = entry.half_space.offset - entry.half_space.normal.dot(at);
        if (!(amount > worst) || set_.find(entry.index, entry.side) >= 0) continue;
        worst = amount;
        choice = k;
      }
      if (choice < 0) return Status::ok;
      const Status status = enter(waiting_.entries[static_cast<std::size_t>(choice)]);
      if (status != Status::ok) return status;
    }
  }

  /// One row enters; those whose multiplier reaches 0 on the way leave, at most 8.
  Status enter(const Violations::Entry& entry) {
    const WorkingSet::Member member{entry.index, entry.side};
    const Vec8 normal = normal_of(entry.half_space);
    const double offset = offset_of(entry.half_space);
    double multiplier = 0.0;
    for (int k = 0; k <= kMaxVariables; ++k) {
      const WorkingSet::Split split = set_.split(normal);
      const double slope = split.rest.squaredNorm();
      const double full = slope > 0.0 ? std::max(0.0, offset - normal.dot(now_.y)) / slope : kUnbounded;
      const WorkingSet::Ratio partial = set_.first_to_leave(now_.multipliers, split.coefficients, normal.norm());
      if (full == kUnbounded && partial.member < 0) return certify(member, split.coefficients);
      if (full <= partial.step) {
        if (!set_.append(member, normal, offset)) return Status::precision_limit;
        ++changes_;
        now_ = set_.minimum(-v_);
        return Status::ok;
      }
      multiplier += partial.step;
      leave(partial.member, multiplier * normal - v_);
    }
    return Status::precision_limit;
  }

  /// Farkas: the entering normal is a combination of the members' with coefficients <= 0. Believed only where the
  /// margin is more than rounding of the combination can move it at x.
  Status certify(const WorkingSet::Member& member, const Vec8& coefficients) {
    certificate_.count = 0;
    certificate_.entries[static_cast<std::size_t>(certificate_.count++)] = {member.index, member.side, 1.0};
    for (int k = 0; k < set_.size(); ++k) {
      if (coefficients[k] >= 0.0) continue;
      const WorkingSet::Member m = set_.member(k);
      certificate_.entries[static_cast<std::size_t>(certificate_.count++)] = {m.index, m.side, -coefficients[k]};
    }
    const FarkasMargin proof = farkas_margin(constraints_, certificate_);
    const bool proven = proof.margin > 16.0 * kEpsilon * proof.terms + 8.0 * proof.combination * x().norm();
    return proven ? Status::infeasible : Status::precision_limit;
  }

  /// A quadratic minimum is one; a linear objective's where g is a combination of the active normals alone.
  [[nodiscard]] bool settled() const {
    if (hessian_) return true;
    const WorkingSet::Split split = set_.split(gradient_);
    const double scale = split.coefficients.cwiseAbs().maxCoeff();
    return split.rest.isZero(0.0) && smallest(split.coefficients, set_.size()) >= -kRounding * scale;
  }

  /// The direction in which the last proximal step went meets no bound.
  [[nodiscard]] bool falls_for_ever() const {
    const Vec8 direction = -set_.split(gradient_).rest;
    return direction.norm() > 0.0 && recedes(constraints_, direction, kRounding);
  }

  ActiveSetResult finish(Status status) {
    ActiveSetResult out;
    out.x = x();
    out.objective = gradient_.dot(out.x) + (hessian_ ? 0.5 * out.x.dot(*hessian_ * out.x) : 0.0);
    out.changes = changes_;
    out.active.count = set_.size();
    const double most = rounding(), least = -negligible();
    const double scale = hessian_ ? 1.0 : (step_ > 0.0 ? 1.0 / step_ : 0.0);
    const auto cut = [&](double multiplier) { return multiplier >= least && multiplier <= most ? 0.0 : multiplier; };
    for (int k = 0; k < set_.size(); ++k) {
      const WorkingSet::Member m = set_.member(k);
      out.active.entries[static_cast<std::size_t>(k)] = {m.index, m.side, scale * cut(now_.multipliers[k])};
    }
    out.residuals = kkt_residuals(hessian_, gradient_, constraints_, out.x, out.active);
    out.scans = scans_ + 2;
    const KktResiduals& r = out.residuals;
    const bool good = r.stationarity <= 1e-10 && r.primal <= 4.0 * tolerance() && r.least_multiplier >= 0.0;
    out.status = status == Status::ok && !good ? Status::precision_limit : status;
    if (status == Status::infeasible) out.active = certificate_;
    return out;
  }

  const Mat8* hessian_;
  const CholeskyFactor<kMaxVariables>* factor_;
  const Vec8 gradient_;
  const Constraints& constraints_;
  const ActiveSetOptions options_;
  const Vec8 largest_;

  WorkingSet set_;
  WorkingSet::Minimum now_;
  Violations waiting_;
  ActiveSet certificate_;
  Vec8 centre_ = Vec8::Zero(), v_ = Vec8::Zero();
  double step_ = 0.0;
  int changes_ = 0, scans_ = 0;
};

/// The first `count` numbers, 0 behind them.
Vec8 head(const Vec8& vector, int count) {
  Vec8 out = Vec8::Zero();
  out.head(count) = vector.head(count);
  return out;
}

}  // namespace

ActiveSetResult minimize_quadratic(const Mat8& hessian, const Vec8& gradient, const Constraints& constraints,
                                   const ActiveSet& warm, const ActiveSetOptions& options) {
  if (!well_formed(constraints) || !warm.fits(constraints)) return {.status = Status::out_of_range};
  const int n = constraints.variables;
  const RowMagnitudes rows = magnitudes(constraints);
  Mat8 padded = Mat8::Identity();
  padded.topLeftCorner(n, n) = hessian.topLeftCorner(n, n);
  const Vec8 g = head(gradient, n);
  if (!rows.usable || !padded.allFinite() || !g.allFinite()) return {.status = Status::not_finite};
  const CholeskyFactor<kMaxVariables> factor(padded);
  if (!factor.positive_definite()) return {.status = Status::not_convex};
  return Solver(&padded, &factor, g, constraints, options, rows.largest).run(Vec8::Zero(), warm);
}

ActiveSetResult minimize_linear(const Vec8& gradient, const Constraints& constraints, const Vec8& start,
                                const ActiveSet& warm, const ActiveSetOptions& options) {
  if (!well_formed(constraints) || !warm.fits(constraints)) return {.status = Status::out_of_range};
  const int n = constraints.variables;
  const RowMagnitudes rows = magnitudes(constraints);
  const Vec8 g = head(gradient, n), from = head(start, n);
  if (!rows.usable || !g.allFinite() || !from.allFinite()) return {.status = Status::not_finite};
  return Solver(nullptr, nullptr, g, constraints, options, rows.largest).run(from, warm);
}

}  // namespace bladefit
