#include "tools/web/feed_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace bladefit {
namespace {

constexpr unsigned kActionFactor = 8, kRegionFactor = 32;

unsigned kind_of(const FedVerdict& verdict) {
  return static_cast<unsigned>(verdict.state) + kActionFactor * static_cast<unsigned>(verdict.action) +
         kRegionFactor * static_cast<unsigned>(verdict.region);
}

/// JSON has no number for what is not finite: 0.
float finite(float value) { return std::isfinite(value) ? value : 0.0F; }

}  // namespace

std::string piece_json(const FeedPiece& piece, std::span<const FedPoint> points) {
  std::string text = fmt::format(R"({{"afresh":{},"more":{},"rows":[)", piece.afresh, piece.more);
  auto to = std::back_inserter(text);
  const char* comma = "";
  for (const FedPoint& point : points) {
    const FedVerdict& verdict = point.verdict;
    fmt::format_to(to, "{}{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f},{:.4g},{},{},{}", comma, point.slot,
                   verdict.sequence, finite(point.foot[0]), finite(point.foot[1]), finite(point.foot[2]),
                   finite(point.normal[0]), finite(point.normal[1]), finite(point.normal[2]), finite(verdict.distance),
                   finite(verdict.tolerance), kind_of(verdict), verdict.revision, verdict.time_ms);
    comma = ",";
  }
  text += "]}";
  return text;
}

std::string history_json(std::uint32_t sequence, std::span<const FedVerdict> history) {
  std::string text = fmt::format(R"({{"sequence":{},"history":[)", sequence);
  auto to = std::back_inserter(text);
  const char* comma = "";
  for (const FedVerdict& verdict : history) {
    fmt::format_to(
        to, R"({}{{"time_ms":{},"distance":{:.4f},"tolerance":{:.4g},"uncertainty":{:.4f},"revision":{},"kind":{}}})",
        comma, verdict.time_ms, finite(verdict.distance), finite(verdict.tolerance), finite(verdict.uncertainty),
        verdict.revision, kind_of(verdict));
    comma = ",";
  }
  text += "]}";
  return text;
}

}  // namespace bladefit
