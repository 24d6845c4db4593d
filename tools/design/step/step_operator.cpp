#include "tools/design/step/step_operator.hpp"

#include <fmt/format.h>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Direction.hxx>

#include <cmath>
#include <optional>

namespace bladefit {
namespace {

using Eigen::Vector3d;

/// Axes nearer to each other than this are parallel; readings of missing ones that differ by more are in doubt.
constexpr double kParallel = 1e-9;

/// Nothing for a direction that is not given.
std::optional<Vector3d> unit_vector(const Handle(StepGeom_Direction) & given) {
  if (given.IsNull() || given->NbDirectionRatios() != 3) return std::nullopt;
  return Vector3d(given->DirectionRatiosValue(1), given->DirectionRatiosValue(2), given->DirectionRatiosValue(3))
      .normalized();
}

/// `vector` without its part along the unit vectors `a` and `b`, of length 1; of no length where nothing is left.
Vector3d across(const Vector3d& vector, const Vector3d& a, const Vector3d& b) {
  const Vector3d once = vector - vector.dot(a) * a, rest = once - once.dot(b) * b;
  return rest.norm() > kParallel ? Vector3d(rest.normalized()) : Vector3d(Vector3d::Zero());
}

/// The axes as columns by the rules of the standard; a column of no length where they do not tell it.
Eigen::Matrix3d standard_axes(const StepGeom_CartesianTransformationOperator3d& operation) {
  const Vector3d z = unit_vector(operation.Axis3()).value_or(Vector3d::UnitZ());
  const Vector3d otherwise = z == Vector3d::UnitX() ? Vector3d::UnitY() : Vector3d::UnitX();
  const Vector3d x = across(unit_vector(operation.Axis1()).value_or(otherwise), z, z);
  const Vector3d y = across(unit_vector(operation.Axis2()).value_or(Vector3d::UnitY()), z, x);
  Eigen::Matrix3d axes;
  axes << x, y, z;
  return axes;
}

/// Of an operator without its second or third axis writers mean a right-handed one, the standard says fixed ones.
bool is_in_doubt(const StepGeom_CartesianTransformationOperator3d& operation, const Eigen::Matrix3d& axes) {
  const bool all = !operation.Axis1().IsNull() && !operation.Axis2().IsNull() && !operation.Axis3().IsNull();
  return !all && axes.determinant() < 1 - kParallel;
}

/// Where the statement around `place` begins and ends, or nothing where it is no complex instance.
struct Statement {
  std::size_t first, end;
};
std::optional<Statement> complex_statement(std::string_view text, std::size_t place) {
  const std::size_t before = text.rfind(';', place), end = text.find(';', place);
  if (before == std::string_view::npos || end == std::string_view::npos) return std::nullopt;
  const std::size_t equals = text.find('=', before);
  if (equals == std::string_view::npos || equals > place) return std::nullopt;
  const std::size_t open = text.find_first_not_of(" \t\r\n", equals + 1);
  if (text[open] != '(') return std::nullopt;
  return Statement{open, end};
}

/// What stands between the parentheses after `word` in a statement; nothing where the word is not there.
std::optional<std::string> arguments_of(std::string_view statement, std::string_view word) {
  for (std::size_t at = statement.find(word); at != std::string_view::npos; at = statement.find(word, at + 1)) {
    const std::size_t open = statement.find_first_not_of(" \t\r\n", at + word.size());
    if (open == std::string_view::npos || statement[open] != '(') continue;
    const std::size_t close = statement.find(')', open);
    if (close == std::string_view::npos) return std::nullopt;
    return std::string(statement.substr(open + 1, close - open - 1));
  }
  return std::nullopt;
}

}  // namespace

StepOperator step_operator(const StepGeom_CartesianTransformationOperator3d& operation) {
  StepOperator result;
  const double scale = operation.HasScale() ? operation.Scale() : 1;
  const Eigen::Matrix3d axes = standard_axes(operation);
  const Handle(StepGeom_CartesianPoint) origin = operation.LocalOrigin();
  if (!std::isfinite(scale) || scale <= 0) {
    result.fault = fmt::format("its scale is {:g}", scale);
  } else if (std::abs(std::abs(axes.determinant()) - 1) > kParallel) {
    result.fault = "its axes are parallel";
  } else if (is_in_doubt(operation, axes)) {
    result.fault = "it is mirrored only because an axis of it is not given";
  } else if (origin.IsNull() || origin->NbCoordinates() != 3) {
    result.fault = "it has no origin";
  } else {
    result.moves.linear() = scale * axes;
    result.moves.translation() =
        Vector3d(origin->CoordinatesValue(1), origin->CoordinatesValue(2), origin->CoordinatesValue(3));
  }
  return result;
}

std::string with_plain_operators(std::string text) {
  constexpr std::string_view kGeneral = "CARTESIAN_TRANSFORMATION_OPERATOR",
                             kSpatial = "CARTESIAN_TRANSFORMATION_OPERATOR_3D";
  for (std::size_t at = text.find(kSpatial); at != std::string::npos; at = text.find(kSpatial, at + 1)) {
    const std::optional<Statement> found = complex_statement(text, at);
    if (!found) continue;
    const std::string_view statement = std::string_view(text).substr(found->first, found->end - found->first);
    const std::optional<std::string> general = arguments_of(statement, kGeneral),
                                     third = arguments_of(statement, kSpatial);
    if (!general || !third) continue;
    text.replace(found->first, found->end - found->first,
                 fmt::format("{}('','','',{},{})", kSpatial, *general, *third));
    at = found->first;
  }
  return text;
}

}  // namespace bladefit
