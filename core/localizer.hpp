#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/fit/fit_mode.hpp"
#include "core/fit/loss.hpp"
#include "core/fit/motion_lock.hpp"
#include "core/fit/point_policy.hpp"
#include "core/fit/pose.hpp"
#include "core/geometry/surface/surface.hpp"
#include "core/inspection/decision.hpp"
#include "core/inspection/tolerance_map.hpp"
#include "core/inspection/verdict.hpp"
#include "core/probe_point.hpp"
#include "core/status.hpp"

namespace bladefit {

struct LocalizerConfig {
  /// Points that are stored, so that their feet follow the pose. Further points are judged and counted, and their rows
  /// stay in the sums as they were; a point of the leading edge takes the place of an older one of the rest.
  std::uint32_t capacity = 65536;
  std::uint32_t refresh_per_push = 8;  ///< K: stored points projected again in each push (2..64)
  double probe_radius_mm = 0;          ///< points are centres of a ball of this radius
  bool use_approach = true;            ///< approach vectors choose the side of the blade
  EdgePolicy edges = EdgePolicy::skip;
  double noise_floor_mm = 0.005;  ///< least standard deviation of a distance assumed in judging what is determined
  /// Largest standard uncertainty of a determined direction, at the half diagonal of the design; 0 = a thousandth of
  /// the half diagonal.
  double determined_mm = 0;
  Pose start;              ///< where the fit starts
  double window_low = 0;   ///< points whose foot at the start pose has u or v below this are rejected
  double window_high = 1;  ///< or above this (thesis 7: 0.05 and 0.95)
  ToleranceMap tolerance;
  Decision decision;
  /// While points come in, the pose is that of the mode over the points looked at so far, once all six degrees of
  /// freedom are determined; refine() makes it the optimum over all.
  FitMode mode = FitMode::least_squares;
  double ratio = 10;  ///< min_tolerance: tolerance of the rest / that of the leading edge
  RegionPolicy regions = RegionPolicy::follow;
  std::uint8_t locked = 0;  ///< degrees of freedom that keep their value of the start pose: bits of motion_lock.hpp
  /// Robust loss of a least-squares fit. Pushes are without it while loss_scale_mm is 0: then refine() finds the scale,
  /// 1.4826 times the median distance at the optimum.
  Loss loss = Loss::none;
  double loss_scale_mm = 0;  ///< standard deviation of good points
  /// Number of additional starting poses (0..12) that modes beside least squares try once the stream is concluded; the
  /// best optimum is kept.
  std::uint32_t further_starts = 12;
};

enum class FitStatus : std::uint8_t { underdetermined = 0, tracking = 1, converged = 2, infeasible = 3 };

/// Why refine() has ended without convergence.
enum class FitEnd : std::uint8_t {
  none = 0,              ///< it has converged, or is not done
  sweeps_used_up = 1,    ///< the pose has not come to rest
  feet_changing = 2,     ///< feet change from side to side of the blade with every pose
  regions_restless = 3,  ///< feet move between regions, so that tolerances change with every pose
  program_failed = 4,    ///< the mode's program has no solution to working precision
  feet_unproven = 5      ///< the search of a foot met its cap
};

/// The words of the ends in results, in the order of their values.
inline constexpr std::array<std::string_view, 6> kFitEndWords = {
    "none", "sweeps_used_up", "feet_changing", "regions_restless", "program_failed", "feet_unproven"};

constexpr std::string_view word_of(FitEnd end) { return kFitEndWords[static_cast<std::size_t>(end)]; }

/// Figures of one region, over the points that count in the fit.
struct RegionReport {
  std::uint32_t count = 0;       ///< points of the region that count in the fit
  std::uint32_t judged_out = 0;  ///< points whose present state is out
  double rms_mm = 0;
  double worst_mm = 0;               ///< distance of largest magnitude, signed
  std::uint32_t worst_sequence = 0;  ///< 0 = no point yet
};

struct FitReport {
  FitStatus status = FitStatus::underdetermined;
  Pose pose;
  /// sigma^2 (J'J)^-1 for (w, dt) of C' = exp([w]x) C, t' = t + dt [rad, mm]; zero unless all six are determined
  Mat6 covariance = Mat6::Zero();
  std::uint32_t determined = 0;  ///< degrees of freedom that the points determine, 0..free
  std::uint32_t free = 6;        ///< degrees of freedom that are not locked
  std::uint32_t points = 0;      ///< accepted so far
  std::uint32_t fitted = 0;      ///< of these, how many count in the fit
  std::uint32_t rejected = 0;
  /// sqrt(sum w d^2 / sum w); with a loss, of 2 w rho(d) and its weights
  double rms_mm = 0;
  /// Standard deviation of a distance of weight 1: sqrt(sum w d^2 / (fitted - free)), with a loss its scale; 0 below 7
  /// points.
  double sigma_mm = 0;
  double loss_scale_mm = 0;        ///< of the robust loss in use; 0: none
  double smallest_eigenvalue = 0;  ///< of the scaled information matrix per point (dimensionless)
  double gradient = 0;             ///< size of the last Newton step [mm at the design's half diagonal]: the self check
  RegionReport leading_edge, rest;
  /// Optimum of the mode: minimax max |d|, range max d - min d, min_tolerance the smallest leading-edge tolerance;
  /// where constrained is infeasible, the smallest leading-edge tolerance that is not, the ratio kept, or where there
  /// is none the smallest tolerance of the rest [mm]. 0 until known.
  double mode_value_mm = 0;
  /// Smallest leading-edge tolerance that some pose meets, the ratio kept (with zones the tightest one of the leading
  /// edge, or where it has none of the rest, all multiplied by the same factor), from min_tolerance and constrained
  /// [mm]. 0 until known, and where the least-squares optimum meets the tolerances: then it is not sought.
  double smallest_tolerance_mm = 0;
  Certificate certificate;  ///< of that optimum; no points in least squares, range and a feasible constrained fit
  double stationarity = 0;  ///< of its Karush-Kuhn-Tucker conditions, relative: the self check of the mode
  std::uint32_t further_starts = 0;  ///< from how many other poses the optimum was sought again
  std::uint32_t same_optimum = 0;    ///< how many of these led to the same one; the others to worse ones
  FitEnd ended = FitEnd::none;
  /// Points whose foot would lie elsewhere beyond the pose, farther away, since it would no longer face the probe: the
  /// mode's optimum rests on so many limits of that kind beside its certificate.
  std::uint32_t held_feet = 0;
  /// Feet whose search met its cap in the last sweep of refine(): then it is not converged.
  std::uint32_t unproven = 0;
  std::uint32_t searches = 0;  ///< global searches for the feet of stored points so far, those for a window left out
  std::uint32_t revision = 0;  ///< +1 whenever the pose moves
  bool memory_full = false;
  /// The mode's optimum still moves, or not every point has been looked at since it did. Never in least squares.
  bool improving = false;
};

struct LocalizerParts;

/// A part of the memory of a localizer.
struct MemoryPart {
  std::string_view name;
  std::uint64_t size = 0;  ///< bytes, with what fills them up to the alignment
};

/// Incremental least squares of a stream of points against a design surface, in the caller's memory.
/// One thread owns it. No call allocates, locks, throws or loops without a bound.
class Localizer {
 public:
  /// Bytes that create() needs for this configuration; alignment 64.
  [[nodiscard]] static std::size_t memory_required(const LocalizerConfig& config);

  /// What they are made of, in the order of their addresses. On a processor with addresses of 32 bits some are smaller.
  [[nodiscard]] static std::array<MemoryPart, 9> memory_parts(const LocalizerConfig& config);

  /// Builds a localizer inside `memory`, which the caller owns and releases after the last use (no destructor is
  /// needed). The memory under `design` must outlive it. Returns ok, null_argument, misaligned (64 bytes),
  /// not_enough_memory or out_of_range (a field of config).
  [[nodiscard]] static Status create(std::span<std::byte> memory, const DesignImage& design,
                                     const LocalizerConfig& config, Localizer*& localizer);

  /// Other tolerances than those of create(), before the first point or after reset(). Returns ok; out_of_range (a
  /// field of `map`, or there are points): then nothing has changed. Cost: linear in the capacity.
  [[nodiscard]] Status set_tolerance(const ToleranceMap& map);

  [[nodiscard]] const LocalizerConfig& config() const;
  /// Of the design.
  [[nodiscard]] std::size_t patches() const;

  /// Projects the point, adds it, moves the pose and judges. Bounded work, whatever came before.
  /// Returns ok, underdetermined, memory_full or duplicate; not_finite or out_of_range (approach not a unit vector or
  /// zero, sequence 0): then nothing has changed. `verdict` is written with every status >= 0 but duplicate.
  [[nodiscard]] Status push(const ProbePoint& point, Verdict& verdict);

  /// Adds the point without moving the pose: batch fits call it for every point and then refine().
  /// Statuses as push(), and out_of_range when the capacity is used up.
  [[nodiscard]] Status stage(const ProbePoint& point);

  /// The same with a first foot found by Newton's method from `start` alone, so it may be another local minimum than
  /// the nearest: it is tracked as it is until the last sweep of refine() proves every foot. It is searched
  /// at once where it ends on an edge or does not face the probe. With a window every point is searched for that.
  /// Statuses as stage(), and out_of_range where `start` is not a place of the design.
  [[nodiscard]] Status stage_from(const ProbePoint& point, const SurfacePlace& start);

  /// Takes the next verdict that a later fit has changed. False when there is none.
  [[nodiscard]] bool next_revision(Verdict& verdict);

  /// Projects up to `max_points` stored points again and moves the pose, until it stands still and a global search of
  /// every foot there has found no other. Returns ok (converged), underdetermined (converged in the determined
  /// directions), more_work (call again), or iteration_cap (the report says how far it came).
  [[nodiscard]] Status refine(std::uint32_t max_points);

  /// Marks the stream as complete: refine() then solves for every direction that the data constrain, however weakly.
  /// The next push() reopens the stream. Cost: constant.
  void conclude();

  /// The fit as it stands. Cost: constant.
  [[nodiscard]] FitReport fit() const;

  /// The present verdict of a point. Returns ok or not_found (unknown sequence, or it lost its place). Cost:
  /// logarithmic.
  [[nodiscard]] Status verdict_of(std::uint32_t sequence, Verdict& verdict) const;

  /// Judges a point that has no place, such as one that lost it, at the present pose, and changes nothing but the
  /// count of searches. Returns ok; not_finite or out_of_range as push(). Cost: a search for its foot.
  [[nodiscard]] Status judge_aside(const ProbePoint& point, Verdict& verdict) const;

  /// Sequence of the point that lost its place to that of the last push(); 0 = none did. Cost: constant.
  [[nodiscard]] std::uint32_t displaced() const;

  /// Forgets all points and goes back to the start pose.
  void reset();

 private:
  explicit Localizer(LocalizerParts& parts) : parts_(&parts) {}

  LocalizerParts* parts_;  ///< behind it in the caller's memory
};

}  // namespace bladefit
