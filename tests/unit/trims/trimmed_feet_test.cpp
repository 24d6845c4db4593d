// Feet on trimmed faces beside OpenCASCADE's extrema and classifiers. The points lie 1e-3 of the size off the faces:
// over them, over what their surfaces are beyond their bounds, and about their edges.
#include <gtest/gtest.h>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <cstdlib>
#include <random>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/touching_balls.hpp"
#include "tests/unit/trims/trimmed_shapes.hpp"
#include "tools/design/image/reach.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/occ/cad_session.hpp"

namespace bladefit {
namespace {

/// The shape whose face has poles.
constexpr std::size_t kWithPoles = 6;
/// Points of this share of the size off the faces.
constexpr double kOff = 1e-3;
/// Loops, and the curves of edges beside those of faces, are within this share of the size.
constexpr double kTolerance = 5e-6;

std::size_t points_asked() {
  const char* const text = std::getenv("BLADEFIT_TRIM_POINTS");
  return text == nullptr ? 3000 : static_cast<std::size_t>(std::strtoul(text, nullptr, 10));
}

Vec3 vec_of(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

/// Its faces alone: of a body, what is inside would be at distance 0.
TopoDS_Shape faces_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (int k = 1; k <= faces.Extent(); ++k) builder.Add(all, faces(k));
  return all;
}

/// A shape written to STEP, read again by OpenCASCADE as the reference and compiled.
class TrimmedCase {
 public:
  explicit TrimmedCase(const testing::TrimmedShape& made) {
    const std::filesystem::path path = folder_.path() / "shape.stp";
    {
      const QuietMessages quiet;
      STEPControl_Writer writer;
      EXPECT_EQ(writer.Transfer(made.shape, STEPControl_AsIs), IFSelect_RetDone);
      EXPECT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
      STEPControl_Reader reader;
      EXPECT_EQ(reader.ReadFile(path.c_str()), IFSelect_RetDone);
      reader.TransferRoots();
      shape_ = faces_of(reader.OneShape());
    }
    const OutwardChoice outward(made.closed ? OutwardOption::automatic : OutwardOption::plus);
    loaded_ = load_design(path, DesignChoice(outward, {"*"}));
    EXPECT_EQ(loaded_.warning, "");
    for (const std::string& note : loaded_.notes) std::printf("  %s\n", note.c_str());
    EXPECT_EQ(DesignImage::open(loaded_.image, design_), Status::ok);
    std::printf("  %zu bytes, %zu patches, %zu leaves, %zu trims\n", loaded_.image.size(), design_.patches().size(),
                design_.leaves().size(), design_.trims().size());
    TopExp::MapShapes(shape_, TopAbs_FACE, faces_);
    TopExp::MapShapesAndAncestors(shape_, TopAbs_EDGE, TopAbs_FACE, edges_);
    for (int k = 1; k <= edges_.Extent(); ++k) {
      edge_tolerance_ = std::max(edge_tolerance_, BRep_Tool::Tolerance(TopoDS::Edge(edges_.FindKey(k))));
    }
    std::printf("  edges within %.2g mm\n", edge_tolerance_);
    Bnd_Box box;
    BRepBndLib::Add(shape_, box, Standard_False);
    size_ = std::sqrt(box.SquareExtent());
  }

  [[nodiscard]] const DesignImage& design() const { return design_; }
  [[nodiscard]] const std::vector<std::byte>& image() const { return loaded_.image; }
  [[nodiscard]] const TopoDS_Shape& shape() const { return shape_; }
  [[nodiscard]] double size() const { return size_; }

  /// Over a face or its surface beside it, or about an edge.
  Vec3 random_point(std::mt19937& random) const {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double side = unit(random) < 0.5 ? -1.0 : 1.0;
    if (unit(random) < 0.5) {
      const BRepAdaptor_Curve curve(TopoDS::Edge(edges_.FindKey(1 + pick(edges_.Extent(), random))));
      if (!BRep_Tool::Degenerated(curve.Edge())) {
        const double t = curve.FirstParameter() + unit(random) * (curve.LastParameter() - curve.FirstParameter());
        std::normal_distribution<double> normal;
        return vec_of(curve.Value(t)) +
               kOff * size_ * Vec3(normal(random), normal(random), normal(random)).normalized();
      }
    }
    const TopoDS_Face& face = TopoDS::Face(faces_(1 + pick(faces_.Extent(), random)));
    double u_min = 0, u_max = 0, v_min = 0, v_max = 0;
    BRepTools::UVBounds(face, u_min, u_max, v_min, v_max);
    gp_Pnt point;
    gp_Vec along_u, along_v;
    BRepAdaptor_Surface(face).D1(u_min + unit(random) * (u_max - u_min), v_min + unit(random) * (v_max - v_min), point,
                                 along_u, along_v);
    const gp_Vec across = along_u.Crossed(along_v);
    const double length = across.Magnitude();
    return vec_of(point) + (length > 0 ? side * kOff * size_ / length : 0.0) * Vec3(across.X(), across.Y(), across.Z());
  }

  /// Faces that an edge belongs to.
  [[nodiscard]] int faces_at(const TopoDS_Shape& edge) const {
    const int index = edges_.FindIndex(edge);
    return index == 0 ? 0 : edges_(index).Extent();
  }

 private:
  static int pick(int count, std::mt19937& random) { return std::uniform_int_distribution<int>(0, count - 1)(random); }

  testing::ScratchFolder folder_;
  TopoDS_Shape shape_;
  LoadedDesign loaded_;
  DesignImage design_;
  TopTools_IndexedMapOfShape faces_;
  TopTools_IndexedDataMapOfShapeListOfShape edges_;
  double size_ = 0, edge_tolerance_ = 0;
};

struct Tally {
  std::size_t points = 0, wrong = 0, unproven = 0, kinds = 0, missed_by_reference = 0, on_edges = 0;
};

double distance_to(const TopoDS_Shape& shape, const Vec3& point) {
  BRepExtrema_DistShapeShape extrema(BRepBuilderAPI_MakeVertex(gp_Pnt(point.x(), point.y(), point.z())).Vertex(),
                                     shape);
  return extrema.Value();
}

void check_kind(const TrimmedCase& given, const BRepExtrema_DistShapeShape& reference, const Foot& foot, Tally& tally) {
  if (reference.NbSolution() != 1) return;
  const BRepExtrema_SupportType support = reference.SupportTypeShape2(1);
  const TopoDS_Shape on = reference.SupportOnShape2(1);
  const double near = 10 * kTolerance * given.size();
  bool good = true;
  if (support == BRepExtrema_IsOnEdge && given.faces_at(on) == 1 && !BRep_Tool::IsClosed(TopoDS::Edge(on))) {
    ++tally.on_edges;
    // A foot right at the edge counts as on either.
    good = foot.kind != FootKind::interior || foot.beyond < near;
    good = good && (foot.kind == FootKind::interior || foot.border != FootBorder::none);
  } else if (support == BRepExtrema_IsInFace) {
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(on, TopAbs_EDGE, edges);
    double to_edge = given.size();
    for (int k = 1; k <= edges.Extent(); ++k) {
      if (!BRep_Tool::Degenerated(TopoDS::Edge(edges(k))))
        to_edge = std::min(to_edge, distance_to(edges(k), foot.point));
    }
    good = foot.kind == FootKind::interior || to_edge < near;
  }
  if (good) return;
  ++tally.kinds;
  ADD_FAILURE() << "kind " << static_cast<int>(foot.kind) << " at " << foot.point.transpose() << ", patch "
                << foot.patch << " u " << foot.u << " v " << foot.v << ", support " << support;
}

void check_point(const TrimmedCase& given, const Surface& surface, const Vec3& r, Tally& tally) {
  ++tally.points;
  const GlobalProjection found = project_global(surface, {r}, nullptr);
  const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(r.x(), r.y(), r.z()));
  const BRepExtrema_DistShapeShape reference(vertex, given.shape());
  if (!found.proven) {
    ++tally.unproven;
    return;
  }
  const double tolerance = kTolerance * given.size(), distance = found.nearest.offset.norm();
  const double beyond = distance - reference.Value();
  if (std::abs(beyond) <= tolerance) {
    check_kind(given, reference, foot_of(surface, found.nearest, 0.0), tally);
    return;
  }
  // Nearer than the reference: that has missed it, where the foot is on the shape.
  if (beyond < 0.0 && distance_to(given.shape(), found.nearest.at.s) <= tolerance) {
    ++tally.missed_by_reference;
    return;
  }
  ++tally.wrong;
  const Foot foot = foot_of(surface, found.nearest, 0.0);
  ADD_FAILURE() << "point " << r.transpose() << ": " << distance << ", not " << reference.Value() << "; patch "
                << foot.patch << " u " << foot.u << " v " << foot.v;
}

class TrimmedFeet : public ::testing::TestWithParam<std::size_t> {};

TEST_P(TrimmedFeet, AreThoseThatOpenCascadeFinds) {
  const std::size_t count = points_asked() / testing::kTrimmedShapes;
  const testing::TrimmedShape made = testing::trimmed_shape(GetParam());
  std::printf("%s\n", made.name.c_str());
  const TrimmedCase given(made);
  const Surface surface(given.design());
  std::mt19937 random(17);
  Tally tally;
  for (std::size_t k = 0; k < count && tally.wrong + tally.kinds < 5; ++k) {
    check_point(given, surface, given.random_point(random), tally);
  }
  std::printf(
      "  %zu points, %zu wrong, %zu kinds wrong, %zu unproven, %zu on free edges, %zu missed by the reference\n",
      tally.points, tally.wrong, tally.kinds, tally.unproven, tally.on_edges, tally.missed_by_reference);
  EXPECT_LE(tally.unproven * 200, tally.points);
}

/// What lies beyond a loop is no rival, and nothing of a face hides behind one.
TEST_P(TrimmedFeet, BallsWithinTheirReachHoldNoOtherPoint) {
  const TrimmedCase given(testing::trimmed_shape(GetParam()));
  std::vector<std::byte> image = given.image();
  mark_reach(image);
  DesignImage design;
  ASSERT_EQ(DesignImage::open(image, design), Status::ok);
  const testing::TouchingBalls balls = testing::touching_balls(Surface(design), testing::balls_asked(1000), 17);
  std::printf("  %zu of %zu balls\n", balls.tested, balls.tried);
  EXPECT_EQ(balls.held, 0U) << balls.first;
  EXPECT_EQ(balls.rivals, 0U) << balls.first;
  if (GetParam() != kWithPoles) {  // of a face with poles little is known
    EXPECT_GT(balls.tested, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, TrimmedFeet, ::testing::Range<std::size_t>(0, testing::kTrimmedShapes));

}  // namespace
}  // namespace bladefit
