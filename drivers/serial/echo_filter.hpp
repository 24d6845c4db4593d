#pragma once
#include <deque>
#include <string>
#include <string_view>

namespace bladefit {

/// Takes the host's own lines out of what comes in, where an RS-485 adapter hears its own sending.
class EchoFilter {
 public:
  static constexpr std::size_t kMostExpected = 64;  ///< lines sent whose echo has not come

  /// Lines as they were sent, `$` and line ends included.
  void sent(std::string_view lines);

  /// Whether a line as the framer gives it is an echo that was expected. Echoes before it that did not come are given
  /// up.
  [[nodiscard]] bool takes(std::string_view line);

  /// True where far more was sent than came back: this line has no echo.
  [[nodiscard]] bool overdue() const { return expected_.size() > kMostExpected; }

  void reset() { expected_.clear(); }

 private:
  std::deque<std::string> expected_;
};

}  // namespace bladefit
