#include "tools/design/occ/design_faces.hpp"

#include <fmt/format.h>
#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>
#include <Standard_Failure.hxx>

#include <Eigen/Geometry>
#include <exception>

#include "tools/design/occ/face_surface.hpp"

namespace bladefit {
namespace {

/// Offsets and high degrees are approximated within this part of the size of the design.
constexpr double kTolerance = 1e-6;

double size_of(const CadFaces& read) {
  Eigen::AlignedBox3d whole;
  for (const CadFace& face : read.faces) {
    Bnd_Box box;
    BRepBndLib::Add(face.face, box, Standard_False);
    if (box.IsVoid()) continue;
    const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
    const Eigen::AlignedBox3d own(Eigen::Vector3d(low.X(), low.Y(), low.Z()),
                                  Eigen::Vector3d(high.X(), high.Y(), high.Z()));
    whole.extend(own.transformed(face.place));
  }
  return whole.isEmpty() ? 0.0 : whole.diagonal().norm();
}

std::string title_of(const CadFace& face) {
  return face.name.empty() ? face.entity : fmt::format("{} ({})", face.entity, face.name);
}

void append_surface(const CadFace& face, double tolerance_mm, DesignFile& design) {
  FaceSurface found = face_surface(face, tolerance_mm);
  found.surface.name = title_of(face);
  if (found.approximated > 0) {
    design.warnings.push_back(fmt::format("{}: {} of degree over {} or offset, approximated within {:.2g} mm",
                                          found.surface.name, found.kind, kMaxDegree, found.approximated));
  }
  design.faces.push_back({face.entity, face.name, face.layer, found.kind, found.area, found.share, found.trims_off,
                          found.trims_fault, face.told, face.in_body});
  design.surfaces.push_back(std::move(found.surface));
}

}  // namespace

void append_surfaces(const CadFaces& read, DesignFile& design) {
  const double tolerance_mm = kTolerance * size_of(read);
  for (const CadFace& face : read.faces) {
    try {
      append_surface(face, tolerance_mm, design);
    } catch (const Standard_Failure& failure) {
      design.missing.push_back(fmt::format("{} ({}): {}", title_of(face), kind_of(face), failure.GetMessageString()));
    } catch (const std::exception& failure) {
      design.missing.push_back(fmt::format("{} ({}): {}", title_of(face), kind_of(face), failure.what()));
    }
  }
  design.missing.insert(design.missing.end(), read.unread.begin(), read.unread.end());
  design.warnings.insert(design.warnings.end(), read.notes.begin(), read.notes.end());
}

}  // namespace bladefit
