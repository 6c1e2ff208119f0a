// SPDX-License-Identifier: BSD-3-Clause
//
// Places by latitude, longitude and altitude (WGS 84) in the frame of a file: docs/reference/formats.md,
// "Places on the Earth".
#pragma once

#include <Eigen/Core>
#include <string>

#include "json/json_forward.h"

namespace vericone::input {

/// On the ellipsoid of WGS 84: degrees, degrees, and metres above it, along its normal.
struct Geographic {
  double latitude = 0, longitude = 0, altitude = 0;
};

/// East, north and up of the place, metres, in the frame that stands at `origin`: straight axes, of which
/// east and north touch the ellipsoid there. To about 3e-9 m, a rounding of the Earth's radius.
Eigen::Vector3d local_place(const Geographic& place, const Geographic& origin);

/// The fields themselves where they have no `origin`. Else, in `kept`, the same without it, each mapping
/// {latitude, longitude, altitude} as [east, north, up], and one without altitude, which is then that of the
/// origin, as [east, north]. Throws InputError naming the field.
const Json& localized(const Json& fields, Json& kept);

/// The row `origin` of the fields of scenes and cases.
inline constexpr const char* kOriginSentence =
    "Where the file's frame stands on the Earth, x east, y north and z up: places may then be written "
    "`{latitude, longitude, altitude}`, below.";
Json origin_schema();
/// For #/$defs/place of the schema of bodies.
Json place_schema();

/// "latitude 52, longitude 4, altitude 0 m" of an `origin` that localized() takes.
std::string origin_words(const Json& origin);

}  // namespace vericone::input
