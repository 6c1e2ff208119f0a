// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's ways to compute a sector, in the form that a planar campaign takes.
#pragma once

#include <vericone/verify/planar/campaign.h>

namespace vericone::verify {

/// sector_by_support: always answers.
[[nodiscard]] PlanarAnswer answer_by_support(const Ellipse& a, const Ellipse& b);

/// sector_by_degenerate_conics: declines where that does.
[[nodiscard]] PlanarAnswer answer_by_degenerate_conics(const Ellipse& a, const Ellipse& b);

}  // namespace vericone::verify
