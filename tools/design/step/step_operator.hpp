#pragma once
#include <StepGeom_CartesianTransformationOperator3d.hxx>

#include <Eigen/Geometry>
#include <string>
#include <string_view>

namespace bladefit {

/// What a CARTESIAN_TRANSFORMATION_OPERATOR_3D does with a point, in the file's unit of length (ISO 10303-42,
/// base_axis): turned, mirrored where its axes are left-handed, made larger by its scale, then shifted by its local
/// origin.
struct StepOperator {
  Eigen::Affine3d moves = Eigen::Affine3d::Identity();
  std::string fault;  ///< why it cannot be told; empty = it can
};

[[nodiscard]] StepOperator step_operator(const StepGeom_CartesianTransformationOperator3d& operation);

/// The text with every operator that is written as a complex instance, as the standard asks where it is also a
/// FUNCTIONALLY_DEFINED_TRANSFORMATION, in the plain form, the only one that OpenCASCADE knows. Costs one search where
/// there is none.
[[nodiscard]] std::string with_plain_operators(std::string text);

}  // namespace bladefit
