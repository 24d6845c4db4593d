// What a report says beside the result: the blade, the files, defects, pictures and QIF; and what must not break it.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <map>
#include <set>
#include <stack>

#include "tests/unit/tools/report_session.hpp"
#include "tools/batch/batch_fit.hpp"
#include "tools/commands/report_record_of.hpp"
#include "tools/drawing/add_drawing.hpp"
#include "tools/files/sha256.hpp"
#include "tools/report/formats.hpp"
#include "tools/report/report_text.hpp"
#include "tools/report/tolerance_scale.hpp"
#include "tools/reproduce/study_case.hpp"

namespace bladefit {
namespace {

constexpr const char* kHostile = "\"></title></style><script>alert('x')</script>\\";

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Result blade_result() {
  static const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  FitPlan plan = study.plan;
  plan.localizer.tolerance.leading_edge_mm = 0.05;
  plan.localizer.tolerance.rest_mm = 0.1;
  Result result = fit_points(study.design, plan, read_subset_points(study, "200"), "points.csv").result;
  ReportRecord record;
  for (const IdentityRow& row : kIdentityRows) record.identity.*row.text = std::string(row.key) + kHostile;
  record.identity.fields = {{kHostile, "H-1\x01\xff"}};
  record.files = {{"design", kHostile, 12, sha256_of("a")}};
  record.version = "bladefit test";
  result.record = record;
  result.written = "2026-11-28 08:41:12 UTC";
  add_drawing(study.design, result);
  return result;
}

/// The elements of an XML text, each with the ways to it and how often it is there; a fault where it is not well
/// formed.
struct XmlElements {
  std::map<std::string, int> count;
  std::string fault;
};

XmlElements elements_of(const std::string& xml) {
  XmlElements found;
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::string tag = xml.substr(at + 1, xml.find('>', at) - at - 1);
    if (tag[0] == '?') continue;
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) found.fault = tag;
      if (!open.empty()) open.pop_back();
      continue;
    }
    open.push_back(tag.substr(0, tag.find_first_of(" /")));
    ++found.count[fmt::format("{}", fmt::join(open, "/"))];
    if (tag.back() == '/') open.pop_back();
  }
  if (!open.empty()) found.fault = open.back();
  return found;
}

TEST(ReportBlade, PageSaysAllThatIdentifiesTheBlade) {
  const Result result = blade_result();
  const std::string page = html_report(result);
  for (const IdentityRow& row : kIdentityRows) {
    EXPECT_TRUE(says(page, std::string(row.key) + "&quot;&gt;")) << row.key;
    EXPECT_TRUE(says(page, ">" + std::string(row.label) + "<")) << row.label;
  }
  EXPECT_TRUE(says(page, sha256_of("a")));
  EXPECT_TRUE(says(page, "bladefit test"));
  for (const char* part :
       {"Pressure side, seen from astern", "Suction side, seen from ahead", "Leading edge at the measured radii",
        "Distances by radius and chord", "Uncertainty and decision", "Lost or not judged"})
    EXPECT_TRUE(says(page, part)) << part;
}

TEST(ReportBlade, NothingThatIsWrittenOfTheBladeBecomesMarkup) {
  const Result result = blade_result();
  const std::string page = html_report(result);
  EXPECT_FALSE(says(page, "<script"));
  EXPECT_FALSE(says(page, "\x01"));
  EXPECT_FALSE(says(page, "\xff"));
  const std::size_t style_end = page.find("</style>");
  EXPECT_TRUE(says(page.substr(style_end, 40), "</head>")) << "the style sheet ends where it is meant to";
  const XmlElements qif = elements_of(qif_report(result));
  EXPECT_EQ(qif.fault, "");
  EXPECT_FALSE(says(qif_report(result), "<script"));
}

TEST(ReportBlade, TextsAreCleanUtf8) {
  EXPECT_EQ(clean_text("M\xc3\xbcller \xe2\x82\xac \xf0\x9f\x9b\xa0"), "M\xc3\xbcller \xe2\x82\xac \xf0\x9f\x9b\xa0");
  for (const char* bad : {"\xc0\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xe2\x82", "\x80", "\n", "\xef\xbf\xbf"})
    EXPECT_TRUE(says(clean_text(bad), "\xef\xbf\xbd")) << bad;
  EXPECT_EQ(shortened("0123456789", 4), "01 ... 89");
}

TEST(ReportBlade, DefectsOfThePageHoldEveryPointThatIsOut) {
  const Result result = blade_result();
  std::size_t out = 0, joined = 0;
  for (const ResultPoint& point : result.points) out += point.state == PointState::out ? 1 : 0;
  for (const BladeDefect& defect : result.drawing->defects) joined += defect.points;
  EXPECT_GT(out, 0U);
  EXPECT_EQ(joined, out);
  EXPECT_TRUE(says(html_report(result), "<b>D1</b>"));
}

/// Rows of the table of defects on the first page.
std::size_t first_rows(const Result& result) {
  const std::string page = html_report(result);
  const std::string first = page.substr(0, page.find("<h2>Map of the blade</h2>"));
  std::size_t rows = 0;
  for (std::size_t at = first.find("<b>D"); at != std::string::npos; at = first.find("<b>D", at + 1)) ++rows;
  return rows;
}

TEST(ReportBlade, TheMapKeepsItsPlaceOnTheFirstPage) {
  Result result = blade_result();
  const BladeDefect defect = result.drawing->defects.front();
  result.drawing->defects.assign(30, defect);
  result.verdict.reasons.clear();
  const std::size_t rows = first_rows(result);
  EXPECT_GE(rows, 4U);
  EXPECT_LE(rows, 8U);
  result.record->identity.fields.assign(8, {"name", "text"});  // four rows
  EXPECT_EQ(first_rows(result), rows - 4 < 3 ? 3U : rows - 4);
  EXPECT_TRUE(says(html_report(result), "<h2>More defects</h2>"));
}

/// Where each element of a QIF 3.0 document stands, and how often: by the standard's Results, Features and
/// Characteristics models.
TEST(Qif, HasTheStructureOfTheStandard) {
  const Result result = blade_result();
  const int points = static_cast<int>(result.points.size());
  const XmlElements found = elements_of(qif_report(result));
  const std::map<std::string, int> wanted = {
      {"QIFDocument", 1},
      {"QIFDocument/QPId", 1},
      {"QIFDocument/Header/Application/Name", 1},
      {"QIFDocument/FileUnits/PrimaryUnits/LinearUnit/UnitConversion/Factor", 1},
      {"QIFDocument/Features/FeatureDefinitions/PointFeatureDefinition", 1},
      {"QIFDocument/Features/FeatureNominals/PointFeatureNominal/Location", points},
      {"QIFDocument/Features/FeatureItems/PointFeatureItem/FeatureNominalId", points},
      {"QIFDocument/Characteristics/CharacteristicDefinitions/PointProfileCharacteristicDefinition/ToleranceValue", 2},
      {"QIFDocument/Characteristics/CharacteristicItems/PointProfileCharacteristicItem/CharacteristicNominalId",
       points},
      {"QIFDocument/Results/MeasurementResultsSet/MeasurementResults/MeasuredFeatures/PointFeatureMeasurement/Location",
       points},
      {"QIFDocument/Results/MeasurementResultsSet/MeasurementResults/MeasuredCharacteristics/"
       "CharacteristicMeasurements/"
       "PointProfileCharacteristicMeasurement/Status/CharacteristicStatusEnum",
       points},
      {"QIFDocument/Results/MeasurementResultsSet/MeasurementResults/InspectionStatus/InspectionStatusEnum", 1}};
  for (const auto& [way, times] : wanted) EXPECT_EQ(found.count.contains(way) ? found.count.at(way) : 0, times) << way;
}

TEST(Qif, EveryReferenceLeadsToAnIdentityThatIsThereOnce) {
  const std::string xml = qif_report(blade_result());
  std::set<std::string> ids;
  std::size_t count = 0;
  for (std::size_t at = xml.find(" id=\""); at != std::string::npos; at = xml.find(" id=\"", at + 1)) {
    ids.insert(xml.substr(at + 5, xml.find('"', at + 5) - at - 5));
    ++count;
  }
  EXPECT_EQ(ids.size(), count);
  for (const char* name : {"FeatureDefinitionId", "FeatureNominalId", "FeatureItemId", "CharacteristicDefinitionId",
                           "CharacteristicNominalId", "CharacteristicItemId", "FormalStandardId", "Id"}) {
    const std::string opening = fmt::format("<{}>", name);
    std::size_t references = 0;
    for (std::size_t at = xml.find(opening); at != std::string::npos; at = xml.find(opening, at + 1), ++references) {
      const std::size_t begin = at + opening.size();
      EXPECT_TRUE(ids.contains(xml.substr(begin, xml.find('<', begin) - begin))) << name;
    }
    EXPECT_GT(references, 0U) << name;
  }
  for (const std::string& id : ids) {
    const std::string most = xml.substr(xml.find("idMax=\"") + 7);
    EXPECT_LE(std::stoul(id), std::stoul(most));
  }
}

TEST(Sha256, IsThatOfTheStandard) {
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(ReportBlade, ManyPointsAreThinnedInPicturesAndThePageSaysSo) {
  Result result = blade_result();
  const ResultPoint some = result.points[0];
  result.points.clear();
  result.drawing->points.resize(150000, result.drawing->points[0]);
  for (std::uint32_t k = 1; k <= 150000; ++k) {
    ResultPoint point = some;
    point.sequence = k;
    point.distance = 0.00001 * (k % 4000);
    point.state = k % 100 == 0 ? PointState::out : PointState::in;
    point.action = Action::cut;
    result.points.push_back(point);
  }
  result.drawing->defects.clear();
  const std::string page = html_report(result);
  EXPECT_TRUE(says(page, "of 150000 points: those out of tolerance"));
  EXPECT_LT(page.size(), 6000000U);
  const DrawnPoints drawn = drawn_points_of(result, tolerance_scale_of(result));
  EXPECT_EQ(drawn.indices.size() + drawn.left_out, 150000U);
  EXPECT_LE(drawn.indices.size(), kMostDrawn + 1);
}

TEST(ReportRecordOf, AResumedSessionKeepsItsBeginningAndItsBlade) {
  ReportRecord before;
  before.identity.part = "Fan";
  before.begun = "then";
  ReportIdentity other;
  other.part = "Other";
  const ReportRecord named = resumed(before, report_record_of(other, {}));
  EXPECT_EQ(named.identity.part, "Other");
  EXPECT_EQ(named.begun, "then");
  EXPECT_EQ(resumed(before, report_record_of({}, {})).identity.part, "Fan");
  const ReportRecord read = parse_record("report.json", record_json(named));
  EXPECT_EQ(read.identity.part, "Other");
  EXPECT_EQ(read.version, named.version);
}

int shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A session of its own, resumed without a word on the blade, then reported.
TEST(ReportBlade, ASessionsFolderHoldsAllThatItsReportNeeds) {
  const testing::ScratchFolder folder;
  const std::string data = BLADEFIT_TEST_DATA "/dtmb4119/";
  const std::string toml = fmt::format(
      "design = \"{}design.igs\"\nsource = \"replay:{}subsets/200.csv\"\n[fit]\nleading_edge = "
      "[\"u:0.4:0.6\"]\ntolerance = 0.05\n",
      data, data);
  const std::string with = folder.write("with.toml", toml + "[report]\npart = \"Wheel 7\"\n");
  const std::string without = folder.write("without.toml", toml);
  const std::string in = "cd '" + folder.path().string() + "' && '" BLADEFIT_COMMAND "' ";
  const std::string quiet = " > out.txt 2>&1";
  EXPECT_EQ(shell(in + "run --headless --panel 127.0.0.1:0 --session s --config " + with + quiet), 1);
  EXPECT_EQ(shell(in + "run --headless --panel 127.0.0.1:0 --session s --config " + without + quiet), 1);
  for (const char* format : {"html", "qif", "csv"})
    EXPECT_EQ(shell(in + "report s --format " + format + " -o report." + format + quiet), 0);
  const std::string page = testing::read_whole(folder.path() / "report.html");
  for (const char* part : {"Wheel 7", "Suction side, seen from ahead", "<b>D1</b>", "SHA-256", "without.toml"})
    EXPECT_TRUE(says(page, part)) << part;
  testing::SessionFolder::write_file(folder.path() / "s" / "design.bfd", "damaged");
  EXPECT_EQ(shell(in + "report s --format html -o report.html" + quiet), 2);
  EXPECT_TRUE(says(testing::read_whole(folder.path() / "out.txt"), "design.bfd: is damaged"));
}

TEST(Pdf, WithoutAPrinterOneLineSaysWhatToInstall) {
  const testing::SessionFolder session;
  const std::string command = "cd '" + session.path().string() +
                              "' && PATH=/nowhere '" BLADEFIT_COMMAND
                              "' report . --format pdf -o page.pdf > out.txt 2>&1";
  EXPECT_EQ(shell(command), 3);
  EXPECT_TRUE(says(session.read("out.txt"), "apt-get install chromium"));
  EXPECT_FALSE(std::filesystem::exists(session.path() / "page.pdf"));
}

TEST(ReportFile, ItsEndTellsTheFormat) {
  EXPECT_EQ(format_of_file("a/b.HTML").name, "html");
  EXPECT_EQ(format_of_file("b.qif").name, "qif");
  EXPECT_THROW(static_cast<void>(format_of_file("report")), ToolError);
  EXPECT_THROW(static_cast<void>(format_of_file("report.docx")), ToolError);
}

}  // namespace
}  // namespace bladefit
