// Parts that a STEP file places by operators: mirrored, scaled, inside of each other, and those that are refused.
#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <STEPControl_Writer.hxx>

#include <Eigen/Geometry>
#include <cmath>
#include <regex>

#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/nurbs/trim_loops.hpp"
#include "tools/design/occ/cad_session.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using testing::replaced;
using testing::ScratchFolder;

const NurbsSurface kPlacedSheet = testing::random_surface({3, 2}, {2, 2}, true, 31);

Vector3d outward_of(const NurbsSurface& surface, double u, double v) {
  constexpr double kStep = 1e-5;
  const auto at = [&](double du, double dv) { return testing::evaluate_surface(surface, u + du, v + dv); };
  const Vector3d cross = (at(kStep, 0) - at(-kStep, 0)).cross(at(0, kStep) - at(0, -kStep)).normalized();
  return surface.reversed ? Vector3d(-cross) : cross;
}

/// `found` is the sheet moved, and looks to the side to which the moved sheet looks.
void expect_sheet(const NurbsSurface& found, const Affine3d& moved) {
  for (const auto& [u, v] : {std::pair{0.2, 0.3}, {0.7, 0.6}}) {
    const Vector3d point = moved * testing::evaluate_surface(kPlacedSheet, u, v);
    EXPECT_LT((testing::evaluate_surface(found, u, v) - point).norm(), 1e-10 * (1 + point.norm()));
    const Vector3d side = moved.linear() * outward_of(kPlacedSheet, u, v);
    EXPECT_GT(side.normalized().dot(outward_of(found, u, v)), 0.999);
  }
}

Affine3d affine(const Eigen::Matrix3d& linear, const Vector3d& shift) {
  Affine3d result = Affine3d::Identity();
  result.linear() = linear;
  result.translation() = shift;
  return result;
}

std::string direction(int number, const Vector3d& along) {
  return fmt::format("#{}=DIRECTION('',({},{},{}));\n", number, testing::real_text(along.x()),
                     testing::real_text(along.y()), testing::real_text(along.z()));
}

/// Statements #70 to #74 of an operator that moves by `moves`; #74 is the operator.
std::string operator_of(const Affine3d& moves, bool complex = false) {
  const double scale = std::cbrt(std::abs(moves.linear().determinant()));
  const Vector3d& origin = moves.translation();
  std::string text;
  for (int k = 0; k < 3; ++k) text += direction(70 + k, moves.linear().col(k) / scale);
  text += fmt::format("#73=CARTESIAN_POINT('',({},{},{}));\n", testing::real_text(origin.x()),
                      testing::real_text(origin.y()), testing::real_text(origin.z()));
  const std::string own = fmt::format("#70,#71,#73,{}", testing::real_text(scale));
  if (!complex) return text + fmt::format("#74=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',{},#72);\n", own);
  return text +
         fmt::format(
             "#74=(CARTESIAN_TRANSFORMATION_OPERATOR({})\n CARTESIAN_TRANSFORMATION_OPERATOR_3D (#72)"
             "FUNCTIONALLY_DEFINED_TRANSFORMATION('','')GEOMETRIC_REPRESENTATION_ITEM()REPRESENTATION_ITEM(''));\n",
             own);
}

constexpr const char* kOwnFrame =
    "#50=CARTESIAN_POINT('',(0.,0.,0.));\n#51=DIRECTION('',(1.,0.,0.));\n#53=DIRECTION('',(0.,0.,1.));\n"
    "#55=AXIS2_PLACEMENT_3D('',#50,#53,#51);\n";

/// A file with the sheet as the representation #29, which `statements` makes another, #40, of the product.
std::string placed_sheet(const std::string& statements, const std::string& units = testing::kStepMillimetre) {
  int number = 100;
  return replaced(testing::step_file(testing::step_surface(kPlacedSheet, "SHEET", number), units),
                  "#30=SHAPE_DEFINITION_REPRESENTATION(#26,#29);",
                  kOwnFrame + statements + "#30=SHAPE_DEFINITION_REPRESENTATION(#26,#40);");
}

constexpr const char* kMappedSheet =
    "#57=REPRESENTATION_MAP(#55,#29);\n#41=MAPPED_ITEM('',#57,#74);\n#40=SHAPE_REPRESENTATION('',(#41,#55),#1);\n";

/// The sheet as a component of another product, placed by the operator #74. `reversed`: told from the whole to the
/// part.
std::string component(bool reversed = false) {
  return fmt::format(
      "#30=SHAPE_DEFINITION_REPRESENTATION(#26,#29);\n#80=PRODUCT('whole','whole','',(#21));\n"
      "#81=PRODUCT_DEFINITION_FORMATION('','',#80);\n#82=PRODUCT_DEFINITION('','',#81,#24);\n"
      "#83=PRODUCT_DEFINITION_SHAPE('','',#82);\n#84=SHAPE_REPRESENTATION('',(#55),#1);\n"
      "#85=SHAPE_DEFINITION_REPRESENTATION(#83,#84);\n"
      "#86=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','','',#82,#25,$);\n#87=PRODUCT_DEFINITION_SHAPE('','',#86);\n"
      "#88=(REPRESENTATION_RELATIONSHIP('','',{})REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#74)"
      "SHAPE_REPRESENTATION_RELATIONSHIP());\n#89=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#88,#87);\n",
      reversed ? "#84,#29" : "#29,#84");
}

std::string component_file(const std::string& operators, bool reversed = false) {
  int number = 100;
  return replaced(testing::step_file(testing::step_surface(kPlacedSheet, "SHEET", number)),
                  "#30=SHAPE_DEFINITION_REPRESENTATION(#26,#29);", kOwnFrame + operators + component(reversed));
}

DesignFile read_placed(const std::string& content) {
  const ScratchFolder folder;
  return read_design(folder.write("a.stp", content));
}

std::string refusal_of_place(const std::string& content) {
  try {
    read_placed(content);
  } catch (const ToolError& error) {
    return error.what();
  }
  return "accepted";
}

/// Turns, mirrors and scales of every kind, each with a shift.
std::vector<Affine3d> similarities() {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -3).normalized()).toRotationMatrix();
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(1, 1) = -1;
  const Vector3d shift(5, -6, 7);
  return {affine(turn, shift),
          affine(mirror, shift),
          affine(turn * mirror, shift),
          affine(2.5 * turn, shift),
          affine(0.25 * mirror, shift),
          affine(3 * mirror * turn, Vector3d::Zero()),
          affine(-Eigen::Matrix3d::Identity(), Vector3d::Zero()),
          affine(2 * Eigen::Matrix3d::Identity(), Vector3d::Zero()),
          Affine3d::Identity()};
}

TEST(DesignOperators, AMappedItemIsMirroredAndScaled) {
  for (const bool complex : {false, true}) {
    for (const Affine3d& moves : similarities()) {
      const DesignFile design = read_placed(placed_sheet(operator_of(moves, complex) + kMappedSheet));
      ASSERT_EQ(design.surfaces.size(), 1U);
      expect_sheet(design.surfaces[0], moves);
    }
  }
}

TEST(DesignOperators, AComponentOfAnAssemblyIsMirroredAndScaled) {
  for (const bool complex : {false, true}) {
    for (const Affine3d& moves : similarities()) {
      const DesignFile design = read_placed(component_file(operator_of(moves, complex)));
      ASSERT_EQ(design.surfaces.size(), 1U);
      expect_sheet(design.surfaces[0], moves);
    }
  }
}

TEST(DesignOperators, ARelationToldTheOtherWayRoundIsUndone) {
  const Affine3d moves = similarities()[5];
  const DesignFile design = read_placed(component_file(operator_of(moves), true));
  ASSERT_EQ(design.surfaces.size(), 1U);
  expect_sheet(design.surfaces[0], moves.inverse());
}

TEST(DesignOperators, OneMirrorInsideOfAnotherFollowsIt) {
  const Affine3d moves = similarities()[2], again = moves * moves;
  const DesignFile design = read_placed(placed_sheet(
      operator_of(moves) +
      "#57=REPRESENTATION_MAP(#55,#29);\n#42=MAPPED_ITEM('',#57,#74);\n#43=SHAPE_REPRESENTATION('',(#42,#55),"
      "#1);\n#44=REPRESENTATION_MAP(#55,#43);\n#41=MAPPED_ITEM('',#44,#74);\n"
      "#40=SHAPE_REPRESENTATION('',(#41,#55),#1);\n"));
  ASSERT_EQ(design.surfaces.size(), 1U);
  expect_sheet(design.surfaces[0], again);
}

TEST(DesignOperators, AMirroredCopyStandsBesideItsPart) {
  const Affine3d moves = similarities()[4];
  const DesignFile design = read_placed(
      placed_sheet(operator_of(moves) +
                   "#57=REPRESENTATION_MAP(#55,#29);\n#41=MAPPED_ITEM('',#57,#74);\n#42=MAPPED_ITEM('',#57,#55);\n"
                   "#40=SHAPE_REPRESENTATION('',(#42,#41,#55),#1);\n"));
  ASSERT_EQ(design.surfaces.size(), 2U);
  expect_sheet(design.surfaces[0], Affine3d::Identity());
  expect_sheet(design.surfaces[1], moves);
}

TEST(DesignOperators, AnOriginIsInTheUnitOfTheFile) {
  const Affine3d moves = similarities()[5], shifted = affine(moves.linear(), Vector3d(1, 2, 3));
  const DesignFile design = read_placed(
      placed_sheet(operator_of(shifted) + kMappedSheet, replaced(testing::kStepMillimetre, ".MILLI.", "$")));
  ASSERT_EQ(design.surfaces.size(), 1U);
  const Vector3d wanted = 1000 * (shifted * testing::evaluate_surface(kPlacedSheet, 0.3, 0.4));
  EXPECT_LT((testing::evaluate_surface(design.surfaces[0], 0.3, 0.4) - wanted).norm(), 1e-10 * wanted.norm());
}

TEST(DesignOperators, AxesThatAreNotSquareAreMadeSoFromTheThirdOn) {
  const std::string skew = direction(70, {2, 0.5, 0.1}) + direction(71, {0.2, -3, 0.4}) + direction(72, {0, 0, 5}) +
                           "#73=CARTESIAN_POINT('',(0.,0.,0.));\n"
                           "#74=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#70,#71,#73,2.,#72);\n";
  const Vector3d x = Vector3d(2, 0.5, 0).normalized(), y = Vector3d(0.5, -2, 0).normalized();
  Eigen::Matrix3d axes;
  axes << x, y, Vector3d::UnitZ();
  const DesignFile design = read_placed(placed_sheet(skew + kMappedSheet));
  ASSERT_EQ(design.surfaces.size(), 1U);
  expect_sheet(design.surfaces[0], affine(2 * axes, Vector3d::Zero()));
}

TEST(DesignOperators, WhatCannotBeToldIsRefusedWithAWayOut) {
  const std::string axes =
      direction(70, {-1, 0, 0}) + direction(72, {0, 0, 1}) + "#73=CARTESIAN_POINT('',(0.,0.,0.));\n";
  const auto mapped = [&](const std::string& own) {
    return refusal_of_place(
        placed_sheet(axes + "#74=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',''," + own + ");\n" + kMappedSheet));
  };
  const auto names = [](const std::string& said, const std::string& what) {
    EXPECT_NE(said.find(what), std::string::npos) << said;
    EXPECT_NE(said.find("export the blade as one part, not as an assembly"), std::string::npos) << said;
  };
  names(mapped("#70,$,#73,1.,#72"),
        "#74: where a part stands cannot be told of the operator: it is mirrored only because");
  names(mapped("#70,#70,#73,1.,#72"), "its axes are parallel");
  names(mapped("#70,$,#73,0.,#72"), "its scale is 0");
  const std::string elsewhere = replaced(kMappedSheet, "REPRESENTATION_MAP(#55", "REPRESENTATION_MAP(#56");
  names(refusal_of_place(placed_sheet(operator_of(similarities()[1]) + "#49=CARTESIAN_POINT('',(1.,0.,0.));\n" +
                                      "#56=AXIS2_PLACEMENT_3D('',#49,#53,#51);\n" + elsewhere)),
        "#41: an operator places a part from axes that are not its own");
  names(refusal_of_place(component_file("#74=ITEM_DEFINED_TRANSFORMATION('','',#50,#55);\n")),
        "#88: where a part stands is given in a way that is not read");
}

/// A body with a bore, written by OpenCASCADE and placed by an operator.
std::string placed_body(const Affine3d& moves, const ScratchFolder& folder) {
  const std::filesystem::path path = folder.path() / "body.stp";
  {
    const QuietMessages quiet;
    const TopoDS_Shape bore = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(4, 9, -1), gp_Dir(0, 0, 1)), 3, 40).Shape();
    STEPControl_Writer writer;
    writer.Transfer(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(10.0, 20.0, 30.0).Shape(), bore), STEPControl_AsIs);
    writer.Write(path.c_str());
  }
  std::string text = read_text(path);
  std::smatch found;
  const std::regex shape(R"(SHAPE_DEFINITION_REPRESENTATION\((#\d+),(#\d+)\);)");
  EXPECT_TRUE(std::regex_search(text, found, shape));
  const std::regex context(R"(ADVANCED_BREP_SHAPE_REPRESENTATION\('',\([^)]*\),(#\d+)\);)");
  std::smatch in;
  EXPECT_TRUE(std::regex_search(text, in, context));
  const std::string whole = fmt::format("SHAPE_DEFINITION_REPRESENTATION({},#9040);\n", found[1].str());
  std::string mapping = fmt::format(
      "{}{}#57=REPRESENTATION_MAP(#55,{});\n#41=MAPPED_ITEM('',#57,#74);\n"
      "#40=SHAPE_REPRESENTATION('',(#41,#55),{});\n",
      kOwnFrame, operator_of(moves), found[2].str(), in[1].str());
  mapping = std::regex_replace(mapping, std::regex("#(4[01]|5[0137]|55|7[0-4])(?![0-9])"), "#90$1");
  // References to the body's own instances keep their numbers: they are longer, or not among these.
  return replaced(text, found[0].str(), whole + mapping);
}

double volume_of(const DesignFile& design) {
  constexpr int kGrid = 60;
  double volume = 0;
  for (const NurbsSurface& surface : design.surfaces) {
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; j < kGrid; ++j) {
        const double u = (i + 0.5) / kGrid, v = (j + 0.5) / kGrid, step = 0.4 / kGrid;
        if (!inside_loops(surface.trims, u, v)) continue;
        const auto at = [&](double du, double dv) { return testing::evaluate_surface(surface, u + du, v + dv); };
        const Vector3d cross = (at(step, 0) - at(-step, 0)).cross(at(0, step) - at(0, -step)) / (4 * step * step);
        volume += (surface.reversed ? -1 : 1) * at(0, 0).dot(cross) / (3.0 * kGrid * kGrid);
      }
    }
  }
  return volume;
}

TEST(DesignOperators, ATrimmedBodyIsAsLargeAsItsPlaceMakesItAndLooksOut) {
  const ScratchFolder folder;
  const double own = 6000 - M_PI * 9 * 30;
  for (const Affine3d& moves : similarities()) {
    const DesignFile design = read_placed(placed_body(moves, folder));
    ASSERT_EQ(design.surfaces.size(), 7U);
    const double scale = std::cbrt(std::abs(moves.linear().determinant()));
    EXPECT_NEAR(volume_of(design) / (own * scale * scale * scale), 1, 0.01);
    double area = 0;
    for (const DesignFace& face : design.faces) {
      EXPECT_TRUE(face.in_body);
      area += face.area / (scale * scale);
    }
    EXPECT_NEAR(area / (2 * (200 + 300 + 600) - 2 * M_PI * 9 + 2 * M_PI * 3 * 30), 1, 0.01);
  }
}

}  // namespace
}  // namespace bladefit
