// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "planar/conics.h"

namespace vericone::verify::planar {

/// Whether two bodies, the centre of B at c from that of A, have no common point. Proved; nothing where
/// pieces of the boundary cannot be made small enough. Wants a Protector.
std::optional<bool> separated(const std::vector<Conic<Interval>>& a, const std::vector<Conic<Interval>>& b,
                              const Point<Interval>& c);

}  // namespace vericone::verify::planar
