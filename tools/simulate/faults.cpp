#include "tools/simulate/faults.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <utility>

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {
namespace {

constexpr double kLongestDelayMs = 60000;

[[noreturn]] void refuse(std::string_view item, std::string_view fix) {
  throw ToolError(fmt::format("--faults: `{}`: {}", item, fix));
}

template <typename Number>
Number parse_number(std::string_view item, std::string_view text, std::string_view fix) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) refuse(item, fix);
  return number;
}

double parse_probability(std::string_view item, std::string_view text) {
  constexpr std::string_view kFix = "needs a probability from 0 to 1, for example drop=0.01";
  const auto probability = parse_number<double>(item, text, kFix);
  if (!(probability >= 0 && probability <= 1)) refuse(item, kFix);
  return probability;
}

/// "0.05:200ms" sets the probability and the time; "0.05" the probability alone.
void parse_delay(std::string_view item, std::string_view text, FaultSettings& settings) {
  constexpr std::string_view kFix =
      "needs PROBABILITY:TIMEms with a time from 0 to 60000 ms, for example delay=0.05:200ms";
  const std::size_t colon = text.find(':');
  settings.delay = parse_probability(item, text.substr(0, colon));
  if (colon == std::string_view::npos) return;
  std::string_view time = text.substr(colon + 1);
  if (!time.ends_with("ms")) refuse(item, kFix);
  time.remove_suffix(2);
  const auto milliseconds = parse_number<double>(item, time, kFix);
  if (!(milliseconds >= 0 && milliseconds <= kLongestDelayMs)) refuse(item, kFix);
  settings.delay_time = std::chrono::nanoseconds(static_cast<std::int64_t>(milliseconds * 1e6));
}

void parse_item(std::string_view item, FaultSettings& settings) {
  const std::array<std::pair<std::string_view, double*>, 4> probabilities{{{"drop", &settings.drop},
                                                                           {"duplicate", &settings.duplicate},
                                                                           {"corrupt", &settings.corrupt},
                                                                           {"disconnect", &settings.disconnect}}};
  if (item == "overflow") {
    settings.overflow = true;
    return;
  }
  const std::size_t equals = item.find('=');
  const std::string_view name = item.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? std::string_view{} : item.substr(equals + 1);
  for (const auto& [fault, probability] : probabilities) {
    if (name == fault) {
      *probability = parse_probability(item, value);
      return;
    }
  }
  if (name == "delay") {
    parse_delay(item, value, settings);
  } else if (name == "seed") {
    settings.seed = parse_number<std::uint64_t>(item, value, "needs a whole number, for example seed=7");
  } else {
    refuse(item, "is unknown; use drop, duplicate, corrupt, delay, disconnect, overflow or seed");
  }
}

}  // namespace

FaultSettings parse_faults(std::string_view specification, const FaultSettings& defaults) {
  FaultSettings settings = defaults;
  while (!specification.empty()) {
    const std::size_t comma = specification.find(',');
    parse_item(specification.substr(0, comma), settings);
    if (comma == std::string_view::npos) break;
    specification.remove_prefix(comma + 1);
  }
  return settings;
}

Fault FaultSource::draw() {
  const std::array<std::pair<Fault, double>, 5> faults{{{Fault::disconnect, settings_.disconnect},
                                                        {Fault::drop, settings_.drop},
                                                        {Fault::delay, settings_.delay},
                                                        {Fault::corrupt, settings_.corrupt},
                                                        {Fault::duplicate, settings_.duplicate}}};
  Fault drawn = Fault::none;
  // Every draw takes the same number of random numbers, so that one fault more does not shift all the others.
  for (const auto& [fault, probability] : faults) {
    const bool strikes = random_.next_fraction() < probability;
    if (strikes && drawn == Fault::none) drawn = fault;
  }
  return drawn;
}

}  // namespace bladefit::simulate
