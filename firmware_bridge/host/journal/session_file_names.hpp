#pragma once

namespace bladefit {

/// Files of a session folder. Journal and settings are the host's; from them and the fit verdicts and result are made
/// when a session ends. The record and the design it was judged by are what reports are made from beside them.
inline constexpr const char* kJournalFile = "journal.bin";
inline constexpr const char* kSettingsFile = "settings.txt";
inline constexpr const char* kVerdictsFile = "verdicts.csv";
inline constexpr const char* kResultFile = "result.json";
inline constexpr const char* kRecordFile = "report.json";
inline constexpr const char* kDesignFile = "design.bfd";

}  // namespace bladefit
