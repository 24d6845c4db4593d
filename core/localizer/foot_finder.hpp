#pragma once
#include <span>

#include "core/fit/quadratic_model.hpp"
#include "core/localizer/fit_problem.hpp"
#include "core/localizer/point_store.hpp"

namespace bladefit {

/// When the foot of a point is searched globally, and not only tracked from where it was.
enum class Search : std::uint8_t {
  if_doubtful,  ///< where tracking ends on an edge, on no minimum or averted from the probe
  past_margin,  ///< there too, and where the point has moved so far that its runner-up may be nearer; finds a new
                ///< margin
  always
};

/// Feet and rows of points at a pose. Changes nothing.
class FootFinder {
 public:
  explicit FootFinder(const FitProblem& problem) : problem_(problem) {}

  /// A point as it comes, with the place that its foot is sought from. With a window its foot at the start pose is
  /// searched.
  [[nodiscard]] StoredPoint new_point(const ProbePoint& point, const SurfacePlace& start) const;
  /// Cost: some 150 ns where the foot is tracked, some microseconds where it is searched.
  [[nodiscard]] Measurement find(const StoredPoint& point, const Pose& pose, Search search) const;
  /// Measures stored points, several at once where the processor can, to the same bits as find(). Rows are taken `x`
  /// away from the reference of the sums they are for. `search_of(point)` says when to search, `use(index,
  /// measurement)` takes each in the order of `indices`; the measurement is gone after that call.
  template <class SearchOf, class Use>
  void find_each(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose, const Vec6& x,
                 SearchOf search_of, Use use) const;
  /// Expansion of the measured distance, `x` away from the reference of the sums it is for.
  [[nodiscard]] DistanceRow row(const Measurement& m, const Vec6& x) const;

 private:
  [[nodiscard]] bool outside_window(const StoredPoint& point) const;
  void track(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose, const Vec6& x,
             LaneBlock& block) const;
  [[nodiscard]] Measurement find_tracked(const StoredPoint& point, const Pose& pose, Search search,
                                         const LaneBlock& block, std::uint32_t lane) const;
  void examine(const StoredPoint& point, const Pose& pose, Search search, Measurement& m) const;
  [[nodiscard]] bool weigh_runner_up(const StoredPoint& point, const ProjectionQuery& query, Measurement& m) const;
  [[nodiscard]] bool same_foot(const Vec3& a, const Vec3& b) const;

  const FitProblem& problem_;
};

template <class SearchOf, class Use>
void FootFinder::find_each(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose,
                           const Vec6& x, SearchOf search_of, Use use) const {
  for (std::size_t first = 0; first < indices.size(); first += kLanes) {
    const auto some = indices.subspan(first, std::min<std::size_t>(kLanes, indices.size() - first));
    LaneBlock block;
    track(store, some, pose, x, block);
    for (std::uint32_t lane = 0; lane < some.size(); ++lane) {
      const StoredPoint& point = store[some[lane]];
      use(some[lane], find_tracked(point, pose, search_of(point), block, lane));
    }
  }
}

}  // namespace bladefit
