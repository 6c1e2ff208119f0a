/* Preloaded into the compiler (VericoneTarget.cmake): where the kernel gives huge pages only to those who ask
   (transparent_hugepage "madvise"), this asks. g++ maps what it collects in pieces of 2 MB, and precompiled headers,
   which are read instead, as pages of a file are small. */
#define _GNU_SOURCE
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

static void* mapped(void* address, size_t size, int protection, int flags, int file, off_t offset)
{
  return (void*)syscall(SYS_mmap, address, size, protection, flags, file, offset);
}

static int read_whole(char* to, size_t size, int file, off_t offset)
{
  while (size > 0) {
    const ssize_t got = pread(file, to, size, offset);
    if (got <= 0) return 0;
    to += got;
    size -= (size_t)got;
    offset += got;
  }
  return 1;
}

void* mmap(void* address, size_t size, int protection, int flags, int file, off_t offset)
{
  const int header = file >= 0 && address && size > (16 << 20) && flags == MAP_PRIVATE &&
                     protection == (PROT_READ | PROT_WRITE);
  if (header) {
    void* copy = mapped(address, size, protection, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (copy != MAP_FAILED) {
      madvise(copy, size, MADV_HUGEPAGE);
      if (read_whole(copy, size, file, offset)) return copy;
      munmap(copy, size);
    }
  }
  void* const at = mapped(address, size, protection, flags, file, offset);
  if (at != MAP_FAILED && (flags & MAP_ANONYMOUS) && size >= 65536) madvise(at, size, MADV_HUGEPAGE);
  return at;
}
