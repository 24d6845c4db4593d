// Parts that stand in assemblies: placed, mirrored, hidden. Files written by OpenCASCADE's XCAF and by hand.
#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeBox.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <Eigen/Geometry>
#include <functional>

#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/occ/cad_session.hpp"
#include "tools/design/read_design.hpp"

namespace bladefit {
namespace {

using testing::replaced;
using testing::ScratchFolder;

const NurbsSurface kPart = testing::random_surface({3, 2}, {2, 2}, true, 31);

Eigen::Vector3d outward_at(const NurbsSurface& surface, double u, double v) {
  constexpr double kStep = 1e-5;
  const auto at = [&](double du, double dv) { return testing::evaluate_surface(surface, u + du, v + dv); };
  const Eigen::Vector3d cross = (at(kStep, 0) - at(-kStep, 0)).cross(at(0, kStep) - at(0, -kStep)).normalized();
  return surface.reversed ? Eigen::Vector3d(-cross) : cross;
}

/// The parts of a file are `moved` ones of the sheet, and look to the side to which the moved sheet looks.
void expect_moved(const NurbsSurface& found, const Eigen::Affine3d& moved) {
  for (const auto& [u, v] : {std::pair{0.2, 0.3}, {0.7, 0.6}}) {
    const Eigen::Vector3d point = moved * testing::evaluate_surface(kPart, u, v);
    EXPECT_LT((testing::evaluate_surface(found, u, v) - point).norm(), 1e-10 * (1 + point.norm()));
    const Eigen::Vector3d side = moved.linear() * outward_at(kPart, u, v);
    EXPECT_GT(side.normalized().dot(outward_at(found, u, v)), 0.999);
  }
}

DesignFile read_text_as(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  return read_design(folder.write(name, content));
}

/// The product's shape is that of the sheet, mapped by `mapping`, statements that make #40 of it.
std::string mapped_step(const std::string& mapping) {
  int number = 100;
  const std::string file = testing::step_file(testing::step_surface(kPart, "SHEET", number));
  return replaced(file, "#30=SHAPE_DEFINITION_REPRESENTATION(#26,#29);",
                  "#50=CARTESIAN_POINT('',(0.,0.,0.));\n#51=DIRECTION('',(1.,0.,0.));\n"
                  "#52=DIRECTION('',(0.,1.,0.));\n#53=DIRECTION('',(0.,0.,1.));\n#54=DIRECTION('',(0.,0.,-1.));\n"
                  "#55=AXIS2_PLACEMENT_3D('',#50,#53,#51);\n#56=CARTESIAN_POINT('',(5.,6.,7.));\n"
                  "#57=REPRESENTATION_MAP(#55,#29);\n" +
                      mapping +
                      "#40=SHAPE_REPRESENTATION('',(#41,#55),#1);\n#30=SHAPE_DEFINITION_REPRESENTATION(#26,#40);");
}

/// Over the xy plane, then by (5, 6, 7).
Eigen::Affine3d mirrored_and_shifted() {
  Eigen::Affine3d moved = Eigen::Affine3d::Identity();
  moved.linear()(2, 2) = -1;
  moved.translation() = Eigen::Vector3d(5, 6, 7);
  return moved;
}

/// Half a turn about x, then by (5, 6, 7).
Eigen::Affine3d turned_and_shifted() {
  Eigen::Affine3d moved = Eigen::Affine3d::Identity();
  moved.linear().diagonal() = Eigen::Vector3d(1, -1, -1);
  moved.translation() = Eigen::Vector3d(5, 6, 7);
  return moved;
}

constexpr const char* kHalfTurn =
    "#59=DIRECTION('',(0.,-1.,0.));\n#58=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#51,#59,#56,1.,#54);\n";

TEST(DesignAssembly, AStepOperatorMovesThePartAndItsSide) {
  const DesignFile design =
      read_text_as("a.stp", mapped_step(std::string(kHalfTurn) + "#41=MAPPED_ITEM('',#57,#58);\n"));
  ASSERT_EQ(design.surfaces.size(), 1U);
  expect_moved(design.surfaces[0], turned_and_shifted());
}

TEST(DesignAssembly, OperatorsInsideOfEachOtherFollowEachOther) {
  const DesignFile design =
      read_text_as("a.stp", mapped_step(std::string(kHalfTurn) +
                                        "#42=MAPPED_ITEM('',#57,#58);\n#43=SHAPE_REPRESENTATION('',(#42,#55),"
                                        "#1);\n#44=REPRESENTATION_MAP(#55,#43);\n#41=MAPPED_ITEM('',#44,#58);\n"));
  ASSERT_EQ(design.surfaces.size(), 1U);
  expect_moved(design.surfaces[0], turned_and_shifted() * turned_and_shifted());
}

TEST(DesignAssembly, AnIgesMatrixMirrorsTheSurface) {
  const IgesOutputEntity mirror{124, "124,1.,0.,0.,5.,0.,1.,0.,6.,0.,0.,-1.,7.", 0, "", 0, 1};
  for (const bool at_owner : {false, true}) {
    std::vector<IgesOutputEntity> entities = {mirror, testing::iges_surface(kPart, at_owner ? 0 : 1)};
    if (at_owner) entities.push_back({144, "144,3,0,0,0", 1, ""});
    const DesignFile design = read_text_as("a.igs", testing::iges_file(entities));
    ASSERT_EQ(design.surfaces.size(), 1U);
    for (std::size_t k = 0; k < kPart.control_points.size(); ++k) {
      const Eigen::Vector3d wanted = mirrored_and_shifted() * kPart.control_points[k];
      EXPECT_LT((design.surfaces[0].control_points[k] - wanted).norm(), 1e-12 * (1 + wanted.norm()));
    }
    EXPECT_FALSE(design.faces[0].told) << "a loose surface of IGES has no side of its own";
  }
}

/// An assembly that `fill` makes, as XCAF writes it.
DesignFile read_assembly(const std::function<void(XCAFDoc_ShapeTool&, XCAFDoc_ColorTool&)>& fill) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "assembly.stp";
  {
    const QuietMessages quiet;
    Handle(TDocStd_Document) document;
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
    const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    fill(*shapes, *XCAFDoc_DocumentTool::ColorTool(document->Main()));
    shapes->UpdateAssemblies();
    STEPCAFControl_Writer writer;
    EXPECT_TRUE(writer.Transfer(document));
    EXPECT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
    document->Close();
  }
  return read_design(path);
}

TopLoc_Location placed_at(double degrees, const gp_Vec& shift) {
  gp_Trsf turn, move;
  turn.SetRotation(gp_Ax1(gp_Pnt(), gp_Dir(0, 0, 1)), degrees / 180 * M_PI);
  move.SetTranslation(shift);
  return TopLoc_Location(move * turn);
}

Eigen::AlignedBox3d box_of_faces(const DesignFile& design, std::size_t first, std::size_t count) {
  Eigen::AlignedBox3d box;
  for (std::size_t k = first; k < first + count; ++k) {
    for (const Eigen::Vector3d& point : design.surfaces[k].control_points) box.extend(point);
  }
  return box;
}

TEST(DesignAssembly, PartsOfNestedAssembliesStandWhereTheyArePlacedAndLookOut) {
  const DesignFile design = read_assembly([](XCAFDoc_ShapeTool& shapes, XCAFDoc_ColorTool&) {
    const TDF_Label part = shapes.AddShape(BRepPrimAPI_MakeBox(10.0, 20.0, 30.0).Shape(), Standard_False);
    const TDF_Label inner = shapes.NewShape(), outer = shapes.NewShape();
    shapes.AddComponent(inner, part, placed_at(90, gp_Vec(100, 0, 0)));
    shapes.AddComponent(outer, inner, placed_at(90, gp_Vec(0, 0, 50)));
    shapes.AddComponent(outer, part, TopLoc_Location());
  });
  ASSERT_EQ(design.surfaces.size(), 12U);
  Eigen::AlignedBox3d placed(Eigen::Vector3d(-10, 80, 50), Eigen::Vector3d(0, 100, 80)),
      plain(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, 20, 30));
  int at_place = 0, at_origin = 0;
  for (std::size_t k = 0; k < 12; ++k) {
    const Eigen::AlignedBox3d face = box_of_faces(design, k, 1);
    const bool moved = placed.isApprox(placed.merged(face), 1e-9);
    const Eigen::AlignedBox3d& body = moved ? placed : plain;
    EXPECT_TRUE(body.isApprox(body.merged(face), 1e-9)) << k;
    (moved ? at_place : at_origin) += 1;
    EXPECT_TRUE(design.faces[k].in_body);
    EXPECT_GT(outward_at(design.surfaces[k], 0.5, 0.5).dot(face.center() - body.center()), 1.0);
  }
  EXPECT_EQ(at_place, 6);
  EXPECT_EQ(at_origin, 6);
}

TEST(DesignAssembly, HiddenPartsOfAnAssemblyAreLeftOutAndTold) {
  const DesignFile design = read_assembly([](XCAFDoc_ShapeTool& shapes, XCAFDoc_ColorTool& colours) {
    const TDF_Label shown = shapes.AddShape(BRepPrimAPI_MakeBox(10.0, 20.0, 30.0).Shape(), Standard_False),
                    hidden = shapes.AddShape(BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape(), Standard_False),
                    whole = shapes.NewShape();
    shapes.AddComponent(whole, shown, TopLoc_Location());
    shapes.AddComponent(whole, hidden, TopLoc_Location());
    colours.SetVisibility(hidden, Standard_False);
  });
  EXPECT_EQ(design.surfaces.size(), 6U);
  EXPECT_GT(box_of_faces(design, 0, 6).diagonal().norm(), 30.0);
  ASSERT_FALSE(design.warnings.empty());
  EXPECT_NE(design.warnings.back().find("6 hidden faces (INVISIBILITY) are left out"), std::string::npos);
}

TEST(DesignAssembly, StyledFacesAndShellsAreHiddenByStep) {
  int number = 100;
  std::string statements = testing::step_surface(kPart, "SHOWN", number);
  const int first_of_hidden = number;
  statements += testing::step_surface(testing::random_surface({}, {}, true, 32), "HIDDEN", number);
  const std::string face = fmt::format("#{}", number - 1);
  ASSERT_GT(number, first_of_hidden);
  const std::string styled = "#60=PRESENTATION_STYLE_ASSIGNMENT((NULL_STYLE(.NULL.)));\n";
  const auto hidden = [&](const std::string& item) {
    return testing::step_file(statements + styled + "#61=STYLED_ITEM('',(#60)," + item +
                              ");\n#62=INVISIBILITY((#61));\n");
  };
  const DesignFile design = read_text_as("a.stp", hidden(face));
  ASSERT_EQ(design.surfaces.size(), 1U);
  EXPECT_EQ(design.faces[0].name, "SHOWN");
  EXPECT_THROW(read_text_as("a.stp", hidden("#27")), std::runtime_error) << "the shell with all faces";
}

}  // namespace
}  // namespace bladefit
