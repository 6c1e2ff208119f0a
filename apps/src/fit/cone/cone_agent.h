// SPDX-License-Identifier: BSD-3-Clause
//
// The argument of `vericone fit FILE --cone AGENT`: who is to keep clear of the scanned object.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/geometry/ellipsoid.h>
#include <optional>
#include <string>
#include <vector>

namespace vericone {

struct ConeAgent {
  Ellipsoid body;    // in the scan's coordinates, metres
  std::string text;  // for people
};

/// One agent, or several to be spread about a scan that is not known yet.
struct ConeRequest {
  std::vector<ConeAgent> agents;  // one, or none where `around` is set
  int around = 0;                 // balls of a quarter of the scan's radius about it
  double distance = 2;            // of their centres from the scan's, in its radii
};

/// "x,y,z,radius" (a ball), "around:N" or "around:N:DISTANCE" (agents spread evenly), or the name of a YAML
/// or JSON file whose field `agent`, or else whose whole content, is an ellipsoid with the fields of a scene.
/// Throws InputError naming "--cone".
ConeRequest read_cone_request(const std::string& argument);

/// The first two forms; nothing where the argument has neither form.
std::optional<ConeRequest> parse_cone_request(const std::string& argument);

/// The agents themselves. The scan's centre is that of its bounds, its radius the largest distance of one of
/// its points from there. Directions: the Fibonacci spiral about z.
std::vector<ConeAgent> agents_of(const ConeRequest& request, const fitting::Sample& scan);

}  // namespace vericone
