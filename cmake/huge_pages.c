/* Preloaded into the compiler (VericoneTarget.cmake): where the kernel gives huge pages only to those who ask
   (transparent_hugepage "madvise"), this asks. g++ maps what it collects in pieces of 2 MB. */
#define _GNU_SOURCE
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

void* mmap(void* address, size_t size, int protection, int flags, int file, off_t offset)
{
  void* mapped = (void*)syscall(SYS_mmap, address, size, protection, flags, file, offset);
  if (mapped != MAP_FAILED && (flags & MAP_ANONYMOUS) && size >= 65536)
    madvise(mapped, size, MADV_HUGEPAGE);
  return mapped;
}
