#include "tools/commands/panel_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "firmware_bridge/host/panel/panel_address.hpp"
#include "tools/commands/run_stop_flag.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/panel/panel_display.hpp"
#include "tools/panel/panel_map_text.hpp"

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kPause{50};

int show_panel(const std::string& address, bool big) {
  std::string host;
  std::uint16_t port = 0;
  if (!parse_address(address, host, port)) {
    fmt::print(stderr, "bladefit: --connect {}: is not an address; use HOST:PORT, for example 127.0.0.1:1503\n",
               address);
    return kBadInput;
  }
  const StopFlag stop;
  PanelDisplay display(std::make_shared<PanelClient>(host, port), big ? ScreenPage::big : ScreenPage::operator_page);
  // The display recovers from later losses by itself: the host may be started again.
  display.turn();
  if (display.failure()) throw ToolError(display.failure());
  while (!stop.requested() && !display.is_cut_off() && !display.wants_to_leave()) {
    display.turn();
    std::this_thread::sleep_for(kPause);
  }
  return 0;
}

}  // namespace

void add_panel_command(CLI::App& app, int& exit_code) {
  const auto address = std::make_shared<std::string>("127.0.0.1:1503");
  const auto map = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("panel", "show a running session live; q or Ctrl-C ends");
  command->add_option("--connect", *address, "HOST:PORT of the session's panel")->capture_default_str();
  command->add_option("--map", *map, "print the register map that the panel serves, as csv or markdown, and end")
      ->check(CLI::IsMember({"csv", "markdown"}));
  command->footer(
      "\nExamples:\n"
      "  bladefit panel --connect 192.168.0.20:1503\n"
      "  bladefit panel --big\n"
      "  bladefit panel --map markdown > registers.md");
  const auto big = std::make_shared<bool>(false);
  command->add_flag("--big", *big, "four lines in block letters, to be read from afar; the key b changes it");
  command->callback([address, map, big, &exit_code] {
    if (map->empty()) {
      exit_code = show_panel(*address, *big);
    } else {
      fmt::print("{}", *map == "csv" ? panel_map_csv() : panel_map_markdown());
      exit_code = 0;
    }
  });
}

}  // namespace bladefit
