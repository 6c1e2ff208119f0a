// SPDX-License-Identifier: BSD-3-Clause
//
// What one engagement leads to: the verdict, the clearance and the time, for bodies of every kind.
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/cones/motion.h>
#include <vericone/cones/slab.h>
#include <vericone/scenes/scene.h>

#include "json/json_forward.h"

namespace vericone {

/// {"verdict", ["rung"], "clearance", "time_to_contact", ...} as docs/reference/formats.md says. The verdict
/// is that within the horizon, all else as without one.
Json answer(const scenes::Scene& scene, bool with_rung, const Horizon& horizon = {});

/// The same of bodies that spin, accelerate or brake: certified (vericone/cones/motion.h).
Json motion_answer(const scenes::Scene& scene, const BodyMotion& agent, const BodyMotion& obstacle,
                   const Horizon& horizon, bool with_rung);

/// The same of a slab in place of the scene's obstacle, with its velocity; exact. Throws InputError naming
/// "horizon" for one that begins later.
Json slab_answer(const scenes::Scene& scene, const Slab& slab, const Horizon& horizon, bool with_rung);

/// When two bodies that miss are nearest, seconds; nothing is proved of it. Of two combined quadrics 5 to 50
/// ms; NaN where their squared lengths are no doubles.
double nearest_time(const Pair& pair, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b);

/// Why a verdict can be relied on: "exact" or "certified".
const char* verdict_kind(const scenes::Scene& scene);

}  // namespace vericone
