// SPDX-License-Identifier: BSD-3-Clause
//
// What stands in FCL's tables of conservative advancement. They hold a function for every pair of kinds, all
// of them templates: this file compiles them once.
#include <benchmarks/fcl_peers.h>

#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/detail/conservative_advancement_func_matrix.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

namespace vericone::benchmarks {
namespace {

bool in_table(fcl::NODE_TYPE a, fcl::NODE_TYPE b) {
  static const fcl::detail::ConservativeAdvancementFunctionMatrix<fcl::detail::GJKSolver_libccdd> table;
  return table.conservative_advancement_matrix[a][b] != nullptr;
}

}  // namespace

bool fcl_ellipsoids_in_table() { return in_table(fcl::GEOM_ELLIPSOID, fcl::GEOM_ELLIPSOID); }
bool fcl_octrees_in_table() { return in_table(fcl::GEOM_ELLIPSOID, fcl::GEOM_OCTREE); }

}  // namespace vericone::benchmarks
