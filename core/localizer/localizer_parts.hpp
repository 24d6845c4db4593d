#pragma once
#include "core/localizer/refinement.hpp"
#include "core/localizer/stream_optimum.hpp"

namespace bladefit {

/// What is known of the stream itself.
struct StreamState {
  bool concluded = false;  ///< no more points will come
  std::uint32_t accepted = 0, last_sequence = 0;
  std::uint32_t displaced = 0;  ///< sequence of the point whose place the newest one took; 0 = none
  SurfacePlace last_place;      ///< of the newest foot, where the next one is sought
};

/// The parts of a localizer, each with its own state. They stand in the caller's memory and refer to each other, so
/// they are neither copied nor moved.
struct LocalizerParts {
  LocalizerParts(const DesignImage& design, const LocalizerConfig& config)
      : problem(design, config),
        plan(problem),
        finder(problem),
        selection(problem),
        loss(problem),
        estimate(problem),
        sums(problem, selection, loss, finder),
        verdicts(problem, selection),
        stream_optimum(problem, plan, finder, selection),
        refinement(problem, plan, finder, store, selection, sums, estimate, loss, verdicts) {}
  LocalizerParts(const LocalizerParts&) = delete;
  LocalizerParts& operator=(const LocalizerParts&) = delete;

  const FitProblem problem;
  const ModePlan plan;
  const FootFinder finder;
  PointStore store;
  PointSelection selection;
  LossSchedule loss;
  PoseEstimate estimate;
  RunningSums sums;
  VerdictBook verdicts;
  ModeOptimum optimum;
  StreamOptimum stream_optimum;
  Refinement refinement;
  StreamState stream;
};

}  // namespace bladefit
