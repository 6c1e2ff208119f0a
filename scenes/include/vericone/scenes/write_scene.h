// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes and bodies to files (docs/reference/formats.md), so that reading gives the same to the bit.
#pragma once

#include <vericone/scenes/scene.h>
#include <filesystem>

namespace vericone::scenes {

/// Writes a scene that read_scene() reads as the same: the same bodies, poses and velocities, bit for bit. A
/// body that a file gave is written as that file gave it, with names of files relative to the new one's
/// folder. Others are written by their numbers: ellipsoids and hulls, a union of them; of a mesh or a cloud
/// the points stand beside the scene, in NAME-agent.ply and NAME-obstacle.ply.
///
/// What was written is read again first; nothing is written, or all. Throws InputError naming "agent" or
/// "obstacle" for a body made by a program that no fields give to the bit (one delimited by hyperboloids, an
/// ellipsoid that a pose moves, a map's boxes), and naming the path where it is no file's; std::system_error
/// where it cannot be written. Cost: that of reading it.
void write_scene(const Scene& scene, const std::filesystem::path& file);

/// The same of one body in space, for read_body(). Throws naming "body".
void write_body(const SceneBody& body, const std::filesystem::path& file);

}  // namespace vericone::scenes
