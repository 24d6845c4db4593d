#pragma once
#include <TopoDS_Face.hxx>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace bladefit {

/// A face that OpenCASCADE made of a file, where it stands.
struct CadFace {
  TopoDS_Face face;
  /// From there to where it stands: of a mirrored or scaled one, which OpenCASCADE's places cannot be; of others
  /// nothing.
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  std::string entity;    ///< for messages: "face #17", "entity 144 at D5"
  std::string name;      ///< as the file has it; may be empty
  std::string layer;     ///< name or number of its layer; empty = none
  int order = 0;         ///< of its entity in the file
  bool told = false;     ///< the file says which side it looks to: it belongs to a shell
  bool in_body = false;  ///< of a closed shell
};

/// The faces of a file, hidden ones left out.
struct CadFaces {
  std::vector<CadFace> faces;       ///< in the order of the file
  std::vector<std::string> unread;  ///< entities of faces that OpenCASCADE could not make, and why
  std::vector<std::string> notes;   ///< what was left out on purpose; one line each
};

}  // namespace bladefit
