#pragma once
#include <cstdint>

namespace bladefit::tuning {

// Every number of the localizer that was chosen and not derived. Lengths marked [L] are in half diagonals of the
// design.

// Points
/// [L] Points farther from the middle of the design than this are not of this blade.
inline constexpr double kFarthestPoint = 1e3;
/// Largest weight of the squared distance of a point; the smallest is its inverse.
inline constexpr double kLargestWeight = 1e12;
/// Approach vectors whose length differs from 1 by more than this are refused.
inline constexpr double kUnitLength = 1e-3;
/// A point may be drawn over an edge where it counts, and back where it does not. Left out so often in one refinement,
/// it stays out of the fit; once, at the optimum, such points come in again. It is judged all the same.
inline constexpr std::uint8_t kMostExits = 4;
/// Points whose rows are taken again in every push: the newest ones, and contested ones as far as there is room.
inline constexpr std::uint32_t kRecentPlaces = 16, kNewestRecent = 4;
/// [L] Contested is a point with another local minimum that is farther by less than this: a small motion of the pose
/// can move its foot to the other side of an edge, which no expansion foretells.
inline constexpr double kContestedMargin = 3e-4;
/// Stored points looked at for one whose place a point of the leading edge may take.
inline constexpr std::uint32_t kEvictionLooks = 64;

// Feet
/// [L] Other local minima are looked for up to this much farther, so that a foot can be tracked for half as long.
inline constexpr double kSearchMargin = 2e-3;
/// Where the reach of a foot proves so many times that margin, a search would find nothing within it either.
inline constexpr double kMarginByReach = 1.01;
/// [L] Feet this near to each other are one.
inline constexpr double kSameFoot = 1e-8;

// Pose
/// [L] A pose moves no farther than this in one step: what lies beyond is no small motion.
inline constexpr double kLongestStep = 0.05;
/// Directions below this share of the trace of the information matrix are rounding.
inline constexpr double kNumericalRank = 1e-13;
/// [L] Largest standard uncertainty of a determined direction, where the configuration does not say.
inline constexpr double kDetermined = 1e-3;
/// [L] Start poses are assumed right to within this when a direction is not determined yet.
inline constexpr double kStartUncertainty = 0.01;
/// [L] While the pose has moved farther than this since the sums in use were begun, their expansions are stale, and a
/// push refreshes so many times the points.
inline constexpr double kStaleBeyond = 5e-4;
inline constexpr std::uint32_t kCatchUp = 8;

// Verdicts
/// [L] A distance above its tolerance by no more than this is in: a constrained optimum touches its bounds.
inline constexpr double kTouchingBound = 1e-11;
/// A verdict is pending while what is not determined may change the distance by more than this share of the tolerance.
inline constexpr double kPendingShare = 0.1;
/// While points come, fewer fitted ones than this hide their own errors: every verdict is pending. Once no more come,
/// so many more than there are free degrees of freedom are needed.
inline constexpr std::uint32_t kLeastJudged = 12, kLeastSpare = 3;

/// [L] What lies farther than this beyond an outer edge no longer belongs to the end of the blade, but was probed
/// where the design ends, as on a root fillet whose face is not in the design.
inline constexpr double kFarBeyond = 0.05;
/// The pose is at rest while it has moved, since the sums in use were begun, by no more than this share of the tightest
/// tolerance.
inline constexpr double kRestShare = 0.5;

// Scale of a robust loss
/// Standard deviation of normal errors over the median of their size.
inline constexpr double kMedianToScale = 1.4826;
/// Halvings of the interval that holds the median: to a billionth of the largest distance.
inline constexpr int kMedianHalvings = 30;
/// A scale that changes by less than this share is at rest; before the last stage, by less than the second.
inline constexpr double kScaleAtRest = 1e-6, kScaleNearRest = 1e-2;
/// Times that the scale is estimated again.
inline constexpr std::uint32_t kScaleRounds = 30;

// Refinement
inline constexpr std::uint32_t kRefineSweeps = 100;
/// After so many sweeps feet keep their sheets until a sweep proves them: where steps meet other sheets again and again
/// the sum of squares jumps, and is no measure of a step. Some ten sweeps are usual.
inline constexpr std::uint32_t kFreeSearchSweeps = 30;
/// [L] A step longer than the first must lower the sum of squares; one shorter than the second means convergence.
inline constexpr double kCheckedAbove = 1e-6, kConvergedBelow = 1e-12;
/// [L] While the pose travels farther than this between two sweeps, feet are searched again: tracked ones would be left
/// on the wrong side of thin places, and the fit led to another optimum.
inline constexpr double kTravelsBeyond = 1e-3;
/// [L] While it travels no farther than this, which is how exact a search is, feet need no other one.
inline constexpr double kSearchHolds = 1e-10;

// Modes beside least squares
/// Times that regions follow the feet at most: then they do not come to rest. So many times they do so freely; after
/// that tolerances only become tighter.
inline constexpr std::uint32_t kRegionRounds = 20, kFreeRegionRounds = 3;
/// Weights that change by less than this share are at rest.
inline constexpr double kWeightsAtRest = 1e-10;
/// A smallest feasible tolerance above the wanted one by no more than this share meets it: at an optimum over all
/// points, and in a stream.
inline constexpr double kFeasible = 1e-12, kFeasibleInStream = 1e-9;
/// Steps of a program in one push: each takes the rows of its points again.
inline constexpr int kProgramStepsPerPush = 2;
/// Fewer fitted points than this do not begin a program: its solution would follow their noise.
inline constexpr std::uint32_t kLeastForProgram = 12;
/// Points looked at for the first ones of a program in a stream.
inline constexpr std::uint32_t kSeedPoints = 512;
/// [L] A pose that moves by less than this does not make what was looked at before uncertain.
inline constexpr double kPoseAtRest = 1e-7;

/// [L] A foot that is held to face its probe does so where the pose may move by this much before it averts itself.
inline constexpr double kFacesBy = 1e-9;
/// And its existence (existence_row.hpp) is kept above this: below, the foot moves ten times as far as its point.
inline constexpr double kLeastExistence = 1e-2;
/// Sweeps of one program, and of all programs of a refinement. Some thirty are usual; a point beyond where its probe
/// can see it may ask for many.
inline constexpr std::uint32_t kProgramSweeps = 150, kModeSweeps = 600;
/// Times that the feet of a program are found on other sheets, at most.
inline constexpr std::uint32_t kSheetRounds = 20;

// Further starts
/// A start looks at every point where there are no more than these, and else at every second, third...
inline constexpr std::uint32_t kStartPoints = 4096;
/// How far off a start lies: distances change by this many times their root mean square.
inline constexpr double kStartDistance = 1.5;
/// Sweeps of one start: six to ten are usual.
inline constexpr std::uint32_t kStartSweeps = 30;
/// Points farther out than this share of the optimum found before are searched at a start, others tracked to it.
inline constexpr double kStartSearch = 0.7;
/// Times that the feet of a start are proven.
inline constexpr std::uint32_t kStartProofs = 2;
/// Values that differ by less than this share are the same optimum.
inline constexpr double kSameOptimum = 1e-7;

}  // namespace bladefit::tuning
