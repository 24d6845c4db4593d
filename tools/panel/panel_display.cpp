#include "tools/panel/panel_display.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kTurn{200};
constexpr std::chrono::seconds kLineEvery{1};
constexpr std::chrono::seconds kRateOver{3};

// ECMA-48 and xterm: the second screen, no cursor; and back.
constexpr const char* kTakeScreen = "\x1b[?1049h\x1b[?25l";
constexpr const char* kGiveScreenBack = "\x1b[?25h\x1b[?1049l";
constexpr const char* kHome = "\x1b[H";
constexpr const char* kClearLine = "\x1b[K";
constexpr const char* kClearBelow = "\x1b[J";

std::pair<int, int> screen_size() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    return {kScreenWidth, kScreenHeight};
  }
  return {size.ws_col, size.ws_row};
}

// https://no-color.org: any value but the empty one.
bool colour_is_wanted() {
  const char* const no_colour = std::getenv("NO_COLOR");
  return no_colour == nullptr || *no_colour == '\0';
}

/// A terminal that can place its cursor.
bool shows_screens() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) == 1 && kind != nullptr && *kind != '\0' && std::string_view(kind) != "dumb";
}

/// The first of these that is set decides (POSIX, Internationalization Variables).
bool shows_utf8() {
  for (const char* const name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* const locale = std::getenv(name);
    if (locale == nullptr || *locale == '\0') continue;
    const std::string_view text(locale);
    return text.find("UTF-8") != text.npos || text.find("utf8") != text.npos;
  }
  return false;
}

std::string key_words(bool may_leave) {
  return std::string("e figures   b big letters   ") + (may_leave ? "q leaves" : "Ctrl-C ends the session");
}

}  // namespace

PanelDisplay::PanelDisplay(const std::shared_ptr<PanelClient>& client, ScreenPage page)
    : PanelDisplay(
          client->address(), [client](PanelState& state) { return client->read(state); }, page, true) {}

PanelDisplay::PanelDisplay(std::string address, ReadPanel read)
    : PanelDisplay(std::move(address), std::move(read), ScreenPage::operator_page, false) {}

PanelDisplay::PanelDisplay(std::string address, ReadPanel read, ScreenPage page, bool may_leave)
    : read_(std::move(read)), terminal_(shows_screens()), may_leave_(may_leave) {
  view_.address = std::move(address);
  view_.colour = terminal_ && colour_is_wanted();
  view_.utf8 = terminal_ && shows_utf8();
  view_.page = page;
  if (terminal_) keyboard_.emplace();
  view_.keys = keyboard_ && keyboard_->works() ? key_words(may_leave) : "Ctrl-C ends";
}

PanelDisplay::~PanelDisplay() {
  if (!screen_taken_) return;
  std::fputs(kGiveScreenBack, stdout);
  std::fflush(stdout);
}

bool PanelDisplay::is_cut_off() const { return std::ferror(stdout) != 0; }

void PanelDisplay::turn() {
  const Clock::time_point now = Clock::now();
  const bool pressed = follow_keys();
  if (!pressed && now - last_turn_ < kTurn) return;
  last_turn_ = now;
  read_panel(now);
  if (!view_.known) return;
  if (terminal_) {
    show_screen();
  } else {
    show_line(now);
  }
}

void PanelDisplay::read_panel(Clock::time_point now) {
  failure_ = read_(view_.state);
  view_.connected = !failure_;
  if (view_.connected) {
    view_.known = true;
    last_good_ = now;
    measure_rate(now);
  }
  view_.age_s = std::chrono::duration<double>(now - last_good_).count();
}

/// True where one was pressed that changes what is shown.
bool PanelDisplay::follow_keys() {
  bool changed = false;
  const auto toggle = [&](ScreenPage page) {
    view_.page = view_.page == page ? ScreenPage::operator_page : page;
    changed = true;
  };
  if (!keyboard_) return false;
  for (char key = keyboard_->next(); key != '\0'; key = keyboard_->next()) {
    if (key == 'e') toggle(ScreenPage::figures);
    if (key == 'b') toggle(ScreenPage::big);
    if (key == 'q') leave_ = may_leave_;
  }
  return changed;
}

void PanelDisplay::measure_rate(Clock::time_point now) {
  const std::uint32_t points = view_.state.points;
  // Fewer points than before: another session, or a reset.
  if (!counts_.empty() && points < counts_.back().second) counts_.clear();
  counts_.emplace_back(now, points);
  while (now - counts_.front().first > kRateOver) counts_.pop_front();
  const std::chrono::duration<double> span = now - counts_.front().first;
  view_.points_per_second = span.count() > 0 ? (points - counts_.front().second) / span.count() : 0;
}

void PanelDisplay::show_screen() {
  std::string out = screen_taken_ ? "" : kTakeScreen;
  screen_taken_ = true;
  out += kHome;
  const auto [width, height] = screen_size();
  const std::vector<std::string> lines = draw_screen(view_, width, height);
  for (std::size_t row = 0; row < lines.size(); ++row) {
    // No line end after the last one: it would scroll a full screen.
    out += (row == 0 ? "" : "\r\n") + lines[row] + kClearLine;
  }
  out += kClearBelow;
  std::fwrite(out.data(), 1, out.size(), stdout);
  std::fflush(stdout);
}

void PanelDisplay::show_line(Clock::time_point now) {
  if (now - last_line_ < kLineEvery) return;
  last_line_ = now;
  std::fputs((status_line(view_) + "\n").c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace bladefit
