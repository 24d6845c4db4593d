#pragma once
#include "core/programs/constraint_rows.hpp"

namespace bladefit {

/// Constraints held as equalities, with the orthogonal factor of their normals. Everything is in the variables y in
/// which the objective is 1/2 |y + v|^2; the minimum on the set,
///
///     y + v = M lambda + mu m,   M'y = offsets,
///
/// is computed afresh from the factor after each change (8 x 8: a microsecond), never updated, so that rounding does
/// not build up however many changes there are. Columns are made orthogonal twice (Kahan: twice is enough).
class WorkingSet {
 public:
  struct Member {
    int index = 0;
    Side side = Side::lower;
  };

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] Member member(int k) const { return members_[static_cast<std::size_t>(k)]; }
  /// The least part of a member's normal that those before it do not span: what divides, and so raises, the rounding of
  /// multipliers. Infinite where there is none.
  [[nodiscard]] double least_own_part() const;
  /// -1: not a member.
  [[nodiscard]] int find(int index, Side side) const;

  /// Adds a constraint with normal m. False, and nothing is changed: m depends on the members' normals to rounding.
  bool append(const Member& member, const Vec8& normal, double offset);
  void remove(int k);
  void set_offset(int k, double offset) { offsets_[k] = offset; }

  /// m = M coefficients + rest, the rest orthogonal to M and 0 where it is rounding.
  struct Split {
    Vec8 coefficients = Vec8::Zero();
    Vec8 rest = Vec8::Zero();
  };
  [[nodiscard]] Split split(const Vec8& vector) const;

  /// The minimum on the set, the term mu m included in `pull` = mu m - v; multipliers of the members.
  struct Minimum {
    Vec8 y = Vec8::Zero();
    Vec8 multipliers = Vec8::Zero();
  };
  [[nodiscard]] Minimum minimum(const Vec8& pull) const;

  /// The member whose multiplier reaches 0 first when all of them move by -step * coefficients; -1: none does.
  struct Ratio {
    double step = std::numeric_limits<double>::infinity();
    int member = -1;
  };
  /// `norm`: of the normal that the coefficients belong to, against which a coefficient may be rounding.
  [[nodiscard]] Ratio first_to_leave(const Vec8& multipliers, const Vec8& coefficients, double norm) const;

 private:
  struct Projection {
    Vec8 within = Vec8::Zero();  ///< Q'm
    Vec8 rest = Vec8::Zero();
  };
  [[nodiscard]] Projection project(const Vec8& vector) const;
  [[nodiscard]] Vec8 solve(const Vec8& b) const;             ///< R^-1 b
  [[nodiscard]] Vec8 solve_transposed(const Vec8& b) const;  ///< R'^-1 b

  int size_ = 0;
  std::array<Member, kMaxVariables> members_;
  Mat8 normals_ = Mat8::Zero();
  Vec8 offsets_ = Vec8::Zero();
  Mat8 q_ = Mat8::Zero(), r_ = Mat8::Zero();
};

}  // namespace bladefit
