#pragma once
#include <string>
#include <vector>

namespace bladefit {

/// How a column's numbers are written.
enum class Figure {
  length,    ///< five decimals, as the thesis writes distances
  bound,     ///< the digits that are there, at most six
  motion,    ///< four decimals, as the thesis writes translations and rotations
  percent,   ///< with sign, one decimal
  time,      ///< seconds; written in min and sec as the thesis does, or in ms
  residual,  ///< two digits with exponent
  count,
};

struct TableColumn {
  std::string key;         ///< in JSON
  std::string over, head;  ///< the two lines above the column
  Figure figure = Figure::length;
};

struct TableRow {
  std::string label;           ///< first column; the same in the rows that belong together
  std::string source;          ///< thesis, or which of our fits
  std::string data, subset;    ///< folder and subset of the stand-in data; empty where there is none
  std::vector<double> values;  ///< one a column; kUnreadable and kNotGiven stand for figures that are not there
};

/// A table as it is printed and written to JSON.
struct ReportTable {
  std::string label;  ///< "Table I", or empty
  std::string title;
  int number = 0;          ///< of the thesis; 0 = none of its tables
  std::string over, head;  ///< above the labels
  std::vector<TableColumn> columns;
  std::vector<TableRow> rows;
  std::vector<std::string> notes;
};

/// Source of the rows that repeat the thesis.
inline constexpr const char* kThesisSource = "thesis";

}  // namespace bladefit
