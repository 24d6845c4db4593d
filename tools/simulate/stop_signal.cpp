#include "tools/simulate/stop_signal.hpp"

#include <sys/signalfd.h>

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {

StopSignal::StopSignal() {
  sigset_t stops{};
  sigemptyset(&stops);
  sigaddset(&stops, SIGINT);
  sigaddset(&stops, SIGTERM);
  sigprocmask(SIG_BLOCK, &stops, &before_);
  std::signal(SIGPIPE, SIG_IGN);
  descriptor_ = Descriptor(signalfd(-1, &stops, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!descriptor_) throw ToolError("no descriptor left for signals; close other programs", ToolError::Kind::device);
}

StopSignal::~StopSignal() {
  // A signal that was seen but not taken would strike as soon as it is let through again.
  signalfd_siginfo taken{};
  while (::read(descriptor_.get(), &taken, sizeof taken) > 0) {
  }
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace bladefit::simulate
