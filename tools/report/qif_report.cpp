#include "tools/report/qif_report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "tools/files/sha256.hpp"
#include "tools/report/findings.hpp"
#include "tools/report/report_text.hpp"
#include "tools/results/json_writer.hpp"

namespace bladefit {
namespace {

/// Identities of what there is once, then of what every point has: `first` on, kPerPoint each.
enum Once : std::uint32_t { kStandard = 1, kFeatureDefinition, kFirstCharacteristic };
constexpr std::uint32_t kPerTolerance = 2, kPerPoint = 5;
enum Each : std::uint32_t { kNominal, kItem, kMeasurement, kCharacteristicItem, kCharacteristicMeasurement };

/// Limits that points are judged by.
struct ProfileTolerance {
  std::string name;
  double plus = 0, minus = 0;

  /// The zone lies about the surface; where no tolerance is set it has no width.
  [[nodiscard]] double width() const { return std::isfinite(plus + minus) ? plus + minus : 0; }
  /// How far its middle lies above the surface.
  [[nodiscard]] double middle() const { return std::isfinite(plus + minus) ? 0.5 * (plus - minus) : 0; }
};

/// Those of both regions, or where there are zones of the rest and of each zone.
std::vector<ProfileTolerance> tolerances_of(const Result& result) {
  std::vector<ProfileTolerance> list;
  if (result.zones.empty()) {
    for (const Region region : {Region::rest, Region::leading_edge}) {
      const double tolerance = judged_tolerance(result, region);
      list.push_back({region == Region::leading_edge ? "leading edge" : "rest of the blade", tolerance, tolerance});
    }
    return list;
  }
  list.push_back({"rest of the blade", result.rest_outside, result.rest_outside});
  for (const ResultZone& zone : result.zones) list.push_back({zone.name, zone.plus, zone.minus});
  return list;
}

std::size_t tolerance_of(const Result& result, const ResultPoint& point) {
  return result.zones.empty() ? static_cast<std::size_t>(point.region) : point.zone;
}

std::uint32_t definition_of(std::size_t tolerance) {
  return kFirstCharacteristic + kPerTolerance * static_cast<std::uint32_t>(tolerance);
}
std::uint32_t nominal_of(std::size_t tolerance) { return definition_of(tolerance) + 1; }
std::uint32_t results_id(const Result& result) {
  return definition_of(result.zones.empty() ? kRegionWords.size() : result.zones.size() + 1);
}

/// An identity of the document that is the same for the same result.
std::string document_identity(const Result& result) {
  std::string hex = sha256_of(result.text.empty() ? result_json(result) : result.text).substr(0, 32);
  hex[12] = '8';  // RFC 9562: a version of one's own, and its variant
  hex[16] = 'a';
  return fmt::format("{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4), hex.substr(16, 4),
                     hex.substr(20, 12));
}

const char* point_status(PointState state, double tolerance) {
  if (!std::isfinite(tolerance)) return "NOT_ANALYZED";
  switch (state) {
    case PointState::in:
      return "PASS";
    case PointState::out:
      return "FAIL";
    case PointState::rejected:
      return "NOT_ANALYZED";
    case PointState::pending:
    case PointState::undecided:
      break;
  }
  return "INDETERMINATE";
}

const char* blade_status(BladeState state) {
  switch (state) {
    case BladeState::in_tolerance:
      return "PASS";
    case BladeState::out_of_tolerance:
      return "FAIL";
    case BladeState::not_judged:
      return "NOT_CALCULATED";
    case BladeState::not_decided:
      break;
  }
  return "UNKNOWN";
}

/// Attributes of the document: what bladefit knows of the blade and QIF has no element for.
std::string attributes_xml(const Result& result) {
  std::vector<std::pair<std::string, std::string>> texts;
  if (result.record) {
    for (const IdentityRow& row : kIdentityRows) {
      if (const std::string& text = result.record->identity.*row.text; !text.empty())
        texts.emplace_back(row.label, text);
    }
    for (const auto& field : result.record->identity.fields) texts.push_back(field);
  }
  texts.emplace_back("verdict", std::string(word_of(result.verdict.state)));
  for (const VerdictReason& reason : result.verdict.reasons) texts.emplace_back(word_of(reason.code), reason.text);
  std::string xml = fmt::format(" <Attributes n=\"{}\">\n", texts.size());
  for (const auto& [name, text] : texts)
    xml += fmt::format("  <AttributeStr name=\"{}\" value=\"{}\"/>\n", escaped(name), escaped(text));
  return xml + " </Attributes>\n";
}

std::string unit_xml(const Result& result) {
  constexpr double kMillimetres = 1000;
  const std::string factor = fmt::format("{}", result.mm_per_unit / kMillimetres);
  const std::string name = result.units == "in" ? "inch" : result.units;
  return fmt::format(
      " <FileUnits>\n  <PrimaryUnits>\n   <LinearUnit><SIUnitName>meter</SIUnitName><UnitName>{}</UnitName>"
      "<UnitConversion><Factor>{}</Factor></UnitConversion></LinearUnit>\n  </PrimaryUnits>\n </FileUnits>\n",
      escaped(name), factor);
}

std::string head_xml(const Result& result) {
  const auto id_max = std::uint64_t{results_id(result)} + 1 + kPerPoint * std::uint64_t{result.points.size()};
  const std::string version = result.record ? result.record->version : "bladefit";
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<QIFDocument xmlns=\"http://qifstandards.org/xsd/qif3\" "
             "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
             "xsi:schemaLocation=\"http://qifstandards.org/xsd/qif3 "
             "../QIFApplications/QIFDocument.xsd\" versionQIF=\"3.0.0\" idMax=\"{}\">\n <QPId>{}</QPId>\n",
             id_max, document_identity(result)) +
         attributes_xml(result) +
         fmt::format(
             " <Header>\n  <Application>\n   <Name>{}</Name>\n   <Organization>bladefit</Organization>\n  "
             "</Application>\n </Header>\n <StandardsDefinitions n=\"1\">\n  <Standard id=\"{}\"><Organization>"
             "<StandardsOrganizationEnum>ISO</StandardsOrganizationEnum></Organization><Designator>1101</Designator>"
             "<Year>2017</Year></Standard>\n </StandardsDefinitions>\n",
             escaped(version), static_cast<std::uint32_t>(kStandard)) +
         unit_xml(result);
}

/// A place in the frame of the design, in the units of the result.
std::string place_text(const Result& result, const Vec3& place) {
  return fmt::format("{} {} {}", result.in_units(place.x()), result.in_units(place.y()), result.in_units(place.z()));
}

std::uint32_t id_of(const Result& result, std::size_t index, Each what) {
  return results_id(result) + 1 + kPerPoint * static_cast<std::uint32_t>(index) + what;
}

/// Calls `each(index, point)` for the points in their order and joins what it returns.
template <typename Text>
std::string for_points(const Result& result, const char* element, Text&& each) {
  std::string xml = fmt::format("  <{} n=\"{}\">\n", element, result.points.size());
  std::size_t index = 0;
  for (const ResultPoint& point : result.points) xml += each(index++, point);
  return xml + fmt::format("  </{}>\n", element);
}

Vec3 moved_point(const Result& result, const ResultPoint& point) {
  return apply(result.pose, Vec3(point.position[0], point.position[1], point.position[2]));
}

std::string features_xml(const Result& result) {
  std::string xml = fmt::format(
      " <Features>\n  <FeatureDefinitions n=\"1\">\n   <PointFeatureDefinition id=\"{}\"/>\n  </FeatureDefinitions>\n",
      static_cast<std::uint32_t>(kFeatureDefinition));
  xml += for_points(result, "FeatureNominals", [&](std::size_t index, const ResultPoint& point) {
    // Where the design is not at hand the foot is not known; the point stands in its own place.
    const Vec3 place = result.drawing && point.foot ? *point.foot : moved_point(result, point);
    return fmt::format(
        "   <PointFeatureNominal id=\"{}\"><FeatureDefinitionId>{}</FeatureDefinitionId><Location>{}"
        "</Location></PointFeatureNominal>\n",
        id_of(result, index, kNominal), static_cast<std::uint32_t>(kFeatureDefinition), place_text(result, place));
  });
  xml += for_points(result, "FeatureItems", [&](std::size_t index, const ResultPoint& point) {
    return fmt::format(
        "   <PointFeatureItem id=\"{}\"><FeatureNominalId>{}</FeatureNominalId><FeatureName>P{}"
        "</FeatureName><DeterminationMode><Checked/></DeterminationMode></PointFeatureItem>\n",
        id_of(result, index, kItem), id_of(result, index, kNominal), point.sequence);
  });
  return xml + " </Features>\n";
}

std::string characteristics_xml(const Result& result) {
  std::string definitions, nominals;
  const std::vector<ProfileTolerance> tolerances = tolerances_of(result);
  for (std::size_t k = 0; k < tolerances.size(); ++k) {
    const double middle = result.in_units(tolerances[k].middle());
    const std::string unequal =
        middle == 0 ? "" : fmt::format("<UnequallyDisposedZone>{}</UnequallyDisposedZone>", middle);
    definitions += fmt::format(
        "   <PointProfileCharacteristicDefinition id=\"{}\"><Name>{}</Name><ToleranceValue>{}"
        "</ToleranceValue>{}</PointProfileCharacteristicDefinition>\n",
        definition_of(k), escaped(tolerances[k].name), result.in_units(tolerances[k].width()), unequal);
    nominals += fmt::format(
        "   <PointProfileCharacteristicNominal id=\"{}\"><CharacteristicDefinitionId>{}"
        "</CharacteristicDefinitionId></PointProfileCharacteristicNominal>\n",
        nominal_of(k), definition_of(k));
  }
  std::string xml = fmt::format(
      " <Characteristics>\n  <FormalStandardId>{0}</FormalStandardId>\n  <CharacteristicDefinitions n=\"{3}\">\n{1}  "
      "</CharacteristicDefinitions>\n  <CharacteristicNominals n=\"{3}\">\n{2}  </CharacteristicNominals>\n",
      static_cast<std::uint32_t>(kStandard), definitions, nominals, tolerances.size());
  xml += for_points(result, "CharacteristicItems", [&](std::size_t index, const ResultPoint& point) {
    return fmt::format(
        "   <PointProfileCharacteristicItem id=\"{}\"><FeatureItemIds n=\"1\"><Id>{}</Id></FeatureItemIds>"
        "<Name>P{}</Name><CharacteristicNominalId>{}</CharacteristicNominalId>"
        "</PointProfileCharacteristicItem>\n",
        id_of(result, index, kCharacteristicItem), id_of(result, index, kItem), point.sequence,
        nominal_of(tolerance_of(result, point)));
  });
  return xml + " </Characteristics>\n";
}

std::string results_xml(const Result& result) {
  const std::vector<ProfileTolerance> tolerances = tolerances_of(result);
  std::string xml = fmt::format(" <Results>\n  <MeasurementResultsSet n=\"1\">\n  <MeasurementResults id=\"{}\">\n",
                                results_id(result));
  xml += for_points(result, "MeasuredFeatures", [&](std::size_t index, const ResultPoint& point) {
    return fmt::format(
        "   <PointFeatureMeasurement id=\"{}\"><FeatureItemId>{}</FeatureItemId><Location>{}</Location>"
        "</PointFeatureMeasurement>\n",
        id_of(result, index, kMeasurement), id_of(result, index, kItem),
        place_text(result, moved_point(result, point)));
  });
  xml += "  <MeasuredCharacteristics>\n";
  xml += for_points(result, "CharacteristicMeasurements", [&](std::size_t index, const ResultPoint& point) {
    const double distance = result.in_units(point.distance);
    const double middle = result.in_units(tolerances[tolerance_of(result, point)].middle());
    return fmt::format(
        "   <PointProfileCharacteristicMeasurement id=\"{}\"><Status><CharacteristicStatusEnum>{}"
        "</CharacteristicStatusEnum></Status><CharacteristicItemId>{}</CharacteristicItemId><FeatureMeasurementIds "
        "n=\"1\"><Id>{}</Id></FeatureMeasurementIds><Value>{}</Value><WorstPositiveDeviation>{}</"
        "WorstPositiveDeviation>"
        "<WorstNegativeDeviation>{}</WorstNegativeDeviation></PointProfileCharacteristicMeasurement>\n",
        id_of(result, index, kCharacteristicMeasurement), point_status(point.state, point.tolerance),
        id_of(result, index, kCharacteristicItem), id_of(result, index, kMeasurement), 2 * std::abs(distance - middle),
        distance, distance);
  });
  return xml + fmt::format(
                   "  </MeasuredCharacteristics>\n  <InspectionStatus><InspectionStatusEnum>{}"
                   "</InspectionStatusEnum></InspectionStatus>\n  </MeasurementResults>\n  "
                   "</MeasurementResultsSet>\n </Results>\n",
                   blade_status(result.verdict.state));
}

}  // namespace

std::string qif_report(const Result& result) {
  return head_xml(result) + features_xml(result) + characteristics_xml(result) + results_xml(result) +
         "</QIFDocument>\n";
}

}  // namespace bladefit
