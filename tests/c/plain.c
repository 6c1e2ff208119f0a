/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The header as C99 has it, and what C says of its structs. */
#include <vericone_c.h>

size_t sizes_in_c(size_t* list);
size_t sizes_in_c(size_t* list) {
  size_t n = 0;
  list[n++] = sizeof(vericone_hyperboloid);
  list[n++] = sizeof(vericone_contact);
  list[n++] = sizeof(vericone_miss);
  list[n++] = sizeof(vericone_barrier);
  list[n++] = sizeof(vericone_sector);
  list[n++] = sizeof(vericone_moving);
  list[n++] = sizeof(vericone_command);
  list[n++] = sizeof(vericone_band_options);
  list[n++] = sizeof(vericone_band);
  list[n++] = sizeof(vericone_course);
  list[n++] = sizeof(vericone_avoid_options);
  list[n++] = sizeof(vericone_avoidance);
  return n;
}
