// Every phase of a refinement with every event.

#include <gtest/gtest.h>

#include <set>

#include "core/localizer/refinement_phase.hpp"

namespace bladefit::testing {
namespace {

using enum RefinementPhase;
using enum RefinementEvent;

struct Transition {
  RefinementPhase phase;
  RefinementEvent event;
  RefinementPhase next;
  const char* sentence;
};

constexpr Transition kTransitions[] = {
    {idle, began, least_squares, "refine() begins with least squares"},
    {idle, program_began, idle, "no program begins before a refinement"},
    {idle, starts_began, idle, "nor do further starts"},
    {idle, converged, idle, "nothing converges"},
    {idle, ended_unconverged, idle, "nor ends"},
    {idle, interrupted, idle, "a point changes nothing"},

    {least_squares, began, least_squares, "a refinement begins once"},
    {least_squares, program_began, mode, "the mode's program follows"},
    {least_squares, starts_began, least_squares, "further starts need an optimum of the mode"},
    {least_squares, converged, done, "least squares is the mode itself"},
    {least_squares, ended_unconverged, idle, "too little is determined, or the cap is met"},
    {least_squares, interrupted, idle, "a point gives it up"},

    {mode, began, mode, "a refinement begins once"},
    {mode, program_began, mode, "the second stage, or other regions"},
    {mode, starts_began, further_starts, "a better optimum is sought"},
    {mode, converged, done, "no further starts are wanted"},
    {mode, ended_unconverged, idle, "the program failed"},
    {mode, interrupted, idle, "a point gives it up"},

    {further_starts, began, further_starts, "a refinement begins once"},
    {further_starts, program_began, mode, "the best start is made exact"},
    {further_starts, starts_began, further_starts, "they are under way"},
    {further_starts, converged, done, "none was better than what was found"},
    {further_starts, ended_unconverged, idle, "none led anywhere"},
    {further_starts, interrupted, idle, "a point gives them up"},

    {done, began, done, "nothing is left to do"},
    {done, program_began, done, "no program begins"},
    {done, starts_began, done, "nor do further starts"},
    {done, converged, done, "it has converged"},
    {done, ended_unconverged, done, "and stays so"},
    {done, interrupted, idle, "until a point comes"},
};

constexpr RefinementPhase kPhases[] = {idle, least_squares, mode, further_starts, done};

TEST(RefinementPhaseTable, IsThisOne) {
  std::set<std::pair<RefinementPhase, RefinementEvent>> seen;
  for (const Transition& t : kTransitions) {
    EXPECT_EQ(next_phase(t.phase, t.event), t.next) << t.sentence;
    seen.insert({t.phase, t.event});
  }
  EXPECT_EQ(seen.size(), 30U) << "every phase with every event";
}

TEST(RefinementPhaseTable, LetsEveryPhaseBeReachedAndLeft) {
  for (const RefinementPhase from : kPhases) {
    std::set<RefinementPhase> reached = {from};
    for (std::size_t before = 0; before != reached.size();) {
      before = reached.size();
      for (const RefinementPhase phase : std::set(reached)) {
        for (int event = 0; event < 6; ++event) {
          reached.insert(next_phase(phase, static_cast<RefinementEvent>(event)));
        }
      }
    }
    EXPECT_EQ(reached.size(), std::size(kPhases)) << "from phase " << static_cast<int>(from);
  }
}

TEST(RefinementPhaseTable, LeadsToTheStartFromEveryPhaseWhenAPointComes) {
  for (const RefinementPhase phase : kPhases) EXPECT_EQ(next_phase(phase, interrupted), idle);
}

}  // namespace
}  // namespace bladefit::testing
