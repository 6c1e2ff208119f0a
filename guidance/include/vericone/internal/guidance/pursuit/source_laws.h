// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of the source's laws of pursuit.
#pragma once

#include <vericone/guidance/pursuit/source_laws.h>

namespace vericone::guidance {

/// Brings each component to at most `most`, m/s^2, and says so. Throws InputError naming "most" below 0.
void saturate(PursuitCommand& command, double most);

/// phi of (4.17), px: of a picture `width` px wide with this field of view, rad.
[[nodiscard]] double focal_length(double width, double field_of_view);

/// u_S of (4.23), m/s^2 up, with phi x_W / x_S = z of (4.19), so that no focal length is needed. size > 0,
/// px.
[[nodiscard]] double size_acceleration(double size, double size_rate, double altitude,
                                       const VerticalGains& gains);

/// (4.24), its second sign corrected, m/s^2 up.
[[nodiscard]] double altitude_acceleration(double wanted, double altitude, double climb, double p, double d);

}  // namespace vericone::guidance
