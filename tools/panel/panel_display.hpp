#pragma once
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "tools/panel/keyboard.hpp"
#include "tools/panel/panel_client.hpp"
#include "tools/panel/screen.hpp"

namespace bladefit {

/// Shows a panel on standard output: on a terminal a screen that is redrawn in place, elsewhere, and on one that
/// cannot place its cursor, a line a second. The terminal is as it was when the display goes.
class PanelDisplay {
 public:
  /// Of another process; the key q leaves.
  PanelDisplay(const std::shared_ptr<PanelClient>& client, ScreenPage page);

  /// Shows what `read` gives, of the session in this process; `address` is where others find it.
  using ReadPanel = std::function<Failure(PanelState& state)>;
  PanelDisplay(std::string address, ReadPanel read);
  ~PanelDisplay();
  PanelDisplay(const PanelDisplay&) = delete;
  PanelDisplay& operator=(const PanelDisplay&) = delete;

  /// Follows the keys; reads the panel and shows what it says, or that it does not answer. Without a key it does
  /// nothing when the last turn was less than a fifth of a second ago.
  void turn();

  /// The key to leave was pressed.
  [[nodiscard]] bool wants_to_leave() const { return leave_; }

  /// Nobody takes the output any more: the terminal or the reader of a pipe is gone.
  [[nodiscard]] bool is_cut_off() const;

  /// Why the last turn that read the panel could not.
  [[nodiscard]] const Failure& failure() const { return failure_; }

 private:
  using Clock = std::chrono::steady_clock;
  PanelDisplay(std::string address, ReadPanel read, ScreenPage page, bool may_leave);
  [[nodiscard]] bool follow_keys();
  void read_panel(Clock::time_point now);
  void measure_rate(Clock::time_point now);
  void show_screen();
  void show_line(Clock::time_point now);

  ReadPanel read_;
  ScreenView view_;
  bool terminal_, may_leave_;
  bool screen_taken_ = false, leave_ = false;
  std::optional<Keyboard> keyboard_;
  Failure failure_;
  Clock::time_point last_turn_{}, last_line_{}, last_good_{};
  std::deque<std::pair<Clock::time_point, std::uint32_t>> counts_;  // of the last seconds
};

}  // namespace bladefit
