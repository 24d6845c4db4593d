#pragma once
#include <fmt/format.h>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_SequenceOfPrinters.hxx>
#include <Standard_Failure.hxx>

#include <exception>
#include <string>

#include "tools/files/tool_error.hpp"

namespace bladefit {

/// Silences OpenCASCADE's messages, which go to the standard output, while it lives.
class QuietMessages {
 public:
  QuietMessages() : printers_(Message::DefaultMessenger()->Printers()) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~QuietMessages() { Message::DefaultMessenger()->ChangePrinters() = printers_; }
  QuietMessages(const QuietMessages&) = delete;
  QuietMessages& operator=(const QuietMessages&) = delete;

 private:
  Message_SequenceOfPrinters printers_;
};

/// Runs `read`, which calls OpenCASCADE on `file`, in silence; whatever it throws becomes a ToolError.
template <class Read>
auto with_cad_library(const std::string& file, Read read) {
  const QuietMessages quiet;
  try {
    return read();
  } catch (const ToolError&) {
    throw;
  } catch (const Standard_Failure& failure) {
    throw ToolError(fmt::format("{}: the CAD library refuses the file ({}: {}); export the design again", file,
                                failure.DynamicType()->Name(), failure.GetMessageString()));
  } catch (const std::exception& failure) {
    throw ToolError(
        fmt::format("{}: the CAD library refuses the file ({}); export the design again", file, failure.what()));
  }
}

}  // namespace bladefit
