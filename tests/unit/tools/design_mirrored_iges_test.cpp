// Closed bodies of IGES that a matrix (124) moves or mirrors, at the body and at what it is made of.
#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeBox.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_TransformationMatrix.hxx>
#include <IGESSolid_SolidInstance.hxx>
#include <Interface_Static.hxx>
#include <TColStd_HArray2OfReal.hxx>

#include <Eigen/Geometry>

#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/choose_sides.hpp"
#include "tools/design/occ/cad_session.hpp"
#include "tools/design/read_design.hpp"

namespace bladefit {
namespace {

using Eigen::Vector3d;

Handle(IGESGeom_TransformationMatrix) matrix_of(const Eigen::Matrix3d& linear, const Vector3d& shift, int form) {
  const Handle(TColStd_HArray2OfReal) values = new TColStd_HArray2OfReal(1, 3, 1, 4);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) values->SetValue(row + 1, column + 1, linear(row, column));
    values->SetValue(row + 1, 4, shift(row));
  }
  const Handle(IGESGeom_TransformationMatrix) matrix = new IGESGeom_TransformationMatrix;
  matrix->Init(values);
  matrix->SetFormNumber(form);
  return matrix;
}

/// (OpenCASCADE writes matrices with nine digits.)
/// A box of 10 x 20 x 30 as a solid (186) whose entities of type `at` have the matrix.
DesignFile body_of_iges(const Handle(IGESGeom_TransformationMatrix) & matrix, int at) {
  const testing::ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "body.igs";
  int placed = 0;
  {
    const QuietMessages quiet;
    IGESControl_Writer writer("MM", 1);
    writer.AddShape(BRepPrimAPI_MakeBox(10.0, 20.0, 30.0).Shape());
    writer.ComputeModel();
    const Handle(IGESData_IGESModel) model = writer.Model();
    for (int k = model->NbEntities(); k >= 1; --k) {
      if (model->Entity(k)->TypeNumber() != at) continue;
      model->Entity(k)->InitTransf(matrix);
      ++placed;
    }
    model->AddEntity(matrix);
    EXPECT_TRUE(writer.Write(path.c_str()));
  }
  EXPECT_GT(placed, 0) << at;
  return read_design(path);
}

Vector3d middle_of(const NurbsSurface& surface) { return testing::evaluate_surface(surface, 0.5, 0.5); }

/// Away from the material, as the file's faces and `outward` tell.
Vector3d outward_normal(const NurbsSurface& surface, int sign) {
  constexpr double kStep = 1e-3;
  const auto at = [&](double du, double dv) { return testing::evaluate_surface(surface, 0.5 + du, 0.5 + dv); };
  const Vector3d cross = (at(kStep, 0) - at(-kStep, 0)).cross(at(0, kStep) - at(0, -kStep)).normalized();
  return surface.reversed != (sign < 0) ? Vector3d(-cross) : cross;
}

TEST(DesignMirroredIges, AClosedBodyStandsWhereItsMatrixPutsItAndLooksOut) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -3).normalized()).toRotationMatrix();
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(2, 2) = -1;
  const Vector3d shift(100, -50, 25);
  for (const auto& [linear, form] :
       {std::pair<Eigen::Matrix3d, int>{turn, 0}, {turn * mirror, 1}, {mirror, 0}, {mirror, 1}}) {
    for (const int at : {186, 514, 510}) {
      DesignFile design = body_of_iges(matrix_of(linear, shift, form), at);
      ASSERT_EQ(design.surfaces.size(), 6U) << at;
      const OutwardSide side = choose_sides(design, {}, "body.igs");
      const Vector3d centre = linear * Vector3d(5, 10, 15) + shift;
      for (std::size_t k = 0; k < 6; ++k) {
        const Vector3d middle = middle_of(design.surfaces[k]),
                       own = linear.transpose() * (middle - shift) - Vector3d(5, 10, 15);
        EXPECT_EQ((own.array().abs() < 1e-6).count(), 2)
            << "matrix at " << at << " form " << form << ": " << own.transpose();
        EXPECT_GT(outward_normal(design.surfaces[k], side.sign).dot((middle - centre).normalized()), 0.99)
            << at << " form " << form;
      }
    }
  }
}

TEST(DesignMirroredIges, AnInstanceOfASolidIsNamedAsUnread) {
  const testing::ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "instance.igs";
  {
    const QuietMessages quiet;
    IGESControl_Writer writer("MM", 1);
    writer.AddShape(BRepPrimAPI_MakeBox(10.0, 20.0, 30.0).Shape());
    writer.ComputeModel();
    const Handle(IGESSolid_SolidInstance) instance = new IGESSolid_SolidInstance;
    instance->Init(writer.Model()->Entity(1));
    ASSERT_EQ(writer.Model()->Entity(1)->TypeNumber(), 186);
    writer.Model()->AddEntity(instance);
    ASSERT_TRUE(writer.Write(path.c_str()));
  }
  const DesignFile design = read_design(path);
  EXPECT_TRUE(design.surfaces.empty());
  ASSERT_EQ(design.missing.size(), 2U);
  EXPECT_NE(design.missing[1].find("entity 430 at D"), std::string::npos) << design.missing[1];
}

}  // namespace
}  // namespace bladefit
