#include "core/localizer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "core/localizer/check_config.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kAlignment = 64;
/// Points farther from the middle of the design than this [half diagonals] are not of this blade.
constexpr double kFarthest = 1e3;
/// A distance above its tolerance by no more than this [half diagonals] is in: a constrained optimum touches its
/// bounds.
constexpr double kTouching = 1e-11;
/// A verdict is pending while what is not determined may change the distance by more than this share of the tolerance.
constexpr double kPendingShare = 0.1;
/// Fewer fitted points than this hide their own errors: every verdict is pending.
constexpr std::uint32_t kLeastFitted = 12;
/// While the pose has moved further than this [half diagonals] since the sums in use were begun, pushes
/// refresh this many times the points: the expansions are worn out.
constexpr double kWornBeyond = 5e-4;
constexpr std::uint32_t kCatchUp = 8;
/// Where addresses have 32 bits, a large capacity needs more than that.
constexpr std::uint64_t kMoreThanThereIs = std::numeric_limits<std::size_t>::max() - 4096;

constexpr std::uint64_t rounded_up(std::uint64_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

Vec3 to_vec3(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

bool finite(const std::array<double, 3>& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

}  // namespace

std::size_t Localizer::memory_required(const LocalizerConfig& config) {
  const std::uint64_t rows = config.mode == FitMode::least_squares ? 0 : BoundedFit::kDoublesPerPoint;
  const std::uint64_t points = config.capacity;
  const std::uint64_t size = rounded_up(sizeof(Localizer)) + rounded_up(sizeof(StoredPoint) * points) +
                             2 * rounded_up(sizeof(std::uint32_t) * points) +
                             rounded_up(sizeof(double) * rows * points);
  return static_cast<std::size_t>(std::min<std::uint64_t>(size, kMoreThanThereIs));
}

Localizer::Localizer(const DesignImage& design, const LocalizerConfig& config) : surface_(design), config_(config) {
  frame_.pivot = surface_.middle();
  frame_.length = surface_.half_diagonal();
  if (config_.determined_mm == 0.0) config_.determined_mm = 1e-3 * frame_.length;
}

Status Localizer::create(std::span<std::byte> memory, const DesignImage& design, const LocalizerConfig& config,
                         Localizer*& localizer) {
  if (memory.data() == nullptr || design.patches().empty()) return Status::null_argument;
  if (reinterpret_cast<std::uintptr_t>(memory.data()) % kAlignment != 0) return Status::misaligned;
  if (check_config(config, design.patches().size())) return Status::out_of_range;
  if (memory.size() < memory_required(config)) return Status::not_enough_memory;

  std::byte* place = memory.data();
  auto* made = new (place) Localizer(design, config);
  place += rounded_up(sizeof(Localizer));
  made->points_ = reinterpret_cast<StoredPoint*>(place);
  for (std::uint32_t k = 0; k < config.capacity; ++k) new (&made->points_[k]) StoredPoint();
  place += rounded_up(sizeof(StoredPoint) * config.capacity);
  made->queue_ = reinterpret_cast<std::uint32_t*>(place);
  for (std::uint32_t k = 0; k < config.capacity; ++k) new (&made->queue_[k]) std::uint32_t(0);
  place += rounded_up(sizeof(std::uint32_t) * config.capacity);
  made->order_ = reinterpret_cast<std::uint32_t*>(place);
  for (std::uint32_t k = 0; k < config.capacity; ++k) new (&made->order_[k]) std::uint32_t(0);
  place += rounded_up(sizeof(std::uint32_t) * config.capacity);
  if (config.mode != FitMode::least_squares) {
    auto* rows = reinterpret_cast<double*>(place);
    for (std::size_t k = 0; k < BoundedFit::kDoublesPerPoint * config.capacity; ++k) new (&rows[k]) double(0);
    made->bounded_.attach(rows, config.capacity);
  }
  made->reset();
  localizer = made;
  return Status::ok;
}

void Localizer::reset() {
  pose_ = config_.start;
  settled_ = filling_ = frozen_ = FitSums();
  frozen_.model.reference = pose_;
  determination_ = Determination();
  determination_.free_directions = Mat6::Identity();
  refinement_ = Refinement();
  sigma_ = config_.noise_floor_mm;
  begin_loss();
  stop_trackers();
  concluded_ = converged_ = has_last_ = regions_held_ = exits_count_ = infeasible_ = false;
  tolerance_factor_ = smallest_tolerance_ = stationarity_ = 0;
  certificate_ = Certificate();
  unproven_ = 0;
  searches_ = revision_ = accepted_ = rejected_ = last_sequence_ = last_path_ = 0;
  judged_out_[0] = judged_out_[1] = 0;
  stored_ = next_given_up_ = fresh_count_ = active_count_ = cursor_ = queue_head_ = queue_size_ = 0;
  last_place_ = SurfacePlace();
  last_step_ = 0;
  begin_sweep();
  settled_ = current_ = filling_;
  covariance_ = unit_covariance(current_.model, determination_, 1.0);
}

Status Localizer::check(const ProbePoint& point) const {
  if (!finite(point.position) || !finite(point.approach) || !std::isfinite(point.weight)) return Status::not_finite;
  const double length = to_vec3(point.approach).norm();
  const double off = (apply(config_.start, to_vec3(point.position)) - frame_.pivot).norm();
  if (off > kFarthest * frame_.length) return Status::out_of_range;
  if (!(point.weight > 0.0)) return Status::out_of_range;
  if (point.sequence == 0 || (length != 0.0 && std::abs(length - 1.0) > 1e-3)) return Status::out_of_range;
  return point.sequence <= last_sequence_ ? Status::duplicate : Status::ok;
}

StoredPoint Localizer::made_from(const ProbePoint& point, const SurfacePlace& start) const {
  StoredPoint stored;
  stored.position = to_vec3(point.position);
  if (config_.use_approach) stored.approach = to_vec3(point.approach);
  stored.sequence = point.sequence;
  stored.weight = point.weight;
  stored.span = start.span;
  stored.foot.u = start.u;
  stored.foot.v = start.v;
  stored.outside_window = outside_window(stored);
  return stored;
}

Status Localizer::push(const ProbePoint& point, Verdict& verdict) {
  if (const Status status = check(point); status != Status::ok) return status;
  redetermine_ = redetermine_ || concluded_;
  refinement_.active = concluded_ = converged_ = regions_held_ = exits_count_ = infeasible_ = false;
  if (refinement_.further.active) {
    refinement_.further.active = false;
    begin_sweep();  // that of a start has filled no sums
  }
  StoredPoint passing = made_from(point, last_place_);
  const Measurement measurement = measure(passing, pose_, Search::past_lead);
  StoredPoint* place = store(passing, measurement);
  settle();
  const bool worn = motion_between(settled_.model.reference, pose_, frame_).norm() > kWornBeyond * frame_.length;
  refresh(worn ? kCatchUp * config_.refresh_per_push : config_.refresh_per_push);
  gather(measurement);
  solve();

  StoredPoint& own = place != nullptr ? *place : passing;
  if (place == nullptr) note(passing, measurement);
  if (place != nullptr && tracker_.active())
    look_at(static_cast<std::uint32_t>(place - points_), measure(own, pose_, Search::past_lead));
  follow_bounds();
  note(own, measure(own, pose_, Search::past_lead));
  judge(own);
  own.told_state = own.state;
  own.told_action = own.action;
  verdict = verdict_from(own);
  if (place == nullptr) return Status::memory_full;
  return determination_.rank == 6 ? Status::ok : Status::underdetermined;
}

void Localizer::conclude() {
  concluded_ = redetermine_ = true;
  const bool sought_on = config_.mode != FitMode::least_squares && config_.further_starts > 0;
  if (sought_on && !refinement_.further.done) converged_ = false;
}

void Localizer::count_verdict(const StoredPoint& point, int sign) {
  const auto one = static_cast<std::uint32_t>(sign);
  if (point.state == PointState::out) judged_out_[static_cast<std::size_t>(point.region)] += one;
  if (point.state == PointState::rejected) rejected_ += one;
}

void Localizer::judge(StoredPoint& point) {
  if (point.tolerance != 0.0) count_verdict(point, -1);
  const Foot& foot = point.foot;
  if (!regions_held_) {
    point.region = region_at(config_.tolerance, foot.patch, foot.u, foot.v);
    point.tolerance = tolerance_at(config_.tolerance, foot.patch, foot.u, foot.v);
  }
  Vec6 gradient;
  gradient.head<3>() = (apply(pose_, point.position) - frame_.pivot).cross(foot.normal) / frame_.length;
  gradient.tail<3>() = foot.normal;
  point.uncertainty = sigma_ * std::sqrt(std::max(0.0, gradient.dot(covariance_ * gradient)));

  const double free =
      (determination_.free_directions.transpose() * gradient).norm() * kStartUncertainty * frame_.length;
  const double share = kPendingShare * (std::isfinite(point.tolerance) ? point.tolerance : config_.determined_mm);
  point.action = Action::none;
  if (left_out(point, foot)) {
    point.state = PointState::rejected;
  } else if (free > share || (current_.model.count < kLeastFitted && !concluded_)) {
    point.state = PointState::pending;
  } else if (std::abs(foot.distance) > point.tolerance + kTouching * frame_.length) {
    point.state = PointState::out;
    point.action = foot.distance > 0.0 ? Action::cut : Action::weld;
  } else {
    point.state = PointState::in;
  }
  count_verdict(point, +1);
}

}  // namespace bladefit
