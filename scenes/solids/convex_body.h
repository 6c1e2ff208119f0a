// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that a word and its sizes give: cylinders, capsules, cones, frusta, boxes, discs; and margins.
#pragma once

#include <vector>

#include "input/body_kind.h"

namespace vericone::input {

/// cylinder, capsule, cone, frustum, box, disc: one line more of convex_body.cpp is a kind more.
std::vector<BodyKind> convex_kinds();

/// Their mappings of sizes, for the JSON schema of bodies: {"cylinder": ...}.
Json convex_schemas();

/// The body without its field `margin`, swollen by it. Throws InputError naming the field within the body.
SceneBody with_margin(SceneBody body, double margin);

/// The fields that give it, without its place: {"cylinder": {"radius", "height"}, "margin"}; null where no
/// word does to the bit.
Json word_fields(const Convex& body);

}  // namespace vericone::input
