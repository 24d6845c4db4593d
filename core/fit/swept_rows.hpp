#pragma once
#include "core/fit/quadratic_model.hpp"
#include "core/geometry/simd/lanes.hpp"

namespace bladefit {

/// Rows of a sweep over the stored points, all taken at the reference of the sums they are for. They are added up in
/// kLanes sums, each point in that of its index modulo kLanes, so that wide registers give the same bits as one row at
/// a time. A block is the rows of up to kLanes points, of which no two have the same lane.
class SweptRows {
 public:
  void clear();

  /// The row of a point of weight w in this lane.
  void add(std::uint32_t lane, const DistanceRow& row, double w, const LossTerms& terms);
  /// The same, of a row that add_block() is given: nothing is added before that.
  void count_in_block(std::uint32_t lane, double w, const LossTerms& terms);
  /// Adds the rows of the lanes that were counted since the last block. Cost: some 370 instructions for four.
  void add_block(const LaneRows& rows);

  /// Adds everything to the model and forgets it.
  void move_to(QuadraticModel& model);

 private:
  LaneSums sums_;
  LaneTerms block_;
  bool in_block_ = false;  ///< block_ is not all 0
  std::uint32_t count_ = 0;
};

}  // namespace bladefit
