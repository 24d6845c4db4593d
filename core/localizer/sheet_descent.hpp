#pragma once
#include "core/localizer/foot_finder.hpp"
#include "core/localizer/kept_sheets.hpp"
#include "core/localizer/mode_program.hpp"

namespace bladefit {

/// The descent of a mode's objective over poses where every foot is the one that the conventions choose: the nearest
/// local minimum that faces the probe. Between two such poses points keep their sheets. Where a search of every foot
/// finds others, the pose counts if the objective, with these, is below that of the last such pose; else the program
/// goes back there, and the feet that would avert themselves from their probes on the way are held to face them: the
/// objective jumps where they cease to, so that its least value may lie at that limit. The merit of the poses that
/// count never rises, and what is held only grows, so that it ends. Where that leads nowhere the other feet are taken
/// from the last proven pose on whatever they cost, a few times: a pose that is the optimum of its own feet, and not
/// worse than where the program began, is one of the mode's as well.
class SheetDescent {
 public:
  explicit SheetDescent(const FitProblem& problem) : problem_(problem) {}

  /// As KeptSheets::attach().
  void attach(KeptPlaces* places) { sheets_.attach(places); }
  /// For another search that needs sheets, between two programs.
  [[nodiscard]] KeptSheets& sheets() { return sheets_; }
  /// The place that the foot of a point is sought from.
  [[nodiscard]] SurfacePlace kept(std::uint32_t index) const { return sheets_.kept(index); }

  /// A program begins with the feet that the points have. `there`: at the pose where the last one ended, so that what
  /// was held there is held on.
  void begin(const PointStore& store, bool there);
  /// A sweep begins. `proof`: every foot is searched in it.
  void begin_sweep(bool proof, ModeProgram& program);
  /// A point was measured in it. `counts`: in the program.
  void note(std::uint32_t index, const StoredPoint& point, const Pose& pose, const Measurement& m, bool counts,
            ModeProgram& program);

  enum class Outcome : std::uint8_t {
    same,     ///< no foot is another one
    adopted,  ///< some are, and the pose counts
    back,     ///< it does not: go on from proven_pose(), whose sheets are kept again
    stuck     ///< this has gone on too long
  };
  /// After a sweep at `pose` of this merit.
  [[nodiscard]] Outcome weigh(double merit, const Pose& pose, std::uint32_t count);
  /// The program leads nowhere. back: go on from proven_pose(), with nothing held. Else stuck.
  [[nodiscard]] Outcome let_go(std::uint32_t count);
  [[nodiscard]] const Pose& proven_pose() const { return proven_pose_; }
  /// The step of the program counts.
  void accept(std::uint32_t count);

 private:
  [[nodiscard]] bool hold_others();
  void release_others();

  static constexpr std::uint32_t kMost = BoundRows::kMostLimits / 2;  ///< each has two limits
  /// A few points by their index.
  struct Points {
    std::array<std::uint32_t, kMost> index{};
    std::uint32_t count = 0;
    [[nodiscard]] std::uint32_t find(std::uint32_t i) const;
    [[nodiscard]] bool holds(std::uint32_t i) const { return find(i) < count; }
    /// False where there is no room.
    bool add(std::uint32_t i);
  };

  /// Something of a foot that must not rise above what it was at the proven pose, or 0, counted in the length that the
  /// pose must have moved for it there.
  struct Limit {
    double allowed = 0, slope = 0;  ///< [-, 1/mm]
    void begin(double value, const Vec6& gradient);
    void set(std::uint32_t k, double value, const Vec6& gradient, double margin, ModeProgram& program) const;
  };
  /// How a foot is held: n . a, and what lacks to its least existence.
  struct Hold {
    bool known = false;
    Limit averted, missing;
    bool placed = false;  ///< the point and its distance at the pose that the next step is made from are known
    Vec3 r = Vec3::Zero(), tried_r = Vec3::Zero();
    double distance = 0, tried_distance = 0;
  };
  [[nodiscard]] bool jumped(Hold& hold, const Measurement& m) const;
  void hold(std::uint32_t k, const Vec3& approach, const Measurement& m, ModeProgram& program);

  const FitProblem& problem_;
  KeptSheets sheets_;
  Points others_;  ///< whose foot in this sweep is on another sheet
  Points held_;    ///< whose foot is held to face its probe, or to be averted no farther
  std::array<Hold, kMost> hold_{};
  bool proof_ = false;  ///< every foot of this sweep is searched
  bool any_other_ = false;
  bool unproven_ = true;  ///< no pose is proven yet
  bool free_ = false;     ///< nothing is held any more
  std::uint32_t rounds_ = 0;
  Pose proven_pose_;
  double first_merit_ = 0, proven_merit_ = 0;
  double free_merit_ = 0;  ///< of the last proven pose since nothing is held
};

}  // namespace bladefit
