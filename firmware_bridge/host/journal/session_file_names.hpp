#pragma once

namespace bladefit {

/// Files of a session folder. Journal and settings are the host's; from them and the fit the last two are made when a
/// session ends.
inline constexpr const char* kJournalFile = "journal.bin";
inline constexpr const char* kSettingsFile = "settings.txt";
inline constexpr const char* kVerdictsFile = "verdicts.csv";
inline constexpr const char* kResultFile = "result.json";

}  // namespace bladefit
