#include "tools/simulate/pseudo_terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {
namespace {

[[noreturn]] void refuse(std::string_view what) {
  throw ToolError(fmt::format("pseudo terminal: {}: {}; check that /dev/pts is mounted and has free entries", what,
                              std::strerror(errno)),
                  ToolError::Kind::device);
}

}  // namespace

PseudoTerminal::PseudoTerminal(std::string link) : link_(std::move(link)) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::symlink_status(link_, error);
  // A link is what a machine that was killed has left behind; anything else belongs to somebody.
  if (!link_.empty() && std::filesystem::exists(status) && !std::filesystem::is_symlink(status)) {
    throw ToolError(fmt::format("--device {}: exists and is not a symbolic link; give another path", link_),
                    ToolError::Kind::device);
  }
  open();
}

PseudoTerminal::~PseudoTerminal() {
  std::error_code error;
  if (!link_.empty() && std::filesystem::read_symlink(link_, error) == slave_) std::filesystem::remove(link_, error);
}

void PseudoTerminal::replace() {
  // With a link the new one is there before the old one goes, so that no reader finds a dead link. Without one the old
  // one goes first, so that the new one mostly gets its name.
  const Descriptor old = link_.empty() ? Descriptor() : std::move(master_);
  master_.close();
  open();
}

void PseudoTerminal::open() {
  master_ = Descriptor(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  if (!master_) refuse("cannot open the master side");
  if (grantpt(master_.get()) != 0 || unlockpt(master_.get()) != 0) refuse("cannot unlock the slave side");
  std::array<char, 128> name{};
  if (ptsname_r(master_.get(), name.data(), name.size()) != 0) refuse("cannot name the slave side");
  slave_ = name.data();
  // Raw from the start, so that what the machine sends before a reader has set its port is not echoed back.
  termios settings{};
  if (tcgetattr(master_.get(), &settings) != 0) refuse("cannot read its settings");
  cfmakeraw(&settings);
  if (tcsetattr(master_.get(), TCSANOW, &settings) != 0) refuse("cannot make it raw");
  if (!link_.empty()) relink();
}

void PseudoTerminal::relink() const {
  // Renamed into place, so that a reader never finds the link missing.
  const std::string replacement = fmt::format("{}.{}", link_, getpid());
  std::error_code error;
  std::filesystem::remove(replacement, error);
  std::filesystem::create_symlink(slave_, replacement, error);
  if (!error) std::filesystem::rename(replacement, link_, error);
  if (error) {
    throw ToolError(fmt::format("--device {}: cannot make the link: {}; give a path in a folder that can be written",
                                link_, error.message()),
                    ToolError::Kind::device);
  }
}

std::size_t PseudoTerminal::write(std::string_view bytes) {
  const ssize_t written = ::write(master_.get(), bytes.data(), bytes.size());
  return written < 0 ? 0 : static_cast<std::size_t>(written);
}

}  // namespace bladefit::simulate
