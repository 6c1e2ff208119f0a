// SPDX-License-Identifier: BSD-3-Clause
//
// What one engagement leads to: the verdict, the clearance and the time, for bodies of every kind.
#pragma once

#include <vericone/cones/assembly/assembly_oracle.h>

#include "input/body.h"

namespace vericone {

/// {"verdict", ["rung"], "clearance", "time_to_contact", ...} as docs/formats.md says.
Json answer(const input::AnyEngagement& engagement, bool with_rung);

/// The agent and the body of an engagement, prepared for many velocities.
AssemblyOracle assembly_oracle(const input::AssemblyEngagement& engagement);

/// Why a verdict can be relied on: "exact" or "certified".
const char* verdict_kind(const input::AnyEngagement& engagement);

/// A planar engagement as a spatial one: each body gets a third semi-axis, along z and no shorter than all
/// others, and its hyperbolas become cylinders. At every height the section is contained in the one at z = 0,
/// so relation, verdict and contact time of bodies that move in the plane are those of the planar bodies, and
/// for ellipses the signed distance of their shadows is as well: it has its largest value at a normal in the
/// plane.
input::Engagement raised(const input::PlanarEngagement& engagement);

}  // namespace vericone
