// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/slab.h>
#include <vericone/scenes/scene.h>
#include <iosfwd>

#include "json/json_forward.h"

namespace vericone {

struct ConeCommand;

/// The cone before a slab in place of the scene's obstacle, which has its velocity: an open half-space of
/// directions, or of parts on both sides all that are not along the slab. Throws InputError naming an option
/// that asks for more.
void run_slab_cone(const ConeCommand& options, const scenes::Scene& scene, const Slab& slab,
                   std::ostream& out);

}  // namespace vericone
