#include "firmware_bridge/host/panel/panel_fields.hpp"

#include <array>

#include "firmware_bridge/host/panel/field_makers.hpp"

namespace bladefit {
namespace {

using namespace panel_rows;
using enum PanelUnit;
using State = PanelState;
using Place = PanelPlace;
using View = BladeView;
using Defect = BladeDefect;

constexpr std::string_view kActions = "0 none, 1 cut, 2 weld";
constexpr std::string_view kSides = "0 not known, 1 suction, 2 pressure, 3 nose of the leading edge";
constexpr std::string_view kInfinite = "panel.infinity where it is not judged: bit 9 of register 282 is set then";

constexpr auto kFields = std::to_array<PanelField>({
    constant<kPanelMapVersion>(0, "map_version", "1"),
    field<&State::session>(1, none, "session_state",
                           "0 idle, 1 connecting, 2 collecting, 3 tracking, 4 settled, 5 fault"),
    field<&State::fit_status>(2, none, "fit_status", "0 underdetermined, 1 tracking, 2 converged, 3 infeasible"),
    field<&State::alarms>(3, none, "alarms",
                          "bit 0 leading edge out, 1 rest out, 2 link lost, 3 data gap, 4 memory full, 5 infeasible"),
    field<&State::points>(4, none, "points", "points taken"),
    field<&State::leading_edge_points>(6, none, "leading_edge_points", "points of the leading edge"),
    field<&State::leading_edge_out>(8, none, "leading_edge_out", "points of the leading edge out of tolerance"),
    field<&State::rest_out>(10, none, "rest_out", "other points out of tolerance"),
    field<&State::rejected>(12, none, "rejected", "points that do not count"),
    field<&State::rms>(14, millimetre, "rms", "root mean square of the distances"),
    field<&State::leading_edge_rms>(16, millimetre, "leading_edge_rms", "the same of the leading edge"),
    field<&State::worst_leading_edge>(18, millimetre, "worst_leading_edge",
                                      "largest distance of the leading edge; positive: cut, negative: weld"),
    field<&State::worst_leading_edge_sequence>(20, none, "worst_leading_edge_point", "number of its point; 0 = none"),
    field<&State::worst_rest>(22, millimetre, "worst_rest", "largest distance of the rest; positive: cut"),
    field<&State::worst_rest_sequence>(24, none, "worst_rest_point", "number of its point; 0 = none"),
    element<&State::pose, 0>(26, millimetre, "tx", "pose: shift along x"),
    element<&State::pose, 1>(28, millimetre, "ty", "pose: shift along y"),
    element<&State::pose, 2>(30, millimetre, "tz", "pose: shift along z"),
    element<&State::pose, 3>(32, radian, "psi", "pose: angle about x"),
    element<&State::pose, 4>(34, radian, "theta", "pose: angle about y"),
    element<&State::pose, 5>(36, radian, "phi", "pose: angle about z"),
    field<&State::last_sequence>(38, none, "last_point", "number of the newest point; 0 = none"),
    field<&State::last_distance>(40, millimetre, "last_distance", "its distance; positive: cut, negative: weld"),
    field<&State::last_state>(42, none, "last_state", "0 pending, 1 in, 2 out, 3 rejected, 4 undecided"),
    field<&State::last_action>(43, none, "last_action", kActions),
    field<&State::last_region>(44, none, "last_region", "0 rest, 1 leading edge"),
    field<&State::leading_edge_tolerance>(45, millimetre, "leading_edge_tolerance", kInfinite),
    field<&State::rest_tolerance>(47, millimetre, "rest_tolerance", kInfinite),
    field<&State::push_latency_us>(49, microsecond, "push_latency", "99 of 100 points were judged within"),
    field<&State::heartbeat>(51, none, "heartbeat", "seconds that the panel runs; stands still where the host hangs"),
    field<&State::smallest_feasible>(52, millimetre, "smallest_feasible",
                                     "smallest feasible tolerance of the leading edge; 0 = not sought"),
    field<&State::determined>(54, none, "determined", "degrees of freedom that the points determine, of 6"),
    places<&Place::sequence>(60, 4, none, "newest_point",
                             "newest points of the leading edge out of tolerance, newest first: number; 0 = none"),
    places<&Place::distance>(62, 4, millimetre, "newest_distance", "distance of that point"),
    places<&Place::patch>(200, 8, none, "newest_patch", "patch of the design that it lies on"),
    places<&Place::u>(201, 8, none, "newest_u", "parameter u there"),
    places<&Place::v>(203, 8, none, "newest_v", "parameter v there"),
    places<&Place::radius>(205, 8, millimetre, "newest_radius", "distance from the shaft axis"),
    places<&Place::action>(207, 8, none, "newest_action", kActions),
    field<&State::improving>(264, none, "improving", "1: the optimum of the mode still improves"),
    list<&State::support, kPanelListed>(
        265, "support_point", "numbers of the points that prove the smallest feasible tolerance; 0 = no more"),
    field<&State::verdict>(281, none, "verdict", "0 not judged, 1 in tolerance, 2 out of tolerance, 3 not decided"),
    field<&State::reasons>(
        282, none, "reasons",
        "bit 0 not converged, 1 underdetermined, 2 unproven, 3 points lost or refused, 4 leading-edge "
        "zone not probed, 5 pending, undecided or unfinished, 6 link lost, 7 wrong units or mirrored, "
        "8 ambiguous or far start, 9 not judged: a tolerance is infinite, 10 a robust fit judges points otherwise"),
    PanelField{283, PanelType::real, none, "test_real", "12345.678; another value: the word order is wrong",
               [](const State&, std::size_t) { return bits_of(kPanelTestReal); }},
    constant<kPanelTestWord>(285, "test_word", "0x12345678 = 305419896; another value: the word order is wrong"),
    field<&State::planned>(287, none, "points_planned", "points that will come; 0 = not known"),
    field<&State::ended>(289, none, "host_state", "0 running, 1 ended: what is shown is the result"),
    text(kTextBase, 1, "verdict_text", "the verdict and its reasons"),
    text(kTextBase + kTextRegisters, 1, "worst_text", "the worst place"),
    text(kTextBase + 2 * kTextRegisters, 1, "advice_text", "what to do"),
    blade_list<&View::edge, View::kCells>(1000, "edge",
                                          "the leading edge in hundredths from root to tip: 0 not probed, 1 in, 2 cut, "
                                          "3 weld, 4 pending, 5 undecided, 6 out beyond the edge of the design"),
    blade<&View::edge_root>(1100, millimetre, "edge_root", "radius where the leading edge begins; 0 = none is set"),
    blade<&View::edge_tip>(1102, millimetre, "edge_tip", "radius where it ends"),
    blade<&View::tip>(1104, millimetre, "tip_radius", "R of r/R"),
    blade<&View::defect_count>(1106, none, "defects", "joined defects in all, of which the worst 16 are listed"),
    field<&State::lost>(1108, none, "points_lost", "records of the device that never came"),
    field<&State::link_down_s>(1110, none, "link_down", "seconds since the link was lost; 0 = it is not"),
    next<&NextPlace::reason>(1112, "next_reason",
                             "why to probe there next: 0 nothing to say, 1 the points leave a direction of the fit "
                             "open, 2 the leading edge has no point there, 3 the side of the blade has none there"),
    next<&NextPlace::side>(1113, "next_side", kSides),
    next<&NextPlace::ratio>(1114, "next_ratio", "r/R of that place"),
    next_axis<0>(1116, "next_x", "machine coordinate of that place"),
    next_axis<1>(1118, "next_y", "machine coordinate of that place"),
    next_axis<2>(1120, "next_z", "machine coordinate of that place"),
    blade_list<&View::suction, View::kBands>(1130, "suction",
                                             "points off the leading edge on the suction side, by tenths of r/R; "
                                             "65535 = no surface there"),
    blade_list<&View::pressure, View::kBands>(1140, "pressure", "the same on the pressure side"),
    field<&State::otherwise_count>(1150, none, "otherwise",
                                   "how many points a robust fit judges otherwise; known when the session has ended"),
    list<&State::otherwise, kPanelListed>(1152, "otherwise_point", "numbers of the first of them; 0 = no more"),
    defects<&Defect::sequence>(1200, none, "defect_point",
                               "neighbouring points out of tolerance, worst first: number of the worst; 0 = none"),
    defects<&Defect::from_ratio>(1202, none, "defect_from", "smallest r/R of its points"),
    defects<&Defect::to_ratio>(1204, none, "defect_to", "largest r/R of its points"),
    defects<&Defect::length>(1206, millimetre, "defect_length", "between its two farthest points"),
    defects<&Defect::distance>(1208, millimetre, "defect_distance", "of the worst point; positive: cut"),
    defects<&Defect::side>(1210, none, "defect_side", kSides),
    defects<&Defect::action>(1211, none, "defect_action", kActions),
    defects<&Defect::region>(1212, none, "defect_region", "0 rest, 1 leading edge"),
    defects<&Defect::points>(1213, none, "defect_points", "how many points"),
    defect_axis<0>(1214, "defect_x", "machine coordinate where the worst point was touched"),
    defect_axis<1>(1216, "defect_y", "machine coordinate where the worst point was touched"),
    defect_axis<2>(1218, "defect_z", "machine coordinate where the worst point was touched"),
    text(1520, 1, "source_text", "where the points come from"),
    text(1560, 2, "link_text", "why the link is lost"),
    text(1640, 2, "loss_text", "which points were lost, and why"),
});

constexpr std::array<PanelBit, 7> kInputs = {
    {{"is_leading_edge_out", "a point of the leading edge is out of tolerance"},
     {"is_any_out", "any point is out of tolerance"},
     {"is_link_lost", "the machine does not answer"},
     {"is_fit_determined", "every free degree of freedom is determined"},
     {"is_in_tolerance", "the verdict is in tolerance"},
     {"is_not_decided", "the verdict is not decided"},
     {"is_ended", "the session is over, what is shown is its result"}}};

constexpr std::array<PanelBit, kPanelCoils> kCoils = {{{"press_start", "take points again"},
                                                       {"press_stop", "take no points"},
                                                       {"press_reset", "forget all points"},
                                                       {"press_acknowledge", "the alarms have been seen"}}};

}  // namespace

std::span<const PanelField> panel_fields() { return kFields; }
std::span<const PanelBit> panel_inputs() { return kInputs; }
std::span<const PanelBit> panel_coils() { return kCoils; }

std::uint16_t register_count(PanelType type) {
  switch (type) {
    case PanelType::word:
      return 1;
    case PanelType::wide:
    case PanelType::real:
      return 2;
    case PanelType::text:
      break;
  }
  return kTextRegisters;
}

}  // namespace bladefit
