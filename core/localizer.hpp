#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/fit/pose.hpp"
#include "core/geometry/design_image.hpp"
#include "core/inspection/tolerance_map.hpp"
#include "core/inspection/verdict.hpp"
#include "core/probe_point.hpp"
#include "core/status.hpp"

namespace bladefit {

enum class EdgePolicy : std::uint8_t { skip = 0, use = 1 };

struct LocalizerConfig {
  std::uint32_t capacity = 65536;      ///< points that keep a place; later ones are judged and counted only
  std::uint32_t refresh_per_push = 8;  ///< K: stored points projected anew in each push (2..64)
  double probe_radius_mm = 0;          ///< points are centres of a ball of this radius
  bool use_approach = true;            ///< approach vectors choose the side of the blade
  EdgePolicy edges = EdgePolicy::skip; ///< whether feet on edges and corners count in the fit
  double noise_floor_mm = 0.005;       ///< least standard deviation assumed of a distance when judging what is determined
  Pose start;                          ///< where the fit starts
  ToleranceMap tolerance;
};

enum class FitStatus : std::uint8_t { underdetermined = 0, tracking = 1, converged = 2, infeasible = 3 };

/// Figures of one region, over the points that count in the fit.
struct RegionReport {
  std::uint32_t count = 0;           ///< points of the region that count in the fit
  std::uint32_t judged_out = 0;      ///< points whose present state is out
  double rms_mm = 0;
  double worst_mm = 0;               ///< distance of largest magnitude, signed
  std::uint32_t worst_sequence = 0;  ///< 0 = no point yet
};

struct FitReport {
  FitStatus status = FitStatus::underdetermined;
  Pose pose;
  /// sigma^2 (J'J)^-1 for (w, dt) of C' = exp([w]x) C, t' = t + dt [rad, mm]; zero unless all six are determined
  Mat6 covariance = Mat6::Zero();
  std::uint32_t determined = 0;      ///< degrees of freedom, 0..6
  std::uint32_t points = 0;          ///< accepted so far
  std::uint32_t fitted = 0;          ///< of these, how many count in the fit
  std::uint32_t rejected = 0;
  double rms_mm = 0;                 ///< sqrt(sum d^2 / fitted)
  double sigma_mm = 0;               ///< sqrt(sum d^2 / (fitted - 6)); 0 below 7 points
  double smallest_eigenvalue = 0;    ///< of the scaled information matrix per point (dimensionless)
  double gradient = 0;               ///< size of the last Newton step [mm at the design's half diagonal]: the self check
  RegionReport leading_edge, rest;
  std::uint32_t revision = 0;        ///< +1 whenever the pose moves
  bool memory_full = false;
};

/// Incremental least squares of a stream of points against a design surface, in the caller's memory.
/// One thread owns it. No call allocates, locks, throws or loops without a bound.
class Localizer {
 public:
  /// Bytes that create() needs for this configuration; alignment 64.
  [[nodiscard]] static std::size_t memory_required(const LocalizerConfig& config);

  /// Builds a localizer inside `memory`, which the caller owns and releases after the last use (no destructor is
  /// needed). The memory under `design` must outlive it. Returns ok, null_argument, misaligned (64 bytes),
  /// not_enough_memory or out_of_range (a field of config).
  [[nodiscard]] static Status create(std::span<std::byte> memory, const DesignImage& design, const LocalizerConfig& config,
                                     Localizer*& localizer);

  /// Projects the point, adds it, moves the pose and judges. Bounded work, whatever came before.
  /// Returns ok, underdetermined, memory_full or duplicate; not_finite or out_of_range (approach not a unit vector or
  /// zero, sequence 0): then nothing has changed. `verdict` is written with every status >= 0 but duplicate.
  [[nodiscard]] Status push(const ProbePoint& point, Verdict& verdict);

  /// Adds the point without moving the pose: batch fits call it for every point and then refine().
  /// Statuses as push(), and out_of_range when the capacity is used up.
  [[nodiscard]] Status stage(const ProbePoint& point);

  /// Takes the next verdict that a later fit has changed. False when there is none.
  [[nodiscard]] bool next_revision(Verdict& verdict);

  /// Projects up to `max_points` stored points anew and moves the pose, until the fit has converged and every foot was
  /// checked by a global search. Returns ok (converged), underdetermined (converged in the determined directions),
  /// more_work, or iteration_cap.
  [[nodiscard]] Status refine(std::uint32_t max_points);

  [[nodiscard]] FitReport fit() const;

  /// The present verdict of a point. Returns ok or not_found (unknown sequence, or its place was given away).
  [[nodiscard]] Status verdict_of(std::uint32_t sequence, Verdict& verdict) const;

  /// Forgets all points and goes back to the start pose.
  void reset();

 private:
  Localizer() = default;
  struct State;
  friend struct LocalizerAccess;
};

}  // namespace bladefit
