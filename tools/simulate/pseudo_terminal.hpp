#pragma once
#include <string>
#include <string_view>

#include "tools/simulate/descriptor.hpp"

namespace bladefit::simulate {

/// The machine's end of a cable: the master of a pseudo terminal whose slave a reader opens like a serial port.
class PseudoTerminal {
 public:
  /// `link` is made a symbolic link to the slave; empty = none. Throws ToolError (device).
  explicit PseudoTerminal(std::string link);
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// Pulls the cable out and plugs in another one under the same link: a reader that still has the old one open sees a
  /// hang-up. Every reader gets a new terminal, because exclusive use and unread bytes would stay with the old one.
  void replace();

  [[nodiscard]] int descriptor() const { return master_.get(); }

  /// What a reader opens: the link, or the slave where there is none.
  [[nodiscard]] const std::string& path() const { return link_.empty() ? slave_ : link_; }

  /// Writes what the terminal takes now; returns how many bytes.
  [[nodiscard]] std::size_t write(std::string_view bytes);

 private:
  void open();
  void relink() const;

  std::string link_;
  std::string slave_;
  Descriptor master_;
};

}  // namespace bladefit::simulate
