#include "tools/design/iges/iges_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kSectionColumn = 72;
constexpr std::string_view kSections = "SGDPT";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<int> parse_integer(std::string_view field) {
  field = trimmed(field);
  int value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

/// Lines ended by LF, CRLF or CR, up to the terminate record: what old systems append is no part of the file. A file
/// without line ends is cut into records of 80 columns.
std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  const bool unbroken = text.find_first_of("\r\n") == std::string_view::npos && text.size() > kColumns;
  while (!text.empty()) {
    const std::size_t end = unbroken ? kColumns : text.find_first_of("\r\n");
    lines.push_back(text.substr(0, end));
    if (lines.back().size() > kSectionColumn && lines.back()[kSectionColumn] == 'T') break;
    if (end >= text.size()) break;
    const bool two = !unbroken && text.substr(end, 2) == "\r\n";
    text.remove_prefix(unbroken ? end : end + (two ? 2 : 1));
  }
  while (!lines.empty() && trimmed(lines.back()).empty()) lines.pop_back();
  return lines;
}

/// One section: its records without section letter and number, and the line where it begins, counted from 1.
struct Section {
  std::vector<std::string_view> records;
  std::size_t first_line = 0;
};

/// The five sections of the file, by the place of their letter in kSections.
struct Sections {
  std::string file;
  std::vector<Section> parts{kSections.size()};

  [[nodiscard]] const Section& of(char letter) const { return parts[kSections.find(letter)]; }
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw ToolError(fmt::format("{}: line {}: {}; export the design again", file, line, what));
  }
};

void check_record(const Sections& sections, std::string_view line, std::size_t number) {
  const bool lettered = line.size() > kSectionColumn && kSections.find(line[kSectionColumn]) != std::string_view::npos;
  if (number == 1 && !lettered) {
    throw ToolError(
        fmt::format("{}: not an IGES file: line 1 has no section letter in column 73; give an IGES (.igs, "
                    ".iges) or STEP (.stp, .step) file",
                    sections.file));
  }
  if (!lettered) sections.fail(number, "the record is truncated: no section letter S, G, D, P or T in column 73");
  if (number == 1 && line[kSectionColumn] != 'S') sections.fail(number, "the start section S is missing");
  if (line.size() > kColumns && !trimmed(line.substr(kColumns)).empty()) {
    sections.fail(number, fmt::format("{} columns where an IGES record has 80", line.size()));
  }
}

Sections split_sections(const std::vector<std::string_view>& lines, const std::string& file) {
  Sections sections{file};
  std::size_t current = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string_view line = lines[k];
    check_record(sections, line, k + 1);
    const std::size_t section = kSections.find(line[kSectionColumn]);
    if (section < current) sections.fail(k + 1, fmt::format("section {} is out of order", kSections[section]));
    current = section;
    Section& part = sections.parts[section];
    if (part.records.empty()) part.first_line = k + 1;
    part.records.push_back(line.substr(0, kSectionColumn));
    const std::string_view number = trimmed(line.substr(kSectionColumn + 1, kColumns - kSectionColumn - 1));
    if (!number.empty() && parse_integer(number) != static_cast<int>(part.records.size())) {
      sections.fail(k + 1, fmt::format("record {} of section {} is missing or misnumbered", part.records.size(),
                                       kSections[section]));
    }
  }
  return sections;
}

void check_terminate(const Sections& sections, std::size_t line_count) {
  const std::vector<std::string_view>& records = sections.of('T').records;
  if (records.empty()) {
    sections.fail(line_count, "the file is truncated: the terminate record T is missing after this line");
  }
  if (records.size() > 1) sections.fail(line_count, "more than one terminate record T");
  for (std::size_t k = 0; k + 1 < kSections.size(); ++k) {
    const std::size_t count = sections.parts[k].records.size();
    const auto said = parse_integer(records.front().substr(8 * k + 1, 7));
    if (count == 0) sections.fail(line_count, fmt::format("the file has no section {}", kSections[k]));
    if (records.front()[8 * k] != kSections[k] || said != static_cast<int>(count)) {
      sections.fail(line_count, fmt::format("the terminate record does not agree with the {} records of section {}",
                                            count, kSections[k]));
    }
  }
}

/// The eight digits of the status number, in which some systems write blanks for zeros.
std::string padded_status(std::string_view field) {
  std::string status(field);
  for (char& digit : status) digit = digit >= '0' && digit <= '9' ? digit : '0';
  return status;
}

void read_entity(const Sections& sections, std::size_t entry, IgesEntity& entity) {
  const Section& directory = sections.of('D');
  const Section& parameters = sections.of('P');
  const std::string_view first_record = directory.records[entry];
  const std::string_view second_record = directory.records[entry + 1];
  const std::size_t line = directory.first_line + entry;
  entity.type = iges_integer(first_record.substr(0, 8), sections.file, line);
  entity.directory_number = static_cast<int>(entry) + 1;
  entity.level = iges_integer(first_record.substr(32, 8), sections.file, line);
  entity.matrix = iges_integer(first_record.substr(48, 8), sections.file, line);
  entity.status = padded_status(first_record.substr(64, 8));
  entity.form = iges_integer(second_record.substr(32, 8), sections.file, line + 1);
  entity.label = trimmed(second_record.substr(56, 8));
  const int first = iges_integer(first_record.substr(8, 8), sections.file, line);
  const int count = iges_integer(second_record.substr(24, 8), sections.file, line + 1);
  const auto available = static_cast<int>(parameters.records.size());
  if (first < 1 || count < 1 || first > available || count > available - first + 1) {
    sections.fail(line, "the directory entry points outside the parameter records");
  }
  const auto begin = parameters.records.begin() + (first - 1);
  entity.first_line = parameters.first_line + static_cast<std::size_t>(first) - 1;
  entity.parameters.assign(begin, begin + count);
}

}  // namespace

int iges_integer(std::string_view field, const std::string& file, std::size_t line) {
  if (trimmed(field).empty()) return 0;
  if (const std::optional<int> value = parse_integer(field)) return *value;
  throw ToolError(
      fmt::format("{}: line {}: \"{}\" is not a whole number; export the design again", file, line, trimmed(field)));
}

IgesText split_iges_text(std::string_view text, const std::string& file) {
  if (trimmed(text).empty()) throw ToolError(fmt::format("{}: the file is empty; export the design again", file));
  const std::vector<std::string_view> lines = split_lines(text);
  const Sections sections = split_sections(lines, file);
  check_terminate(sections, lines.size());
  const Section& directory = sections.of('D');
  if (directory.records.size() % 2 != 0) {
    sections.fail(directory.first_line, "the directory has an odd number of records");
  }
  IgesText parts;
  parts.global = sections.of('G').records;
  parts.entities.resize(directory.records.size() / 2);
  for (std::size_t k = 0; k < parts.entities.size(); ++k) read_entity(sections, 2 * k, parts.entities[k]);
  return parts;
}

}  // namespace bladefit
