#include "tools/design/occ/face_trim.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>

#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// What is nearer to a natural bound than this share of the range lies on it: boundary curves are approximations.
constexpr double kOnBound = 1e-4;
constexpr int kSamples = 16;  ///< of each boundary curve
constexpr int kBoundedTypes[] = {143, 144, 510};

bool inside(double value, double low, double high) {
  const double margin = kOnBound * (high - low);
  return value > low + margin && value < high - margin;
}

/// The B-spline or Bezier surface under a face; null where the face lies on another one.
Handle(Geom_Surface) free_form_surface(const TopoDS_Face& face) {
  TopLoc_Location place;
  Handle(Geom_Surface) surface = BRep_Tool::Surface(face, place);
  if (const auto part = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !part.IsNull()) {
    surface = part->BasisSurface();
  }
  const bool free_form = !surface.IsNull() && (surface->IsKind(STANDARD_TYPE(Geom_BSplineSurface)) ||
                                               surface->IsKind(STANDARD_TYPE(Geom_BezierSurface)));
  return free_form ? surface : Handle(Geom_Surface){};
}

bool is_trimmed_face(const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = free_form_surface(face);
  if (surface.IsNull()) return false;
  double u_low = 0, u_high = 0, v_low = 0, v_high = 0;
  surface->Bounds(u_low, u_high, v_low, v_high);
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edges.Current()), face, first, last);
    for (int k = 0; !curve.IsNull() && k <= kSamples; ++k) {
      const gp_Pnt2d place = curve->Value(first + (last - first) * k / kSamples);
      if (inside(place.X(), u_low, u_high) && inside(place.Y(), v_low, v_high)) return true;
    }
  }
  return false;
}

}  // namespace

bool is_trimmed(const TopoDS_Shape& shape) {
  if (shape.IsNull()) return true;
  TopExp_Explorer faces(shape, TopAbs_FACE);
  if (!faces.More()) return true;
  for (; faces.More(); faces.Next()) {
    if (is_trimmed_face(TopoDS::Face(faces.Current()))) return true;
  }
  return false;
}

std::vector<std::string> trimmed_iges_faces(const std::filesystem::path& path) {
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) {
    throw ToolError(fmt::format("{}: its trimmed surfaces cannot be read; export the design again", path.string()));
  }
  const Handle(IGESData_IGESModel) model = reader.IGESModel();
  std::vector<std::string> names;
  for (int k = 1; k <= model->NbEntities(); ++k) {
    const Handle(IGESData_IGESEntity) entity = model->Entity(k);
    if (std::ranges::find(kBoundedTypes, entity->TypeNumber()) == std::end(kBoundedTypes)) continue;
    reader.ClearShapes();
    reader.TransferEntity(entity);
    if (is_trimmed(reader.OneShape())) {
      names.push_back(fmt::format("entity {} at D{}", entity->TypeNumber(), model->DNum(entity)));
    }
  }
  return names;
}

std::string trim_warning(const std::string& file, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  return fmt::format("{}: trimmed faces are used whole, points beyond their trim are judged as well: {}", file,
                     fmt::join(names, ", "));
}

}  // namespace bladefit
