#pragma once
#include <limits>
#include <span>

namespace bladefit {

/// A figure that the scan of the thesis does not show, or not in a place that is certain.
inline constexpr double kUnreadable = std::numeric_limits<double>::quiet_NaN();
/// A figure that the thesis does not give.
inline constexpr double kNotGiven = std::numeric_limits<double>::infinity();

/// A motion as the thesis prints it: r = C R + t [in, rad].
struct PrintedMotion {
  double tx = 0, ty = 0, tz = 0, phi = 0, theta = 0, psi = 0;
};

/// A row of the tables of unconstrained localization. Lengths in inches.
struct UnconstrainedFigures {
  const char* subset;  ///< of the stand-in data that is put beside it
  int points;
  double rms_before, rms_after, change_percent, cpu_s;
  PrintedMotion motion;
};

/// Figures of one region of the blade.
struct RegionFigures {
  double constraint, rms_before, rms_after, change_percent;
};

/// A row of the tables of constrained localization. Lengths in inches.
struct ConstrainedFigures {
  const char* subset;
  int points;
  RegionFigures leading_edge, rest;
  double cpu_s;
  PrintedMotion motion;
  double max_leading_edge, max_rest;
  double global_before, global_after, global_change_percent;
};

/// What the text says of the means over a table's rows [per cent].
struct MeanChanges {
  double unconstrained, leading_edge, rest, global;
};

/// The tables of one blade, or of one blade in three patches; a number of 0: there is no such table.
struct ThesisStudy {
  const char* data;       ///< folder of the stand-in data
  const char* propeller;  ///< as the titles name it
  bool three_patches;
  int rms_table, motion_table;
  int leading_edge_table, rest_table, constrained_motion_table, global_table;
  std::span<const UnconstrainedFigures> unconstrained;
  std::span<const ConstrainedFigures> constrained;
  MeanChanges mean;
  const char *rms_note, *motion_note, *constrained_motion_note;  ///< of single figures of these tables; may be null
};

/// Tables I to XVI of R. A. Jinkerson, Constrained and Unconstrained Localization for Automated Inspection of Marine
/// Propellers, MIT 1991, chapter 5, figure by figure as its scan shows them.
[[nodiscard]] std::span<const ThesisStudy> thesis_studies();

}  // namespace bladefit
