// The core allocates nothing, three proofs: the archive asks for no allocator, nothing is allocated in a whole session,
// and Eigen's own check stays silent (this test is built with the core's sources and EIGEN_RUNTIME_NO_MALLOC).

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>
#include <vector>

#include "tests/support/localizer_session.hpp"
#include "tests/unit/core/programs.hpp"

namespace {

std::atomic<bool> counting{false};
std::atomic<std::size_t> allocations{0};

void count() {
  if (counting) ++allocations;
}

}  // namespace

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

// The sanitizers bring their own allocator, which reports what it is asked for. Declared here, since GCC comes without
// the header sanitizer/allocator_interface.h.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*malloc_hook)(const volatile void*, std::size_t),
                                                         void (*free_hook)(const volatile void*));

namespace {
const int installed = __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t) { count(); },
                                                                [](const volatile void*) { count(); });
}  // namespace

#else

// Takes the place of the C library's allocator, which operator new goes through as well.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
  count();
  return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  *block = memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
void free(void* block) {
  if (block != nullptr) count();
  __libc_free(block);
}
}

#endif

namespace bladefit::testing {
namespace {

/// Counts what happens while it lives.
class AllocationCount {
 public:
  AllocationCount() {
    allocations = 0;
    counting = true;
    Eigen::internal::set_is_malloc_allowed(false);
  }
  ~AllocationCount() { stop(); }
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;
  std::size_t stop() {
    counting = false;
    Eigen::internal::set_is_malloc_allowed(true);
    return allocations;
  }
};

/// What nm prints of the core's archive.
std::vector<std::string> symbol_lines(const std::string& options) {
  FILE* pipe = popen(("nm -P " + options + " '" + BLADEFIT_CORE_ARCHIVE + "' 2>&1").c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) text.append(buffer.data(), n);
  EXPECT_EQ(pclose(pipe), 0) << text;
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::set<std::string> undefined_symbols() {
  std::set<std::string> symbols;
  for (const std::string& line : symbol_lines("-u")) {
    const std::size_t end = line.find(" U");
    if (end != std::string::npos) symbols.insert(line.substr(0, end));
  }
  return symbols;
}

/// Everything that the core may ask of the outside: memory copies, mathematics, what the processor can do, assertions
/// of a debug build, and what sanitizers add.
bool allowed(const std::string& symbol) {
  static const std::set<std::string> names = {"memcpy",
                                              "memmove",
                                              "memset",
                                              "memcmp",
                                              "strlen",
                                              "sqrt",
                                              "sin",
                                              "cos",
                                              "sincos",
                                              "atan2",
                                              "hypot",
                                              "__assert_fail",
                                              "__cpu_model",  // libgcc: what the processor can do
                                              "__stack_chk_fail",
                                              "_GLOBAL_OFFSET_TABLE_"};
  const auto begins = [&](const char* prefix) { return symbol.rfind(prefix, 0) == 0; };
  return names.contains(symbol) || begins("_ZN8bladefit") || begins("_ZNK8bladefit") || begins("__asan_") ||
         begins("__ubsan_") || begins("__tsan_") || begins("__sanitizer_");
}

TEST(CoreMemory, ArchiveAsksForNoAllocator) {
  const std::set<std::string> symbols = undefined_symbols();
  EXPECT_TRUE(symbols.contains("sqrt") || symbols.contains("atan2")) << "nm gave nothing";
  for (const std::string& symbol : symbols) EXPECT_TRUE(allowed(symbol)) << symbol;
  for (const char* forbidden : {"malloc", "free", "_Znwm", "_ZdlPvm", "__cxa_throw", "pthread_mutex_lock"}) {
    EXPECT_FALSE(allowed(forbidden)) << forbidden;
  }
}

/// What the kernels define is theirs alone: a function that other files have too could be linked from here, and would
/// then ask for AVX2 of every processor.
TEST(CoreMemory, KernelsShareNoCode) {
  std::set<std::string> defined;
  for (const std::string& line : symbol_lines("-A -g --defined-only")) {
    const bool kernel = line.find("[lane_walk.cpp.o]") != std::string::npos ||
                        line.find("[lane_rows.cpp.o]") != std::string::npos ||
                        line.find("[bicubic_newton.cpp.o]") != std::string::npos;
    if (!kernel || line.find("]: ") == std::string::npos) continue;
    const std::string symbol = line.substr(line.find("]: ") + 3);
    EXPECT_NE(symbol.find(" T "), std::string::npos) << symbol;
    defined.insert(symbol.substr(0, symbol.find(' ')));
  }
  EXPECT_EQ(defined.size(), 3U) << "walk_lanes, take_rows and newton_in_bicubic";
}

TEST(CoreMemory, CounterCounts) {
  AllocationCount count;
  auto* number = new int(3);
  EXPECT_GT(allocations, 0U);
  delete number;
  void* volatile block = malloc(10);  // or the compiler leaves the pair out
  free(block);
  EXPECT_GE(count.stop(), 4U);
}

TEST(CoreMemoryDeathTest, EigensCheckIsAlive) {
  EXPECT_DEATH(
      {
        Eigen::internal::set_is_malloc_allowed(false);
        const Eigen::MatrixXd matrix = Eigen::MatrixXd::Ones(7, 7);
        std::printf("%g", matrix.sum());
      },
      "allocation is forbidden");
}

class CoreMemoryOfMode : public ::testing::TestWithParam<FitMode> {};

TEST_P(CoreMemoryOfMode, NothingIsAllocatedInAWholeSession) {
  const BladeSession s;
  LocalizerConfig config = s.config;
  config.mode = GetParam();
  if (config.mode == FitMode::constrained) {
    config.tolerance.leading_edge_mm = 0.05;
    config.tolerance.rest_mm = 0.5;
  }
  config.capacity = 1500;  // the memory becomes full on the way
  const AlignedBlock block(Localizer::memory_required(config));
  std::size_t accepted = 0, revisions = 0, found = 0;

  AllocationCount count;
  DesignImage image;
  const Status opened = DesignImage::open(s.design.bytes(), image);
  Localizer* localizer = nullptr;
  const Status created = Localizer::create(block.bytes(), image, config, localizer);
  Verdict verdict;
  for (const ProbePoint& point : s.points) {
    accepted += succeeded(localizer->push(point, verdict)) ? 1 : 0;
    while (localizer->next_revision(verdict)) ++revisions;
    if (point.sequence % 100 == 0) (void)localizer->refine(config.mode == FitMode::least_squares ? 500 : 20000);
    if (point.sequence % 10 == 0) (void)localizer->fit();
  }
  localizer->conclude();
  const Status refined = refine_fully(*localizer);
  for (const ProbePoint& point : s.points)
    found += localizer->verdict_of(point.sequence, verdict) == Status::ok ? 1 : 0;
  const FitReport report = localizer->fit();
  localizer->reset();
  for (const ProbePoint& point : s.points) {
    if (localizer->stage(point) != Status::ok) break;
  }
  EXPECT_EQ(count.stop(), 0U);

  EXPECT_EQ(opened, Status::ok);
  EXPECT_EQ(created, Status::ok);
  EXPECT_EQ(refined, Status::ok);
  EXPECT_EQ(accepted, s.points.size());
  EXPECT_EQ(found, 1500U);
  EXPECT_GT(revisions, 0U);
  EXPECT_EQ(report.status, FitStatus::converged);
}

INSTANTIATE_TEST_SUITE_P(Modes, CoreMemoryOfMode,
                         ::testing::Values(FitMode::least_squares, FitMode::range, FitMode::min_tolerance,
                                           FitMode::constrained));

TEST(CoreMemory, NothingIsAllocatedBySolvingPrograms) {
  std::mt19937_64 random(7);
  OwnedRows rows = minimax_rows(random, 500, true, 0.05);
  const Constraints constraints = minimax(rows);
  AllocationCount count;
  const ActiveSetResult linear = minimize_linear(Vec8::Unit(6), constraints);
  const ActiveSetResult quadratic = minimize_quadratic(Mat8::Identity(), Vec8::Unit(6), constraints, linear.active);
  EXPECT_EQ(count.stop(), 0U);
  EXPECT_EQ(linear.status, Status::ok);
  EXPECT_EQ(quadratic.status, Status::ok);
}

}  // namespace
}  // namespace bladefit::testing
