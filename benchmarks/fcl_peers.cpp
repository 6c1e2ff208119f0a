// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/fcl_peers.h>

#include <fcl/config.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/detail/conservative_advancement_func_matrix.h>
#include <fcl/narrowphase/distance.h>
#include <array>
#include <map>
#include <utility>

namespace vericone::benchmarks {
namespace {

using Vertices = std::vector<Eigen::Vector3d>;
using Polytope = fcl::Convexd;

/// Directions and triangles of an icosahedron halved twice: 162 vertices, 320 faces.
struct Tessellation {
  Vertices directions;
  std::vector<std::array<int, 3>> triangles;

  Tessellation() {
    const double g = std::numbers::phi;
    directions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int halving = 0; halving < 2; ++halving) {
      std::map<std::pair<int, int>, int> middles;
      const auto middle = [&](int i, int j) {
        const auto [entry, added] =
            middles.try_emplace(std::minmax(i, j), static_cast<int>(directions.size()));
        if (added) directions.push_back(0.5 * (directions[i] + directions[j]));
        return entry->second;
      };
      std::vector<std::array<int, 3>> finer;
      for (const auto& [i, j, k] : triangles) {
        const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
        finer.insert(finer.end(), {{i, ij, ki}, {j, jk, ij}, {k, ki, jk}, {ij, jk, ki}});
      }
      triangles = std::move(finer);
      for (Eigen::Vector3d& d : directions) d.normalize();
    }
  }
};

Polytope inscribed(const Eigen::Vector3d& semi_axes) {
  static const Tessellation sphere;
  auto vertices = std::make_shared<Vertices>();
  for (const Eigen::Vector3d& d : sphere.directions) vertices->push_back(semi_axes.cwiseProduct(d));
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& t : sphere.triangles) faces->insert(faces->end(), {3, t[0], t[1], t[2]});
  return {vertices, static_cast<int>(sphere.triangles.size()), faces};
}

fcl::Transform3d transform(const Placed& placed) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = placed.rotation;
  t.translation() = placed.center;
  return t;
}

fcl::GJKSolverType type(FclSolver solver) {
  return solver == FclSolver::libccd ? fcl::GST_LIBCCD : fcl::GST_INDEP;
}

template <typename Gjk>
bool advance(const fcl::Ellipsoidd& a, const fcl::MotionBased& motion_a, const fcl::Ellipsoidd& b,
             const fcl::MotionBased& motion_b) {
  const Gjk gjk;
  double time = 0;
  fcl::CollisionResultd result;
  return fcl::detail::conservativeAdvancement(a, &motion_a, b, &motion_b, &gjk, fcl::CollisionRequestd(),
                                              result, time);
}

}  // namespace

struct FclPair::Objects {
  fcl::Ellipsoidd a, b;
  Polytope polytope_a, polytope_b;
  fcl::Transform3d place_a, place_b, end_a;

  explicit Objects(const Engagement& e)
      : a(e.placed_a.semi_axes),
        b(e.placed_b.semi_axes),
        polytope_a(inscribed(e.placed_a.semi_axes)),
        polytope_b(inscribed(e.placed_b.semi_axes)),
        place_a(transform(e.placed_a)),
        place_b(transform(e.placed_b)),
        end_a(place_a) {
    end_a.translation() += e.horizon() * e.w;
  }

  bool continuous(const fcl::CollisionGeometryd& moving, const fcl::CollisionGeometryd& resting,
                  const fcl::ContinuousCollisionRequestd& request) const {
    fcl::ContinuousCollisionResultd result;
    const fcl::TranslationMotiond motion_a(place_a, end_a), motion_b(place_b, place_b);
    fcl::continuousCollide(&moving, &motion_a, &resting, &motion_b, request, result);
    return result.is_collide;
  }
};

FclPair::FclPair(const Engagement& engagement) : objects_(std::make_unique<Objects>(engagement)) {}
FclPair::~FclPair() = default;
FclPair::FclPair(FclPair&&) noexcept = default;
FclPair& FclPair::operator=(FclPair&&) noexcept = default;

double FclPair::distance(FclSolver solver) const {
  fcl::DistanceRequestd request;
  request.gjk_solver_type = type(solver);
  fcl::DistanceResultd result;
  return fcl::distance(&objects_->a, objects_->place_a, &objects_->b, objects_->place_b, request, result);
}

bool FclPair::collide(FclSolver solver) const {
  fcl::CollisionRequestd request;
  request.gjk_solver_type = type(solver);
  fcl::CollisionResultd result;
  return fcl::collide(&objects_->a, objects_->place_a, &objects_->b, objects_->place_b, request, result) > 0;
}

bool FclPair::naive(int steps) const {
  return objects_->continuous(
      objects_->a, objects_->b,
      {static_cast<std::size_t>(steps), 1.0 / steps, fcl::CCDM_TRANS, fcl::GST_LIBCCD, fcl::CCDC_NAIVE});
}

bool FclPair::advancement(FclSolver solver) const {
  const Objects& o = *objects_;
  const fcl::TranslationMotiond motion_a(o.place_a, o.end_a), motion_b(o.place_b, o.place_b);
  return solver == FclSolver::libccd ? advance<fcl::detail::GJKSolver_libccdd>(o.a, motion_a, o.b, motion_b)
                                     : advance<fcl::detail::GJKSolver_indepd>(o.a, motion_a, o.b, motion_b);
}

bool FclPair::polytope_advancement(FclSolver solver) const {
  return objects_->continuous(objects_->polytope_a, objects_->polytope_b,
                              {10, 1e-4, fcl::CCDM_TRANS, type(solver), fcl::CCDC_CONSERVATIVE_ADVANCEMENT});
}

const char* fcl_version() { return FCL_VERSION; }

}  // namespace vericone::benchmarks
