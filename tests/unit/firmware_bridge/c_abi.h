/* The part of the C interface's test that is written in C. */
#ifndef BLADEFIT_TESTS_UNIT_BRIDGE_C_ABI_H
#define BLADEFIT_TESTS_UNIT_BRIDGE_C_ABI_H

#include "firmware_bridge/bladefit.h"
#include "firmware_bridge/bladefit_zones.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A whole session as a controller would run it. `points` holds count times x, y, z, i, j, k [mm]; `memory` is aligned.
 * Returns the status of the last refinement, or the first failure. */
bladefit_status c_session(void* memory, size_t memory_size, const void* design, size_t design_size,
                          const double* points, uint32_t count, bladefit_fit_report* report, uint32_t* verdicts,
                          uint32_t* revisions);

/* The same with zones of their own tolerances in the mode `mode`; *zones[k]: how many verdicts were of zone k, 0 for
 * the rest. */
bladefit_status c_zoned_session(void* memory, size_t memory_size, const void* design, size_t design_size,
                                const double* points, uint32_t count, uint32_t mode, bladefit_fit_report* report,
                                uint32_t zones[3]);

/* The default configuration as C sees it. */
bladefit_config c_defaults(void);

#ifdef __cplusplus
}
#endif

#endif
