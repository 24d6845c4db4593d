#include "config/fit_table.hpp"

#include <type_traits>
#include <variant>

#include "config/fit_option.hpp"

namespace bladefit {
namespace {

template <typename Kind>
void read_option(TableReader& table, std::string_view key, const Kind& kind, FitSettings& settings) {
  if (!table.has(key)) return;
  typename Kind::Given given{};
  if constexpr (std::is_same_v<Kind, PathOption>) {
    table.read(key, given);
    if (table.good() && (kind.word.empty() || given != kind.word)) table.read_path(key, given);
  } else {
    table.read(key, given);
  }
  if (!table.good()) return;
  if (const Failure error = set(kind, given, settings)) table.fail(key, error.message);
}

}  // namespace

void read_fit_table(TableReader& table, FitSettings& settings) {
  for (const FitOption& option : fit_options()) {
    std::visit([&](const auto& kind) { read_option(table, option.key, kind, settings); }, option.kind);
  }
  table.finish();
}

}  // namespace bladefit
