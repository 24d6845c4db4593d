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

static bladefit_status set_two_zones(bladefit_handle* handle) {
  const bladefit_box edge = {0.4, 0.6, 0.0, 1.0, 0u, 0u};
  const bladefit_axis axis = {(uint32_t)sizeof axis, 0u, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  bladefit_zone zones[2];
  memset(zones, 0, sizeof zones);
  zones[0].struct_size = zones[1].struct_size = (uint32_t)sizeof zones[0];
  zones[0].region = BLADEFIT_LEADING_EDGE;
  zones[0].boxes = &edge;
  zones[0].box_count = 1;
  zones[0].plus_mm = 0.06;
  zones[0].minus_mm = 0.03;
  zones[1].radius_low_mm = 100.0;
  zones[1].plus_mm = 0.3;
  zones[1].minus_mm = 0.15;
  zones[0].radius_high_mm = zones[1].radius_high_mm = INFINITY;
  return bladefit_set_zones(handle, zones, 2, &axis);
}

bladefit_status c_zoned_session(void* memory, size_t memory_size, const void* design, size_t design_size,
                                const double* points, uint32_t count, uint32_t mode, bladefit_fit_report* report,
                                uint32_t zones[3]) {
  bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
  bladefit_handle* handle = NULL;
  bladefit_status status;
  uint32_t verdicts = 0, revisions = 0, index;
  config.capacity = 4096;
  config.mode = mode;
  config.rest_tolerance_mm = 0.25;
  status = bladefit_init(memory, memory_size, design, design_size, &config, &handle);
  if (status != BLADEFIT_OK) return status;
  status = set_two_zones(handle);
  if (status != BLADEFIT_OK) return status;
  status = push_all(handle, points, count, &verdicts, &revisions);
  if (status != BLADEFIT_OK) return status;
  if (set_two_zones(handle) != BLADEFIT_TOO_LATE) return BLADEFIT_BAD_HANDLE;
  status = bladefit_conclude(handle);
  if (status != BLADEFIT_OK) return status;
  do {
    status = bladefit_refine(handle, 1000);
  } while (status == BLADEFIT_MORE_WORK);
  for (index = 1; index <= verdicts; ++index) {
    uint32_t zone = 3;
    if (bladefit_zone_of(handle, index, &zone) != BLADEFIT_OK || zone > 2) return BLADEFIT_NOT_FOUND;
    ++zones[zone];
  }
  report->struct_size = (uint32_t)sizeof *report;
  return bladefit_fit(handle, report) == BLADEFIT_OK ? status : BLADEFIT_BAD_HANDLE;
}
