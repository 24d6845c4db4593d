#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/journal/journal_format.hpp"

namespace bladefit {

/// Reads up to `bytes` at `offset`. Returns how many there were; nothing at a read error, which errno tells.
[[nodiscard]] std::optional<std::size_t> read_at(int descriptor, std::span<std::byte> bytes, std::uint64_t offset);

/// Gives the records behind the header, whole or not, with their places from 1 on, until `visit` returns false or no
/// further one is complete. False at a read error.
[[nodiscard]] bool visit_records(int descriptor,
                                 const std::function<bool(const JournalRecord&, std::uint32_t place)>& visit);

/// That the file cannot be read, with the reason in errno.
[[nodiscard]] Failure unreadable_journal(const std::string& path);

/// Why a header is none of a journal that this program reads, but for its check sum; bad_input.
[[nodiscard]] Failure check_journal_kind(const std::string& path, const JournalHeader& header);

}  // namespace bladefit
