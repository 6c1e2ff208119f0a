// SPDX-License-Identifier: BSD-3-Clause
//
// Half-spaces and slabs: no bodies, and the obstacle of `vericone query` alone.
#pragma once

#include <vericone/cones/slab.h>
#include <optional>

#include "input/body.h"

namespace vericone::input {

/// The obstacle where it is a half-space or a slab, taken out of the engagement: a body that nobody asks for
/// stands in its place, in the plane where the normal has two numbers. Throws InputError naming the field.
std::optional<Slab> take_slab(Json& engagement);

/// For readers of bodies. Throws InputError with `path` before the field.
void refuse_slab(const Json& body, const std::string& path);

/// Fields of the JSON schema of bodies, and the mappings in it.
Json slab_schema();
Json slab_schemas();

}  // namespace vericone::input
