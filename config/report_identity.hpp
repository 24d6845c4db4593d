#pragma once
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/table_reader.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// What a report says of the blade and of those who measured it: the table [report] of a session or fit file. An empty
/// text was not given.
struct ReportIdentity {
  std::string part, serial, drawing, revision, order, machine, operated_by, inspector;
  std::vector<std::pair<std::string, std::string>> fields;  ///< further names with their texts, in alphabetical order

  [[nodiscard]] bool empty() const;
};

/// A key of the table, how a report names it, and where its text is.
struct IdentityRow {
  std::string_view key, label;
  std::string ReportIdentity::*text;
};

inline constexpr std::array<IdentityRow, 8> kIdentityRows = {{{"part", "Part", &ReportIdentity::part},
                                                              {"serial", "Serial number", &ReportIdentity::serial},
                                                              {"drawing", "Drawing", &ReportIdentity::drawing},
                                                              {"revision", "Revision", &ReportIdentity::revision},
                                                              {"order", "Order", &ReportIdentity::order},
                                                              {"machine", "Machine", &ReportIdentity::machine},
                                                              {"operator", "Operator", &ReportIdentity::operated_by},
                                                              {"inspector", "Inspector", &ReportIdentity::inspector}}};

/// Characters that a text of the table may have, and further fields that it may name.
inline constexpr std::size_t kMostIdentityText = 200, kMostIdentityFields = 24;

/// Reads the table [report]; what is wrong in it is kept in the reader's document.
void read_report_table(TableReader& table, ReportIdentity& identity);

/// Reads the table [report] of a file such as config/fit.toml, whatever else is in it. Errors: as load_fit().
[[nodiscard]] Failure load_report_identity(const std::string& path, ReportIdentity& identity);

}  // namespace bladefit
