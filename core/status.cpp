#include "core/status.hpp"

namespace bladefit {

const char* status_text(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::underdetermined:
      return "the points do not determine all six degrees of freedom";
    case Status::more_work:
      return "more work to do";
    case Status::memory_full:
      return "memory full: the point is judged and counted but will not be revisited";
    case Status::duplicate:
      return "the sequence number is not above the last one";
    case Status::iteration_cap:
      return "the iteration limit was reached before convergence";
    case Status::precision_limit:
      return "double precision does not decide the problem: scale it better";
    case Status::null_argument:
      return "an argument is null";
    case Status::not_enough_memory:
      return "the memory block is too small";
    case Status::misaligned:
      return "the memory block is not aligned";
    case Status::not_finite:
      return "a number is NaN or infinite";
    case Status::out_of_range:
      return "a value is out of its range";
    case Status::not_found:
      return "no such point";
    case Status::infeasible:
      return "no solution satisfies all constraints";
    case Status::unbounded:
      return "the objective has no minimum on the constraints";
    case Status::not_convex:
      return "the Hessian is not positive definite";
    case Status::bad_magic:
      return "not a bladefit design image: compile the design again";
    case Status::bad_version:
      return "a design image of another format version: compile the design again";
    case Status::bad_length:
      return "the design image is cut off or too long: compile the design again";
    case Status::bad_crc:
      return "the design image is damaged (CRC): compile the design again";
    case Status::bad_content:
      return "the design image contradicts itself: compile the design again";
    case Status::bad_byte_order:
      return "a design image made for a processor of the other byte order: compile the design for this one";
  }
  return "unknown status";
}

}  // namespace bladefit
