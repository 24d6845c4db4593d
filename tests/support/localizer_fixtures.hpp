#pragma once
/// What nearly every test of the localizer needs: a case with its design and points, and a localizer for them.
#include "tests/support/owned_localizer.hpp"
#include "tests/support/random_places.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/reference_design.hpp"
