#pragma once

namespace bladefit {

/// "commit 1a2b3c" of the sources that were built, with -dirty where they were changed since; written at each build.
extern const char* const kCommit;

}  // namespace bladefit
