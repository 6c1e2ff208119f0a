// SPDX-License-Identifier: BSD-3-Clause
//
// Half-spaces and slabs: the part of one within an extent is a body like others; one without end is the
// obstacle of `vericone query` and `cone`.
#pragma once

#include <vericone/cones/slab.h>
#include <optional>
#include <vector>

#include "input/body_kind.h"

namespace vericone::input {

/// half_space and slab.
std::vector<BodyKind> slab_kinds();

/// The obstacle where it is a half-space or a slab without end, taken out of the engagement: a body that
/// nobody asks for stands in its place, in the plane where the normal has two numbers. Throws InputError
/// naming the field.
std::optional<Slab> take_slab(Json& engagement);

/// Whether a body is a half-space or a slab without extent.
bool is_endless(const Json& body);
/// Such a one, in the body's own frame. Throws InputError with `path` before the field.
Slab read_endless(const Json& body, const std::string& path);

/// Whether it is one of the plane, by its normal.
bool is_flat_slab(const Json& body);
/// The part of such a one, raised as high as it is wide; it has no center. Throws as read_endless().
SceneBody read_flat_slab(const Json& body, const std::string& path);

/// The mappings in the JSON schema of bodies.
Json slab_schemas();

}  // namespace vericone::input
