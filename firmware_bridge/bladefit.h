/* bladefit C interface: fits probed points of a propeller blade to its design, one point at a time.
 *
 * C99 and C++. No call allocates, locks, waits, does input or output, throws, or loops without a bound; everything
 * lives in one block of memory that the caller owns.
 *
 *   bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
 *   size_t size = bladefit_memory_required(&config, design, design_size);
 *   bladefit_init(memory, size, design, design_size, &config, &handle);
 *   for each point: bladefit_push(handle, &point, &verdict);
 *                   while (bladefit_next_revision(handle, &verdict) == BLADEFIT_OK) ...
 *   bladefit_refine(handle, budget) when a path of the probe ends, until BLADEFIT_OK when the last point is in.
 *
 * Units: mm and rad. Frames: points are in the machine's coordinates, feet in those of the design.
 *
 * Threads: a handle belongs to one thread at a time; two handles may be used by two threads at once, also on the same
 * design. States: a handle exists from a bladefit_init() that returned BLADEFIT_OK until its memory is used for
 * something else; there is nothing to close. A copy of its memory is no handle: it is refused with BAD_HANDLE.
 *
 * Arguments: every pointer is checked for null and for the alignment of its type, every struct_size and every number
 * before anything is done. A negative status means that nothing has changed, the handle and all outputs included. */
#ifndef BLADEFIT_FIRMWARE_BRIDGE_BLADEFIT_H
#define BLADEFIT_FIRMWARE_BRIDGE_BLADEFIT_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes when a struct or the meaning of a call changes. Compare with bladefit_abi_version(). */
#define BLADEFIT_ABI_VERSION 2u

#define BLADEFIT_MEMORY_ALIGNMENT 64u   /* of the memory given to bladefit_init() [bytes] */
#define BLADEFIT_MAX_BOXES 32u          /* leading-edge boxes */
#define BLADEFIT_MAX_CAPACITY 16777216u /* points that can keep a place */

/* Most that was measured of the stack of a call [bytes], x86-64, all modes, the designs of the tests: push, push_many
 * and refine 23.7 kB, init and memory_required 15 kB, design_check 8 kB, fit and reset 3.4 kB, others below 1 kB. */
#define BLADEFIT_STACK_BYTES 24576u

/* Outcome of a call: 0 success, positive success with a qualification, negative the reason why nothing was done. */
typedef int32_t bladefit_status;
enum {
  BLADEFIT_OK = 0,
  BLADEFIT_UNDERDETERMINED = 1, /* fewer than six degrees of freedom follow from the points so far */
  BLADEFIT_MORE_WORK = 2,       /* the budget of bladefit_refine() is spent; call again to go on */
  BLADEFIT_MEMORY_FULL = 3,     /* judged and counted, but the point will not be revisited */
  BLADEFIT_DUPLICATE = 4,       /* sequence not above the last one; nothing has changed, no verdict was written */
  BLADEFIT_ITERATION_CAP = 5,   /* the best answer so far, not a converged one */
  BLADEFIT_POINTS_REFUSED = 7,  /* some points of a batch were not taken: their own statuses say why */
  BLADEFIT_NULL_ARGUMENT = -1,
  BLADEFIT_NOT_ENOUGH_MEMORY = -2,
  BLADEFIT_MISALIGNED = -3,
  BLADEFIT_NOT_FINITE = -4,     /* a number is NaN or infinite where it must not be */
  BLADEFIT_OUT_OF_RANGE = -5,   /* a number is outside what its field allows */
  BLADEFIT_NOT_FOUND = -6,      /* no such point, or no revision waits */
  BLADEFIT_BAD_SIZE = -7,       /* struct_size is not that of this version of the struct */
  BLADEFIT_BAD_HANDLE = -8,     /* the handle does not come from a successful bladefit_init() */
  BLADEFIT_BAD_MAGIC = -20,     /* the design is not a design image */
  BLADEFIT_BAD_VERSION = -21,   /* the design image is of another format version */
  BLADEFIT_BAD_LENGTH = -22,    /* the design image is shorter or longer than it says */
  BLADEFIT_BAD_CRC = -23,       /* the design image is damaged */
  BLADEFIT_BAD_CONTENT = -24,   /* the design image contradicts itself */
  BLADEFIT_BAD_BYTE_ORDER = -25 /* the design image is of this version, but for a processor of the other byte order */
};

enum { BLADEFIT_EDGES_SKIP = 0, BLADEFIT_EDGES_USE = 1 }; /* bladefit_config.edges */
enum {
  BLADEFIT_LEAST_SQUARES = 0, /* the sum of squared distances */
  BLADEFIT_MINIMAX = 1,       /* the largest distance */
  BLADEFIT_RANGE = 2,         /* the largest less the smallest signed distance */
  BLADEFIT_MIN_TOLERANCE = 3, /* the leading-edge tolerance, `ratio` times it on the rest */
  BLADEFIT_CONSTRAINED = 4    /* the sum of squares, every distance within its tolerance */
};                            /* bladefit_config.mode: what the fit minimises */
enum { BLADEFIT_REGIONS_FOLLOW = 0, BLADEFIT_REGIONS_FIXED = 1 };                  /* bladefit_config.regions */
enum { BLADEFIT_LOSS_NONE = 0, BLADEFIT_LOSS_HUBER = 1, BLADEFIT_LOSS_TUKEY = 2 }; /* bladefit_config.loss */
/* bladefit_config.locked, added up: these keep their value of the start pose. RX, RY, RZ: psi, theta, phi. */
enum { BLADEFIT_LOCK_TX = 1, BLADEFIT_LOCK_TY = 2, BLADEFIT_LOCK_TZ = 4 };
enum { BLADEFIT_LOCK_RX = 8, BLADEFIT_LOCK_RY = 16, BLADEFIT_LOCK_RZ = 32 };
enum { BLADEFIT_INTERIOR = 0, BLADEFIT_EDGE = 1, BLADEFIT_CORNER = 2 }; /* kind */
enum { BLADEFIT_REST = 0, BLADEFIT_LEADING_EDGE = 1 };                  /* region */
enum {
  BLADEFIT_PENDING = 0,  /* the fit is not determined well enough to judge the point */
  BLADEFIT_IN = 1,       /* within its tolerance */
  BLADEFIT_OUT = 2,      /* beyond it */
  BLADEFIT_REJECTED = 3, /* left out of fit and judgement */
  BLADEFIT_UNDECIDED = 4 /* BLADEFIT_GUARDED: nearer to its tolerance than its expanded uncertainty */
};                       /* state */
/* bladefit_config.decision: distances as they are, or with their expanded uncertainty (ISO 14253-1:2017) */
enum { BLADEFIT_SIMPLE = 0, BLADEFIT_GUARDED = 1 };
enum { BLADEFIT_NO_ACTION = 0, BLADEFIT_CUT = 1, BLADEFIT_WELD = 2 }; /* action */
/* left_out. WINDOW: the foot at the start pose is outside the window. EDGE: the foot is on an outer edge, not beyond it
 * by more than the tolerance. */
enum { BLADEFIT_LEFT_OUT_NONE = 0, BLADEFIT_LEFT_OUT_WINDOW = 1, BLADEFIT_LEFT_OUT_EDGE = 2 };
enum { BLADEFIT_FIT_UNDERDETERMINED = 0, BLADEFIT_FIT_TRACKING = 1 }; /* bladefit_fit_report.status */
enum { BLADEFIT_FIT_CONVERGED = 2, BLADEFIT_FIT_INFEASIBLE = 3 };

/* Part of a patch between isoparameter lines, limits included, in parameters normalised to 0..1. */
typedef struct bladefit_box {
  double u_min, u_max, v_min, v_max; /* min <= max */
  uint32_t patch;                    /* from 0, in the order of the design file */
  uint32_t reserved;                 /* 0 */
} bladefit_box;

typedef struct bladefit_config {
  uint32_t struct_size;             /* sizeof(bladefit_config) */
  uint32_t capacity;                /* points that keep a place, 6..BLADEFIT_MAX_CAPACITY */
  uint32_t refresh_per_push;        /* stored points projected again in each push, 2..64 */
  uint32_t use_approach;            /* 1: approach vectors choose the side of the blade; 0: they are ignored */
  uint32_t edges;                   /* BLADEFIT_EDGES_SKIP or _USE: whether feet on edges and corners count */
  uint32_t box_count;               /* leading-edge boxes in use, 0..BLADEFIT_MAX_BOXES */
  double probe_radius_mm;           /* >= 0; points are centres of a ball of this radius */
  double noise_floor_mm;            /* > 0; least standard deviation assumed of a distance */
  double determined_mm;             /* >= 0; largest standard uncertainty, at the design's half diagonal, of a direction
                                       that counts as determined; 0 = a thousandth of the half diagonal */
  double leading_edge_tolerance_mm; /* > 0; INFINITY = not judged */
  double rest_tolerance_mm;         /* > 0; INFINITY = not judged */
  double transition;                /* >= 0; width in parameter units over which the tolerance rises outside a box */
  double window_low;                /* 0..1; points whose foot at the start pose has u or v below this are rejected */
  double window_high;               /* above window_low, at most 1; or above this */
  double start_rotation[9];         /* row by row, orthogonal to 1e-9: where the fit starts, machine -> design */
  double start_translation[3];      /* [mm] */
  bladefit_box boxes[BLADEFIT_MAX_BOXES]; /* the leading-edge region is the union of the first box_count */
  uint32_t mode;                          /* BLADEFIT_LEAST_SQUARES ... */
  uint32_t regions;                       /* BLADEFIT_REGIONS_FOLLOW: a point's region is that of its present foot, or
                                             _FIXED: of its foot at the least-squares fit */
  uint32_t locked;                        /* sum of BLADEFIT_LOCK_..., not all six */
  uint32_t loss;                          /* BLADEFIT_LOSS_...: robust loss of a least-squares fit */
  double ratio;                           /* >= 1, or 0 for 10; min_tolerance: tolerance of the rest / leading edge */
  double loss_scale_mm;                   /* >= 0; standard deviation of good points; 0 = bladefit_refine() finds it */
  uint32_t decision;                      /* BLADEFIT_SIMPLE or _GUARDED */
  uint32_t reserved;                      /* 0 */
  double coverage_factor;                 /* > 0, or 0 for 2; k of the expanded uncertainty U = k u */
  double probe_uncertainty_mm;            /* >= 0; standard uncertainty of a distance that comes from the probe, and */
  double probe_uncertainty_per_mm;        /* >= 0; of it per mm from the middle of the design; one > 0 with _GUARDED */
} bladefit_config;

/* A config to start from: 65536 points, nothing judged, start pose = identity. */
#define BLADEFIT_CONFIG_DEFAULTS                                                                                       \
  {                                                                                                                    \
    (uint32_t)sizeof(bladefit_config), 65536u, 8u, 1u, BLADEFIT_EDGES_SKIP, 0u, 0.0, 0.005, 0.0, INFINITY, INFINITY,   \
        0.0, 0.0, 1.0, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, {{0.0, 0.0, 0.0, 0.0, 0u, 0u}}, \
        BLADEFIT_LEAST_SQUARES, BLADEFIT_REGIONS_FOLLOW, 0u, BLADEFIT_LOSS_NONE, 10.0, 0.0, BLADEFIT_SIMPLE, 0u, 2.0,  \
        0.0, 0.0                                                                                                       \
  }

/* One touch of the probe, in the machine's coordinates. */
typedef struct bladefit_point {
  uint32_t struct_size; /* sizeof(bladefit_point) */
  uint32_t sequence;    /* >= 1, rising; after 4294967295 every point is a duplicate until bladefit_reset() */
  uint32_t path;        /* scan line, 0..65535; 0 = unknown */
  uint32_t reserved;    /* 0 */
  double position[3];   /* [mm] */
  double approach[3];   /* unit vector from the probe to the material; all 0 = unknown */
  double weight;        /* of the squared distance in the least-squares objective, 1e-12 to 1e12; 0 = 1 */
} bladefit_point;

typedef struct bladefit_verdict {
  uint32_t struct_size; /* sizeof(bladefit_verdict), set by the caller */
  uint32_t sequence;
  uint32_t patch;
  uint32_t kind;
  uint32_t region;
  uint32_t state;
  uint32_t action;       /* where the state is BLADEFIT_OUT; NONE there: beyond an outer edge of the design */
  uint32_t fit_revision; /* at which the point was judged */
  double u, v;           /* 0..1 */
  double foot[3];        /* nearest point of the design [mm, design coordinates] */
  double normal[3];      /* outward unit normal there */
  double distance_mm;    /* > 0 excess material, < 0 missing material, less the probe radius */
  double tolerance_mm;   /* INFINITY = not judged */
  double uncertainty_mm; /* standard uncertainty of the distance that comes from the pose */
  double expanded_mm;    /* expanded uncertainty of the distance, the probe's part included where it is given */
  double beyond_mm;      /* how far the point lies beyond an outer edge of the design, along the surface */
  uint32_t left_out;     /* where the state is BLADEFIT_REJECTED: BLADEFIT_LEFT_OUT_... */
  uint32_t fitted;       /* 1: counts in the fit, which is another thing than being judged */
} bladefit_verdict;

typedef struct bladefit_region_report {
  uint32_t count;          /* points that count in the fit */
  uint32_t judged_out;     /* points whose state is out */
  uint32_t worst_sequence; /* 0 = no point yet */
  uint32_t reserved;
  double rms_mm;
  double worst_mm; /* distance of largest magnitude, signed */
} bladefit_region_report;

/* Points that prove an optimum: no motion brings them all nearer. */
typedef struct bladefit_certificate {
  uint32_t count; /* 0..8; 0 = none */
  uint32_t reserved;
  uint32_t sequence[8];
  int32_t sign[8];      /* of the distance */
  double multiplier[8]; /* >= 0; sum of multiplier * sign * gradient of the distance = 0 */
} bladefit_certificate;

typedef struct bladefit_fit_report {
  uint32_t struct_size; /* sizeof(bladefit_fit_report), set by the caller */
  uint32_t status;      /* BLADEFIT_FIT_... */
  uint32_t determined;  /* degrees of freedom that follow from the points, 0..6 less the locked ones */
  uint32_t points;      /* accepted so far */
  uint32_t fitted;      /* of these, how many count in the fit */
  uint32_t rejected;
  uint32_t revision;    /* +1 whenever the pose moves */
  uint32_t memory_full; /* 0 or 1 */
  double rotation[9];   /* row by row; r = rotation * R + translation (machine -> design) */
  double translation[3];
  double psi, theta, phi; /* rotation = Rx(psi) Ry(theta) Rz(phi) */
  double covariance[36];  /* of (w, dt) in C' = exp([w]x) C, t' = t + dt; 0 unless all six are determined */
  double rms_mm;
  double sigma_mm; /* sqrt(sum d^2 / (fitted - 6)); 0 below 7 points */
  bladefit_region_report leading_edge, rest;
  uint32_t improving;         /* 1: the mode's optimum still moves, or not every point was looked at since it did */
  uint32_t unproven;          /* feet whose search met its cap: then the fit is not converged */
  double tolerance_factor_mm; /* optimum of the mode: largest distance, range, smallest leading-edge tolerance (also of
                                 an infeasible constrained fit); 0 until known */
  double smallest_tolerance_mm; /* smallest leading-edge tolerance that some pose meets, the ratio kept, in the modes
                                   min_tolerance and constrained; 0 until known, and where the least-squares optimum
                                   meets the tolerances: then it is not sought */
  double stationarity;          /* relative residual of the optimum's Karush-Kuhn-Tucker conditions */
  double loss_scale_mm;         /* of the robust loss in use; 0 = none */
  bladefit_certificate certificate;
} bladefit_fit_report;

/* At least the bytes that bladefit_init() needs, as a constant for static memory, whatever else is configured:
 *   static double memory[BLADEFIT_MEMORY_BYTES(4096, BLADEFIT_LEAST_SQUARES) / sizeof(double) + 8];
 * of which the first address that BLADEFIT_MEMORY_ALIGNMENT divides is given. */
#define BLADEFIT_MEMORY_BYTES(capacity, mode) \
  (48128u + (size_t)(capacity) * ((mode) == BLADEFIT_LEAST_SQUARES ? 280u : 424u))

/* A fit in the caller's memory. */
typedef struct bladefit_handle bladefit_handle;

/* Any thread, any time. BLADEFIT_ABI_VERSION of the library. */
uint32_t bladefit_abi_version(void);

/* Any thread, any time. One English phrase for a status, never null; it lives for ever. */
const char* bladefit_status_text(bladefit_status status);

/* Any thread, any time. Whether bladefit_init() would take the design. Returns OK, NULL_ARGUMENT, MISALIGNED,
 * BAD_MAGIC, BAD_BYTE_ORDER, BAD_VERSION, BAD_LENGTH, BAD_CRC or BAD_CONTENT. Cost: linear in design_size. */
bladefit_status bladefit_design_check(const void* design, size_t design_size);

/* Any thread, any time. Bytes that bladefit_init() needs for this configuration and design; 0 when the configuration is
 * not valid or the design's head not that of an image: bladefit_init() then says why. Cost: constant. */
size_t bladefit_memory_required(const bladefit_config* config, const void* design, size_t design_size);

/* Makes a fit in `memory` and writes its handle. `design` is a design image (.bfd), 8-byte aligned; it is used in place
 * and must stay as it is while the handle is used. `memory` (BLADEFIT_MEMORY_ALIGNMENT) must not hold a fit that
 * another thread is using. Cost: linear in memory_size and design_size. Returns OK, NULL_ARGUMENT, MISALIGNED,
 * BAD_SIZE, NOT_FINITE, OUT_OF_RANGE, NOT_ENOUGH_MEMORY, BAD_MAGIC, BAD_BYTE_ORDER, BAD_VERSION, BAD_LENGTH, BAD_CRC or
 * BAD_CONTENT. */
bladefit_status bladefit_init(void* memory, size_t memory_size, const void* design, size_t design_size,
                              const bladefit_config* config, bladefit_handle** handle);

/* The handle's thread. Projects the point, adds it, moves the pose and judges; bounded work, whatever came before.
 * Returns OK, UNDERDETERMINED, MEMORY_FULL or DUPLICATE (no verdict then); NULL_ARGUMENT, MISALIGNED, BAD_SIZE,
 * BAD_HANDLE, NOT_FINITE or OUT_OF_RANGE. */
bladefit_status bladefit_push(bladefit_handle* handle, const bladefit_point* point, bladefit_verdict* verdict);

/* The handle's thread. Pushes points, such as a scan line, one after the other; the answers are the same bits as by
 * bladefit_push(). The arrays have `count` elements and do not overlap; statuses[k] becomes what bladefit_push()
 * returns for points[k]: one that is refused keeps back none of the others. Cost: that of the pushes. Returns OK, or
 * POINTS_REFUSED where a status is negative; before anything is done NULL_ARGUMENT, MISALIGNED or BAD_HANDLE. */
bladefit_status bladefit_push_many(bladefit_handle* handle, const bladefit_point* points, size_t count,
                                   bladefit_verdict* verdicts, bladefit_status* statuses);

/* The handle's thread. Takes the next verdict that a later fit has changed. Returns OK, NOT_FOUND (none waits),
 * NULL_ARGUMENT, MISALIGNED, BAD_SIZE or BAD_HANDLE. */
bladefit_status bladefit_next_revision(bladefit_handle* handle, bladefit_verdict* verdict);

/* The handle's thread. Projects up to max_points stored points again and moves the pose. Returns OK (the fit has
 * converged, and every foot was checked), UNDERDETERMINED (converged in the determined directions), MORE_WORK,
 * ITERATION_CAP; NULL_ARGUMENT, MISALIGNED or BAD_HANDLE. */
bladefit_status bladefit_refine(bladefit_handle* handle, uint32_t max_points);

/* The handle's thread. Says that no more points come: from here on bladefit_refine() uses every direction that the
 * points determine at all, however weakly. Call it once the program is finished, then bladefit_refine() until it no
 * longer returns MORE_WORK. The next bladefit_push() takes it back. Cost: constant. Returns OK, NULL_ARGUMENT,
 * MISALIGNED or BAD_HANDLE. */
bladefit_status bladefit_conclude(bladefit_handle* handle);

/* The handle's thread. Returns OK, NULL_ARGUMENT, MISALIGNED, BAD_SIZE or BAD_HANDLE. */
bladefit_status bladefit_fit(const bladefit_handle* handle, bladefit_fit_report* report);

/* The handle's thread. The present verdict of a point. Returns OK, NOT_FOUND, NULL_ARGUMENT, MISALIGNED, BAD_SIZE or
 * BAD_HANDLE. */
bladefit_status bladefit_verdict_of(const bladefit_handle* handle, uint32_t sequence, bladefit_verdict* verdict);

/* The handle's thread. Forgets all points and goes back to the start pose. Returns OK, NULL_ARGUMENT, MISALIGNED or
 * BAD_HANDLE. */
bladefit_status bladefit_reset(bladefit_handle* handle);

#ifdef __cplusplus
}
#endif

#endif
