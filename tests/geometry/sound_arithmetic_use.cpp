// SPDX-License-Identifier: BSD-3-Clause
//
// A program that asks whether its arithmetic is sound: sound_arithmetic.cmake compiles and links it with
// options that make it so and with others.
#include <vericone/geometry/error.h>
#include <vericone/geometry/sound_arithmetic.h>

#include <cstdio>

int main() try {
  vericone::require_sound_arithmetic();
  return 0;
} catch (const vericone::InputError& e) {
  std::puts(e.what());
  return 1;
}
