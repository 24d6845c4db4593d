#pragma once

namespace bladefit {

/// The style of what pictures are made of. Each picture has it within itself, since some printers draw it alone.
inline constexpr const char* kPictureStyle =
    "<style>"
    "text { font-family: \"Segoe UI\", \"Helvetica Neue\", Arial, \"Liberation Sans\", sans-serif; fill: #1a1d21; }"
    ".blade { fill: #f3f4f6; stroke: #555; } .edge { fill: #e9e4d0; stroke: #857b50; stroke-dasharray: 5 3; }"
    ".grid { stroke: #b4b9bf; stroke-width: 0.6; fill: none; } .frame { stroke: #555; fill: none; }"
    ".tick { font-size: 11px; } .axis { font-size: 12.5px; font-weight: 600; }"
    ".number { font-size: 11px; font-weight: 600; paint-order: stroke; stroke: #fff; stroke-width: 3px; }"
    ".in { stroke: #6d737a; stroke-width: 0.5; } .out { stroke: #000; stroke-width: 1.4; }"
    ".pending { fill: none; stroke: #555; stroke-dasharray: 2 1.5; } .rejected { stroke: #777; fill: none; }"
    ".undecided { fill: #fff; stroke: #000; stroke-width: 1.2; }"
    ".bar { stroke: #6d737a; stroke-width: 0.6; } .limit { stroke: #000; stroke-dasharray: 5 3; fill: none; }"
    ".curve { fill: none; stroke: #1a1d21; stroke-width: 1.1; stroke-linecap: round; }"
    ".band { fill: none; stroke: #dfe3ea; stroke-linecap: round; stroke-linejoin: round; }"
    ".whisker { stroke: #1a1d21; stroke-width: 0.8; fill: none; }"
    ".proof { fill: none; stroke: #000; stroke-width: 1.6; }"
    "</style>\n";

}  // namespace bladefit
