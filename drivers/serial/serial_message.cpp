#include "drivers/serial/serial_message.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "drivers/serial/protocol_v1.hpp"
#include "drivers/source/crc16.hpp"
#include "drivers/source/direction.hpp"
#include "drivers/text/text_number.hpp"

namespace bladefit {

namespace protocol = serial_protocol_v1;

namespace {

constexpr std::size_t kPathField = 7;

SerialMessage damaged(std::string_view what, std::string_view line) {
  SerialMessage message;
  std::string printable(line.substr(0, 40));
  for (char& character : printable) {
    if (character < ' ' || character > '~') character = '.';
  }
  message.damage = fmt::format("{} in the line '{}'", what, printable);
  return message;
}

std::string check_digits(std::string_view content) { return fmt::format("{:04X}", crc16(content)); }

/// Cuts the text up to the next separator off `rest`.
std::string_view take_field(std::string_view& rest) {
  const std::size_t end = rest.find(protocol::kFieldSeparator);
  const std::string_view field = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return field;
}

SerialMessage parse_numbered(SerialMessage::Kind kind, std::string_view fields, std::string_view line) {
  const std::optional<std::uint32_t> number = parse_whole<std::uint32_t>(fields);
  if (!number) return damaged("no whole number", line);
  SerialMessage message;
  message.kind = kind;
  message.number = *number;
  return message;
}

SerialMessage parse_point(std::string_view fields, std::string_view line) {
  std::array<std::string_view, protocol::kPointFields> texts;
  for (std::string_view& text : texts) text = take_field(fields);
  const std::optional<std::uint32_t> sequence = parse_whole<std::uint32_t>(texts[0]);
  const std::optional<std::uint16_t> path = parse_whole<std::uint16_t>(texts[kPathField]);
  if (!fields.empty() || !sequence || *sequence == 0 || !path) return damaged("wrong fields", line);
  SerialMessage message;
  message.kind = SerialMessage::Kind::point;
  message.number = message.point.sequence = *sequence;
  message.point.path = *path;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<double> coordinate = parse_finite(texts[1 + axis]);
    const std::optional<double> component = parse_finite(texts[4 + axis]);
    if (!coordinate || !component) return damaged("no finite number", line);
    message.point.position[axis] = *coordinate;
    message.point.approach[axis] = *component;
  }
  if (!normalise_direction(message.point.approach)) return damaged("a direction that is not a unit vector", line);
  return message;
}

bool is_host_tag(std::string_view tag) {
  return tag == protocol::kStartTag || tag == protocol::kAcknowledgeTag || tag == protocol::kMissingTag ||
         tag == protocol::kStopTag;
}

}  // namespace

SerialMessage parse_message(std::string_view line) {
  const std::size_t mark = line.rfind(protocol::kCrcMark);
  if (mark == std::string_view::npos) return damaged("no check sum", line);
  std::string_view content = line.substr(0, mark);
  if (line.substr(mark + 1) != check_digits(content)) return damaged("a wrong check sum", line);
  const std::string_view tag = take_field(content);
  if (tag == protocol::kPointTag) return parse_point(content, line);
  if (tag == protocol::kRunTag) return parse_numbered(SerialMessage::Kind::run, content, line);
  if (tag == protocol::kFinishedTag) return parse_numbered(SerialMessage::Kind::finished, content, line);
  if (!is_host_tag(tag)) return damaged("an unknown tag", line);
  SerialMessage message;
  message.kind = SerialMessage::Kind::host;
  return message;
}

std::string encode_line(std::string_view content) {
  return fmt::format("{}{}{}{}{}", protocol::kBegin, content, protocol::kCrcMark, check_digits(content),
                     protocol::kEnd);
}

std::string encode_line(std::string_view tag, std::uint32_t sequence) {
  return encode_line(fmt::format("{}{}{}", tag, protocol::kFieldSeparator, sequence));
}

}  // namespace bladefit
