#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "firmware_bridge/host/journal/journal_salvage.hpp"
#include "tests/fuzz/reader.hpp"
#include "tools/design/iges/iges_clean.hpp"
#include "tools/design/occ/memory_file.hpp"
#include "tools/design/step/step_text.hpp"
#include "tools/design/text/design_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit::fuzz {
namespace {

/// What a text is made into is taken by the reader that made it, and is then left as it is.
template <typename Clean>
Answer read_cad_text(std::string_view bytes, const Clean& clean) {
  std::string text;
  try {
    const MemoryFile file(bytes);
    text = clean(read_design_text(file.path()));
  } catch (const ToolError& error) {
    return {error.what(), broken_words(error.what())};
  }
  try {
    const std::string again = clean(text);
    return {"", clean(again) == again ? "" : "what was put right twice is put right once more"};
  } catch (const ToolError& error) {
    return {"", std::string("what was put right is refused: ") + error.what()};
  }
}

Answer read_step_text(std::string_view bytes) {
  return read_cad_text(bytes, [](std::string_view text) { return clean_step_text(text, "design.stp"); });
}

Answer read_iges_text(std::string_view bytes) {
  return read_cad_text(bytes, [](std::string_view text) { return clean_iges_text(text, "design.igs").text; });
}

Answer read_journal_file(std::string_view bytes) {
  const MemoryFile file(bytes);
  JournalContent content;
  const Failure failure = read_journal(file.path(), content);
  if (failure) return {failure.message, broken_words(failure.message)};
  return {"", content.events.size() == content.records ? "" : "the journal counts other records than it gives"};
}

Answer read_salvage(std::string_view bytes) {
  const MemoryFile file(bytes);
  Salvage salvage;
  const Failure failure = salvage_journal(file.path(), salvage);
  if (failure) return {failure.message, broken_words(failure.message)};
  std::uint64_t damaged = 0;
  for (const DamagedRecords& records : salvage.damaged) damaged += records.last - records.first + 1;
  return {"", salvage.events.size() + damaged == salvage.records ? "" : "records are neither whole nor damaged"};
}

/// Gives header and records the right check sums, as if the host itself had written them.
void repair_journal(std::string& bytes) {
  if (bytes.size() < sizeof(JournalHeader)) return;
  JournalHeader header{};
  std::memcpy(&header, bytes.data(), sizeof header);
  header = make_journal_header({header.design_crc, header.config_digest}, header.run_id, header.version);
  std::memcpy(bytes.data(), &header, sizeof header);
  std::uint32_t place = 1;
  for (std::size_t at = sizeof header; at + sizeof(JournalRecord) <= bytes.size(); at += sizeof(JournalRecord)) {
    JournalRecord record{};
    std::memcpy(&record, bytes.data() + at, sizeof record);
    record = make_journal_record(event_of(record), place++, record.group);
    std::memcpy(bytes.data() + at, &record, sizeof record);
  }
}

/// A design that is taken can be asked for the nearest places of points in and about its box.
Answer read_image(std::string_view bytes) {
  std::vector<double> aligned(bytes.size() / sizeof(double) + 1);
  std::memcpy(aligned.data(), bytes.data(), bytes.size());
  DesignImage image;
  const Status status = DesignImage::open(std::as_bytes(std::span(aligned)).first(bytes.size()), image);
  if (status != Status::ok) return {status_text(status), ""};
  const Surface surface(image);
  const Vec3 low(image.header().box_min), high(image.header().box_max);
  for (const double share : {-0.5, 0.0, 0.3, 0.5, 1.0, 2.0}) {
    ProjectionQuery query;
    query.point = low + share * (high - low);
    const Projection nearest = project_global(surface, query, nullptr).nearest;
    if (!std::isfinite(nearest.distance_squared())) return {"", "the nearest place of a point is at no distance"};
  }
  return {"", ""};
}

void repair_image(std::string& bytes) {
  if (bytes.size() < sizeof(ImageHeader)) return;
  const std::uint64_t size = bytes.size();
  std::memcpy(bytes.data() + offsetof(ImageHeader, total_size), &size, sizeof size);
  const std::uint32_t crc = image_crc(std::as_bytes(std::span(bytes)));
  std::memcpy(bytes.data() + offsetof(ImageHeader, crc32), &crc, sizeof crc);
}

}  // namespace

const Reader kStep{"step", read_step_text, nullptr};
const Reader kIges{"iges", read_iges_text, nullptr};
const Reader kJournal{"journal", read_journal_file, repair_journal};
const Reader kSalvage{"salvage", read_salvage, repair_journal};
const Reader kImage{"image", read_image, repair_image};

}  // namespace bladefit::fuzz
