/* Prints a digest of every verdict and report of a stream of points, a line for each mode: the same on every platform,
 * to the last bit. C99 and the C interface alone, so that it runs where a controller does. platform_digest DESIGN.bfd
 * POINTS.csv LEAST_U MOST_U POINTS The points: columns x,y,z,i,j,k [mm] after a line of names. The leading edge: patch
 * 0 from LEAST_U to MOST_U. Exit codes: 0, or 1 with a line that says what failed. */
#include <stdio.h>
#include <stdlib.h>

#include "firmware_bridge/bladefit.h"

enum { kMostPoints = 2000 };

static bladefit_point points[kMostPoints];
static uint64_t digest;

static void fail(const char* what) {
  printf("platform_digest: %s\n", what);
  exit(1);
}

/* FNV-1a, over the bytes of a number from the lowest on. */
static void add_bits(uint64_t bits, int bytes) {
  for (; bytes > 0; --bytes, bits >>= 8) digest = (digest ^ (bits & 0xFFu)) * UINT64_C(0x100000001b3);
}

static void add_word(uint32_t word) { add_bits(word, 4); }

static void add_real(double real) {
  union {
    double real;
    uint64_t bits;
  } value;
  value.real = real;
  add_bits(value.bits, 8);
}

static void add_reals(const double* reals, int count) {
  for (int k = 0; k < count; ++k) add_real(reals[k]);
}

static void add_verdict(const bladefit_verdict* v) {
  const uint32_t words[] = {v->sequence, v->patch,        v->kind,     v->region, v->state,
                            v->action,   v->fit_revision, v->left_out, v->fitted};
  const double reals[] = {v->u, v->v, v->distance_mm, v->tolerance_mm, v->uncertainty_mm, v->expanded_mm, v->beyond_mm};
  for (size_t k = 0; k < sizeof words / sizeof *words; ++k) add_word(words[k]);
  add_reals(reals, sizeof reals / sizeof *reals);
  add_reals(v->foot, 3);
  add_reals(v->normal, 3);
}

static void add_report(const bladefit_fit_report* r) {
  const uint32_t words[] = {r->status,   r->determined, r->points,    r->fitted,
                            r->rejected, r->revision,   r->improving, r->unproven};
  const double reals[] = {
      r->psi,         r->theta, r->phi, r->rms_mm, r->sigma_mm, r->tolerance_factor_mm, r->smallest_tolerance_mm,
      r->stationarity};
  for (size_t k = 0; k < sizeof words / sizeof *words; ++k) add_word(words[k]);
  add_reals(reals, sizeof reals / sizeof *reals);
  add_reals(r->rotation, 9);
  add_reals(r->translation, 3);
  add_reals(r->covariance, 36);
}

static void* read_design(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  if (file == NULL || fseek(file, 0, SEEK_END) != 0) fail("the design cannot be read");
  *size = (size_t)ftell(file);
  rewind(file);
  void* design = malloc(*size);
  if (design == NULL || fread(design, 1, *size, file) != *size) fail("the design cannot be read whole");
  fclose(file);
  return design;
}

static uint32_t read_points(const char* path, uint32_t most) {
  FILE* file = fopen(path, "r");
  if (file == NULL) fail("the points cannot be read");
  while (fgetc(file) != '\n')
    if (feof(file)) fail("the points have no second line");
  uint32_t count = 0;
  for (; count < most; ++count) {
    bladefit_point* p = &points[count];
    double* const r = p->position;
    double* const a = p->approach;
    if (fscanf(file, "%lf,%lf,%lf,%lf,%lf,%lf%*[^\n]", r, r + 1, r + 2, a, a + 1, a + 2) != 6) break;
    p->struct_size = sizeof *p;
    p->sequence = count + 1;
  }
  fclose(file);
  return count;
}

/* A session: every push, every revision, and the end. */
static void run(const bladefit_config* config, const void* design, size_t design_size, uint32_t count) {
  const size_t size = bladefit_memory_required(config, design, design_size);
  char* block = malloc(size + BLADEFIT_MEMORY_ALIGNMENT);
  if (size == 0 || block == NULL) fail("no memory for the fit");
  void* memory = block + (BLADEFIT_MEMORY_ALIGNMENT - (uintptr_t)block % BLADEFIT_MEMORY_ALIGNMENT);
  bladefit_handle* fit = NULL;
  if (bladefit_init(memory, size, design, design_size, config, &fit) < 0) fail("the fit does not start");
  bladefit_verdict verdict = {sizeof verdict};
  for (uint32_t k = 0; k < count; ++k) {
    if (bladefit_push(fit, &points[k], &verdict) < 0) fail("a point is refused");
    add_verdict(&verdict);
    while (bladefit_next_revision(fit, &verdict) == BLADEFIT_OK) add_verdict(&verdict);
  }
  if (bladefit_conclude(fit) < 0) fail("the fit does not conclude");
  bladefit_status status = BLADEFIT_MORE_WORK;
  while (status == BLADEFIT_MORE_WORK) status = bladefit_refine(fit, 1000000u);
  add_word((uint32_t)status);
  for (uint32_t k = 1; k <= count; ++k) {
    if (bladefit_verdict_of(fit, k, &verdict) != BLADEFIT_OK) fail("a point has no verdict");
    add_verdict(&verdict);
  }
  bladefit_fit_report report = {sizeof report};
  if (bladefit_fit(fit, &report) < 0) fail("the fit has no report");
  add_report(&report);
  free(block);
}

int main(int argc, char** argv) {
  if (argc != 6) fail("DESIGN.bfd POINTS.csv LEAST_U MOST_U POINTS are wanted");
  size_t design_size = 0;
  void* design = read_design(argv[1], &design_size);
  const long most = strtol(argv[5], NULL, 10);
  if (most < 1 || most > kMostPoints) fail("1 to 2000 POINTS are wanted");
  const uint32_t count = read_points(argv[2], (uint32_t)most);
  static const char* const names[] = {"least_squares", "minimax", "range", "min_tolerance", "constrained"};
  for (uint32_t mode = BLADEFIT_LEAST_SQUARES; mode <= BLADEFIT_CONSTRAINED; ++mode) {
    bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
    config.capacity = kMostPoints;
    config.mode = mode;
    config.leading_edge_tolerance_mm = 0.15;
    config.rest_tolerance_mm = 0.5;
    config.box_count = 1;
    config.boxes[0].u_min = strtod(argv[3], NULL);
    config.boxes[0].u_max = strtod(argv[4], NULL);
    config.boxes[0].v_max = 1.0;
    digest = UINT64_C(0xcbf29ce484222325);
    run(&config, design, design_size, count);
    printf("%-14s %lu points %08lx%08lx\n", names[mode], (unsigned long)count, (unsigned long)(digest >> 32),
           (unsigned long)(digest & 0xFFFFFFFFu));
  }
  free(design);
  return 0;
}
