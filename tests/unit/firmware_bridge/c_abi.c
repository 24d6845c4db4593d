#include "tests/unit/firmware_bridge/c_abi.h"

#include <string.h>

bladefit_config c_defaults(void) {
  const bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
  return config;
}

static bladefit_status push_all(bladefit_handle* handle, const double* points, uint32_t count, uint32_t* verdicts,
                                uint32_t* revisions) {
  bladefit_verdict verdict;
  uint32_t index;
  memset(&verdict, 0, sizeof verdict);
  verdict.struct_size = (uint32_t)sizeof verdict;
  for (index = 0; index < count; ++index) {
    bladefit_point point;
    bladefit_status status;
    memset(&point, 0, sizeof point);
    point.struct_size = (uint32_t)sizeof point;
    point.sequence = index + 1;
    memcpy(point.position, points + 6 * index, sizeof point.position);
    memcpy(point.approach, points + 6 * index + 3, sizeof point.approach);
    status = bladefit_push(handle, &point, &verdict);
    if (status < 0) return status;
    if (verdict.sequence == index + 1) ++*verdicts;
    while (bladefit_next_revision(handle, &verdict) == BLADEFIT_OK) ++*revisions;
  }
  return BLADEFIT_OK;
}

bladefit_status c_session(void* memory, size_t memory_size, const void* design, size_t design_size,
                          const double* points, uint32_t count, bladefit_fit_report* report, uint32_t* verdicts,
                          uint32_t* revisions) {
  bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
  bladefit_handle* handle = NULL;
  bladefit_status status;
  config.capacity = 4096;
  config.box_count = 1;
  config.boxes[0].u_min = 0.4;
  config.boxes[0].u_max = 0.6;
  config.boxes[0].v_max = 1.0;
  config.leading_edge_tolerance_mm = 0.1;
  config.rest_tolerance_mm = 0.2;
  if (bladefit_memory_required(&config, design, design_size) > memory_size) return BLADEFIT_NOT_ENOUGH_MEMORY;
  status = bladefit_init(memory, memory_size, design, design_size, &config, &handle);
  if (status != BLADEFIT_OK) return status;
  status = push_all(handle, points, count, verdicts, revisions);
  if (status != BLADEFIT_OK) return status;
  status = bladefit_conclude(handle);
  if (status != BLADEFIT_OK) return status;
  do {
    status = bladefit_refine(handle, 1000);
  } while (status == BLADEFIT_MORE_WORK);
  report->struct_size = (uint32_t)sizeof *report;
  return bladefit_fit(handle, report) == BLADEFIT_OK ? status : BLADEFIT_BAD_HANDLE;
}
