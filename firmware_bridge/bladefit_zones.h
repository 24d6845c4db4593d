/* Parts of the blade with tolerances of their own, beside bladefit.h and under its rules for arguments, threads and
 * memory.
 *
 *   bladefit_init(memory, size, design, design_size, &config, &handle);
 *   bladefit_set_zones(handle, zones, count, NULL);
 *   for each point: bladefit_push(handle, &point, &verdict); bladefit_zone_of(handle, point.sequence, &zone); */
#ifndef BLADEFIT_FIRMWARE_BRIDGE_BLADEFIT_ZONES_H
#define BLADEFIT_FIRMWARE_BRIDGE_BLADEFIT_ZONES_H

#include "bladefit.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BLADEFIT_MAX_ZONES 16u       /* zones of bladefit_set_zones() */
#define BLADEFIT_MAX_ZONE_BOXES 128u /* boxes of all its zones together */

/* A bladefit_status beside those of bladefit.h: there are points already. */
enum { BLADEFIT_TOO_LATE = -10 };

/* A part of the blade with tolerances of its own: its boxes, a band of radii about the shaft, or those boxes within
 * that band. */
typedef struct bladefit_zone {
  uint32_t struct_size;      /* sizeof(bladefit_zone) */
  uint32_t region;           /* BLADEFIT_REST or _LEADING_EDGE: where its points are summed up */
  const bladefit_box* boxes; /* box_count of them, read during the call alone; null where box_count is 0 */
  uint32_t box_count;        /* 0: the whole band */
  uint32_t reserved;         /* 0 */
  double radius_low_mm;      /* >= 0; of the band, limits included */
  double radius_high_mm;     /* above radius_low_mm; INFINITY = no end */
  double plus_mm;            /* > 0; excess material that is allowed, beyond it is cut; INFINITY = not judged */
  double minus_mm;           /* > 0; missing material that is allowed, beyond it is welded; INFINITY = not judged */
} bladefit_zone;

/* The axis of the shaft, from which the radii of zones are measured [design coordinates]. */
typedef struct bladefit_axis {
  uint32_t struct_size; /* sizeof(bladefit_axis) */
  uint32_t reserved;    /* 0 */
  double point[3];      /* [mm] */
  double direction[3];  /* unit vector */
} bladefit_axis;

/* The handle's thread, before the first point or after bladefit_reset(). Sets zones, 1..BLADEFIT_MAX_ZONES of them by
 * falling precedence: a foot has the tolerances of the first zone that it lies in, outside of all rest_tolerance_mm on
 * both sides. Boxes, leading_edge_tolerance_mm and ratio of the configuration play no part any more; transition must be
 * 0. Zones stay over bladefit_reset(). Those set before are gone; to have none, call bladefit_init().
 * BLADEFIT_MIN_TOLERANCE then finds the smallest multiple of all tolerances, rest included, that some pose meets, and
 * BLADEFIT_CONSTRAINED keeps every distance from -minus_mm to plus_mm of its zone: both need a finite
 * rest_tolerance_mm, and limits of a zone that are finite on both sides or on none; tolerance_factor_mm and
 * smallest_tolerance_mm then tell what becomes of the tightest tolerance of the leading edge, or where none is set
 * there of the rest, with all others in proportion. A verdict's tolerance_mm is the limit on the side of its distance.
 * `axis` null: the x axis. Cost: linear in the capacity; no more memory than before. Returns OK, NULL_ARGUMENT,
 * MISALIGNED, BAD_SIZE, BAD_HANDLE, NOT_FINITE, OUT_OF_RANGE or TOO_LATE. */
bladefit_status bladefit_set_zones(bladefit_handle* handle, const bladefit_zone* zones, uint32_t count,
                                   const bladefit_axis* axis);

/* The handle's thread. Zone of a point's present verdict: k + 1 for zones[k], 0 for the rest. Returns OK, NOT_FOUND,
 * NULL_ARGUMENT, MISALIGNED or BAD_HANDLE. Cost: logarithmic. */
bladefit_status bladefit_zone_of(const bladefit_handle* handle, uint32_t sequence, uint32_t* zone);

#ifdef __cplusplus
}
#endif

#endif
