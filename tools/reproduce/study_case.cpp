#include "tools/reproduce/study_case.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "drivers/replay/points_csv.hpp"
#include "drivers/text/units.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

using Json = nlohmann::json;

ParameterBox box_of(const Json& json) {
  ParameterBox box;
  box.patch = json.at("patch");
  box.u_min = json.at("u").at(0);
  box.u_max = json.at("u").at(1);
  box.v_min = json.at("v").at(0);
  box.v_max = json.at("v").at(1);
  return box;
}

FitPlan plan_of(const Json& json, const std::string& file) {
  FitPlan plan;
  plan.units = json.at("units");
  if (plan.units != "mm" && plan.units != "in") {
    throw ToolError(fmt::format("{}: units: {} is neither mm nor in; give one of them", file, plan.units));
  }
  plan.points.unit = plan.units == "in" ? Unit::inch : Unit::mm;
  plan.mm_per_unit = mm_per_unit(plan.points.unit);
  plan.localizer.regions = RegionPolicy::fixed;
  plan.localizer.use_approach = json.at("use_approach");
  plan.localizer.probe_radius_mm = plan.mm_per_unit * json.at("probe_radius").get<double>();
  ToleranceMap& map = plan.localizer.tolerance;
  for (const Json& box : json.at("leading_edge").at("boxes")) {
    if (map.box_count == ToleranceMap::kMaxBoxes) {
      throw ToolError(fmt::format("{}: leading_edge.boxes: at most {} are possible; give fewer", file, map.box_count));
    }
    map.boxes[map.box_count++] = box_of(box);
  }
  return plan;
}

void take_design(StudyCase& study, const std::filesystem::path& path) {
  DesignFile file = read_design(path);
  study.loaded.image = write_image(file.surfaces, file.unit, study.outward);
  study.surfaces = std::move(file.surfaces);
  if (const Status status = DesignImage::open(study.loaded.image, study.design); status != Status::ok) {
    throw ToolError(fmt::format("{}: {}; take another design", path.string(), status_text(status)));
  }
}

}  // namespace

StudyCase read_study_case(const std::filesystem::path& folder) {
  const std::string file = (folder / "case.json").string();
  StudyCase study;
  study.name = folder.filename().string();
  try {
    const Json json = Json::parse(read_text(file));
    study.plan = plan_of(json, file);
    study.outward = json.at("design").at("normal_sign").get<int>() < 0 ? -1 : 1;
    for (const Json& subset : json.at("subsets")) {
      study.points[subset.at("name")] = folder / subset.at("points").get<std::string>();
    }
    take_design(study, folder / json.at("design").at("iges").get<std::string>());
  } catch (const Json::exception&) {
    throw ToolError(fmt::format("{}: is not the description of a case; take the file as it came with the data", file));
  }
  return study;
}

std::vector<ProbePoint> read_subset_points(const StudyCase& study, const std::string& subset) {
  const auto found = study.points.find(subset);
  if (found == study.points.end()) {
    throw ToolError(fmt::format("{}: case.json names no subset {}; take the data as it came", study.name, subset));
  }
  PointsFile file = read_points_csv(found->second.string(), study.plan.points);
  if (file.error) throw ToolError(file.error);
  return std::move(file.points);
}

}  // namespace bladefit
