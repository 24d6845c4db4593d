#pragma once
#include <string>
#include <vector>

#include "drivers/modbus/cmm_header.hpp"
#include "tools/doctor/map_change.hpp"
#include "tools/doctor/register_reader.hpp"

namespace bladefit {

/// A way to read the map that makes sense of the header.
struct HeaderTrial {
  MapChange change;
  CmmMap map;  ///< with the change
  CmmHeader header;
  bool proven = false;  ///< version, record size or test constant is there and as expected
};

/// Reads the header in every way of header_changes(). Returns those that check_header() accepts, those with fewer
/// changes first; where one shows the test constant, only those that do. Cost: at most six reads.
[[nodiscard]] std::vector<HeaderTrial> try_headers(RegisterReader& reader, const CmmMap& map);

/// The registers as they came, such as "registers 0 to 3 (function 4): 0001 0002 0000 0007", or why there are none.
[[nodiscard]] std::string raw_text(const RegisterReply& reply, RegisterTable table, int address);

/// What a header says, a line a field that the map has.
[[nodiscard]] std::vector<std::string> header_lines(const CmmHeader& header, const CmmMap& map);

}  // namespace bladefit
