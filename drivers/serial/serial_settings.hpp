#pragma once
#include <chrono>

#include "drivers/serial/line_settings.hpp"

namespace bladefit {

/// Serial protocol v1.
struct SerialSettings {
  SerialLineSettings line;
  std::chrono::milliseconds start_interval{500};      ///< an unanswered $START is repeated after this
  std::chrono::milliseconds resend_interval{250};     ///< least time between two $NAK for the same record
  std::chrono::milliseconds resend_pause{50};         ///< least time between any two $NAK, and patience after damage
  std::chrono::milliseconds silence{1000};            ///< after this without a frame the host asks again
  std::chrono::milliseconds open_timeout{5000};       ///< a device that has not answered $START by then is an error
  std::chrono::milliseconds reconnect_first{50};      ///< first pause before opening the port again; it doubles ...
  std::chrono::milliseconds reconnect_longest{1000};  ///< ... up to this
  int resend_tries = 100;                             ///< how often a record is asked for before it counts as lost
  bool echo = false;                                  ///< RS-485: every byte that is sent is received first
};

}  // namespace bladefit
