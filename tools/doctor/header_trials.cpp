#include "tools/doctor/header_trials.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace bladefit {
namespace {

bool is_proven(const CmmHeader& header, const CmmMap& map) {
  return header.test_constant_provided || map.version.present || map.reported_record_size.present;
}

}  // namespace

std::vector<HeaderTrial> try_headers(RegisterReader& reader, const CmmMap& map) {
  std::vector<HeaderTrial> trials;
  for (const MapChange& change : header_changes(map)) {
    const std::optional<CmmMap> tried = changed(map, change);
    if (!tried) continue;
    const RegisterBlock block = header_block(*tried);
    const RegisterReply& reply = reader.read(tried->table, block.first, block.count);
    if (!reply.good()) continue;
    const CmmHeader header = decode_header(reply.registers, *tried);
    if (check_header(header, *tried)) continue;
    trials.push_back({.change = change, .map = *tried, .header = header, .proven = is_proven(header, *tried)});
  }
  const auto shows_constant = [](const HeaderTrial& trial) { return trial.header.test_constant_provided; };
  if (std::ranges::any_of(trials, shows_constant))
    std::erase_if(trials, [&](const HeaderTrial& trial) { return !shows_constant(trial); });
  return trials;
}

std::string raw_text(const RegisterReply& reply, RegisterTable table, int address) {
  const int function = table == RegisterTable::input ? 4 : 3;
  if (!reply.good()) return fmt::format("registers from {} (function {}): {}", address, function, reply.fault);
  return fmt::format("registers {} to {} (function {}): {:04X}", address,
                     address + static_cast<int>(reply.registers.size()) - 1, function, fmt::join(reply.registers, " "));
}

std::vector<std::string> header_lines(const CmmHeader& header, const CmmMap& map) {
  std::vector<std::string> lines;
  const auto add = [&lines](bool present, std::string text) {
    if (present) lines.push_back(std::move(text));
  };
  add(map.version.present, fmt::format("map version {} (expected {})", header.version, map.expected_version));
  add(map.status.present, fmt::format("status {:04X}", header.status));
  add(true,
      header.newest == 0 ? std::string("newest record: none yet") : fmt::format("newest record {}", header.newest));
  add(true, fmt::format("ring of {} records of {} registers", header.capacity, header.record_size));
  add(map.run_id.present, fmt::format("run id {}", header.run_id));
  if (map.test_constant.present && header.test_constant_provided)
    add(true, fmt::format("test constant {} (expected {})", header.test_constant, map.expected_test_constant));
  if (map.test_constant.present && !header.test_constant_provided) add(true, "test constant: not provided");
  return lines;
}

}  // namespace bladefit
