#include "tools/reproduce/thesis_figures.hpp"

#include <array>

namespace bladefit {
namespace {

constexpr double lost = kUnreadable, none = kNotGiven;

/// "m min s sec" as the tables give it [s].
constexpr double cpu(int minutes, int seconds) { return 60.0 * minutes + seconds; }

// Tables I and II. Of 1261 points the text (5.3.1) gives the change and the time alone.
constexpr std::array kArl{
    UnconstrainedFigures{
        "021", 21, 0.02371, 0.01866, -21.3, cpu(0, 40), {0.1796, -0.0215, -0.2896, 0.0005, -0.0058, -0.0005}},
    UnconstrainedFigures{
        "041", 41, 0.03196, 0.02593, -18.9, cpu(1, 25), {0.0887, -0.0627, -0.1069, 0.0041, 0.0005, -0.0023}},
    UnconstrainedFigures{
        "061", 61, 0.03016, 0.02435, -19.3, cpu(1, 56), {0.1018, -0.0529, 0.0538, 0.0025, -0.0073, -0.0023}},
    UnconstrainedFigures{
        "085", 85, 0.03130, 0.02485, -20.6, cpu(2, 45), {0.1094, -0.0645, 0.0914, 0.0034, -0.0077, -0.0028}},
    UnconstrainedFigures{
        "106", 106, 0.03010, 0.02447, -18.7, cpu(4, 9), {0.0827, -0.0501, 0.0135, 0.0025, -0.0047, -0.0020}},
    UnconstrainedFigures{"full", 1261, none, none, -19.6, cpu(67, 0), {none, none, none, none, none, none}}};

// Tables III to VI.
constexpr std::array kArlConstrained{ConstrainedFigures{"021",
                                                        21,
                                                        {0.012, 0.01408, 0.01014, -28.0},
                                                        {0.12, 0.02201, 0.04251, 134.0},
                                                        cpu(0, 7),
                                                        {0.1712, -0.0866, 0.5881, 0.0043, -0.0045, -0.0043},
                                                        0.01200,
                                                        0.11609,
                                                        0.01866,
                                                        0.03155,
                                                        69.1},
                                     ConstrainedFigures{"041",
                                                        41,
                                                        {0.012, 0.02038, 0.00888, -56.4},
                                                        {0.12, 0.02749, 0.04241, 54.3},
                                                        cpu(0, 13),
                                                        {0.0821, -0.0324, -0.0966, 0.0004, -0.0096, -0.0011},
                                                        0.01200,
                                                        0.12000,
                                                        0.02593,
                                                        0.03825,
                                                        47.4},
                                     ConstrainedFigures{"061",
                                                        61,
                                                        {0.017, 0.01552, 0.01290, -19.8},
                                                        {0.17, 0.02642, 0.04877, 185.6},
                                                        cpu(0, 36),
                                                        {-0.0018, 0.0077, 0.1717, -0.0038, -0.0054, -0.0008},
                                                        0.01700,
                                                        0.11643,
                                                        0.02435,
                                                        0.04325,
                                                        72.7},
                                     ConstrainedFigures{"085",
                                                        85,
                                                        {0.017, 0.01542, 0.01168, -24.2},
                                                        {0.17, 0.02697, 0.03902, 44.7},
                                                        cpu(0, 27),
                                                        {-0.1185, -0.0887, 0.6217, 0.0040, -0.0084, -0.0051},
                                                        0.01700,
                                                        0.11593,
                                                        0.02485,
                                                        0.03483,
                                                        38.4},
                                     ConstrainedFigures{"106",
                                                        106,
                                                        {0.017, 0.01529, 0.01046, -50.0},
                                                        {0.17, 0.02657, 0.03935, 35.0},
                                                        cpu(1, 8),
                                                        {-0.1788, -0.0629, 0.6799, 0.0034, -0.0062, -0.0036},
                                                        0.01700,
                                                        0.12961,
                                                        0.02447,
                                                        0.03535,
                                                        41.9}};

// Tables VII and VIII.
constexpr std::array kPnsy{
    UnconstrainedFigures{
        "021", 21, 0.15599, 0.11430, -26.7, cpu(1, 14), {0.1278, -0.0622, -0.1460, -0.0025, -0.0011, -0.0006}},
    UnconstrainedFigures{
        "041", 41, 0.15798, 0.09763, -38.2, cpu(2, 51), {0.3079, -0.2866, -0.2232, 0.0043, 0.0029, 0.0017}},
    UnconstrainedFigures{
        "061", 61, 0.16103, 0.11528, -28.4, cpu(2, 20), {-0.0682, -0.4959, -0.0666, -0.0078, 0.0028, -0.0011}},
    UnconstrainedFigures{
        "081", 81, 0.16291, 0.10698, -34.3, cpu(2, 44), {0.1580, -0.5114, -0.1442, -0.0022, 0.0035, 0.0009}},
    UnconstrainedFigures{
        "101", 101, 0.14236, 0.10966, -23.0, cpu(3, 20), {-0.0097, -0.4866, -0.0736, -0.0061, 0.0030, -0.0006}}};

// Tables IX to XII. In the scan of table XI the columns tz, phi and theta are torn: seven of their figures stand below
// the table in no certain order, and of two rows one angle is left that may be phi or theta.
constexpr std::array kPnsyConstrained{ConstrainedFigures{"021",
                                                         21,
                                                         {0.11, 0.13280, 0.09419, -29.1},
                                                         {1.1, 0.10382, 0.25875, 149.2},
                                                         cpu(0, 12),
                                                         {0.1401, -0.0495, lost, lost, lost, -0.0006},
                                                         0.11000,
                                                         0.48742,
                                                         0.11430,
                                                         0.21816,
                                                         90.8},
                                      ConstrainedFigures{"041",
                                                         41,
                                                         {0.12, 0.11777, 0.09560, -18.8},
                                                         {1.2, 0.08793, 0.21682, 124.1},
                                                         cpu(0, 50),
                                                         {0.3222, -0.2930, -0.2317, lost, lost, 0.0021},
                                                         0.12000,
                                                         0.48649,
                                                         0.09762,
                                                         0.18954,
                                                         94.2},
                                      ConstrainedFigures{"061",
                                                         61,
                                                         {0.12, 0.10991, 0.07713, -29.8},
                                                         {1.2, 0.11728, 0.31872, 171.8},
                                                         cpu(0, 22),
                                                         {-0.3292, 0.2712, lost, -0.0160, -0.0196, -0.0065},
                                                         0.11119,
                                                         0.67443,
                                                         0.11528,
                                                         0.27373,
                                                         137.4},
                                      ConstrainedFigures{"081",
                                                         81,
                                                         {0.15, 0.12298, 0.10382, -15.6},
                                                         {1.5, 0.09993, 0.20267, 102.8},
                                                         cpu(0, 18),
                                                         {0.1762, -0.4528, -0.2197, lost, lost, 0.0021},
                                                         0.14612,
                                                         0.45780,
                                                         0.10698,
                                                         0.18020,
                                                         68.4},
                                      ConstrainedFigures{"101",
                                                         101,
                                                         {0.13, 0.11247, 0.09010, -19.9},
                                                         {1.3, 0.10862, 0.27141, 149.9},
                                                         cpu(1, 22),
                                                         {-0.1731, 0.2832, lost, -0.0122, -0.0160, -0.0032},
                                                         0.12856,
                                                         0.60269,
                                                         0.10966,
                                                         0.23703,
                                                         116.1}};

// Tables XIII and XIV.
constexpr std::array kArlPatches{
    UnconstrainedFigures{
        "020", 20, 0.03406, 0.02574, -24.4, cpu(0, 37), {0.2275, -0.0673, -0.2386, 0.0011, -0.0080, -0.0032}},
    UnconstrainedFigures{
        "041", 41, 0.03399, 0.02416, -28.9, cpu(1, 34), {0.2090, -0.0801, -0.1102, 0.0031, -0.0078, -0.0035}},
    UnconstrainedFigures{
        "061", 61, 0.03269, 0.02517, -23.0, cpu(2, 3), {0.1018, -0.0587, 0.1361, 0.0035, -0.0005, -0.0022}},
    UnconstrainedFigures{
        "082", 82, 0.03346, 0.02524, -24.6, cpu(2, 31), {0.1440, -0.0616, -0.0585, 0.0029, -0.0063, -0.0026}},
    UnconstrainedFigures{
        "102", 102, 0.03317, 0.02576, -22.3, cpu(3, 31), {0.1279, -0.0638, -0.0722, 0.0031, -0.0043, -0.0026}}};

// Tables XV and XVI. The first row has 21 points in one and 20 in the other. The scan gives the last three rows of XVI
// column by column.
constexpr std::array kPnsyPatches{
    UnconstrainedFigures{
        "020", 21, 0.19794, 0.13681, -30.9, cpu(0, 37), {-0.3495, -0.3568, -0.0381, -0.0149, -0.0003, -0.0029}},
    UnconstrainedFigures{
        "041", 41, 0.17408, 0.10136, -41.8, cpu(3, 10), {0.2840, -0.4473, -0.1510, 0.0010, -0.0024, -0.0011}},
    UnconstrainedFigures{
        "061", 61, 0.16325, 0.11439, -29.9, cpu(1, 57), {0.1354, -0.6949, -0.1327, -0.0024, 0.0035, 0.0000}},
    UnconstrainedFigures{
        "082", 82, 0.15866, 0.09463, -40.4, cpu(2, 54), {0.3346, -0.9238, -0.1712, 0.0030, 0.0011, 0.0063}},
    UnconstrainedFigures{
        "102", 102, 0.15417, 0.11440, -25.8, cpu(3, 33), {0.1685, -0.2034, -0.1401, -0.0012, 0.0033, 0.0000}}};

constexpr const char* kTextNote = "1261 points: change and time stand in the text of the thesis (5.3.1).";
constexpr const char* kTornNote =
    "In the scan the columns tz, phi and theta of the thesis are torn: figures whose place is not certain are left "
    "out.";
constexpr const char* kCountNote =
    "The thesis' first set has 21 points in Table XV and 20 in Table XVI; beside it stands our set of 20.";

constexpr std::array kStudies{ThesisStudy{"arl_fan",
                                          "ARL",
                                          false,
                                          1,
                                          2,
                                          3,
                                          4,
                                          5,
                                          6,
                                          kArl,
                                          kArlConstrained,
                                          {-19.8, -35.7, 90.7, 53.9},
                                          kTextNote,
                                          nullptr,
                                          nullptr},
                              ThesisStudy{"pnsy_sub",
                                          "PNSY",
                                          false,
                                          7,
                                          8,
                                          9,
                                          10,
                                          11,
                                          12,
                                          kPnsy,
                                          kPnsyConstrained,
                                          {-30.1, -21.2, 139.6, 101.4},
                                          nullptr,
                                          nullptr,
                                          kTornNote},
                              ThesisStudy{"arl_3patch",
                                          "ARL",
                                          true,
                                          13,
                                          14,
                                          0,
                                          0,
                                          0,
                                          0,
                                          kArlPatches,
                                          {},
                                          {-24.6, none, none, none},
                                          nullptr,
                                          nullptr,
                                          nullptr},
                              ThesisStudy{"pnsy_3patch",
                                          "PNSY",
                                          true,
                                          15,
                                          16,
                                          0,
                                          0,
                                          0,
                                          0,
                                          kPnsyPatches,
                                          {},
                                          {-33.8, none, none, none},
                                          kCountNote,
                                          kCountNote,
                                          nullptr}};

}  // namespace

std::span<const ThesisStudy> thesis_studies() { return kStudies; }

}  // namespace bladefit
