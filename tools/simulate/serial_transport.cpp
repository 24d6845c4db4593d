#include "tools/simulate/serial_transport.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>

#include "drivers/serial/protocol_v1.hpp"
#include "tools/simulate/check_sum.hpp"

namespace bladefit::simulate {
namespace protocol = serial_protocol_v1;
namespace {

constexpr std::size_t kOutputLimit = 1024;  ///< while more waits for the line no further record is sent [bytes]
constexpr std::size_t kInputLimit = 4096;   ///< a host that sends this much without an end of line sends noise [bytes]
constexpr auto kEndPeriod = std::chrono::seconds(1);

std::string check_digits(std::string_view content) {
  return fmt::format("{:04X}", check_sum(content, protocol::kCrcInitial, protocol::kCrcPolynomial));
}

/// Shortest decimal number that reads back as the same double, without an exponent.
std::string decimal(double value) {
  std::array<char, 400> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return error == std::errc() ? std::string(text.data(), end) : std::string("0");
}

/// What stands between the marks of a line, if it is whole and its check sum is right.
std::optional<std::string_view> checked_content(std::string_view line) {
  const std::size_t begin = line.rfind(protocol::kBegin);
  const std::size_t mark = line.rfind(protocol::kCrcMark);
  if (begin == std::string_view::npos || mark == std::string_view::npos || mark < begin) return std::nullopt;
  const std::string_view content = line.substr(begin + 1, mark - begin - 1);
  if (line.substr(mark + 1) != check_digits(content)) return std::nullopt;
  return content;
}

std::optional<std::uint32_t> sequence_after(std::string_view content, std::string_view tag) {
  if (!content.starts_with(tag)) return std::nullopt;
  content.remove_prefix(tag.size());
  if (content.empty() || content.front() != protocol::kFieldSeparator) return std::nullopt;
  content.remove_prefix(1);
  std::uint32_t sequence = 0;
  const auto [end, error] = std::from_chars(content.data(), content.data() + content.size(), sequence);
  if (error != std::errc() || end != content.data() + content.size()) return std::nullopt;
  return sequence;
}

}  // namespace

std::string frame(std::string_view content) {
  return fmt::format("{}{}{}{}{}", protocol::kBegin, content, protocol::kCrcMark, check_digits(content),
                     protocol::kEnd);
}

std::string record_line(std::uint32_t sequence, const MachinePoint& point) {
  std::string content = fmt::format("{},{}", protocol::kPointTag, sequence);
  for (const double coordinate : point.position_mm) content += protocol::kFieldSeparator + decimal(coordinate);
  for (const double component : point.direction) content += protocol::kFieldSeparator + decimal(component);
  return frame(fmt::format("{},{}", content, point.path));
}

SerialTransport::SerialTransport(Machine& machine, const std::string& link, const FaultSettings& faults, const Log& log)
    : machine_(machine), log_(log), terminal_(link), faults_(faults) {}

std::vector<pollfd> SerialTransport::interests() const {
  const auto wanted = static_cast<short>(output_.empty() ? POLLIN : POLLIN | POLLOUT);
  return {{terminal_.descriptor(), wanted, 0}};
}

std::optional<Clock::time_point> SerialTransport::next_wakeup() const {
  std::optional<Clock::time_point> earliest = end_due_;
  for (const HeldLine& held : held_) {
    if (!earliest || held.due < *earliest) earliest = held.due;
  }
  return earliest;
}

void SerialTransport::publish(Clock::time_point now) {
  for (const HeldLine& held : held_) {
    if (held.due <= now) output_ += held.line;
  }
  std::erase_if(held_, [now](const HeldLine& held) { return held.due <= now; });
  while (streaming_ && sent_ < machine_.available() && output_.size() < kOutputLimit) {
    ++sent_;
    if (sent_ == machine_.total()) end_due_ = now;
    send_record(sent_, now);
    flush();
  }
  if (streaming_ && end_due_ && *end_due_ <= now) {
    // Repeated, because nothing in the protocol tells the machine that the host has it.
    output_ += frame(fmt::format("{},{}", protocol::kFinishedTag, machine_.total()));
    end_due_ = now + kEndPeriod;
  }
  flush();
}

void SerialTransport::service(std::span<const pollfd> events, Clock::time_point now) {
  const short event = events_of(events, terminal_.descriptor());
  if ((event & POLLIN) != 0) {
    read_lines(now);
  } else if ((event & (POLLHUP | POLLERR)) != 0) {
    hang_up();
  }
  publish(now);
}

void SerialTransport::read_lines(Clock::time_point now) {
  std::array<char, 1024> buffer{};
  const ssize_t length = ::read(terminal_.descriptor(), buffer.data(), buffer.size());
  if (length <= 0) {
    if (length == 0 || errno == EIO) hang_up();
    return;
  }
  has_reader_ = true;
  input_.append(buffer.data(), static_cast<std::size_t>(length));
  for (std::size_t end = input_.find('\n'); end != std::string::npos; end = input_.find('\n')) {
    std::string line = input_.substr(0, end);
    input_.erase(0, end + 1);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    obey(line, now);
  }
  if (input_.size() > kInputLimit) input_.clear();
}

void SerialTransport::obey(std::string_view line, Clock::time_point now) {
  const std::optional<std::string_view> content = checked_content(line);
  if (!content) {
    log_("a line of {} characters was not understood", line.size());
  } else if (const auto first = sequence_after(*content, protocol::kStartTag)) {
    start(*first, now);
  } else if (const auto stored = sequence_after(*content, protocol::kAcknowledgeTag)) {
    if (*stored > machine_.acknowledged() && *stored <= machine_.available()) (void)machine_.acknowledge(*stored);
  } else if (const auto missing = sequence_after(*content, protocol::kMissingTag)) {
    resend(*missing);
  } else if (*content == protocol::kStopTag) {
    log_("stopped by the host");
    machine_.stop();
    streaming_ = false;
    end_due_.reset();
  } else {
    log_("unknown command `{}`", *content);
  }
}

void SerialTransport::start(std::uint32_t first, Clock::time_point now) {
  if (first == 0 || !machine_.acknowledge(first - 1)) {
    log_("start at {} refused: the last point is {}", first, machine_.total());
    return;
  }
  log_("started at {}", first);
  machine_.restart(now);
  sent_ = first - 1;
  streaming_ = true;
  held_.clear();
  end_due_.reset();
  if (machine_.finished()) end_due_ = now;
  output_ += frame(fmt::format("{},{}", protocol::kRunTag, machine_.settings().run_id));
}

void SerialTransport::resend(std::uint32_t first_missing) {
  const std::uint32_t first = std::max(first_missing, machine_.oldest_kept());
  if (!streaming_ || first == 0 || first > sent_) return;
  log_("resends from {}", first);
  sent_ = first - 1;
  end_due_.reset();
}

void SerialTransport::send_record(std::uint32_t sequence, Clock::time_point now) {
  std::string line = record_line(sequence, machine_.point(sequence));
  const Fault fault = faults_.draw();
  if (fault == Fault::drop) {
    log_("fault: record {} lost", sequence);
    return;
  }
  if (fault == Fault::delay) {
    log_("fault: record {} held back", sequence);
    held_.push_back({now + faults_.delay_time(), std::move(line)});
    return;
  }
  if (fault == Fault::disconnect) {
    log_("fault: line hung up at record {}", sequence);
    hang_up();
    return;
  }
  if (fault == Fault::corrupt) {
    const std::size_t place = faults_.choose(line.size());
    line[place] = static_cast<char>(static_cast<unsigned char>(line[place]) ^ (1U + faults_.choose(255)));
    log_("fault: character {} of record {} changed", place, sequence);
  }
  output_ += line;
  if (fault == Fault::duplicate) {
    log_("fault: record {} sent twice", sequence);
    output_ += line;
  }
}

void SerialTransport::flush() {
  if (!output_.empty()) output_.erase(0, terminal_.write(output_));
}

void SerialTransport::hang_up() {
  log_("line hung up");
  machine_.stop();
  streaming_ = false;
  has_reader_ = false;
  end_due_.reset();
  held_.clear();
  input_.clear();
  output_.clear();
  terminal_.replace();
}

}  // namespace bladefit::simulate
