// fuzz_readers CORPUS [--seconds S] [--seed N] [--reader NAME] [--input FILE]: gives the readers of outside input every
// file of the corpus, then changed ones for so long. A file whose name begins with refused- must be refused, one that
// begins with read- must be read. An input that breaks something is written to ./broken-READER and named.
// Exit codes: 0 everything holds, 1 something is broken, 2 wrong use.

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/mutation.hpp"
#include "tests/fuzz/reader.hpp"

// Of the sanitizers, where the program is built with one.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*)());

namespace bladefit::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr unsigned kLongestRead_s = 20;
constexpr std::size_t kQuickChanges = 200;  ///< of each reader, where no time is given

struct Wish {
  std::string corpus, reader, input;
  double seconds = 0;
  std::uint64_t seed = 1;
};

/// The input that is being read, for whoever is left when that ends everything.
struct UnderWay {
  std::string reader, bytes;
} under_way;

void save_input() {
  const std::string name = "broken-" + under_way.reader;
  std::ofstream(name, std::ios::binary) << under_way.bytes;
  fmt::print(stderr, "fuzz_readers: {}: the input is in {}\n", under_way.reader, name);
}

void on_signal(int number) {
  save_input();
  signal(number, SIG_DFL);
  raise(number);
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Sample {
  std::string name, bytes;
};

std::vector<Sample> samples_of(const Reader& reader, const std::string& corpus) {
  std::vector<Sample> samples;
  const fs::path folder = fs::path(corpus) / reader.name;
  if (!fs::is_directory(folder)) return samples;
  for (const auto& entry : fs::directory_iterator(folder))
    samples.push_back({entry.path().filename(), content_of(entry.path())});
  std::ranges::sort(samples, {}, &Sample::name);
  return samples;
}

/// What the reader broke with this input; empty = nothing.
std::string broken_by(const Reader& reader, const std::string& bytes, std::string& refusal) {
  under_way = {std::string(reader.name), bytes};
  alarm(kLongestRead_s);
  std::string broken;
  try {
    const Answer answer = reader.read(bytes);
    refusal = answer.refusal;
    broken = answer.broken;
  } catch (const std::exception& error) {
    broken = std::string("it let an exception out: ") + error.what();
  }
  alarm(0);
  if (!broken.empty()) save_input();
  return broken;
}

/// Says what is wrong with the answer to a file of the corpus.
bool holds_for(const Reader& reader, const Sample& sample) {
  std::string refusal;
  std::string broken = broken_by(reader, sample.bytes, refusal);
  if (broken.empty() && sample.name.starts_with("refused-") && refusal.empty()) broken = "it must be refused";
  if (broken.empty() && sample.name.starts_with("read-") && !refusal.empty()) broken = "it must be read: " + refusal;
  if (broken.empty()) return true;
  fmt::print(stderr, "fuzz_readers: {}/{}: {}\n", reader.name, sample.name, broken);
  return false;
}

/// Changed inputs, from seed 1 of this reader on, until the time or the number is over.
bool holds_for_changed(const Reader& reader, const std::vector<Sample>& samples, const Wish& wish, double seconds) {
  std::vector<std::string> corpus;
  for (const Sample& sample : samples) corpus.push_back(sample.bytes);
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  std::size_t done = 0, refused = 0;
  for (std::uint64_t seed = wish.seed; seconds > 0 ? Clock::now() < until : done < kQuickChanges; ++seed, ++done) {
    std::mt19937_64 random(seed);
    std::string bytes = mutated(corpus[random() % corpus.size()], corpus, random);
    if (reader.repair != nullptr && random() % 2 == 0) reader.repair(bytes);
    std::string refusal;
    const std::string broken = broken_by(reader, bytes, refusal);
    refused += refusal.empty() ? 0 : 1;
    if (broken.empty()) continue;
    fmt::print(stderr, "fuzz_readers: {}, seed {}: {}\n", reader.name, seed, broken);
    return false;
  }
  fmt::print("{}: {} files, {} changed inputs, {} of them refused\n", reader.name, samples.size(), done, refused);
  return true;
}

bool run_reader(const Reader& reader, const Wish& wish, double seconds) {
  if (!wish.input.empty()) return holds_for(reader, {"input", content_of(wish.input)});
  const std::vector<Sample> samples = samples_of(reader, wish.corpus);
  if (samples.empty()) {
    fmt::print(stderr, "fuzz_readers: {}/{}: the folder of the corpus is empty\n", wish.corpus, reader.name);
    return false;
  }
  bool good = true;
  for (const Sample& sample : samples) good = holds_for(reader, sample) && good;
  return holds_for_changed(reader, samples, wish, seconds) && good;
}

/// False: wrong use.
bool read_wish(const std::vector<std::string>& words, Wish& wish) {
  if (words.empty()) return false;
  wish.corpus = words[0];
  for (std::size_t k = 1; k + 1 < words.size(); k += 2) {
    const std::string &name = words[k], &value = words[k + 1];
    const char* const end = value.data() + value.size();
    if (name == "--reader")
      wish.reader = value;
    else if (name == "--input")
      wish.input = value;
    else if (name == "--seconds" && std::from_chars(value.data(), end, wish.seconds).ptr == end)
      continue;
    else if (name == "--seed" && std::from_chars(value.data(), end, wish.seed).ptr == end)
      continue;
    else
      return false;
  }
  return words.size() % 2 == 1;
}

int run(const std::vector<std::string>& words) {
  Wish wish;
  std::vector<Reader> chosen;
  if (read_wish(words, wish)) {
    for (const Reader& reader : readers()) {
      if (wish.reader.empty() || wish.reader == reader.name) chosen.push_back(reader);
    }
  }
  if (chosen.empty() || (!wish.input.empty() && wish.reader.empty())) {
    fmt::print(stderr, "usage: fuzz_readers CORPUS [--seconds S] [--seed N] [--reader NAME [--input FILE]]\n");
    return 2;
  }
  for (const int number : {SIGALRM, SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL}) signal(number, on_signal);
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(save_input);
  bool good = true;
  for (const Reader& reader : chosen)
    good = run_reader(reader, wish, wish.seconds / static_cast<double>(chosen.size())) && good;
  return good ? 0 : 1;
}

}  // namespace
}  // namespace bladefit::fuzz

int main(int argc, char** argv) { return bladefit::fuzz::run({argv + 1, argv + argc}); }
