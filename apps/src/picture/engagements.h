// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/scenes/scene.h>

#include "json/json_forward.h"

namespace vericone {

/// The source's Fig 6.6: an ellipsoid and a body with dents (about the origin; it is placed and turned here),
/// their section by one plane through the line of centres with its corners and common tangents, and the cone
/// of many such planes beside the true one. `resolution` of the surfaces.
Json section_figure(const CombinedEllipsoid& dented, double resolution);

/// A small ball before a body with a waist: the true cone has notches that the cone of the convex hulls has
/// not, and a velocity in a notch passes the waist.
Json notch_figure(const CombinedEllipsoid& waisted, double resolution);

/// The engagement of a scene: bodies, certified cone, slice cone, and the course of its velocities where they
/// differ (course.h). Null where the cone reaches a right angle from the line of centres: it has no section
/// then.
Json scene_figure(const scenes::Scene& scene, double tolerance, int planes);

/// What the picture of one engagement shows: both bodies, the slice cone inside the exact one, and a velocity
/// between the two with the contact it leads to; the scene's own velocities too, where they differ
/// (course.h). Requires disjoint ellipsoids.
Json engagement_picture(const scenes::Scene& scene, int planes, int samples);

}  // namespace vericone
