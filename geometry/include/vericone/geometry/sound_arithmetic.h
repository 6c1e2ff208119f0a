// SPDX-License-Identifier: BSD-3-Clause
//
// The arithmetic on which every bound of this library rests: doubles of IEEE 754, each operation rounded to
// nearest. Options of a compiler take that away, and so do other parts of a program: what is linked with
// -ffast-math flushes subnormal numbers to zero for all, and anyone may set another rounding. What a compiler
// tells of itself ends the compilation here; require_sound_arithmetic() finds the rest.
#pragma once

#include <cfloat>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "vericone: -ffast-math reorders sums and assumes infinities away, so that answers may be wrong"
#endif
#if FLT_EVAL_METHOD != 0
#error "vericone: results have more than double precision (x87), so that answers may be wrong; use SSE2"
#endif

namespace vericone {
namespace detail {

/// What is wrong with the arithmetic of this thread, as compiled where this is inlined; null where nothing
/// is.
[[nodiscard]] [[gnu::always_inline]] inline const char* arithmetic_fault() noexcept {
  // Read when the program runs, so that no compiler knows the results before.
  const volatile double unit = 1, least_normal = DBL_MIN, subnormal = 0x1p-1060;
  const double one = unit;
  if (!(least_normal * 0.5 > 0 && subnormal * 0x1p100 > 0))
    return "subnormal numbers flushed to zero, as a part linked with -ffast-math does";
  if ((one + 0x1p-54) - one == 0x1p-54) return "sums reordered or of more than double precision";
  const double x = one + 0x1p-30;  // x x = 1 + 2^-29 + 2^-60 does not fit
  if (x * x - (one + 0x1p-29) == 0x1p-60) return "products fused into sums (-ffp-contract=off is missing)";
  if (one + 0x1p-54 != one || -one - 0x1p-54 != -one || one + 0x1.8p-53 == one)
    return "another rounding than to nearest";
  return nullptr;
}

}  // namespace detail

/// Throws InputError naming "arithmetic of the program" or "arithmetic of the library" where it does not keep
/// what the bounds rest on. For the start of a program, and of a thread whose rounding others may have set:
/// rounding and flushing belong to a thread. `of_caller` is left out: its default is compiled where this is
/// called, with the options of that file. Cost: docs/howto/building.md.
void require_sound_arithmetic(const char* of_caller = detail::arithmetic_fault());

}  // namespace vericone
