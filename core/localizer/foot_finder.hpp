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
  /// The same of up to kLanes points into a block that holds as long as the caller wants. `use_lane(index, foot)` takes
  /// those that are tracked in a lane and need no search.
  template <class StartOf, class UseLane, class Use>
  void find_block(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose, const Vec6& x,
                  StartOf start_of, UseLane use_lane, Use use, LaneBlock& block) const;
  /// The measurement of a foot in a lane.
  [[nodiscard]] Measurement measured(const LaneFoot& foot) const;
  /// Expansion of the measured distance, `x` away from the reference of the sums it is for.
  [[nodiscard]] DistanceRow row(const Measurement& m, const Vec6& x) const;

 private:
  [[nodiscard]] bool outside_window(const StoredPoint& point) const;
  void track(const Vec6& x, LaneBlock& block) const;
  [[nodiscard]] Measurement find_tracked(const FootStart& start, const StoredPoint& point, const Pose& pose,
                                         const LaneBlock& block, std::uint32_t lane) const;
  [[nodiscard]] bool stays_in_lane(const FootStart& start, const StoredPoint& point, const Pose& pose,
                                   LaneFoot& foot) const;
  void examine(const StoredPoint& point, const Pose& pose, Search search, Measurement& m) const;
  [[nodiscard]] bool may_be_overtaken(const StoredPoint& point, Search search, const Vec3& r) const;
  [[nodiscard]] bool weigh_runner_up(const StoredPoint& point, const ProjectionQuery& query, Measurement& m) const;
  [[nodiscard]] bool proven_without_search(double margin, Measurement& m) const;
  [[nodiscard]] bool left_trim(const StoredPoint& point) const;
  [[nodiscard]] bool same_foot(const Vec3& a, const Vec3& b) const;

  const FitProblem& problem_;
};

template <class StartOf, class UseLane, class Use>
void FootFinder::find_block(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose,
                            const Vec6& x, StartOf start_of, UseLane use_lane, Use use, LaneBlock& block) const {
  std::array<FootStart, kLanes> starts;
  for (std::uint32_t lane = 0; lane < indices.size(); ++lane) {
    starts[lane] = start_of(indices[lane]);
    block.feet.enter(problem_.surface, apply(pose, store[indices[lane]].position), starts[lane].place);
  }
  track(x, block);
  for (std::uint32_t lane = 0; lane < indices.size(); ++lane) {
    const StoredPoint& point = store[indices[lane]];
    LaneFoot foot{&block, lane, false};
    if (!block.feet.found(lane) || !block.rows.regular[lane]) {
      use(indices[lane], find_from(starts[lane], point, pose));
    } else if (stays_in_lane(starts[lane], point, pose, foot)) {
      use_lane(indices[lane], foot);
    } else {
      use(indices[lane], find_tracked(starts[lane], point, pose, block, lane));
    }
  }
}

template <class StartOf, class Use>
void FootFinder::find_each(const PointStore& store, std::span<const std::uint32_t> indices, const Pose& pose,
                           const Vec6& x, StartOf start_of, Use use) const {
  for (std::size_t first = 0; first < indices.size(); first += kLanes) {
    LaneBlock block;
    const std::size_t count = std::min<std::size_t>(kLanes, indices.size() - first);
    const auto use_lane = [&](std::uint32_t index, const LaneFoot& foot) { use(index, measured(foot)); };
    find_block(store, indices.subspan(first, count), pose, x, start_of, use_lane, use, block);
  }
}

}  // namespace bladefit
