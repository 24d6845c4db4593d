// Linked into the digest program, this takes the place of the core's function, which the linker then leaves in its
// archive: no wide registers are in use.

#include "core/geometry/simd/lanes.hpp"

bool bladefit::lanes_available() { return false; }
