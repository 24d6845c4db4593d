#include "drivers/serial/port_list.hpp"

#include <libserialport.h>

namespace bladefit {

std::string known_ports() {
  constexpr std::size_t kMostNamed = 8;
  sp_port** ports = nullptr;
  if (sp_list_ports(&ports) != SP_OK) return "the ports of this machine cannot be listed";
  std::string text;
  for (std::size_t index = 0; ports[index] != nullptr && index < kMostNamed; ++index) {
    text += (text.empty() ? "ports here: " : ", ") + std::string(sp_get_port_name(ports[index]));
  }
  sp_free_port_list(ports);
  return text.empty() ? "this machine has no serial ports" : text;
}

}  // namespace bladefit
