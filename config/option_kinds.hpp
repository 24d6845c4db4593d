#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/fit_settings.hpp"
#include "core/localizer.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

inline constexpr double kLargestGiven = 1e9;  ///< accepted length [units] or ratio

// Kinds of options. `value` is where the parsed value is kept, `Given` how a file or the command line gives it. For
// each kind a set() parses what is given; its error is the reason alone, before which the caller names flag or key, and
// leaves the settings as they were.

/// A number from `low` to `high`; with `above`, low itself is excluded.
struct NumberOption {
  using Given = double;
  std::optional<double> FitSettings::*value;
  double low, high;
  bool above = false;
};

/// A length, 0 or above; with `above`, 0 itself is excluded.
struct LengthOption {
  using Given = Length;
  std::optional<Length> FitSettings::*value;
  bool above = false;
};

/// One of `words`, which stand in the order of the enumeration's values.
template <typename Enum>
struct ChoiceOption {
  using Given = std::string;
  std::optional<Enum> FitSettings::*value;
  std::span<const std::string_view> words;
};

/// Leading-edge zones, each as parse_edge_zone() reads it.
struct ZonesOption {
  using Given = std::vector<std::string>;
  std::optional<std::vector<EdgeZone>> FitSettings::*value;
};

/// As parse_place() reads it.
struct PlaceOption {
  using Given = std::string;
  std::optional<Vec3> FitSettings::*value;
};

/// As parse_outward() reads it.
struct OutwardKind {
  using Given = std::string;
  std::optional<OutwardChoice> FitSettings::*value;
};

/// Any texts.
struct NamesOption {
  using Given = std::vector<std::string>;
  std::optional<std::vector<std::string>> FitSettings::*value;
};

/// As parse_window() reads it.
struct WindowOption {
  using Given = std::string;
  std::optional<ParameterWindow> FitSettings::*value;
};

/// Degrees of freedom, as parse_lock() reads them.
struct LocksOption {
  using Given = std::string;
  std::optional<std::uint8_t> FitSettings::*value;
};

/// As parse_mpe() reads it.
struct MpeOption {
  using Given = std::string;
  std::optional<ProbeError> FitSettings::*value;
};

/// As parse_axis() reads it.
struct AxisOption {
  using Given = std::string;
  std::optional<ShaftAxis> FitSettings::*value;
};

/// A file, or a word that stands for none. In a TOML file a relative path is taken from the folder of that file.
struct PathOption {
  using Given = std::string;
  std::optional<std::string> FitSettings::*value;
  std::string_view word = {};
};

/// Names of the columns of the points file, as check_point_columns() takes them.
struct ColumnsOption {
  using Given = std::string;
  std::optional<std::string> FitSettings::*value;
};

/// Given or not on the command line, true or false in a file.
struct FlagOption {
  using Given = bool;
  std::optional<bool> FitSettings::*value;
};

using FitOptionKind =
    std::variant<NumberOption, LengthOption, ChoiceOption<FitMode>, OutwardKind, NamesOption, ChoiceOption<Unit>,
                 ChoiceOption<RegionPolicy>, ChoiceOption<EdgePolicy>, ChoiceOption<Loss>, ChoiceOption<DecisionRule>,
                 MpeOption, ZonesOption, PlaceOption, ChoiceOption<Rotation>, WindowOption, LocksOption, AxisOption,
                 PathOption, ColumnsOption, FlagOption>;

[[nodiscard]] Failure set(const NumberOption& option, double given, FitSettings& settings);
[[nodiscard]] Failure set(const LengthOption& option, const Length& given, FitSettings& settings);
[[nodiscard]] Failure set(const ZonesOption& option, const std::vector<std::string>& given, FitSettings& settings);
[[nodiscard]] Failure set(const PlaceOption& option, const std::string& given, FitSettings& settings);
[[nodiscard]] Failure set(const OutwardKind& option, const std::string& given, FitSettings& settings);
[[nodiscard]] Failure set(const NamesOption& option, const std::vector<std::string>& given, FitSettings& settings);
[[nodiscard]] Failure set(const WindowOption& option, const std::string& given, FitSettings& settings);
[[nodiscard]] Failure set(const LocksOption& option, const std::string& given, FitSettings& settings);
[[nodiscard]] Failure set(const MpeOption& option, const std::string& given, FitSettings& settings);
[[nodiscard]] Failure set(const AxisOption& option, const std::string& given, FitSettings& settings);
[[nodiscard]] Failure set(const PathOption& option, const std::string& given, FitSettings& settings);
[[nodiscard]] Failure set(const ColumnsOption& option, const std::string& given, FitSettings& settings);
[[nodiscard]] Failure set(const FlagOption& option, bool given, FitSettings& settings);

/// The place of a text among words. Error: it is none of them.
[[nodiscard]] Failure find_word(std::span<const std::string_view> words, std::string_view text, std::size_t& place);

template <typename Enum>
[[nodiscard]] Failure set(const ChoiceOption<Enum>& option, const std::string& given, FitSettings& settings) {
  std::size_t place = 0;
  if (const Failure error = find_word(option.words, given, place)) return error;
  settings.*option.value = static_cast<Enum>(place);
  return {};
}

}  // namespace bladefit
