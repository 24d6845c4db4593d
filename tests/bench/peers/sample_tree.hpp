#pragma once
#include <memory>

#include "tests/bench/peers/textbook_surface.hpp"

namespace bladefit::bench {

/// Nearest points by a k-d tree of samples of the surface and Newton's method from the nearest of them: fast, and right
/// wherever the nearest sample lies in the valley of the nearest foot.
class SampleTree {
 public:
  SampleTree(const UnitSurface& surface, int outward);
  ~SampleTree();
  SampleTree(const SampleTree&) = delete;
  SampleTree& operator=(const SampleTree&) = delete;

  [[nodiscard]] const TextbookSurface& surface() const { return surface_; }

  /// The foot of r. With an `approach` that is not zero only samples whose outward normal faces it are considered.
  [[nodiscard]] Parameters foot(const Vec3& r, const Vec3& approach = Vec3::Zero()) const;

 private:
  struct Index;
  TextbookSurface surface_;
  std::unique_ptr<Index> index_;
};

/// Solves `problem` by `solve`, which tracks feet that are known: where they are not they are found by the tree, and
/// again at the solution until none of them is another one.
template <class Solve>
Pose solved_from_cold(const SampleTree& tree, const FitProblem& problem, Solve solve);

/// True where a foot at `pose` is nearer than the one that was tracked; `feet` are then the new ones.
bool feet_renewed(const SampleTree& tree, const FitProblem& problem, const Pose& pose, std::vector<Parameters>& feet);

template <class Solve>
Pose solved_from_cold(const SampleTree& tree, const FitProblem& problem, Solve solve) {
  constexpr int kMaxRounds = 10;
  if (!problem.feet.empty()) return solve(problem);
  FitProblem known = problem;
  feet_renewed(tree, problem, problem.start, known.feet);
  for (int round = 0; round < kMaxRounds; ++round) {
    known.start = solve(known);
    if (!feet_renewed(tree, problem, known.start, known.feet)) break;
  }
  return known.start;
}

}  // namespace bladefit::bench
