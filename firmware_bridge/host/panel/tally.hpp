#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "core/inspection/blade_verdict.hpp"
#include "firmware_bridge/host/blade/blade_counts.hpp"

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

/// The newest verdict of every point whose verdict may still change, and what follows from those of all. Grows up to
/// the points that have a place in the fit: it belongs to the publication thread, which may allocate.
class Tally {
 public:
  /// Both must outlive it.
  Tally(const ToleranceMap& tolerance, const BladeLayout& layout)
      : zones_(tolerance), blade_(layout), by_limits_(tolerance.zone_count > 0) {}

  /// Takes a first verdict or a revision. Cost: logarithmic.
  void accept(const Verdict& verdict);

  /// No revision of this point will come: it is counted as it is. Nothing where the sequence is unknown.
  void give_up(std::uint32_t sequence);

  /// Forgets every point.
  void clear();

  [[nodiscard]] const TallyCounts& counts() const { return counts_; }

  [[nodiscard]] const ZoneCount& zones() const { return zones_; }

  /// The same by places of the blade.
  [[nodiscard]] const BladeCounts& blade() const { return blade_; }

  /// The point of a region that is farthest off, by the same verdicts as the counts; null where there is none. Pending
  /// points, whose distances are old while the pose moves, take part where asked for. Cost: constant, but linear where
  /// the farthest one has come nearer.
  [[nodiscard]] const Verdict* worst(Region region, bool with_pending) const;

  /// Verdicts that may change, by their sequence.
  [[nodiscard]] const std::map<std::uint32_t, Verdict>& verdicts() const { return verdicts_; }

  /// Null when the sequence is unknown, or given up.
  [[nodiscard]] const Verdict* find(std::uint32_t sequence) const;

  /// The leading-edge points that are out and became so last, newest first, kNewest at most.
  [[nodiscard]] std::vector<Verdict> newest_leading_edge_out() const;
  static constexpr std::size_t kNewest = 8;

  /// How often a point has become out of tolerance so far, in any region.
  [[nodiscard]] std::uint64_t times_out() const { return times_out_; }

 private:
  /// `direction`: +1 to add, -1 to take back.
  void count(const Verdict& verdict, int direction);
  void follow_leading_edge(std::uint32_t sequence, bool was_out, bool is_out);
  void follow_worst(const Verdict& verdict);
  [[nodiscard]] bool is_farther(const Verdict& verdict, const std::optional<Verdict>& other) const;

  /// The farthest point of a region so far, with or without pending ones.
  struct Worst {
    std::optional<Verdict> verdict;
    std::optional<Verdict> given_up;  ///< of those given up
    bool stale = false;               ///< the farthest has come nearer: others are to be looked at again
  };
  [[nodiscard]] Worst& worst_of(Region region, bool with_pending) const {
    return worst_[static_cast<std::size_t>(region)][with_pending ? 1 : 0];
  }

  std::map<std::uint32_t, Verdict> verdicts_;
  std::vector<std::uint32_t> leading_edge_out_;  ///< in the order in which they became so
  std::deque<Verdict> given_up_out_;             ///< of these, the newest that were given up
  mutable std::array<std::array<Worst, 2>, 2> worst_{};
  TallyCounts counts_;
  ZoneCount zones_;
  BladeCounts blade_;
  bool by_limits_;  ///< there are zones
  std::uint64_t times_out_ = 0;
};

}  // namespace bladefit
