#pragma once
#include <vector>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

/// A book of verdicts without a localizer around it.
namespace bladefit::testing {

inline constexpr double kOnEdgeOfBlade = 0.5,
                        kOnRest = 0.1;               ///< u of feet in the box of the leading edge and outside of it
inline constexpr double kTight = 0.02, kWide = 0.2;  ///< their tolerances [mm]

inline LocalizerConfig judged_config() {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 32);
  config.tolerance.leading_edge_mm = kTight;
  config.tolerance.rest_mm = kWide;
  return config;
}

/// A book over a few stored points, and a pose that is as well known as a test wants it.
struct Desk {
  explicit Desk(std::uint32_t points, const LocalizerConfig& config = judged_config())
      : problem(reference_design("dtmb4119").image(), config),
        selection(problem),
        estimate(problem),
        store(points),
        ring(points),
        book(problem, selection) {
    book.attach(ring.data(), points);
    book.clear();
    know_pose(Vec6::Zero());
    for (std::uint32_t k = 1; k <= points; ++k) {
      store.append(numbered(k));
      see(k - 1, foot_at(kOnRest, 0.0));
      book.judge_new(store[k - 1], evidence());
    }
  }

  /// `open`: a direction that is not determined; 0: there is none.
  void know_pose(const Vec6& open) {
    Minimum minimum{};
    minimum.determination.rank = open.isZero() ? 6 : 5;
    minimum.determination.free_directions.col(0) = open;
    minimum.covariance = Mat6::Identity();
    minimum.sigma = 1e-3;
    estimate.know(minimum);
  }
  [[nodiscard]] Evidence evidence(bool enough = true, bool settled = true) const { return {estimate, enough, settled}; }
  void see(std::uint32_t index, const Foot& foot) { store[index].foot = foot; }
  void judge(std::uint32_t index, const Foot& foot) {
    see(index, foot);
    book.judge_again(store, index, evidence());
  }
  /// State of a point with this foot.
  [[nodiscard]] PointState state(const Foot& foot, bool enough = true) {
    see(0, foot);
    book.judge_new(store[0], evidence(enough));
    return store[0].state;
  }
  /// Sequences of all revisions.
  [[nodiscard]] std::vector<std::uint32_t> told() {
    std::vector<std::uint32_t> out;
    Verdict verdict;
    while (book.next_revision(store, verdict)) out.push_back(verdict.sequence);
    return out;
  }

  FitProblem problem;
  PointSelection selection;
  PoseEstimate estimate;
  OwnedStore store;
  std::vector<std::uint32_t> ring;
  VerdictBook book;
};

}  // namespace bladefit::testing
