#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/inspection/tolerance_map.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// The window a:b of patch parameters, 0 <= a < b <= 1.
struct ParameterWindow {
  double low = 0, high = 1;
};

/// Of lengths and ratios.
inline constexpr double kLargestSetting = 1e9;

/// The fit as a file or the command line gives it. What is not set is left to the caller, so that flags win over files.
/// Lengths are in `units`, by default those of the design file.
struct FitSettings {
  std::optional<std::string> mode;  ///< least_squares, minimax, range, min_tolerance or constrained
  std::optional<std::vector<std::string>> leading_edge;  ///< boxes [PATCH:]u:a:b, each accepted by parse_leading_edge
  std::optional<double> tolerance;                       ///< |distance| allowed at the leading edge, > 0
  std::optional<double> rest_tolerance;                  ///< |distance| allowed elsewhere, > 0
  std::optional<double> ratio;                           ///< rest tolerance / leading-edge tolerance, >= 1
  std::optional<double> transition;                      ///< width of the zone between them [patch parameter], 0..1
  std::optional<std::string> window;                     ///< a:b, accepted by parse_window
  std::optional<std::string> outward;                    ///< +, - or auto
  std::optional<double> probe_radius;                    ///< >= 0
  std::optional<std::string> units;                      ///< mm or in
  std::optional<std::string> regions;                    ///< follow or fixed
  std::optional<std::string> edges;                      ///< skip or use
  std::optional<std::string> lock;                       ///< tx,ty,tz,rx,ry,rz: some of these, by commas
  std::optional<std::string> loss;                       ///< none, huber or tukey
  std::optional<double> loss_scale;                      ///< standard deviation of good points, > 0
  std::optional<std::string> start;                      ///< file of point pairs that give the start pose
  std::optional<bool> ignore_approach;
};

/// Reads the table [fit] of a TOML file such as config/fit.toml into `settings`. Relative paths are those of the file's
/// folder, made ready to be used from the working directory.
/// Errors: unreadable file, TOML syntax, unknown key, wrong type, out of range; then `settings` is as before.
[[nodiscard]] Failure load_fit(const std::string& path, FitSettings& settings);

/// A leading-edge box as on the command line: `[PATCH:]u:0.4:0.6` or `[PATCH:]v:0.4:0.6`. Without PATCH it is patch 0;
/// the other parameter runs from 0 to 1. Error: a line that names the text and the mend.
[[nodiscard]] Failure parse_leading_edge(std::string_view text, ParameterBox& box);

/// Of the rigid motion, in the order of their bits.
inline constexpr std::array<std::string_view, 6> kDegreesOfFreedom = {"tx", "ty", "tz", "rx", "ry", "rz"};

/// Degrees of freedom as on the command line, `tx,rz`: bits 0 to 5 for tx, ty, tz, rx, ry, rz. Error: a line that names
/// the text and the mend.
[[nodiscard]] Failure parse_lock(std::string_view text, std::uint8_t& locked);

/// A window `a:b` as on the command line. Error: a line that names the text and the mend.
[[nodiscard]] Failure parse_window(std::string_view text, ParameterWindow& window);

}  // namespace bladefit
