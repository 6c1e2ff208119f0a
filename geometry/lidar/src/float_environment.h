// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cfenv>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace vericone::lidar {

/// Puts rounding mode, flushing of subnormals and exception flags back as they were: Embree may change them,
/// and predicates rest on them.
class FloatEnvironment {
 public:
#if defined(__SSE__)
  FloatEnvironment() : saved_(_mm_getcsr()) {}
  ~FloatEnvironment() { _mm_setcsr(saved_); }
#else
  FloatEnvironment() { std::fegetenv(&saved_); }
  ~FloatEnvironment() { std::fesetenv(&saved_); }
#endif
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
#if defined(__SSE__)
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

}  // namespace vericone::lidar
