#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/fit/loss.hpp"
#include "core/fit/point_policy.hpp"
#include "core/fit/pose.hpp"
#include "core/fit/pose_solver.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "core/inspection/tolerance_map.hpp"
#include "core/inspection/verdict.hpp"
#include "core/localizer/measurement.hpp"
#include "core/localizer/refinement.hpp"
#include "core/localizer/stored_point.hpp"
#include "core/probe_point.hpp"
#include "core/programs/bound_tracker.hpp"
#include "core/programs/bounded_fit.hpp"
#include "core/status.hpp"

namespace bladefit {

struct LocalizerConfig {
  /// Points that keep a place, where their feet follow the pose. Beyond it points are judged and counted, and their
  /// rows stay in the sums as they were; a point of the leading edge takes the place of an older one of the rest.
  std::uint32_t capacity = 65536;
  std::uint32_t refresh_per_push = 8;   ///< K: stored points projected anew in each push (2..64)
  double probe_radius_mm = 0;           ///< points are centres of a ball of this radius
  bool use_approach = true;             ///< approach vectors choose the side of the blade
  EdgePolicy edges = EdgePolicy::skip;  ///< whether feet on edges and corners count in the fit
  double noise_floor_mm = 0.005;  ///< least standard deviation assumed of a distance when judging what is determined
  double determined_mm = 0;       ///< largest standard uncertainty of a determined direction, at the design's half
                                  ///< diagonal; 0 = a thousandth of the half diagonal
  Pose start;                     ///< where the fit starts
  double window_low = 0;          ///< points whose foot at the start pose has u or v below this are rejected
  double window_high = 1;         ///< or above this (thesis 7: 0.05 and 0.95)
  ToleranceMap tolerance;
  /// While points come in, the pose is that of the mode over the points looked at so far, once all six degrees of
  /// freedom are determined; refine() makes it the optimum over all.
  FitMode mode = FitMode::least_squares;
  double ratio = 10;  ///< min_tolerance: tolerance elsewhere / that at the leading edge
  RegionPolicy regions = RegionPolicy::follow;
  std::uint8_t locked = 0;  ///< degrees of freedom that keep their value of the start pose: bits of motion_lock.hpp
  /// Robust loss of a least-squares fit. Pushes are without it while loss_scale_mm is 0: then refine() finds the scale,
  /// 1.4826 times the median distance at the optimum.
  Loss loss = Loss::none;
  double loss_scale_mm = 0;  ///< standard deviation of good points
  /// Modes beside least squares have several optima. Once they have found one, and no more points come, they start
  /// so many times again from elsewhere (0..12) and keep the best.
  std::uint32_t further_starts = 12;
};

enum class FitStatus : std::uint8_t { underdetermined = 0, tracking = 1, converged = 2, infeasible = 3 };

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
  std::uint32_t determined = 0;  ///< degrees of freedom, 0..6
  std::uint32_t points = 0;      ///< accepted so far
  std::uint32_t fitted = 0;      ///< of these, how many count in the fit
  std::uint32_t rejected = 0;
  /// sqrt(sum w d^2 / sum w); with a loss, of 2 w rho(d) and its weights
  double rms_mm = 0;
  double sigma_mm =
      0;  ///< of a distance of weight 1: sqrt(sum w d^2 / (fitted - free)), with a loss its scale; 0 below 7 points
  double loss_scale_mm = 0;        ///< of the robust loss in use; 0: none
  double smallest_eigenvalue = 0;  ///< of the scaled information matrix per point (dimensionless)
  double gradient = 0;             ///< size of the last Newton step [mm at the design's half diagonal]: the self check
  RegionReport leading_edge, rest;
  /// Optimum of the mode: minimax max |d|, range max d - min d, min_tolerance the smallest leading-edge tolerance;
  /// where constrained is infeasible, the smallest leading-edge tolerance that is not, the ratio kept, or where there
  /// is none the smallest tolerance of the rest [mm]. 0 until known.
  double tolerance_factor_mm = 0;
  /// Smallest leading-edge tolerance that some pose meets, the ratio kept, from min_tolerance and constrained; 0 until
  /// known [mm].
  double smallest_tolerance_mm = 0;
  Certificate certificate;  ///< of that optimum; no points in least squares, range and a feasible constrained fit
  double stationarity = 0;  ///< of its Karush-Kuhn-Tucker conditions, relative: the self check of the mode
  std::uint32_t further_starts = 0;  ///< from how many other poses the optimum was sought again
  std::uint32_t same_optimum = 0;    ///< how many of these led to the same one; the others to worse ones
  std::uint32_t unproven =
      0;  ///< feet whose search met its cap in the last sweep of refine(): then it is not converged
  std::uint32_t searches = 0;  ///< global searches for the feet of stored points so far, those for a window left out
  std::uint32_t revision = 0;  ///< +1 whenever the pose moves
  bool memory_full = false;
  /// The mode's optimum still moves, or not every point has been looked at since it did. Never in least squares.
  bool improving = false;
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
  [[nodiscard]] static Status create(std::span<std::byte> memory, const DesignImage& design,
                                     const LocalizerConfig& config, Localizer*& localizer);

  /// Projects the point, adds it, moves the pose and judges. Bounded work, whatever came before.
  /// Returns ok, underdetermined, memory_full or duplicate; not_finite or out_of_range (approach not a unit vector or
  /// zero, sequence 0): then nothing has changed. `verdict` is written with every status >= 0 but duplicate.
  [[nodiscard]] Status push(const ProbePoint& point, Verdict& verdict);

  /// Adds the point without moving the pose: batch fits call it for every point and then refine().
  /// Statuses as push(), and out_of_range when the capacity is used up.
  [[nodiscard]] Status stage(const ProbePoint& point);

  /// The same with a first foot found by Newton's method from `start` alone, so it may be another local minimum than
  /// the nearest: it is tracked as it is until the last sweep of refine() searches every foot globally. It is searched
  /// at once where it ends on an edge or does not face the probe. With a window every point is searched for that.
  /// Statuses as stage(), and out_of_range where `start` is not a place of the design.
  [[nodiscard]] Status stage_from(const ProbePoint& point, const SurfacePlace& start);

  /// Takes the next verdict that a later fit has changed. False when there is none.
  [[nodiscard]] bool next_revision(Verdict& verdict);

  /// Projects up to `max_points` stored points anew and moves the pose, until it stands still and every foot has
  /// been searched globally there, to within how exact a search is, and no other found. Returns ok (converged),
  /// underdetermined (converged in the determined directions), more_work, or iteration_cap.
  [[nodiscard]] Status refine(std::uint32_t max_points);

  /// No more points will come: from here on refine() uses every direction the points determine at all, however weakly.
  /// The next push() takes it back. Cost: constant.
  void conclude();

  [[nodiscard]] FitReport fit() const;

  /// The present verdict of a point. Returns ok or not_found (unknown sequence, or its place was given away).
  [[nodiscard]] Status verdict_of(std::uint32_t sequence, Verdict& verdict) const;

  /// Forgets all points and goes back to the start pose.
  void reset();

 private:
  Localizer(const DesignImage& design, const LocalizerConfig& config);

  static constexpr std::uint32_t kFreshPlaces = 16;
  /// Start poses are assumed right to within this [half diagonals] when a direction is not determined yet.
  static constexpr double kStartUncertainty = 0.01;

  [[nodiscard]] Status check(const ProbePoint& point) const;
  [[nodiscard]] bool outside_window(const StoredPoint& point) const;
  [[nodiscard]] bool left_out(const StoredPoint& point, const Foot& foot) const;
  /// When the foot of a stored point is searched globally, and not only tracked from where it was.
  enum class Search : std::uint8_t {
    if_doubtful,  ///< where tracking ends on an edge, on no minimum or averted from the probe
    past_lead,    ///< there too, and where the point has moved so far that a rival may be nearer; finds a new lead
    always
  };
  [[nodiscard]] Measurement measure(const StoredPoint& point, const Pose& pose, Search search) const;
  void track(LaneBlock& block, std::span<const std::uint32_t> indices, const Vec6& x) const;
  [[nodiscard]] Measurement measure(const LaneBlock& block, std::uint32_t lane, Search search) const;
  void examine(const StoredPoint& point, const Pose& pose, Search search, Measurement& m) const;
  [[nodiscard]] DistanceRow row_of(const Measurement& m, const Vec6& x) const;
  void add_row(FitSums& sums, const StoredPoint& point, const Measurement& m, const DistanceRow& row,
               const Vec6& x) const;
  [[nodiscard]] bool same_foot(const Vec3& a, const Vec3& b) const;
  [[nodiscard]] bool weigh_rival(const StoredPoint& point, const ProjectionQuery& query, Measurement& m) const;
  [[nodiscard]] Search sweep_search(const StoredPoint& point) const;
  [[nodiscard]] StoredPoint made_from(const ProbePoint& point, const SurfacePlace& start) const;
  void stage(const StoredPoint& passing, Search search);
  void count_in(const StoredPoint& point, const Measurement& measurement);
  StoredPoint* store(const StoredPoint& point, const Measurement& measurement);
  StoredPoint* keep(std::uint32_t index, const StoredPoint& point, const Measurement& measurement);
  [[nodiscard]] std::uint32_t place_to_give_up();
  void give_up(std::uint32_t index);
  void note(StoredPoint& point, const Measurement& measurement);
  void judge(StoredPoint& point);
  void count_verdict(const StoredPoint& point, int sign);
  void include(FitSums& sums, const StoredPoint& point, const Measurement& measurement, const Vec6& x) const;
  void make_fresh(std::uint32_t index);
  void settle_one(std::uint32_t place);
  void settle();
  void settle_all();
  void review(std::uint32_t index, const Measurement& measurement);
  void rejudge(std::uint32_t index);
  [[nodiscard]] bool contested(const StoredPoint& point) const;
  void include(FitSums& sums, const StoredPoint& point, const Measurement& measurement) const;
  void gather(const Measurement& newest);
  void begin_sweep();
  void refresh(std::uint32_t budget);
  double solve();
  [[nodiscard]] bool visit_next(std::uint32_t count, Status& status);
  void visit(const Measurement& measurement);
  [[nodiscard]] bool finish_refine_sweep(Status& status);
  [[nodiscard]] bool proven_already() const;
  [[nodiscard]] bool retreat();
  [[nodiscard]] Status least_squares_step();
  void begin_loss();
  [[nodiscard]] bool adapt_loss();
  [[nodiscard]] double robust_scale() const;
  [[nodiscard]] FitMode first_stage() const;
  void begin_bounded(FitMode mode);
  [[nodiscard]] double bound_weight(const Foot& foot) const;
  [[nodiscard]] double bound_unit() const;
  void stop_trackers();
  [[nodiscard]] double middle_distance(std::uint32_t stride) const;
  void begin_trackers(std::uint32_t stride);
  void look_at(std::uint32_t index, const Measurement& m);
  [[nodiscard]] bool follow(BoundTracker& tracker);
  void follow_bounds();
  void tell_bounds();
  void name_points(Certificate& certificate) const;
  [[nodiscard]] bool improving() const;
  [[nodiscard]] Status bounded_step();
  [[nodiscard]] Status bounded_optimum();
  void certify();
  [[nodiscard]] double reach() const { return 0.05 * frame_.length; }  ///< longest step of a program
  void plan_further_starts();
  [[nodiscard]] bool begin_further_starts(double own_value);
  void begin_start();
  [[nodiscard]] bool visit_from_start(Status& status);
  void finish_start_sweep();
  void end_start(double value);
  [[nodiscard]] bool end_further_starts(Status& status);
  [[nodiscard]] bool go_back();
  [[nodiscard]] bool seek_better(double value);
  [[nodiscard]] bool go_elsewhere();
  [[nodiscard]] FitMode sought_mode() const;
  [[nodiscard]] double assign_regions();
  void include_row(std::uint32_t index, const DistanceRow& row);
  void find_determined(const Vec6& x);
  [[nodiscard]] Verdict verdict_from(const StoredPoint& point) const;
  void queue_revision(std::uint32_t index);

  Surface surface_;
  LocalizerConfig config_;
  MotionFrame frame_;
  Pose pose_;
  FitSums settled_;  ///< all points but the fresh ones
  FitSums
      current_;  ///< those and the fresh ones, whose rows are taken anew in every push: what the pose is solved from
  FitSums filling_;  ///< by the sweep under way; takes the place of settled_ at its end
  FitSums frozen_;   ///< points that have no place in memory
  Determination determination_;
  Mat6 covariance_ = Mat6::Identity();  ///< of x, for unit variance
  double sigma_ = 0;
  Loss loss_ = Loss::none;  ///< in use, with its scale
  double loss_scale_ = 0;
  bool concluded_ = false, converged_ = false, redetermine_ = true;
  Refinement refinement_;
  BoundedFit bounded_;
  /// In a stream: the mode's program, and in a constrained fit that of the smallest feasible tolerances.
  BoundTracker tracker_, least_;
  std::uint32_t looked_at_ = 0;  ///< points since the programs last moved
  bool regions_held_ = false;    ///< points keep region and tolerance whatever their feet
  bool exits_count_ = false;     ///< points that were left out too often stay so
  bool infeasible_ = false;
  double tolerance_factor_ = 0, smallest_tolerance_ = 0, stationarity_ = 0;
  Certificate certificate_;
  std::uint32_t unproven_ = 0;
  double last_step_ = 0;
  std::uint32_t searches_ = 0;
  std::uint32_t revision_ = 0, accepted_ = 0, rejected_ = 0, last_sequence_ = 0, last_path_ = 0;
  std::uint32_t judged_out_[2] = {0, 0};
  SurfacePlace last_place_;
  bool has_last_ = false;
  std::uint32_t stored_ = 0, cursor_ = 0, next_given_up_ = 0;
  std::uint32_t queue_head_ = 0, queue_size_ = 0;
  /// Indices of the fresh points; the first active_count_ are outside of settled_, the others leave it at the sweep's
  /// end.
  std::array<std::uint32_t, kFreshPlaces> fresh_{};
  std::uint32_t fresh_count_ = 0, active_count_ = 0;
  StoredPoint* points_ = nullptr;   ///< capacity of them
  std::uint32_t* order_ = nullptr;  ///< their indices by rising sequence
  std::uint32_t* queue_ = nullptr;  ///< ring of indices with a changed verdict, each at most once
};

}  // namespace bladefit
