#pragma once
#include <array>
#include <span>

#include "core/fit/quadratic_model.hpp"
#include "core/localizer/fit_problem.hpp"
#include "core/localizer/point_store.hpp"

namespace bladefit {

/// When the foot of a point is proven, by its reach or else by a global search, and not only tracked from where it was.
enum class Search : std::uint8_t {
  if_doubtful,  ///< where tracking ends on an edge, on no minimum or averted from the probe
  past_margin,  ///< there too, and where the point has moved so far that its runner-up may be nearer; finds a new
                ///< margin
  keep,         ///< only where tracking ends on no minimum or at a seam: the foot stays on its sheet
  always        ///< it is proven: searched where its reach does not prove it
};

/// Where the foot of a point is sought from, and how.
struct FootStart {
  SurfacePlace place;
  Search search;
};

/// That of its last foot.
[[nodiscard]] inline SurfacePlace place_of(const StoredPoint& point) {
  return {point.span, point.foot.u, point.foot.v};
}

/// Feet and rows of points at a pose. Changes nothing.
class FootFinder {
 public:
  explicit FootFinder(const FitProblem& problem) : problem_(problem) {}

  /// A point as it comes, with the place that its foot is sought from. With a window its foot at the start pose is
  /// searched.
  [[nodiscard]] StoredPoint new_point(const ProbePoint& point, const SurfacePlace& start) const;
  /// Cost: some 150 ns where the foot is tracked, some microseconds where it is searched.
  [[nodiscard]] Measurement find(const StoredPoint& point, const Pose& pose, Search search) const {
    return find_from({place_of(point), search}, point, pose);
  }
  [[nodiscard]] Measurement find_from(const FootStart& start, const StoredPoint& point, const Pose& pose) const;
  /// Measures stored points, several at once where the processor can, to the same bits as find(). Rows are taken `x`
  /// away from the reference of the sums they are for. `start_of(index)` says where from and how, `use(index,
  /// measurement)` takes each in the order of `indices`; the measurement is gone after that call.
  template <class StartOf, class Use>
  void find_each(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose, const Vec6& x,
                 StartOf start_of, Use use) const;
  /// The same of up to kLanes points, whose measurements hold until the block goes.
  template <class StartOf, class Use>
  void find_block(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose, const Vec6& x,
                  StartOf start_of, Use use, LaneBlock& block) const;
  /// Expansion of the measured distance, `x` away from the reference of the sums it is for.
  [[nodiscard]] DistanceRow row(const Measurement& m, const Vec6& x) const;

 private:
  [[nodiscard]] bool outside_window(const StoredPoint& point) const;
  void track(const Vec6& x, LaneBlock& block) const;
  [[nodiscard]] Measurement find_tracked(const FootStart& start, const StoredPoint& point, const Pose& pose,
                                         const LaneBlock& block, std::uint32_t lane) const;
  void examine(const StoredPoint& point, const Pose& pose, Search search, Measurement& m) const;
  [[nodiscard]] bool weigh_runner_up(const StoredPoint& point, const ProjectionQuery& query, Measurement& m) const;
  [[nodiscard]] bool proven_without_search(double margin, Measurement& m) const;
  [[nodiscard]] bool left_trim(const StoredPoint& point) const;
  [[nodiscard]] bool same_foot(const Vec3& a, const Vec3& b) const;

  const FitProblem& problem_;
};

template <class StartOf, class Use>
void FootFinder::find_block(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose,
                            const Vec6& x, StartOf start_of, Use use, LaneBlock& block) const {
  std::array<FootStart, kLanes> starts;
  for (std::uint32_t lane = 0; lane < indices.size(); ++lane) {
    starts[lane] = start_of(indices[lane]);
    block.feet.enter(problem_.surface, apply(pose, store[indices[lane]].position), starts[lane].place);
  }
  track(x, block);
  for (std::uint32_t lane = 0; lane < indices.size(); ++lane) {
    use(indices[lane], find_tracked(starts[lane], store[indices[lane]], pose, block, lane));
  }
}

template <class StartOf, class Use>
void FootFinder::find_each(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose,
                           const Vec6& x, StartOf start_of, Use use) const {
  for (std::size_t first = 0; first < indices.size(); first += kLanes) {
    LaneBlock block;
    const std::size_t count = std::min<std::size_t>(kLanes, indices.size() - first);
    find_block(store, indices.subspan(first, count), pose, x, start_of, use, block);
  }
}

}  // namespace bladefit
