#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/inspection/blade_verdict.hpp"

namespace bladefit {

/// How many points have which verdict at present.
struct TallyCounts {
  std::uint32_t points = 0;
  std::uint32_t leading_edge = 0;  ///< points of the region, rejected ones left out
  std::uint32_t leading_edge_out = 0;
  std::uint32_t rest_out = 0;
  std::uint32_t rejected = 0;
  std::uint32_t refused = 0;                 ///< of these, how many could not be used at all
  std::uint32_t pending = 0, undecided = 0;  ///< of those that have a tolerance
};

/// The newest verdict of every point, and what follows from them. Grows with the session: it belongs to the
/// publication thread, which may allocate.
class Tally {
 public:
  explicit Tally(const ToleranceMap& tolerance) : zones_(tolerance) {}

  /// Takes a first verdict or a revision. Cost: constant for rising sequence numbers, else a binary search.
  void accept(const Verdict& verdict);

  /// Forgets every point.
  void clear();

  [[nodiscard]] const TallyCounts& counts() const { return counts_; }

  [[nodiscard]] const ZoneCount& zones() const { return zones_; }

  /// The point of a region that is farthest off, by the same verdicts as the counts; null where there is none. Pending
  /// points, whose distances are old while the pose moves, take part where asked for. Cost: linear.
  [[nodiscard]] const Verdict* worst(Region region, bool with_pending) const;

  /// Verdicts in rising order of sequence.
  [[nodiscard]] std::span<const Verdict> verdicts() const { return verdicts_; }

  /// Null when the sequence is unknown.
  [[nodiscard]] const Verdict* find(std::uint32_t sequence) const;

  /// Sequences of the leading-edge points that are out, in the order in which they became so.
  [[nodiscard]] std::span<const std::uint32_t> leading_edge_out() const { return leading_edge_out_; }

  /// How often a point has become out of tolerance so far, in any region.
  [[nodiscard]] std::uint64_t times_out() const { return times_out_; }

 private:
  void count(const Verdict& verdict, std::uint32_t sign);
  void follow_leading_edge(std::uint32_t sequence, bool was_out, bool is_out);

  std::vector<Verdict> verdicts_;
  std::vector<std::uint32_t> leading_edge_out_;
  TallyCounts counts_;
  ZoneCount zones_;
  std::uint64_t times_out_ = 0;
};

}  // namespace bladefit
