#include "tools/panel/panel_map_text.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "firmware_bridge/host/panel/panel_fields.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 9> kHeads = {"table", "address", "input", "holding", "registers",
                                                    "type",  "unit",    "name",  "meaning"};
using Row = std::array<std::string, kHeads.size()>;

std::string_view type_word(PanelType type) {
  switch (type) {
    case PanelType::word:
      return "uint16";
    case PanelType::wide:
      return "uint32";
    case PanelType::real:
      return "float32";
    case PanelType::text:
      break;
  }
  return "ascii";
}

std::string_view unit_word(PanelUnit unit) {
  constexpr std::array<std::string_view, 4> kWords = {"", "mm", "rad", "us"};
  return kWords[static_cast<std::size_t>(unit)];
}

/// The unit of the int32 in place of a float32.
std::string_view twin_unit_word(PanelUnit unit) {
  constexpr std::array<std::string_view, 4> kWords = {"1e-6", "um", "urad", "us"};
  return kWords[static_cast<std::size_t>(unit)];
}

Row register_row(std::size_t address, const PanelField& field, const std::string& name, bool twin) {
  const bool replaced = twin && field.type == PanelType::real;
  return {"registers",
          std::to_string(address),
          std::to_string(300001 + address),
          std::to_string(400001 + address),
          std::to_string(register_count(field.type)),
          std::string(replaced ? "int32" : type_word(field.type)),
          std::string(replaced ? twin_unit_word(field.unit) : unit_word(field.unit)),
          name,
          std::string(field.meaning)};
}

void add_registers(std::vector<Row>& rows, bool twin) {
  for (const PanelField& field : panel_fields()) {
    if (twin && field.address >= kPanelRegisters) return;
    for (std::size_t item = 0; item < field.items; ++item) {
      const std::size_t address = field.address + item * field.stride + (twin ? kTwinBase : 0U);
      std::string name = field.items > 1 ? fmt::format("{}_{}", field.name, item + 1) : std::string(field.name);
      if (twin) name += "_twin";
      rows.push_back(register_row(address, field, name, twin));
    }
  }
}

void add_bits(std::vector<Row>& rows, std::string_view table, int first, std::span<const PanelBit> bits) {
  for (std::size_t index = 0; index < bits.size(); ++index) {
    rows.push_back({std::string(table), std::to_string(index), fmt::format("{:06}", first + static_cast<int>(index)),
                    "", "1", "bit", "", std::string(bits[index].name), std::string(bits[index].meaning)});
  }
}

std::vector<Row> rows_of_map() {
  std::vector<Row> rows;
  add_registers(rows, false);
  add_registers(rows, true);
  add_bits(rows, "discrete_inputs", 100001, panel_inputs());
  add_bits(rows, "coils", 1, panel_coils());
  return rows;
}

}  // namespace

std::string panel_map_csv() {
  std::string text = fmt::format("{}\n", fmt::join(kHeads, ","));
  for (const Row& row : rows_of_map()) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      const bool quoted = row[column].find(',') != std::string::npos;
      text += fmt::format("{0}{1}{2}{1}", column == 0 ? "" : ",", quoted ? "\"" : "", row[column]);
    }
    text += '\n';
  }
  return text;
}

std::string panel_map_markdown() {
  std::string text =
      "# Register map of the panel\n\n"
      "Modbus TCP, any unit identifier. Addresses count from 0; function 3 (holding registers, 4xxxxx) reads the same "
      "as\n"
      "function 4 (input registers, 3xxxxx). Registers up to 599 that are not named read 0; a read takes 1 to 125 of "
      "them.\n"
      "The high word of a number comes first unless `panel.word_order` says otherwise. From 500 on the registers 0 to "
      "91\n"
      "stand again with an int32 in place of every float32, limited to its range. Discrete inputs (function 2) up to "
      "15 that\n"
      "are not named read 0. Coils read 0 (function 1); they are written (functions 5, 15) only where `panel.commands "
      "=\n"
      "true`. Function 43/14 tells maker, product and version.\n\n";
  text += fmt::format("| {} |\n|{}\n", fmt::join(kHeads, " | "), [] {
    std::string dashes;
    for (std::size_t column = 0; column < kHeads.size(); ++column) dashes += "---|";
    return dashes;
  }());
  for (const Row& row : rows_of_map()) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text;
}

}  // namespace bladefit
