#include "drivers/serial/line_framer.hpp"

#include "drivers/serial/protocol_v1.hpp"

namespace bladefit {

namespace protocol = serial_protocol_v1;

std::optional<FramedLine> LineFramer::next() {
  while (used_ < input_.size()) {
    if (std::optional<FramedLine> line = take(input_[used_++])) return line;
  }
  input_.clear();
  used_ = 0;
  return std::nullopt;
}

std::optional<FramedLine> LineFramer::take(char byte) {
  if (byte == protocol::kBegin) {
    const bool cut = inside_;
    const bool noisy = noise_ > 0;
    inside_ = true;
    noise_ = 0;
    line_.clear();
    if (cut) return FramedLine{{}, "a line was cut off by another"};
    if (noisy) return FramedLine{{}, "noise between lines"};
    return std::nullopt;
  }
  if (!inside_) {
    if (byte != '\r' && byte != '\n') ++noise_;
    return std::nullopt;
  }
  if (byte == '\n') {
    inside_ = false;
    if (line_.ends_with('\r')) line_.pop_back();
    return FramedLine{std::move(line_), {}};
  }
  line_ += byte;
  if (line_.size() <= protocol::kMaxLine) return std::nullopt;
  inside_ = false;
  return FramedLine{{}, "a line without an end"};
}

void LineFramer::reset() {
  input_.clear();
  line_.clear();
  used_ = noise_ = 0;
  inside_ = false;
}

}  // namespace bladefit
