#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/fit_settings.hpp"
#include "config/point_plan.hpp"
#include "config/report_identity.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// The operator's panel over Modbus TCP, and the page in a browser.
struct PanelSettings {
  std::optional<std::string> address;             ///< to listen at; the host's default is 127.0.0.1
  std::optional<std::uint16_t> port;              ///< 0 = any free one; the host's default is 1503
  std::optional<bool> commands;                   ///< whether coils may be written
  std::optional<bool> low_word_first;             ///< which register of a number comes first
  std::optional<double> infinity;                 ///< sent for what is infinite; not NaN
  std::optional<double> linger;                   ///< [s] that the panel stays with the result of an ended session
  std::optional<std::vector<std::string>> allow;  ///< addresses that may connect; empty = every one
  std::optional<std::string> http;                ///< HOST:PORT to serve the web panel at; it is off unless set
  std::optional<std::string> http_token_file;     ///< holds what a page must know that presses commands
};

/// A session as a file gives it. What is not set is left to the caller, so that flags win over the file.
/// Relative paths are those of the file's folder, made ready to be used from the working directory.
struct SessionSettings {
  std::optional<std::string> design;      ///< .igs, .iges, .stp, .step or .bfd
  std::optional<std::string> source;      ///< a source URI, as on the command line
  std::optional<std::string> device;      ///< device TOML; where `source` is set too, that one says where the device is
  std::optional<std::string> session;     ///< directory of the journal and the results
  std::optional<double> until_idle;       ///< [s], > 0
  std::optional<std::uint32_t> capacity;  ///< points that keep a place in the fit, 6..16777216
  std::optional<bool> headless;           ///< no screen
  std::optional<PointPlan> plan;          ///< of the points that will come
  FitSettings fit;
  PanelSettings panel;
  ReportIdentity report;  ///< what reports say of the blade
};

/// Reads a TOML file such as config/session.toml into `settings`.
/// Errors: unreadable file, TOML syntax, unknown key, wrong type, out of range; then `settings` is as before.
[[nodiscard]] Failure load_session(const std::string& path, SessionSettings& settings);

}  // namespace bladefit
