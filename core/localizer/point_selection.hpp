#pragma once
#include "core/localizer/fit_problem.hpp"
#include "core/localizer/point_store.hpp"
#include "core/localizer/tuning.hpp"

namespace bladefit {

/// Which points count in the fit, and to which region they belong. Being judged is another matter: that follows from
/// the foot at the pose judged at alone (verdict_book.hpp), whatever happened on the way there.
class PointSelection {
 public:
  /// by_foot: as the present foot says. by_exits: so too, but a point that was left out too often stays out until
  /// readmit(). held: as it was when hold() was called, wherever the feet go.
  enum class Rule : std::uint8_t { by_foot, by_exits, held };

  explicit PointSelection(const FitProblem& problem) : problem_(problem) {}

  void by_foot() { rule_ = Rule::by_foot; }
  /// Begins to count how often points leave. Cost: linear.
  void by_exits(PointStore& store);
  /// At an optimum: points that stayed out because the pose travelled, and whose present foot counts, come in again.
  /// True where there are any; once in a refinement, so that it ends: what leaves as often again moves to and fro at
  /// the optimum itself, and stays out. Cost: linear.
  [[nodiscard]] bool readmit(PointStore& store);
  /// Which points count is settled by the least-squares fit: none escapes its bound over an edge. Cost: linear.
  void hold(PointStore& store);
  [[nodiscard]] bool held() const { return rule_ == Rule::held; }

  /// Whether the point, with this foot, does not count.
  [[nodiscard]] bool left_out(const StoredPoint& point, const Foot& foot) const {
    if (rule_ == Rule::held) return point.held_out;
    return (rule_ == Rule::by_exits && point.exits >= tuning::kMostExits) || out_by_foot(point, foot);
  }
  /// Smallest and largest of the signed distances [mm].
  struct Span {
    double least = 0, most = 0;
  };
  /// Of every `stride`-th point, those that count, with their present feet; least > most where none does.
  [[nodiscard]] Span distances(const PointStore& store, std::uint32_t stride) const;
  /// Region of the point with this foot.
  [[nodiscard]] Region region(const StoredPoint& point, const Foot& foot) const {
    return rule_ == Rule::held ? point.region : problem_.region_of(foot);
  }
  /// Counts an exit where the point leaves with its next foot. Called before that is recorded.
  void note_exit(StoredPoint& point, const Foot& next) const;

 private:
  [[nodiscard]] bool out_by_foot(const StoredPoint& point, const Foot& foot) const {
    return point.outside_window || (foot.kind != FootKind::interior && problem_.config.edges == EdgePolicy::skip);
  }

  const FitProblem& problem_;
  Rule rule_ = Rule::by_foot;
  bool readmitted_ = false;
};

}  // namespace bladefit
