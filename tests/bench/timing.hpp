#pragma once
#include <functional>
#include <string>
#include <vector>

namespace bladefit::bench {

/// One of several solvers that answer the same question and are timed in turn.
struct Contestant {
  std::string name;
  std::function<void()> prepare;  ///< before every run, not timed; may be empty
  std::function<void()> run;
};

struct Effort {
  int most = 25;       ///< repetitions of each contestant
  int least = 3;       ///< however slow it is
  double seconds = 1;  ///< of one contestant, beyond which no repetition more than `least` is begun
};

/// What was measured of one contestant.
struct Timing {
  std::vector<double> seconds;      ///< of each repetition, in the order of the rounds
  std::vector<double> calibration;  ///< seconds of one multiply-add of the fixed chain, before and after each of them
};

/// Processor time of this process [s]: what other programs do meanwhile counts only as far as they take caches and
/// clock.
double processor_seconds();

/// Rounds in which each contestant runs once, so that all meet the same state of the machine. Who has used up its
/// effort leaves out the later rounds.
std::vector<Timing> timed_in_turn(const std::vector<Contestant>& contestants, const Effort& effort);

double median(std::vector<double> values);
double least(const std::vector<double>& values);

/// Median of `timing` / median of `base`, over the rounds that both ran.
double ratio(const Timing& timing, const Timing& base);

/// (largest - least) / median.
double spread(const std::vector<double>& values);

}  // namespace bladefit::bench
