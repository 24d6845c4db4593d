#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "drivers/source/failure.hpp"
#include "drivers/source/probe_source.hpp"
#include "drivers/source_settings.hpp"

namespace bladefit {

/// What the house needs to know of one protocol. Behind the scheme of a URI stands the place of the device.
struct SourceProtocol {
  std::string_view word;  ///< scheme of its URI, and its `kind` in a device file
  std::string_view form;  ///< of its URI, for help and messages; empty: only a device file can name it
  bool place_is_path;     ///< a file can give the place relative to its own folder

  SourceSettings (*defaults)();
  bool (*owns)(const SourceSettings& settings);
  /// Whether a device file that gives these settings may be pointed elsewhere by a URI of this protocol.
  bool (*accepts)(const SourceSettings& settings);
  /// Puts the place of a URI into settings that it accepts. bad_input with a phrase that names the part and the fix.
  Failure (*apply)(std::string_view place, SourceSettings& settings);
  std::string (*place)(const SourceSettings& settings);
  /// A source that is not yet open; `name` is for its messages.
  std::unique_ptr<ProbeSource> (*make)(const SourceSettings& settings, std::string name);
};

/// A row for each protocol, in the order in which help names them.
[[nodiscard]] std::span<const SourceProtocol> source_protocols();

/// The protocol of this word; null = there is none.
[[nodiscard]] const SourceProtocol* find_protocol(std::string_view word);

/// The protocol that owns these settings; null where nobody has said which.
[[nodiscard]] const SourceProtocol* protocol_of(const SourceSettings& settings);

/// Every word, as in "modbus-tcp, serial or replay".
[[nodiscard]] std::string source_words();

/// The form of every URI, as in "modbus-tcp://HOST:PORT, serial:DEVICE or replay:FILE.csv".
[[nodiscard]] std::string source_uri_forms();

}  // namespace bladefit
