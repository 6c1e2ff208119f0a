/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The program's malloc is that of its shared libraries too: here each call is counted. */
#include <stddef.h>

void* __libc_malloc(size_t size);
void* __libc_realloc(void* p, size_t size);
void* __libc_calloc(size_t count, size_t size);
size_t counted(void);

static size_t calls;
size_t counted(void) { return __atomic_load_n(&calls, __ATOMIC_RELAXED); }
static void count(void) { __atomic_fetch_add(&calls, 1, __ATOMIC_RELAXED); }

void* malloc(size_t size) {
  count();
  return __libc_malloc(size);
}
void* realloc(void* p, size_t size) {
  count();
  return __libc_realloc(p, size);
}
void* calloc(size_t n, size_t size) {
  count();
  return __libc_calloc(n, size);
}
