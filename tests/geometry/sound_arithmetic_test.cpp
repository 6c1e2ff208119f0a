// SPDX-License-Identifier: BSD-3-Clause
//
// What other parts of a program do to a thread is noticed. What compilers do: sound_arithmetic.cmake.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/sound_arithmetic.h>

#include <cfenv>
#include <string>
#include <thread>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace vericone::sound_arithmetic_test {
namespace {

/// The line of the refusal, empty where there is none.
[[gnu::noinline]] std::string refusal() {
  try {
    require_sound_arithmetic();
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(SoundArithmetic, IsThatOfThisBuild) { EXPECT_EQ(refusal(), ""); }

TEST(SoundArithmetic, NoticesAnotherRounding) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    ASSERT_EQ(std::fesetround(mode), 0);
    const std::string line = refusal();
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(
        line,
        "arithmetic of the library: got another rounding than to nearest, must be that of IEEE 754, each "
        "operation on doubles rounded to nearest (docs/howto/building.md)")
        << mode;
  }
  EXPECT_EQ(refusal(), "");
}

#if defined(__SSE2__)
TEST(SoundArithmetic, NoticesNumbersFlushedToZero) {
  for (const unsigned flush : {0x8000U, 0x0040U}) {  // results to zero, operands to zero
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | flush);
    const std::string line = refusal();
    _mm_setcsr(before);
    EXPECT_NE(line.find("subnormal numbers flushed to zero"), std::string::npos) << line;
  }
  EXPECT_EQ(refusal(), "");
}
#endif

TEST(SoundArithmetic, IsAskedOfTheThreadThatCalls) {
  std::string here, there;
  std::thread([&] {
    std::fesetround(FE_UPWARD);
    there = refusal();
  }).join();
  here = refusal();
  EXPECT_EQ(here, "");
  EXPECT_NE(there, "");
}

}  // namespace
}  // namespace vericone::sound_arithmetic_test
