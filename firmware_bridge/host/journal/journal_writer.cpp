#include "firmware_bridge/host/journal/journal_writer.hpp"

#include <array>

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kFlushWait{100};

struct Group {
  std::array<StreamEvent, kJournalGroup> events;
  std::size_t count = 0;
  std::uint32_t last_sequence = 0;
};

void take_group(Ring<StreamEvent>& ring, Group& group) {
  group.count = 0;
  while (group.count < kJournalGroup && ring.pop(group.events[group.count])) {
    const StreamEvent& event = group.events[group.count++];
    if (event.kind == EventKind::point || event.kind == EventKind::lost) group.last_sequence = event.point.sequence;
  }
}

}  // namespace

void write_journal(Journal& journal, HostShared& shared) {
  Group group;
  while (true) {
    const bool closed = shared.journal_closed.load();
    take_group(shared.to_journal.ring, group);
    if (group.count == 0 && closed) return;
    Failure error = journal.append(std::span(group.events).first(group.count));
    if (!error) error = journal.check_link();
    if (error) {
      shared.outcome.fail(error);
      return;
    }
    if (group.count == 0) {
      shared.to_journal.wakeup.wait(kFlushWait);
      continue;
    }
    if (group.last_sequence != 0) shared.stored.sequence.store(group.last_sequence);
    shared.stored.events.fetch_add(group.count);
    shared.stored.wakeup.signal();
  }
}

}  // namespace bladefit
