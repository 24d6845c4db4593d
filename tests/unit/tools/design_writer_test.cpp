// What the IGES writer writes, read back by the product and by OpenCASCADE's own reader.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <IGESControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_BSplineSurface.hxx>
#include <Interface_Check.hxx>
#include <filesystem>

#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/nurbs/iges_writer.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

using testing::random_surface;
using testing::ScratchFolder;

const std::filesystem::path kDesigns = BLADEFIT_TEST_DATA;

void expect_read_back(const NurbsSurface& read, const NurbsSurface& written) {
  EXPECT_EQ(read.u.knots, written.u.knots);
  EXPECT_EQ(read.v.knots, written.v.knots);
  EXPECT_EQ(std::pair(read.u.start, read.u.end), std::pair(written.u.start, written.u.end));
  EXPECT_EQ(std::pair(read.v.start, read.v.end), std::pair(written.v.start, written.v.end));
  EXPECT_EQ(read.weights, written.weights);
  EXPECT_EQ(read.control_points, written.control_points);
}

/// The file as OpenCASCADE's IGES model holds it, before it makes shapes of it.
void expect_same_in_opencascade(const std::filesystem::path& path, const std::vector<NurbsSurface>& surfaces,
                                DesignUnit unit) {
  IGESControl_Reader reader;
  ASSERT_EQ(reader.ReadFile(path.c_str()), IFSelect_RetDone);
  const Handle(IGESData_IGESModel) model = reader.IGESModel();
  EXPECT_EQ(model->GlobalCheck(true)->NbFails() + model->GlobalCheck(true)->NbWarnings(), 0);
  EXPECT_EQ(model->GlobalSection().UnitFlag(), unit == DesignUnit::inch ? 1 : 2);
  EXPECT_EQ(model->GlobalSection().IGESVersion(), 11);
  ASSERT_EQ(model->NbEntities(), static_cast<int>(surfaces.size()));
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const NurbsSurface& wanted = surfaces[k];
    const Handle(IGESGeom_BSplineSurface) read =
        Handle(IGESGeom_BSplineSurface)::DownCast(model->Entity(static_cast<int>(k) + 1));
    ASSERT_FALSE(read.IsNull());
    const Handle(Interface_Check) check = model->Check(static_cast<int>(k) + 1, true);
    EXPECT_EQ(check->NbFails() + check->NbWarnings(), 0);
    EXPECT_EQ(read->DegreeU(), wanted.u.degree);
    EXPECT_EQ(read->DegreeV(), wanted.v.degree);
    for (int i = 0; i < wanted.u.control_points + wanted.u.degree + 1; ++i) {
      EXPECT_EQ(read->KnotU(i - wanted.u.degree), wanted.u.knots[static_cast<std::size_t>(i)]);
    }
    for (int j = 0; j < wanted.v.control_points + wanted.v.degree + 1; ++j) {
      EXPECT_EQ(read->KnotV(j - wanted.v.degree), wanted.v.knots[static_cast<std::size_t>(j)]);
    }
    for (int i = 0; i < wanted.u.control_points; ++i) {
      for (int j = 0; j < wanted.v.control_points; ++j) {
        const auto place = static_cast<std::size_t>(i * wanted.v.control_points + j);
        const gp_Pnt point = read->Pole(i, j);
        const Eigen::Vector3d mm = mm_per_unit(unit) * Eigen::Vector3d(point.X(), point.Y(), point.Z());
        EXPECT_EQ(mm, wanted.control_points[place]);
        EXPECT_EQ(read->Weight(i, j), wanted.weights[place]);
      }
    }
  }
  EXPECT_EQ(reader.TransferRoots(), static_cast<int>(surfaces.size()));
}

RC_GTEST_PROP(DesignWriter, MillimetresReadBackBitForBit, ()) {
  const auto degree_u = *rc::gen::inRange(1, 10);
  const bool clamped = *rc::gen::arbitrary<bool>();
  const NurbsSurface surface = random_surface({degree_u, 3, clamped, false, clamped}, {3, 2},
                                              *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<std::uint32_t>());
  const ScratchFolder folder;
  write_iges_design(folder.path() / "a.igs", {surface, surface}, DesignUnit::mm);
  const DesignFile design = read_design(folder.path() / "a.igs");
  RC_ASSERT(design.surfaces.size() == 2U);
  RC_ASSERT(design.warnings.empty());
  expect_read_back(design.surfaces[1], surface);
}

/// Designs in inches: the numbers of the first file come to stand in the second.
TEST(DesignWriter, ReferenceDesignsReadBackBitForBit) {
  for (const char* name : {"arl_fan", "arl_3patch", "pnsy_sub", "dtmb4119"}) {
    const DesignFile design = read_design(kDesigns / name / "design.igs");
    const ScratchFolder folder;
    const std::filesystem::path copy = folder.path() / "copy.igs";
    write_iges_design(copy, design.surfaces, design.unit);
    const DesignFile read = read_design(copy);
    EXPECT_EQ(read.unit, design.unit);
    ASSERT_EQ(read.surfaces.size(), design.surfaces.size());
    for (std::size_t k = 0; k < read.surfaces.size(); ++k) expect_read_back(read.surfaces[k], design.surfaces[k]);
    expect_same_in_opencascade(copy, design.surfaces, design.unit);
  }
}

TEST(DesignWriter, RecordsAreThoseOfIges) {
  const NurbsSurface surface = random_surface({}, {}, true, 5);
  const std::string text = iges_design_text({surface, surface}, DesignUnit::inch, "wei\xC3\x9F,blade;long.igs",
                                            std::chrono::system_clock::time_point(std::chrono::hours(24)));
  std::istringstream lines(text);
  std::string sections;
  for (std::string line; std::getline(lines, line);) {
    ASSERT_EQ(line.size(), 80U) << line;
    if (sections.empty() || sections.back() != line[72]) sections += line[72];
  }
  EXPECT_EQ(sections, "SGDPT");
  for (const char* part : {"1H,,1H;,", "wei__,blade;long.igs", ",1,2HIN,", "15H19700102.000000", "PATCH1", "PATCH2"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST(DesignWriter, SaysWhichSurfacesAreClosedAndPolynomial) {
  NurbsSurface surface = random_surface({}, {}, true, 5);
  EXPECT_EQ(iges_surface_parameters(surface).rfind("128,6,6,3,3,0,0,0,0,0,", 0), 0U);
  surface.weights.assign(surface.weights.size(), 2.0);
  for (std::size_t j = 0; j < 7; ++j) surface.control_points[42 + j] = surface.control_points[j];
  EXPECT_EQ(iges_surface_parameters(surface).rfind("128,6,6,3,3,1,0,1,0,0,", 0), 0U);
  for (std::size_t i = 0; i < 7; ++i) surface.control_points[7 * i + 6] = surface.control_points[7 * i];
  EXPECT_EQ(iges_surface_parameters(surface).rfind("128,6,6,3,3,1,1,1,0,0,", 0), 0U);
}

TEST(DesignWriter, RealsHaveAPointAndTheirExponentIsD) {
  EXPECT_EQ(iges_real(1), "1.");
  EXPECT_EQ(iges_real(-0.1), "-0.1");
  EXPECT_EQ(iges_real(1e-300), "1.D-300");
  EXPECT_EQ(iges_real(1.5e22), "1.5D+22");
}

TEST(DesignWriter, LeavesNoPartOfAFileBehind) {
  const NurbsSurface surface = random_surface({}, {}, true, 5);
  const ScratchFolder folder;
  EXPECT_THROW(write_iges_design(folder.path() / "a.stp", {surface}, DesignUnit::mm), ToolError);
  std::filesystem::create_directory(folder.path() / "taken.igs");
  EXPECT_THROW(write_iges_design(folder.path() / "taken.igs", {surface}, DesignUnit::mm), ToolError);
  EXPECT_THROW(write_iges_design(folder.path() / "nowhere" / "a.igs", {surface}, DesignUnit::mm), ToolError);
  const auto entries = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

}  // namespace
}  // namespace bladefit
