#include "config/fit_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "config/fit_option.hpp"
#include "config/report_identity.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kWidth = 100;  ///< columns of a comment

/// A comment of whole words, at most kWidth columns wide where they allow it.
std::string comment(std::string_view text) {
  std::string out = "#";
  std::size_t column = 1;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (column > 1 && column + 1 + word.size() > kWidth) {
      out += "\n#";
      column = 1;
    }
    out += fmt::format(" {}", word);
    column += 1 + word.size();
  }
  return out + "\n";
}

/// Examples of tables [[zone]].
std::string zones_toml() {
  return "\n" +
         comment(
             "Tolerances zone by zone, in place of leading_edge, tolerance, ratio and transition above. A point is "
             "judged by the first zone that its foot lies in, outside of all by rest_tolerance. where: a leading "
             "edge as leading_edge takes it, a band of radii r/R 0.7:1.0 (limits included, from 0 to 1.2, of "
             "tip_radius about axis), or both: then within that band; plus: excess material that is allowed, "
             "minus: missing material, in units. The modes min_tolerance and constrained need rest_tolerance beside "
             "them") +
         "# [[zone]]\n# name = \"tip edge\"\n# where = \"auto:5mm r/R 0.7:1.0\"\n# plus = 0.10\n# minus = 0.05\n"
         "\n# [[zone]]\n# name = \"outer blade\"\n# where = \"r/R 0.7:1.0\"\n# plus = \"0.3mm\"\n# minus = "
         "\"0.2mm\"\n";
}

/// The table [report], whose texts are those of an example.
std::string report_toml() {
  std::string text =
      "\n# What reports say of the blade, and further names with their texts. Every key may be left out.\n[report]\n";
  for (const IdentityRow& row : kIdentityRows) text += fmt::format("# {} = \"\"\n", row.key);
  return text + "\n[report.fields]\n# \"heat number\" = \"\"\n";
}

}  // namespace

std::string fit_toml() {
  std::string text =
      "# Fit options for `bladefit localize --config FILE`. Flags on the command line win over them. Every key may be "
      "left out.\n[fit]\n";
  for (const FitOption& option : fit_options()) {
    text += "\n" + comment(option.help);
    text += fmt::format("{}{} = {}\n", option.active ? "" : "# ", option.key, option.example);
  }
  return text + zones_toml() + report_toml();
}

}  // namespace bladefit
