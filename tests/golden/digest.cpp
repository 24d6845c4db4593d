// Prints a digest of every verdict, report and revision of the designs of tests/data: a line for each design, mode and
// way in (batch or stream), and for the choices of a fit. A change that keeps behaviour keeps every line, to the last
// bit. Linked twice: with the wide registers of the processor in use, and without (digest_plain.cpp).
//   digest            all of it
//   digest NAME...    the lines that begin with one of the names

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/compile_case.hpp"
#include "tests/support/json_file.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// FNV-1a over the bits of what it is given.
class Digest {
 public:
  template <class Number>
  void add(Number number) requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) {
    unsigned char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3ULL;
  }
  template <class Matrix>
  void add_all(const Matrix& numbers) {
    for (Eigen::Index i = 0; i < numbers.size(); ++i) add(numbers.data()[i]);
  }
  [[nodiscard]] unsigned long long value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

void add(Digest& digest, const Verdict& v) {
  digest.add(v.sequence);
  digest.add(v.foot.patch);
  digest.add(v.foot.u);
  digest.add(v.foot.v);
  digest.add_all(v.foot.point);
  digest.add_all(v.foot.normal);
  digest.add(v.foot.distance);
  digest.add(v.foot.kind);
  digest.add(v.region);
  digest.add(v.tolerance_mm);
  digest.add(v.uncertainty_mm);
  digest.add(v.state);
  digest.add(v.action);
  digest.add(v.revision);
}

void add(Digest& digest, const RegionReport& r) {
  digest.add(r.count);
  digest.add(r.judged_out);
  digest.add(r.rms_mm);
  digest.add(r.worst_mm);
  digest.add(r.worst_sequence);
}

/// All but the number of searches, which is a cost and no answer.
void add(Digest& digest, const FitReport& r) {
  digest.add(r.status);
  digest.add_all(r.pose.rotation);
  digest.add_all(r.pose.translation);
  digest.add_all(r.covariance);
  for (const std::uint32_t count : {r.determined, r.points, r.fitted, r.rejected, r.further_starts, r.same_optimum,
                                    r.unproven, r.revision, r.certificate.count}) {
    digest.add(count);
  }
  for (const double number : {r.rms_mm, r.sigma_mm, r.loss_scale_mm, r.smallest_eigenvalue, r.gradient, r.mode_value_mm,
                              r.smallest_tolerance_mm, r.stationarity}) {
    digest.add(number);
  }
  add(digest, r.leading_edge);
  add(digest, r.rest);
  for (std::uint32_t k = 0; k < r.certificate.count; ++k) {
    digest.add(r.certificate.sequence[k]);
    digest.add(r.certificate.multiplier[k]);
  }
  digest.add(r.memory_full);
  digest.add(r.improving);
}

void add_state(Digest& digest, Localizer& localizer, const std::vector<ProbePoint>& points) {
  Verdict verdict;
  while (localizer.next_revision(verdict)) add(digest, verdict);
  for (const ProbePoint& point : points) {
    const Status status = localizer.verdict_of(point.sequence, verdict);
    digest.add(status);
    if (status == Status::ok) add(digest, verdict);
  }
  add(digest, localizer.fit());
}

void refine(Digest& digest, Localizer& localizer, std::uint32_t at_once) {
  Status status = Status::more_work;
  while (status == Status::more_work) digest.add(status = localizer.refine(at_once));
}

/// Every point is staged; then the fit is refined to its end.
Digest batch(Localizer& localizer, const std::vector<ProbePoint>& points) {
  Digest digest;
  for (const ProbePoint& point : points) digest.add(localizer.stage(point));
  localizer.conclude();
  refine(digest, localizer, 100000);
  add_state(digest, localizer, points);
  return digest;
}

void push(Digest& digest, Localizer& localizer, const ProbePoint& point) {
  Verdict verdict;
  const Status status = localizer.push(point, verdict);
  digest.add(status);
  if (succeeded(status)) add(digest, verdict);
  while (localizer.next_revision(verdict)) add(digest, verdict);
}

/// Every point is pushed; at a third of them the fit is refined in small pieces, at two thirds it is interrupted.
Digest stream(Localizer& localizer, const std::vector<ProbePoint>& points) {
  Digest digest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    push(digest, localizer, points[i]);
    if (i == points.size() / 3) {
      localizer.conclude();
      refine(digest, localizer, 333);
      add_state(digest, localizer, points);
    }
    if (i == points.size() * 2 / 3) digest.add(localizer.refine(2 * static_cast<std::uint32_t>(points.size()) + 77));
    if (i % 50 == 0) add(digest, localizer.fit());
  }
  localizer.conclude();
  refine(digest, localizer, 1001);
  add_state(digest, localizer, points);
  return digest;
}

struct Way {
  const char* name;
  Digest (*run)(Localizer&, const std::vector<ProbePoint>&);
};
constexpr Way kWays[] = {{"batch", batch}, {"stream", stream}};

struct Mode {
  const char* name;
  FitMode mode;
};
constexpr Mode kModes[] = {{"least_squares", FitMode::least_squares},
                           {"minimax", FitMode::minimax},
                           {"range", FitMode::range},
                           {"min_tolerance", FitMode::min_tolerance},
                           {"constrained", FitMode::constrained}};

struct Program {
  std::vector<std::string_view> wanted;

  void print(const std::string& name, const DesignImage& design, const LocalizerConfig& config,
             const std::vector<ProbePoint>& points) const {
    for (const Way& way : kWays) {
      const std::string line = name + " " + way.name;
      bool asked = wanted.empty();
      for (const std::string_view begin : wanted) asked = asked || line.starts_with(begin);
      if (!asked) continue;
      OwnedLocalizer localizer(design, config);
      std::printf("%s %016llx\n", line.c_str(), way.run(*localizer, points).value());
      std::fflush(stdout);
    }
  }

  void modes(const ReferenceCase& c, const DesignImage& design, const std::vector<ProbePoint>& points) const {
    for (const auto& [word, mode] : kModes) {
      LocalizerConfig config = tolerant(c, points.size());
      config.mode = mode;
      print(c.name + " " + word, design, config, points);
    }
  }

  /// Choices that change a fit, each alone, on one design.
  void choices(const ReferenceCase& c, const DesignImage& design, const std::vector<ProbePoint>& points) const {
    const auto choice = [&](const char* name, auto change) {
      LocalizerConfig config = tolerant(c, points.size());
      change(config);
      print(c.name + " " + name, design, config, points);
    };
    choice("edges_use", [](LocalizerConfig& f) { f.edges = EdgePolicy::use; });
    choice("huber", [](LocalizerConfig& f) { f.loss = Loss::huber; });
    choice("tukey", [](LocalizerConfig& f) { f.loss = Loss::tukey; });
    choice("tukey_scale", [](LocalizerConfig& f) {
      f.loss = Loss::tukey;
      f.loss_scale_mm = 0.06;
    });
    choice("lock", [](LocalizerConfig& f) { f.locked = kLockTx | kLockRz; });
    choice("lock_minimax", [](LocalizerConfig& f) {
      f.mode = FitMode::minimax;
      f.locked = kLockTy;
    });
    choice("window", [](LocalizerConfig& f) { f.window_low = 0.05, f.window_high = 0.95; });
    choice("no_approach", [](LocalizerConfig& f) { f.use_approach = false; });
    choice("transition", [](LocalizerConfig& f) {
      f.mode = FitMode::constrained;
      f.tolerance.transition = 0.1;
    });
    choice("infeasible", [](LocalizerConfig& f) {
      f.mode = FitMode::constrained;
      f.tolerance.leading_edge_mm = 0.01;
    });
    choice("regions_fixed", [](LocalizerConfig& f) {
      f.mode = FitMode::min_tolerance;
      f.regions = RegionPolicy::fixed;
    });
    choice("start_off", [](LocalizerConfig& f) { f.start.translation = Vec3(1.5, -2.0, 1.0); });
    choice("full_memory", [](LocalizerConfig& f) { f.capacity = 300; });
    choice("full_memory_min_tolerance", [](LocalizerConfig& f) {
      f.mode = FitMode::min_tolerance;
      f.capacity = 300;
    });
  }

 private:
  /// Tolerances that some points miss, and that a constrained fit can meet.
  static LocalizerConfig tolerant(const ReferenceCase& c, std::size_t capacity) {
    LocalizerConfig config = config_of(c, capacity);
    const nlohmann::json bounds = read_json(c.folder / "truth" / "full.json").at("constrained");
    config.tolerance.leading_edge_mm = bounds.at("epsilon").get<double>() * c.mm_per_unit;
    config.tolerance.rest_mm = 0.3 * bounds.at("delta").get<double>() * c.mm_per_unit;
    return config;
  }
};

}  // namespace
}  // namespace bladefit::testing

int main(int count, char** words) {
  using namespace bladefit::testing;
  const Program program{{words + 1, words + count}};
  for (const std::string& name : reference_case_names()) {
    const ReferenceCase c = read_case(name);
    const CompiledDesign design(compile_case(c));
    const auto points = points_of(c, "full");
    program.modes(c, design.image(), points);
    if (name == "dtmb4119") program.choices(c, design.image(), points);
  }
  return 0;
}
