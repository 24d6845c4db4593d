#pragma once
#include <array>

#include "core/localizer/pose_estimate.hpp"

namespace bladefit {

/// What verdicts are made from beside the point.
struct Evidence {
  const PoseEstimate& estimate;
  bool enough;   ///< points to judge any
  bool settled;  ///< the pose is at rest: while it is not, points keep the verdicts that they had when it was
};

/// Judges points, counts the verdicts, and keeps those that have changed since they were reported.
class VerdictBook {
 public:
  VerdictBook(const FitProblem& problem, const PointSelection& selection) : problem_(problem), selection_(selection) {}

  /// `ring`: capacity numbers, which outlive the book.
  void attach(std::uint32_t* ring, std::uint32_t capacity);
  void clear();

  /// State and action of a point with its present foot, as the caller gets them now.
  void judge_new(StoredPoint& point, const Evidence& evidence);
  /// The same of a stored one: where that changes what the caller knows, a revision is queued.
  void judge_again(PointStore& store, std::uint32_t index, const Evidence& evidence);
  /// Judges a point that has no place and is counted nowhere.
  void judge_aside(StoredPoint& point, const Evidence& evidence) const;
  /// Region, zone and tolerance of a point follow its foot, although regions are held.
  void assign_region(StoredPoint& point);

  /// Takes the next changed verdict. False where there is none.
  [[nodiscard]] bool next_revision(PointStore& store, Verdict& verdict);

  [[nodiscard]] std::uint32_t out(Region region) const { return out_[static_cast<std::size_t>(region)]; }
  [[nodiscard]] std::uint32_t rejected() const { return rejected_; }

 private:
  struct Finding {
    PointState state;
    Action action = Action::none;
    LeftOut left_out = LeftOut::none;
  };
  [[nodiscard]] Finding finding_of(const StoredPoint& point) const;
  void follow_foot(StoredPoint& point) const;
  void judge(StoredPoint& point, const Evidence& evidence);
  void assess(StoredPoint& point, const Evidence& evidence) const;
  void count(const StoredPoint& point, int sign);

  const FitProblem& problem_;
  const PointSelection& selection_;
  std::uint32_t* ring_ = nullptr;  ///< indices of points with a changed verdict, each at most once
  std::uint32_t capacity_ = 0, head_ = 0, size_ = 0;
  std::array<std::uint32_t, 2> out_{};
  std::uint32_t rejected_ = 0;
};

[[nodiscard]] Verdict verdict_of(const StoredPoint& point);

}  // namespace bladefit
