// SPDX-License-Identifier: BSD-3-Clause
//
// A body as a list of doubles and back, bit for bit: to hand it to another process or machine.
#pragma once

#include <vericone/geometry/body.h>
#include <span>
#include <vector>

namespace vericone {

/// All that defines the body, in its own frame, metres: which of Body::Shape it is, then its parts, lists
/// after their lengths (body_numbers.cpp). A mesh 9 numbers a triangle.
[[nodiscard]] std::vector<double> body_numbers(const Body& body);

/// The body of these numbers: every answer about it is that about the other one. Throws InputError naming
/// "numbers[i]" where they are not those of a body.
[[nodiscard]] Body body_of_numbers(std::span<const double> numbers);

}  // namespace vericone
