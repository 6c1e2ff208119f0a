// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone::round {

/// Thrown where the last rung has no answer about a pair of pieces, and caught where one about the whole
/// bodies is given: that is then `undecided`.
struct Undecided {};

}  // namespace vericone::round
