#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/geometry/surface/design_image.hpp"
#include "tests/support/json_file.hpp"
#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tests/unit/tools/design_image_reading.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/read_design.hpp"

namespace bladefit {
namespace {

using testing::iges_file;
using testing::iges_surface;
using testing::open_image;
using testing::random_surface;
using testing::ScratchFolder;
using testing::step_file;
using testing::step_surface;

const std::filesystem::path kData = BLADEFIT_TEST_DATA;
constexpr const char* kCases[] = {"arl_3patch", "arl_fan", "dtmb4119", "dtmb4119_ball", "pnsy_3patch", "pnsy_sub"};

void expect_same_direction(const SurfaceDirection& read, const SurfaceDirection& written) {
  EXPECT_EQ(read.degree, written.degree);
  EXPECT_EQ(read.knots, written.knots);
  EXPECT_EQ(std::pair(read.start, read.end), std::pair(written.start, written.end));
}

/// Knots, weights and control points as they stand in the file; lengths that were turned to mm to the last bit.
void expect_same(const NurbsSurface& read, const NurbsSurface& written, double mm = 1.0) {
  expect_same_direction(read.u, written.u);
  expect_same_direction(read.v, written.v);
  EXPECT_EQ(read.weights, written.weights);
  ASSERT_EQ(read.control_points.size(), written.control_points.size());
  for (std::size_t k = 0; k < read.control_points.size(); ++k) {
    const Eigen::Vector3d expected = mm * written.control_points[k];
    EXPECT_LE((read.control_points[k] - expected).norm(), (mm == 1.0 ? 0 : 4e-16) * expected.norm()) << k;
  }
}

/// The same points at the same shares of the parameter ranges.
void expect_same_points(const NurbsSurface& read, const NurbsSurface& written) {
  for (const double u : {0.0, 0.31, 0.77, 1.0}) {
    for (const double v : {0.0, 0.46, 1.0}) {
      const Eigen::Vector3d one = testing::evaluate_surface(read, u, v);
      const Eigen::Vector3d other = testing::evaluate_surface(written, u, v);
      EXPECT_LT((one - other).norm(), 1e-12 * other.norm());
    }
  }
}

NurbsSurface read_single(const ScratchFolder& folder, const std::string& name, const std::string& content) {
  const DesignFile design = read_design(folder.write(name, content));
  EXPECT_EQ(design.surfaces.size(), 1U);
  return design.surfaces.at(0);
}

TEST(DesignFiles, EveryCaseCompilesAndTwinsAgree) {
  for (const char* name : kCases) {
    const nlohmann::json facts = testing::read_json(kData / name / "case.json");
    const LoadedDesign iges = load_design(kData / name / "design.igs", OutwardOption::automatic);
    const LoadedDesign step = load_design(kData / name / "design.stp", OutwardOption::automatic);
    const DesignImage image = open_image(iges.image);
    const DesignImage twin = open_image(step.image);
    EXPECT_EQ(image.header().outward, facts["design"]["normal_sign"].get<int>()) << name;
    EXPECT_EQ(twin.header().outward, image.header().outward) << name;
    EXPECT_EQ(image.header().design_unit, facts["units"] == "in" ? 1U : 0U) << name;
    EXPECT_EQ(image.patches().size(), facts["design"]["patches"].size()) << name;
    EXPECT_EQ(iges.notes.size(), 1U) << name;
    ASSERT_EQ(image.points().size(), twin.points().size()) << name;
    const double tolerance = 1e-12 * testing::image_size(image);
    for (std::size_t k = 0; k < image.points().size(); ++k) {
      ASSERT_NEAR(image.points()[k], twin.points()[k], tolerance) << name;
    }
    EXPECT_EQ(testing::check_cones(image, 3), 0) << name;
  }
}

TEST(DesignFiles, EqualDeBoorOfTheFile) {
  for (const char* name : {"arl_3patch", "pnsy_sub"}) {
    const DesignFile design = read_design(kData / name / "design.stp");
    const LoadedDesign loaded = load_design(kData / name / "design.stp", OutwardOption::plus);
    const DesignImage image = open_image(loaded.image);
    double error = 0;
    for (const ImageSpan& span : image.spans()) {
      const ImagePatch& patch = image.patches()[span.patch];
      const double* u = &image.breaks()[patch.first_break_u + span.iu];
      const double* v = &image.breaks()[patch.first_break_v + span.iv];
      const Eigen::Vector3d expected = testing::evaluate_surface(
          design.surfaces[span.patch], u[0] + 0.3 * (u[1] - u[0]), v[0] + 0.6 * (v[1] - v[0]));
      error = std::max(error, (testing::evaluate_span(image, span, 0.3, 0.6).point - expected).norm());
    }
    EXPECT_LT(error, 1e-13 * testing::image_size(image)) << name;
  }
}

RC_GTEST_PROP(DesignFiles, BothFormatsReadBackExactly, ()) {
  const auto degree_u = *rc::gen::inRange(1, 10);
  const auto degree_v = *rc::gen::inRange(1, 10);
  const bool clamped = *rc::gen::arbitrary<bool>();
  const NurbsSurface surface =
      random_surface({degree_u, 3, clamped, false, clamped}, {degree_v, 2}, true, *rc::gen::arbitrary<std::uint32_t>());
  const ScratchFolder folder;
  expect_same(read_single(folder, "a.IGS", iges_file({iges_surface(surface)})), surface);
  int number = 100;
  expect_same(read_single(folder, "a.Step", step_file(step_surface(surface, "", number))), surface);
  RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(DesignFiles, IgesSubRangeIsRespected) {
  const NurbsSurface surface = random_surface({3, 5, true, true}, {2, 4, false, true}, true, 4);
  const ScratchFolder folder;
  expect_same_points(read_single(folder, "a.iges", iges_file({iges_surface(surface)})), surface);
}

TEST(DesignFiles, RangeJustBeyondTheKnotsIsCut) {
  NurbsSurface surface = random_surface({}, {}, false, 4);
  const double end = surface.u.end;
  surface.u.end += 1e-9;
  const ScratchFolder folder;
  const DesignFile design = read_design(folder.write("a.igs", iges_file({iges_surface(surface)})));
  EXPECT_EQ(design.surfaces[0].u.end, end);
  EXPECT_EQ(design.warnings.size(), 1U);
}

TEST(DesignFiles, IgesUnits) {
  struct Case {
    const char* units;
    double mm;
    DesignUnit shown;
  };
  constexpr Case kUnits[] = {{"1,2HIN", 25.4, DesignUnit::inch},   {"2,2HMM", 1, DesignUnit::mm},
                             {"3,4HINCH", 25.4, DesignUnit::inch}, {"3,2HCM", 10, DesignUnit::mm},
                             {"4,2HFT", 304.8, DesignUnit::mm},    {"6,1HM", 1000, DesignUnit::mm},
                             {"10,2HCM", 10, DesignUnit::mm}};
  const NurbsSurface surface = random_surface({}, {}, true, 4);
  const ScratchFolder folder;
  for (const Case& unit : kUnits) {
    const DesignFile design = read_design(folder.write("a.igs", iges_file({iges_surface(surface)}, unit.units)));
    expect_same(design.surfaces.at(0), surface, unit.mm);
    EXPECT_EQ(design.unit, unit.shown) << unit.units;
    EXPECT_EQ(design.warnings.size(), unit.mm == 1 || unit.mm == 25.4 ? 0U : 1U) << unit.units;
  }
}

TEST(DesignFiles, IgesScaleDividesCoordinates) {
  const NurbsSurface surface = random_surface({}, {}, true, 4);
  const ScratchFolder folder;
  const auto path = folder.write("a.igs", iges_file({iges_surface(surface)}, "2,2HMM", "0.5"));
  expect_same(read_design(path).surfaces.at(0), surface, 2.0);
}

TEST(DesignFiles, IgesTransformationMatrixMovesTheSurface) {
  const NurbsSurface surface = random_surface({}, {}, true, 4);
  const ScratchFolder folder;
  const std::string matrix = "124,0.,-1.,0.,5.,1.,0.,0.,6.,0.,0.,1.,7.";
  const NurbsSurface moved =
      read_single(folder, "a.igs", iges_file({{124, matrix, 0, ""}, iges_surface(surface, 1)}, "1,2HIN"));
  for (std::size_t k = 0; k < surface.control_points.size(); ++k) {
    const Eigen::Vector3d& point = surface.control_points[k];
    const Eigen::Vector3d expected(5 - point.y(), 6 + point.x(), 7 + point.z());
    EXPECT_LT((moved.control_points[k] - 25.4 * expected).norm(), 1e-12 * 25.4 * 100);
  }
}

TEST(DesignFiles, TwoFilesOfOneBladeInOtherUnitsAreToldOf) {
  const ScratchFolder folder;
  int number = 100;
  const std::string sheet = testing::step_surface(testing::random_surface({}, {}, true, 41), "SHEET", number);
  const std::filesystem::path mm = folder.write("mm.stp", testing::step_file(sheet)),
                              metre = folder.write(
                                  "metre.stp", testing::step_file(
                                                   sheet, testing::replaced(testing::kStepMillimetre, ".MILLI.", "$")));
  const DesignFile design = read_designs({mm, metre});
  const auto told = [](const std::string& line) {
    return line.find("its unit is 1000 mm, that of ") != std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(design.warnings, told), 1);
}

TEST(DesignFiles, StepUnits) {
  const auto inch_of = [](const std::string& factor) {
    return "#4=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));\n#5=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
           "#3=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(" +
           factor +
           "),#4);\n"
           "#2=(CONVERSION_BASED_UNIT('INCH',#3)LENGTH_UNIT()NAMED_UNIT(#5));\n";
  };
  const std::string milli = "#2=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n";
  const NurbsSurface surface = random_surface({}, {}, true, 4);
  const ScratchFolder folder;
  int number = 100;
  const std::string statements = step_surface(surface, "", number);
  const auto read_with = [&](const std::string& unit) {
    const std::string units = testing::replaced(testing::kStepMillimetre, milli, unit);
    return read_design(folder.write("a.stp", step_file(statements, units)));
  };
  expect_same(read_with(milli).surfaces.at(0), surface);
  expect_same(read_with("#2=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n").surfaces.at(0), surface, 1000);
  const DesignFile inch = read_with(inch_of("2.54"));
  EXPECT_EQ(inch.unit, DesignUnit::inch);
  expect_same(inch.surfaces.at(0), surface, 25.4);
}

TEST(DesignFiles, StepSurfacesFollowTheNumbersOfTheirFaces) {
  const NurbsSurface first = random_surface({}, {}, true, 1);
  const NurbsSurface second = random_surface({}, {}, true, 2);
  const ScratchFolder folder;
  for (const bool named : {true, false}) {
    int number = 100;
    const std::string statements =
        step_surface(second, named ? "PATCH10" : "PATCH", number) + step_surface(first, "PATCH9", number);
    const DesignFile design = read_design(folder.write("a.stp", step_file(statements)));
    ASSERT_EQ(design.surfaces.size(), 2U);
    EXPECT_EQ(design.faces[0].name, named ? "PATCH9" : "PATCH");
    expect_same(design.surfaces[0], named ? first : second);
    expect_same(design.surfaces[1], named ? second : first);
  }
}

NurbsSurface with_knots(NurbsSurface surface, const std::vector<double>& knots_u, const std::vector<double>& knots_v) {
  surface.u.knots = knots_u;
  surface.v.knots = knots_v;
  for (SurfaceDirection* direction : {&surface.u, &surface.v}) {
    direction->start = direction->knots[static_cast<std::size_t>(direction->degree)];
    direction->end = direction->knots[static_cast<std::size_t>(direction->control_points)];
  }
  return surface;
}

TEST(DesignFiles, StepImpliedKnots) {
  const ScratchFolder folder;
  const auto read_as = [&](const NurbsSurface& surface, testing::StepForm form) {
    int number = 100;
    return read_single(folder, "a.stp", step_file(step_surface(surface, "", number, form)));
  };
  const NurbsSurface piece = random_surface({3, 1}, {2, 1}, true, 1);
  expect_same(read_as(piece, testing::StepForm::bezier),
              with_knots(piece, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 1, 1, 1}));
  const NurbsSurface sheet = random_surface({3, 2}, {2, 2}, true, 1);
  expect_same(read_as(sheet, testing::StepForm::quasi_uniform),
              with_knots(sheet, {0, 0, 0, 0, 1, 2, 2, 2, 2}, {0, 0, 0, 1, 2, 2, 2}));
  expect_same(read_as(sheet, testing::StepForm::uniform),
              with_knots(sheet, {-3, -2, -1, 0, 1, 2, 3, 4, 5}, {-2, -1, 0, 1, 2, 3, 4}));
}

TEST(DesignFiles, ImagesAreReadAsTheyAreAndTurned) {
  const NurbsSurface surface = random_surface({}, {}, true, 1);
  const ScratchFolder folder;
  const auto source = folder.write("a.igs", iges_file({iges_surface(surface)}));
  const LoadedDesign compiled = load_design(source, OutwardOption::minus);
  const auto path =
      folder.write("a.bfd", {reinterpret_cast<const char*>(compiled.image.data()), compiled.image.size()});
  EXPECT_EQ(load_design(path, OutwardOption::automatic).image, compiled.image);
  EXPECT_EQ(load_design(path, OutwardOption::minus).image, compiled.image);
  EXPECT_EQ(open_image(load_design(path, OutwardOption::plus).image).header().outward, 1);
}

}  // namespace
}  // namespace bladefit
