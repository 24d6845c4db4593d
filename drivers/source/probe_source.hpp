#pragma once
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/probe_point.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

enum class LinkState : std::uint8_t { connecting, up, lost };

/// Published state of a source, for the panel and the log.
struct SourceStatus {
  LinkState link = LinkState::connecting;
  bool finished = false;  ///< the device said that the program is finished, and every record was delivered or given up
  std::uint32_t planned = 0;  ///< records that there will be in all; 0 = not known
  std::uint32_t last = 0;     ///< every record up to this sequence was handed out or is given up for good
  bool device_fault = false;  ///< the device says that it has a fault
  bool behind = false;        ///< records are known to be there that have not been delivered yet
  std::uint32_t run_id = 0;  ///< of the device; another value means that numbering has restarted; without runs always 0
  std::uint64_t records = 0;  ///< good records received, resent ones included
  std::uint64_t duplicates = 0;
  std::uint64_t damaged = 0;  ///< records or frames whose check sum or sequence was wrong
  std::uint64_t resends = 0;  ///< how often records were asked for again
  std::uint64_t reconnects = 0;
  std::uint32_t consecutive_faults = 0;  ///< 0 after any good exchange
  std::string stopped;  ///< why nothing more will be delivered, with the fix; empty = it goes on. Not for a new run id
  std::string last_fault;               ///< the newest fault in words; empty = none so far
  std::uint64_t losses = 0;             ///< how often records were lost in the device, not to be had again
  std::uint64_t unnumbered_losses = 0;  ///< how many of these have left no jump in the sequence
  std::string last_loss;                ///< the newest in words: which records, why, and the fix
  std::vector<std::string> remarks;     ///< what the user should know though no record is lost; each is told once
};

/// Where probe points come from: a machine or a recording. One thread owns it.
/// It delivers every record once, in rising sequence order, whatever the link does in between; a jump in the sequence
/// happens only where the device itself has lost records, which status().losses counts.
class ProbeSource {
 public:
  virtual ~ProbeSource() = default;

  /// Connects and asks for the records after `after` (0 = from the first). A device that is missing, busy, of another
  /// map version or of a wrong word order is an error here; later losses of the link are overcome by the source itself.
  /// `run_id` is the run that the records up to `after` are of (where there are any): a device that is in another one
  /// is left as it is, where the protocol shows the run before it asks for anything; status() says which run it is in.
  [[nodiscard]] virtual Failure open(std::uint32_t after, std::uint32_t run_id) = 0;

  /// Whether the device can say that its program is finished. Where not, the session's own end has to stand for that.
  [[nodiscard]] virtual bool tells_end() const { return true; }

  /// Waits for at most `timeout` and writes the next records to `points`. Returns how many; 0 is no error.
  [[nodiscard]] virtual std::size_t poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) = 0;

  /// Tells the device that every record up to `sequence` is safely stored. Sent with the next poll() at the latest.
  virtual void acknowledge(std::uint32_t sequence) = 0;

  /// Sends what is still to be acknowledged, asks the device to stop, closes the link. Takes at most one second.
  virtual void close() = 0;

  [[nodiscard]] virtual const SourceStatus& status() const = 0;
};

}  // namespace bladefit
