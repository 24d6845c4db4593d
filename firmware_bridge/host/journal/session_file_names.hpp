#pragma once

namespace bladefit {

/// Files of a session folder. The journal is the host's; from it and the fit the last two are made when a session ends.
inline constexpr const char* kJournalFile = "journal.bin";
inline constexpr const char* kVerdictsFile = "verdicts.csv";
inline constexpr const char* kResultFile = "result.json";

}  // namespace bladefit
