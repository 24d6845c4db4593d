#pragma once
#include <cstdint>

namespace bladefit {

/// Outcome of every call of the core. 0 is plain success, positive values are success with a qualification, negative
/// values name the reason for which nothing was changed.
enum class Status : std::int32_t {
  ok = 0,
  underdetermined = 1,  ///< fewer than six degrees of freedom follow from the points
  more_work = 2,        ///< the budget of the call is spent; call again to go on
  memory_full = 3,      ///< judged and counted, but the point's place will not be revisited
  duplicate = 4,        ///< the sequence number is not above the last one; nothing changed
  iteration_cap = 5,    ///< the best answer so far, not a converged one
  precision_limit = 6,  ///< the best answer that double precision gives; its residuals say how good it is
  null_argument = -1,
  not_enough_memory = -2,
  misaligned = -3,
  not_finite = -4,
  out_of_range = -5,
  not_found = -6,
  infeasible = -7,
  unbounded = -8,
  not_convex = -9,
  bad_magic = -20,       ///< not a design image
  bad_version = -21,     ///< an image of another format version
  bad_length = -22,      ///< the image is shorter or longer than it says
  bad_crc = -23,         ///< the image is damaged
  bad_content = -24,     ///< the image contradicts itself
  bad_byte_order = -25,  ///< an image of this version, made for a processor of the other byte order
};

/// True where the call did what was asked, perhaps with a qualification.
[[nodiscard]] constexpr bool succeeded(Status status) { return static_cast<std::int32_t>(status) >= 0; }

/// One English phrase for a status; never null.
[[nodiscard]] const char* status_text(Status status);

}  // namespace bladefit
