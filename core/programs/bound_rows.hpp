#pragma once
#include <cstddef>
#include <cstdint>

#include "core/algebra/matrix.hpp"
#include "core/inspection/limits.hpp"
#include "core/programs/constraint_rows.hpp"

namespace bladefit {

/// The linearised distances of a program, and limits beside them, in the caller's memory, column by column.
class BoundRows {
 public:
  /// Conditions beside the distances that a step must keep.
  static constexpr std::uint32_t kMostLimits = 32;
  /// Doubles of the caller's memory for `capacity` points: six of a gradient, two bounds and two weights for each and
  /// for the limits.
  static constexpr std::uint64_t doubles_for(std::uint64_t capacity) { return 10 * (capacity + kMostLimits); }

  void attach(double* memory, std::uint32_t capacity);
  /// `count` points, and no limit. `within`: the distances are bounded by their weights, else by multiples of these.
  void begin(std::uint32_t count, bool within);
  /// Further points, some of them new.
  void resume(std::uint32_t count) { count_ = count; }
  [[nodiscard]] std::uint32_t count() const { return count_; }

  /// That of either side [Limits], kept until it is set again. Returns how much it changed at most, relative to the
  /// larger one.
  double set_weight(std::uint32_t i, const Limits& weight);
  [[nodiscard]] Limits weight(std::uint32_t i) const { return {column(kWeight)[i], column(kLowerWeight)[i]}; }
  /// d + gradient x is within the weights, or within their multiples.
  void set(std::uint32_t i, const Vec6& gradient, double distance);
  void skip(std::uint32_t i);
  /// Of gradient x, without the levels.
  struct Bounds {
    double lower = 0, upper = 0;
  };
  [[nodiscard]] Bounds bounds(std::uint32_t i) const { return {column(kLower)[i], column(kUpper)[i]}; }
  void set_bounds(std::uint32_t i, const Bounds& bounds);
  /// NaN of a row that does not count.
  [[nodiscard]] double distance(std::uint32_t i) const;
  /// Smallest and largest signed distance [mm].
  struct Extremes {
    double least = 0, most = 0;
  };
  [[nodiscard]] Extremes extremes() const;
  /// Largest |d| over the weight of its side, or over 1.
  [[nodiscard]] double largest(bool weighted) const;
  /// By how much the distances and the limits break their bounds at most; 0 where they do not.
  [[nodiscard]] double violation() const;

  /// So many limits; each is set or freed before a step.
  void set_limits(std::uint32_t count) { limits_ = count; }
  /// value + gradient x <= 0.
  void set_limit(std::uint32_t k, double value, const Vec6& gradient);
  void free_limit(std::uint32_t k) { skip(count_ + k); }
  [[nodiscard]] std::uint32_t limits() const { return limits_; }
  /// By how much the limits are broken at most; 0 where they are not.
  [[nodiscard]] double broken_limit() const;

  /// What an active constraint's index stands for: a distance; this or a limit; else the bound of a variable.
  [[nodiscard]] bool is_distance(int index) const { return index < static_cast<int>(count_); }
  [[nodiscard]] bool is_row(int index) const { return index < static_cast<int>(count_ + limits_); }
  [[nodiscard]] bool is_limit(int index) const { return is_row(index) && !is_distance(index); }

  /// All rows, without levels.
  [[nodiscard]] ConstraintRows view() const;
  /// Their levels are multiplied by the weights.
  void add_weights(ConstraintRows& rows) const;

 private:
  /// Columns: 0..5 the gradient, then
  static constexpr int kLower = 6, kUpper = 7, kWeight = 8, kLowerWeight = 9;
  [[nodiscard]] std::size_t stride() const { return std::size_t{capacity_} + kMostLimits; }
  [[nodiscard]] double* column(int k) const { return memory_ + static_cast<std::size_t>(k) * stride(); }

  double* memory_ = nullptr;
  std::uint32_t capacity_ = 0, count_ = 0, limits_ = 0;
  bool within_ = false;
  bool lopsided_ = false;  ///< a weight was set that is not the same on both sides
};

}  // namespace bladefit
