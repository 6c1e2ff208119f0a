// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/geometry/sound_arithmetic.h>

namespace vericone {

void require_sound_arithmetic(const char* of_caller) {
  constexpr const char* kRequirement =
      "that of IEEE 754, each operation on doubles rounded to nearest (docs/howto/building.md)";
  if (const char* fault = detail::arithmetic_fault())
    throw InputError("arithmetic of the library", fault, kRequirement);
  if (of_caller) throw InputError("arithmetic of the program", of_caller, kRequirement);
}

}  // namespace vericone
