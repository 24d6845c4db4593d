#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace bladefit {

/// One entity of an IGES file as its directory entry describes it.
struct IgesEntity {
  int type = 0;
  int directory_number = 0;  ///< of its directory entry, counted from 1
  int form = 0;
  int level = 0;                             ///< its layer, or minus the directory number of a list of layers
  int matrix = 0;                            ///< directory number of its transformation matrix (entity 124), or 0
  std::string status = "00000000";           ///< blank, subordinate, use and hierarchy, two digits each
  std::string label;                         ///< without blanks; may be empty
  std::size_t first_line = 0;                ///< line of the file of the first parameter record, counted from 1
  std::vector<std::string_view> parameters;  ///< its parameter records, of which columns 1 to 64 count
};

/// An IGES file taken apart into records; views into its text.
struct IgesText {
  std::vector<std::string_view> global;  ///< records of the global section, 72 columns each
  std::vector<IgesEntity> entities;  ///< in the order of the directory: number k of them has directory number 2 k - 1
};

/// Takes the text of an IGES file apart after checking its frame: records of 80 columns, numbered without gap or not at
/// all, the sections S, G, D, P and T with the counts of the T record, and directory entries that point to existing
/// parameter records. What follows the T record is no part of the file. Throws ToolError naming the line.
IgesText split_iges_text(std::string_view text, const std::string& file);

/// A whole number with blanks around it, as directory fields are. A blank field is 0. Throws ToolError naming the
/// line for anything else.
int iges_integer(std::string_view field, const std::string& file, std::size_t line);

}  // namespace bladefit
