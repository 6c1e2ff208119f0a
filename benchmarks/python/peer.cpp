// SPDX-License-Identifier: BSD-3-Clause
//
// What the Python package is measured against: the same questions about the same arrays, in loops of C++.
// ratios.py loads this library beside the package, so that both are timed in one run.
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/pair.h>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

using namespace vericone;

namespace {

static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double) && sizeof(Membership) == 1);

// The bodies of ratios.py.
const Ellipsoid kAgent = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 0.5});
const Ellipsoid kObstacle = Ellipsoid::from_axes({10, 2, 0}, {2, 3, 1});

const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

std::span<const Eigen::Vector3d> vectors(const double* numbers, std::size_t n) {
  return {reinterpret_cast<const Eigen::Vector3d*>(numbers), n};
}

}  // namespace

extern "C" {

void memberships(const double* w, std::size_t n, std::int8_t* out) {
  static const ConeOracle oracle(kAgent, kObstacle);
  oracle.memberships(vectors(w, n), {reinterpret_cast<Membership*>(out), n});
}

void verdicts(const double* w, std::size_t n, std::int8_t* out) {
  static const Pair pair(Placed{kAgent}, Placed{kObstacle});
  for (const Eigen::Vector3d& v : vectors(w, n)) *out++ = static_cast<std::int8_t>(pair.verdict(v, kStill));
}

// The distances are returned, so that nothing is left out; all of each answer is kept, as Python does.
void clearances(const double* w, std::size_t n, double* out) {
  std::vector<Clearance> answers(n);
  const auto all = vectors(w, n);
  for (std::size_t i = 0; i < n; ++i) answers[i] = clearance(kAgent, kObstacle, all[i]);
  for (std::size_t i = 0; i < n; ++i) out[i] = answers[i].distance;
}

void times_to_contact(const double* w, std::size_t n, double* out) {
  for (const Eigen::Vector3d& v : vectors(w, n))
    *out++ = time_to_contact(kAgent, kObstacle, v).value_or(std::numeric_limits<double>::quiet_NaN());
}

void hull_memberships(const double* points, std::size_t count, const double* w, std::size_t n,
                      std::int8_t* out) {
  const auto corners = vectors(points, count);
  const Pair pair{Placed(kAgent), Placed(HullBody({corners.begin(), corners.end()}))};
  for (const Eigen::Vector3d& v : vectors(w, n)) *out++ = static_cast<std::int8_t>(pair.verdict(v, kStill));
}

void mesh_memberships(const double* points, std::size_t count, const std::uint32_t* corners,
                      std::size_t triangles, const double* w, std::size_t n, std::int8_t* out) {
  const auto vertices = vectors(points, count);
  std::vector<Assembly::Triangle> faces(triangles);
  for (std::size_t i = 0; i < triangles; ++i)
    faces[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
  const Pair pair{Placed(kAgent), Placed(Assembly::mesh({vertices.begin(), vertices.end()}, faces))};
  for (const Eigen::Vector3d& v : vectors(w, n)) *out++ = static_cast<std::int8_t>(pair.verdict(v, kStill));
}

}  // extern "C"
