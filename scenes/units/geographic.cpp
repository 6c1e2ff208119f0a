// SPDX-License-Identifier: BSD-3-Clause
#include "units/geographic.h"

#include <vericone/internal/scenes/words.h>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "input/field_table.h"
#include "json/json_value.h"

namespace vericone::input {
namespace {

struct PlaceOnEarth {
  double latitude = 0, longitude = 0;
  std::optional<double> altitude;
};

const Fields<PlaceOnEarth>& place_fields() {
  using P = PlaceOnEarth;
  static const Fields<P> fields =
      Fields<P>("place")
          .row("latitude", &P::latitude,
               checked<double>(number("degrees"), "between -90 and 90 (degrees)",
                               [](const double& x) { return std::abs(x) <= 90; }),
               "North of the equator.", required("between -90 and 90 (degrees)"))
          .row("longitude", &P::longitude,
               checked<double>(number("degrees"), "between -180 and 180 (degrees)",
                               [](const double& x) { return std::abs(x) <= 180; }),
               "East of Greenwich.", required("between -180 and 180 (degrees)"))
          .row("altitude", &P::altitude,
               checked<double>(number("m"), "between -1e8 and 1e8 (metres)",
                               [](const double& x) { return std::abs(x) <= 1e8; }),
               "Above the ellipsoid, not above the sea, which lies up to 107 m beside it.",
               absent("a place in the plane; of an origin 0"));
  return fields;
}

/// Of an angle in degrees, right to the last digits where it is a whole quarter of a turn.
std::pair<double, double> sine_and_cosine(double degrees) {
  const double quarters = std::round(degrees / 90);
  const double rest = (degrees - 90 * quarters) * (std::numbers::pi / 180);
  const double s = std::sin(rest), c = std::cos(rest);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// From the Earth's middle: x towards latitude 0, longitude 0, z towards the north pole.
Eigen::Vector3d from_earth_middle(const Geographic& place) {
  constexpr double kEquator = 6'378'137, kFlattening = 1 / 298.257223563;  // WGS 84
  constexpr double kSquared = kFlattening * (2 - kFlattening);             // eccentricity squared
  const auto [sin_lat, cos_lat] = sine_and_cosine(place.latitude);
  const auto [sin_lon, cos_lon] = sine_and_cosine(place.longitude);
  const double across = kEquator / std::sqrt(1 - kSquared * sin_lat * sin_lat);  // to the axis, on the normal
  const double from_axis = (across + place.altitude) * cos_lat;
  return {from_axis * cos_lon, from_axis * sin_lon, (across * (1 - kSquared) + place.altitude) * sin_lat};
}

Geographic read_origin(const Json& value) {
  const PlaceOnEarth read = place_fields().read(value, "origin");
  return {read.latitude, read.longitude, read.altitude.value_or(0)};
}

void localize(Json& value, const std::string& path, const Geographic& origin) {
  if (value.is_object() && (value.contains("latitude") || value.contains("longitude"))) {
    const PlaceOnEarth read = place_fields().read(value, path);
    const Eigen::Vector3d place =
        local_place({read.latitude, read.longitude, read.altitude.value_or(origin.altitude)}, origin);
    value = read.altitude ? vector_json(place) : vector_json(place.head<2>());
  } else if (value.is_object()) {
    for (const auto& item : value.items()) localize(item.value(), join(path, item.key().c_str()), origin);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      if (value[i].is_structured()) localize(value[i], at(path, i), origin);
  }
}

}  // namespace

Eigen::Vector3d local_place(const Geographic& place, const Geographic& origin) {
  const Eigen::Vector3d d = from_earth_middle(place) - from_earth_middle(origin);
  const auto [sin_lat, cos_lat] = sine_and_cosine(origin.latitude);
  const auto [sin_lon, cos_lon] = sine_and_cosine(origin.longitude);
  const double outwards = cos_lon * d.x() + sin_lon * d.y();  // in the plane of the equator
  return {cos_lon * d.y() - sin_lon * d.x(), cos_lat * d.z() - sin_lat * outwards,
          cos_lat * outwards + sin_lat * d.z()};
}

const Json& localized(const Json& fields, Json& kept) {
  if (!fields.is_object() || !fields.contains("origin")) return fields;
  const Geographic origin = read_origin(fields["origin"]);
  kept = fields;
  kept.erase("origin");
  localize(kept, "", origin);
  return kept;
}

Json origin_schema() { return {{"$ref", "body.schema.json#/$defs/place"}}; }

Json place_schema() { return place_fields().schema(); }

std::string origin_words(const Json& value) {
  const Geographic origin = read_origin(value);
  return "latitude " + to_text(origin.latitude) + ", longitude " + to_text(origin.longitude) + ", altitude " +
         scenes::brief(origin.altitude) + " m; x east, y north, z up";
}

}  // namespace vericone::input
