// SPDX-License-Identifier: BSD-3-Clause
//
// What a function asks of its caller with "Requires ..." in its comment, checked where assertions are: in the
// presets dev and asan-ubsan, and wherever else NDEBUG is not defined. In release it costs nothing. What
// comes from users is never left to this: it throws InputError (error.h). Of what Python can call, a
// requirement says what breaks it too: VERICONE_REQUIRES(i < size(), "i", "no such piece", "below size()");
// the binding reads that (python/generate/requirements.py) and refuses by the same words.
#pragma once

namespace vericone::detail {

/// Tells which function requires what, in one line on standard error, and ends the program.
[[noreturn]] void requirement_broken(const char* function, const char* requirement) noexcept;

}  // namespace vericone::detail

#ifdef NDEBUG
#define VERICONE_REQUIRES(condition, ...) static_cast<void>(sizeof(static_cast<bool>(condition)))
#else
#define VERICONE_REQUIRES(condition, ...) \
  ((condition) ? static_cast<void>(0) : ::vericone::detail::requirement_broken(__func__, #condition))
#endif
