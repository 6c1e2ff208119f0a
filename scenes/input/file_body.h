// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies named by files, and unions of bodies: in scenes, cases and scenarios alike.
#pragma once

#include "input/body.h"

namespace vericone::input {

/// The fields of a body. Where `value` is {file: NAME}, those of the file: a body, or the `pieces` or the
/// `obstacle` that `vericone fit` wrote; names of files in it are then relative to `folder`. With `center`
/// and `rotation` beside `file` the file's own origin comes to stand there. Throws InputError with `path`
/// before the field.
Json body_fields(const Json& value, const std::string& path, const std::filesystem::path& folder);

/// SceneBody::fields of what body_fields() takes; a velocity beside it is left out.
std::string remembered_fields(const Json& value, const std::string& path,
                              const std::filesystem::path& folder);

/// Whether the fields say that the body is a union.
bool is_union(const Json& value);

/// The union of ellipsoids and delimited ones, or of convex hulls: `pieces`, a list of bodies or the name of
/// a file that has one, in a frame of their own that `center` and `rotation` place. Throws InputError.
Placed read_union(const Json& value, const std::string& path, const std::filesystem::path& folder);

/// What the JSON schema of bodies says of the two.
Json file_body_schema();
Json union_schema();

}  // namespace vericone::input
