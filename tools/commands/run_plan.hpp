#pragma once
#include <chrono>
#include <string>
#include <vector>

#include "config/session_settings.hpp"
#include "drivers/source_settings.hpp"
#include "firmware_bridge/host/host.hpp"
#include "tools/batch/fit_options.hpp"
#include "tools/commands/report_record_of.hpp"
#include "tools/commands/volume_flags.hpp"
#include "tools/web/web_settings.hpp"

namespace bladefit {

/// What the command line of `run` says; an empty text or a missing value says nothing.
struct RunFlags {
  std::string config;  ///< session TOML
  std::string json;    ///< where to write a copy of result.json; - = standard output
  std::string panel;   ///< HOST:PORT
  std::string http;    ///< HOST:PORT
  Volume volume;
  SessionSettings session;
};

/// A session ready to start.
struct RunPlan {
  LoadedDesign design;  ///< holds the memory of `image`
  DesignImage image;
  FitPlan fit;
  SourceSettings source;
  HostSettings host;
  std::optional<WebSettings> web;  ///< where there is to be a web panel
  bool headless = false;
  std::chrono::milliseconds linger{0};  ///< that the panel stays with the result
  std::string json;
  ReportIdentity report;  ///< what reports say of the blade
  FileRoles files;        ///< that the session rests on
  Volume volume;
};

/// Reads the session file, lets the flags win, loads the design and checks everything that can be checked before the
/// device is touched. Throws ToolError that names the option or file and the fix.
[[nodiscard]] RunPlan plan_run(const RunFlags& flags);

}  // namespace bladefit
