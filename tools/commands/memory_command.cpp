#include "tools/commands/memory_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/session_settings.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "core/localizer.hpp"
#include "core/localizer/check_config.hpp"
#include "firmware_bridge/bladefit.h"
#include "tools/batch/fit_options.hpp"
#include "tools/commands/fit_flags.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

struct MemoryFlags {
  std::string config, design, json;
  std::optional<std::uint32_t> capacity;
  FitSettings fit;
};

/// What a fit takes, and how much of it its parts are [bytes].
struct MemoryNeed {
  std::uint32_t capacity = 0;
  FitMode mode = FitMode::least_squares;
  std::uint64_t total = 0;         ///< as bladefit_memory_required() says
  std::uint64_t static_bytes = 0;  ///< BLADEFIT_MEMORY_BYTES
  std::optional<std::uint64_t> design;
  std::vector<MemoryPart> parts;
};

/// The name of a mode in the header of the C interface.
std::string c_name_of(FitMode mode) {
  std::string name = "BLADEFIT_" + std::string(word_of(mode));
  std::ranges::transform(name, name.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return name;
}

/// The smallest head that is an image: the need does not depend on what is in it.
ImageHeader some_head() {
  ImageHeader header{};
  std::copy(std::begin(kImageMagic), std::end(kImageMagic), header.magic);
  header.version = kImageVersion;
  header.total_size = sizeof header;
  header.patch_count = 1;
  header.outward = 1;
  return header;
}

MemoryNeed need_of(std::uint32_t capacity, FitMode mode) {
  bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
  config.capacity = capacity;
  config.mode = static_cast<std::uint32_t>(mode);
  config.leading_edge_tolerance_mm = config.rest_tolerance_mm = 1;
  const ImageHeader head = some_head();
  MemoryNeed need{.capacity = capacity, .mode = mode, .design = {}, .parts = {}};
  need.total = bladefit_memory_required(&config, &head, sizeof head);
  need.static_bytes = BLADEFIT_MEMORY_BYTES(capacity, static_cast<std::uint32_t>(mode));
  LocalizerConfig localizer;
  localizer.capacity = capacity;
  localizer.mode = mode;
  const auto parts = Localizer::memory_parts(localizer);
  need.parts.assign(parts.begin(), parts.end());
  need.parts.insert(need.parts.begin(),
                    {"head of the C interface", need.total - Localizer::memory_required(localizer)});
  return need;
}

std::string memory_text(const MemoryNeed& need) {
  constexpr double kMega = 1e6;
  std::string text = fmt::format(
      "{} bytes ({:.2f} MB) for {} points in the mode {}, in one block aligned to {} bytes\n", need.total,
      static_cast<double>(need.total) / kMega, need.capacity, word_of(need.mode), BLADEFIT_MEMORY_ALIGNMENT);
  for (const MemoryPart& part : need.parts) text += fmt::format("  {:>12} bytes  {}\n", part.size, part.name);
  text += fmt::format("as a constant, on every processor: BLADEFIT_MEMORY_BYTES({}, {}) = {} bytes\n", need.capacity,
                      c_name_of(need.mode), need.static_bytes);
  if (need.design)
    text += fmt::format("beside the block, read only (file or flash): design image of {} bytes\n", *need.design);
  return text;
}

std::string memory_json(const MemoryNeed& need) {
  nlohmann::ordered_json json = {{"capacity", need.capacity},
                                 {"mode", word_of(need.mode)},
                                 {"alignment_bytes", BLADEFIT_MEMORY_ALIGNMENT},
                                 {"total_bytes", need.total},
                                 {"static_bytes", need.static_bytes}};
  json["design_bytes"] = need.design ? nlohmann::ordered_json(*need.design) : nlohmann::ordered_json(nullptr);
  for (const MemoryPart& part : need.parts) json["parts"].push_back({{"name", part.name}, {"bytes", part.size}});
  return json.dump(2) + "\n";
}

int tell_memory(const MemoryFlags& flags) {
  SessionSettings session;
  if (!flags.config.empty()) {
    if (const Failure error = load_session(flags.config, session)) throw ToolError(error);
  }
  const std::uint32_t capacity = flags.capacity.value_or(session.capacity.value_or(LocalizerConfig{}.capacity));
  const FitSettings settings = merged(flags.fit, session.fit);
  MemoryNeed need = need_of(capacity, settings.mode.value_or(FitMode::least_squares));
  const std::string design = flags.design.empty() ? session.design.value_or("") : flags.design;
  if (!design.empty()) need.design = load_design(design, design_choice_of(settings)).image.size();
  if (!flags.json.empty()) write_output(flags.json, memory_json(need));
  if (flags.json != "-") fmt::print("{}", memory_text(need));
  return 0;
}

}  // namespace

void add_memory_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<MemoryFlags>();
  CLI::App* command = app.add_subcommand("memory", "how much memory a fit takes in a controller, by part");
  command->footer(
      "\nThe block is all that a fit ever takes: nothing is allocated later. Its size depends on the capacity and the "
      "mode "
      "alone.\nExamples:\n"
      "  bladefit memory --capacity 4096 --mode min_tolerance\n"
      "  bladefit memory --config session.toml --json -");
  command->add_option("--config", flags->config, "session TOML, as for run: its capacity, mode and design");
  command->add_option("--design", flags->design, "design, for the size of its image: .igs .iges .stp .step .bfd");
  command->add_option_function<double>(
      "--capacity",
      [flags](double value) {
        if (!(value >= kLeastCapacity && value <= kMostCapacity) || value != std::floor(value)) {
          throw ToolError(fmt::format("--capacity {}: give a whole number of points, {} to {}", value, kLeastCapacity,
                                      kMostCapacity));
        }
        flags->capacity = static_cast<std::uint32_t>(value);
      },
      "points that keep a place in the fit (default 65536)");
  command->add_option("--json", flags->json, "write the figures here as JSON; - writes them to standard output");
  constexpr std::array<std::string_view, 1> kKeys = {"mode"};
  add_fit_options(*command, flags->fit, kKeys);
  command->callback([flags, &exit_code] { exit_code = tell_memory(*flags); });
}

}  // namespace bladefit
