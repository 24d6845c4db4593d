#pragma once
#include <fmt/format.h>

#include <filesystem>

#include "tests/golden/command_fixture.hpp"
#include "tests/support/json_file.hpp"
#include "tests/support/reference_case.hpp"

namespace bladefit::testing {

/// `number` box limits as the command line takes them; only the direction that does not span the patch is named.
inline std::string leading_edge_option(const ReferenceCase::Box& box) {
  const bool along_u = box.v[0] == 0.0 && box.v[1] == 1.0;
  const double* limits = along_u ? box.u : box.v;
  return fmt::format("{}:{}:{}:{}", box.patch, along_u ? 'u' : 'v', limits[0], limits[1]);
}

class GoldenCase : public CommandTest {
 protected:
  /// The options that case.json asks for, lengths in `unit`.
  static std::vector<std::string> fit_options(const ReferenceCase& c, const std::string& unit) {
    const double length = unit == c.unit ? 1.0 : c.mm_per_unit == 1.0 ? 1.0 / 25.4 : 25.4;
    std::vector<std::string> options;
    for (const ReferenceCase::Box& box : c.leading_edge) {
      options.insert(options.end(), {"--leading-edge", leading_edge_option(box)});
    }
    if (c.probe_radius != 0.0)
      options.insert(options.end(), {"--probe-radius", fmt::format("{}", c.probe_radius * length)});
    if (!c.use_approach) options.emplace_back("--ignore-approach");
    return options;
  }

  /// Runs the fit with these options and compares its result with the truth of the subset.
  void expect_truth(const ReferenceCase& c, const ReferenceSubset& subset, const std::string& design,
                    std::vector<std::string> options) const {
    const std::string result = scratch("result.json");
    std::filesystem::remove(result);
    options.insert(options.begin(), {BLADEFIT_COMMAND, "localize", "--design", design, "--json", result});
    // Points beyond the border of the blade count in the subsets called `all`, and in no other.
    if (subset.name == "all") options.insert(options.end(), {"--edges", "use"});
    const Outcome fit = run(options);
    expect_decided_or_pending(fit, result);
    const Outcome check = run({"python3", BLADEFIT_TEST_DATA "/check.py", subset.truth, result});
    EXPECT_EQ(check.exit_code, 0) << c.name << "/" << subset.name << ": " << check.output << fit.output;
  }

  /// No point is out, and the exit code is that of the verdict: points of a small subset may be determined too badly
  /// for the tolerance, and nothing but that leaves the blade undecided.
  static void expect_decided_or_pending(const Outcome& fit, const std::string& result) {
    ASSERT_TRUE(fit.exit_code == 0 || fit.exit_code == 4) << fit.output;
    const nlohmann::json json = read_json(result);
    EXPECT_EQ(fit.exit_code, exit_code_of_verdict(json)) << fit.output;
    for (const nlohmann::json& reason : json.at("verdict").at("reasons")) {
      const bool few = reason.at("code") == "pending" || reason.at("code") == "zone_not_probed";
      EXPECT_TRUE(few) << fit.output;
    }
    for (const nlohmann::json& point : json.at("points")) EXPECT_NE(point.at("state"), "out") << fit.output;
  }

  static std::vector<std::string> with(std::vector<std::string> left, const std::vector<std::string>& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
  }

  static std::string sign_text(const ReferenceCase& c) { return c.normal_sign > 0 ? "+" : "-"; }
};

}  // namespace bladefit::testing
