#include "core/localizer.hpp"

#include <algorithm>
#include <limits>
#include <new>

#include "core/localizer/check_config.hpp"
#include "core/localizer/fit_report.hpp"
#include "core/localizer/localizer_memory.hpp"

namespace bladefit {
namespace {

/// Where addresses have 32 bits, a large capacity needs more than that.
constexpr std::uint64_t kMoreThanThereIs = std::numeric_limits<std::size_t>::max() - 4096;

/// The pose is at rest: at the optimum over all points, or while they come near enough to it not to change a verdict.
bool settled(const LocalizerParts& p) {
  if (p.refinement.phase() == RefinementPhase::done) return true;
  if (p.plan.bounded()) return false;  // a later point that does not fit moves its pose far
  const ToleranceMap& map = p.problem.config.tolerance;
  const double tightest = std::min(tightest_of(map, Region::leading_edge), tightest_of(map, Region::rest));
  return p.sums.moved_to(p.estimate.pose()) <= tuning::kRestShare * tightest;
}

/// `at_rest`: what settled() says, which many points share.
Evidence evidence_of(const LocalizerParts& p, bool at_rest) {
  const std::uint32_t spare = 6 - p.estimate.determination().locked + tuning::kLeastSpare;
  return {p.estimate, p.sums.model().count >= (p.stream.concluded ? spare : tuning::kLeastJudged), at_rest};
}

Evidence evidence_of(const LocalizerParts& p) { return evidence_of(p, settled(p)); }

Status check(const LocalizerParts& p, const ProbePoint& point) {
  if (const Status status = p.problem.check(point); status != Status::ok) return status;
  return point.sequence <= p.stream.last_sequence ? Status::duplicate : Status::ok;
}

/// A point has come: what was found over those before it is open again.
void reopen(LocalizerParts& p) {
  p.refinement.interrupt();
  p.selection.by_foot();
  p.optimum.infeasible = false;
}

void count_in(LocalizerParts& p, const StoredPoint& point, const Measurement& m) {
  p.stream.last_sequence = point.sequence;
  p.stream.last_place = m.place;
  ++p.stream.accepted;
}

/// Gives the point a place in memory, where there is none that of another one if it is of the leading edge. Returns its
/// index; size() of the store where it found none.
std::uint32_t take_in(LocalizerParts& p, const StoredPoint& point, const Measurement& m) {
  count_in(p, point, m);
  p.stream.displaced = 0;
  std::uint32_t index = p.store.size();
  if (!p.store.full()) {
    p.store.append(point);
  } else {
    const bool judged = !p.selection.left_out(point, m.foot) || m.foot.border == FootBorder::joint;
    const bool of_edge = judged && p.problem.region_of(m.foot) == Region::leading_edge;
    if (of_edge) index = p.store.next_to_evict([&p](std::uint32_t i) { return p.stream_optimum.holds(i); });
    if (index == p.store.size()) {
      p.sums.take_in_passing(point, m, p.estimate.pose());
      return index;
    }
    p.sums.evict(p.store[index], index, p.estimate.pose());
    p.stream.displaced = p.store[index].sequence;
    p.store.replace(index, point);
  }
  p.store.record(p.store[index], m, p.estimate.revision());
  p.sums.take_in(p.store, index, p.estimate);
  return index;
}

/// The mode's programs after a new point: the pose becomes their solution. `index`: of the new point, where it is
/// stored.
void follow_mode(LocalizerParts& p, std::uint32_t index) {
  if (!p.plan.bounded()) return;
  const Pose before = p.estimate.pose();
  if (index < p.store.size() && p.stream_optimum.leads())
    p.stream_optimum.look_at(p.store, index, p.finder.find(p.store[index], before, Search::past_margin));
  p.stream_optimum.follow(p.store, p.sums.model(), p.estimate, p.optimum);
  if (!p.stream_optimum.leads()) return;
  const Pose& pose = p.stream_optimum.pose(p.optimum);
  if (motion_between(before, pose, p.problem.frame).norm() > 0.0) p.estimate.move_to(pose);
}

void stage_made(LocalizerParts& p, const StoredPoint& made, Search search) {
  reopen(p);
  p.stream_optimum.stop();
  p.estimate.redetermine();
  p.sums.settle_all(p.store, p.estimate);
  if (p.sums.cursor() > 0) p.sums.begin_sweep(p.estimate.pose());  // points that wait for its end are in no sums of it
  const Measurement m = p.finder.find(made, p.estimate.pose(), search);
  count_in(p, made, m);
  StoredPoint& own = p.store[p.store.append(made)];
  p.store.record(own, m, p.estimate.revision());
  p.sums.take_in_staged(own, m, p.estimate.pose());
  p.verdicts.judge_new(own, evidence_of(p));
}

}  // namespace

std::array<MemoryPart, 9> Localizer::memory_parts(const LocalizerConfig& config) { return parts_in_memory(config); }

std::size_t Localizer::memory_required(const LocalizerConfig& config) {
  std::uint64_t size = 0;
  for (const MemoryPart& part : memory_parts(config)) size += part.size;
  return static_cast<std::size_t>(std::min<std::uint64_t>(size, kMoreThanThereIs));
}

Status Localizer::create(std::span<std::byte> memory, const DesignImage& design, const LocalizerConfig& config,
                         Localizer*& localizer) {
  if (memory.data() == nullptr || design.patches().empty()) return Status::null_argument;
  if (reinterpret_cast<std::uintptr_t>(memory.data()) % kBlockAlignment != 0) return Status::misaligned;
  if (check_config(config, design.patches().size())) return Status::out_of_range;
  if (memory.size() < memory_required(config)) return Status::not_enough_memory;

  localizer = new (memory.data()) Localizer(build_parts(memory.data() + rounded_up(sizeof(Localizer)), design, config));
  localizer->reset();
  return Status::ok;
}

Status Localizer::set_tolerance(const ToleranceMap& map) {
  const DesignImage design = parts_->problem.surface.image();
  LocalizerConfig wanted = config();
  wanted.tolerance = map;
  if (parts_->stream.accepted > 0 || check_config(wanted, design.patches().size())) return Status::out_of_range;
  parts_ = &build_parts(reinterpret_cast<std::byte*>(parts_), design, wanted);
  reset();
  return Status::ok;
}

const LocalizerConfig& Localizer::config() const { return parts_->problem.config; }

std::size_t Localizer::patches() const { return parts_->problem.surface.image().patches().size(); }

void Localizer::reset() {
  LocalizerParts& p = *parts_;
  p.store.clear();
  p.selection.by_foot();
  p.loss.restart();
  p.sums.clear(p.problem.config.start);
  p.estimate.reset(p.sums.model());
  p.verdicts.clear();
  p.optimum = ModeOptimum();
  p.stream_optimum.stop();
  p.refinement.clear();
  p.stream = StreamState();
}

Status Localizer::push(const ProbePoint& point, Verdict& verdict) {
  LocalizerParts& p = *parts_;
  if (const Status status = check(p, point); status != Status::ok) return status;
  if (p.stream.concluded) p.estimate.redetermine();
  p.stream.concluded = false;
  reopen(p);

  StoredPoint passing = p.finder.new_point(point, p.stream.last_place);
  const Measurement measured = p.finder.find(passing, p.estimate.pose(), Search::past_margin);
  const std::uint32_t index = take_in(p, passing, measured);
  const bool stored = index < p.store.size();
  StoredPoint& own = stored ? p.store[index] : passing;

  bool at_rest = settled(p);
  const auto review = [&p, &at_rest](std::uint32_t i, const Measurement& m) {
    p.store.record(p.store[i], m, p.estimate.revision());
    p.stream_optimum.look_at(p.store, i, m);
    p.verdicts.judge_again(p.store, i, evidence_of(p, at_rest));
  };
  p.sums.settle(p.store, p.estimate);
  const bool stale = p.sums.moved_to(p.estimate.pose()) > tuning::kStaleBeyond * p.problem.frame.length;
  const std::uint32_t budget = p.problem.config.refresh_per_push * (stale ? tuning::kCatchUp : 1);
  if (p.sums.refresh(p.store, p.estimate, budget, review)) {
    p.estimate.redetermine();
    at_rest = settled(p);
  }
  p.sums.gather(p.store, p.estimate.pose(), point.sequence, measured, review);

  const Minimum minimum =
      p.estimate.minimum_of(p.sums.model(), p.loss, p.stream.concluded, PoseEstimate::Undetermined::to_start);
  p.estimate.know(minimum);
  if (!p.stream_optimum.leads()) p.estimate.move_to(minimum.pose);
  if (!stored) p.store.record(passing, measured, p.estimate.revision());
  follow_mode(p, index);

  p.store.record(own, p.finder.find(own, p.estimate.pose(), Search::past_margin), p.estimate.revision());
  p.verdicts.judge_new(own, evidence_of(p));
  verdict = bladefit::verdict_of(own);
  if (!stored) return Status::memory_full;
  return p.estimate.determined() ? Status::ok : Status::underdetermined;
}

Status Localizer::stage(const ProbePoint& point) {
  LocalizerParts& p = *parts_;
  if (const Status status = check(p, point); status != Status::ok) return status;
  if (p.store.full()) return Status::out_of_range;
  stage_made(p, p.finder.new_point(point, p.stream.last_place), Search::always);
  return Status::ok;
}

Status Localizer::stage_from(const ProbePoint& point, const SurfacePlace& start) {
  LocalizerParts& p = *parts_;
  if (const Status status = check(p, point); status != Status::ok) return status;
  if (p.store.full() || !p.problem.on_design(start)) return Status::out_of_range;
  StoredPoint made = p.finder.new_point(point, start);
  made.runner_up.margin = std::numeric_limits<double>::infinity();  // no motion makes the foot doubtful
  stage_made(p, made, Search::if_doubtful);
  return Status::ok;
}

Status Localizer::refine(std::uint32_t max_points) {
  LocalizerParts& p = *parts_;
  if (p.store.size() == 0) return Status::underdetermined;
  if (p.refinement.phase() == RefinementPhase::done) return Status::ok;
  if (p.refinement.phase() == RefinementPhase::idle) {
    p.stream_optimum.stop();
    p.refinement.begin(p.stream.concluded, p.optimum);
  }
  const Status status = p.refinement.advance(max_points, p.stream.concluded, p.optimum);
  if (status == Status::more_work) return status;
  const Evidence evidence = evidence_of(p);
  for (std::uint32_t i = 0; i < p.store.size(); ++i) p.verdicts.judge_again(p.store, i, evidence);
  if (status == Status::ok && p.plan.bounded()) p.stream_optimum.begin(p.store, p.estimate.pose(), 1);
  return status;
}

void Localizer::conclude() {
  LocalizerParts& p = *parts_;
  p.stream.concluded = true;
  p.estimate.redetermine();
  const bool sought_on = p.plan.bounded() && p.problem.config.further_starts > 0;
  const bool converged = p.refinement.phase() == RefinementPhase::done;
  if (converged && sought_on && !p.refinement.further_starts().done()) p.refinement.interrupt();
}

bool Localizer::next_revision(Verdict& verdict) { return parts_->verdicts.next_revision(parts_->store, verdict); }

Status Localizer::verdict_of(std::uint32_t sequence, Verdict& verdict) const {
  const PointStore& points = parts_->store;
  const std::uint32_t index = points.find(sequence);
  if (index == points.size()) return Status::not_found;
  verdict = bladefit::verdict_of(points[index]);
  return Status::ok;
}

Status Localizer::judge_aside(const ProbePoint& point, Verdict& verdict) const {
  LocalizerParts& p = *parts_;
  if (const Status status = p.problem.check(point); status != Status::ok) return status;
  StoredPoint passing = p.finder.new_point(point, p.stream.last_place);
  const Measurement measured = p.finder.find(passing, p.estimate.pose(), Search::always);
  p.store.record(passing, measured, p.estimate.revision());
  p.verdicts.judge_aside(passing, evidence_of(p));
  verdict = bladefit::verdict_of(passing);
  return Status::ok;
}

std::uint32_t Localizer::displaced() const { return parts_->stream.displaced; }

FitReport Localizer::fit() const { return report_of(*parts_); }

}  // namespace bladefit
