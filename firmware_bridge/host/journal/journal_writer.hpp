#pragma once
#include "firmware_bridge/host/journal/journal.hpp"
#include "firmware_bridge/host/threads/host_shared.hpp"

namespace bladefit {

/// Puts on disk what comes through HostShared::to_journal: everything that waits goes out in one group, so that a slow
/// disk makes the groups larger and not the queue longer. Runs in a thread of its own, because the alarm of the newest
/// point must not wait for the disk. Returns when the ring is closed and empty, or at the first failure.
void write_journal(Journal& journal, HostShared& shared);

}  // namespace bladefit
