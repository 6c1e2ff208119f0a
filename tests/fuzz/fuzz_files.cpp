// SPDX-License-Identifier: BSD-3-Clause
//
// libFuzzer entry: the first byte chooses the extension, the rest is the file. Whatever it is, the readers of
// meshes, clouds and octrees give a sound result or an InputError.
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "octree_header.h"
#include "source.h"

namespace {

using vericone::InputError;

constexpr std::array kNames = {"a.obj",  "a.off", "a.ply", "a.stl",     "a.pcd",   "a.las",
                               "a.xyz",  "a.csv", "a.bin", "b.pcd.bin", "a.graph", "a.dae",
                               "a.gltf", "a.laz", "a.ptx", "a.bt",      "a.ot"};

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

void check_points(const vericone::files::Source& source) {
  auto file = vericone::files::read_points(source);
  require(!file.points.empty(), "no points");
  for (const auto& p : file.points) require(p.allFinite(), "a point that is not finite");
  for (const auto& face : file.faces) {
    require(face.size() >= 3, "a face of less than three corners");
    for (const auto v : face) require(v < file.points.size(), "an index out of range");
  }
  if (!file.faces.empty()) vericone::files::triangle_mesh(std::move(file));
}

void check_octree(const vericone::files::Source& source) {
  const auto octree = vericone::octomap::read_octree(source);
  std::uint64_t volume = 0;
  for (const auto& cell : octree.cells) volume += std::uint64_t{1} << (3 * (16 - cell.depth));
  require(volume == std::uint64_t{1} << 48, "cells that do not fill the cube");
  vericone::octomap::obstacle_boxes(octree, {});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const vericone::files::Source source{kNames[data[0] % kNames.size()],
                                       {reinterpret_cast<const char*>(data) + 1, size - 1}};
  try {
    data[0] % kNames.size() < kNames.size() - 2 ? check_points(source) : check_octree(source);
  } catch (const InputError& error) {
    require(std::string(error.what()).find('\n') == std::string::npos, "a message of several lines");
  }
  return 0;
}
