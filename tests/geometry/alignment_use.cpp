// SPDX-License-Identifier: BSD-3-Clause
//
// A program that knows a body: alignment.cmake compiles it with the library's options and with others.
#include <vericone/geometry/ellipsoid.h>

int main() { return vericone::Ellipse::from_axes({0, 0}, {1, 2}).defined_by_factor() ? 0 : 1; }
