// SPDX-License-Identifier: GPL-3.0-or-later
//
// AssemblyOracle over real meshes, clouds and maps against all of their pieces, one after the other.
// VERICONE_CASES and VERICONE_SEED replace the number of velocities of each body and agent, and the seed.
#include <gtest/gtest.h>
#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/verify/assembly/truth.h>
#include <vericone/internal/verify/seeded_random.h>

#ifdef VERICONE_HAVE_OCTOMAP
#include <vericone/octomap/read_octree.h>
#endif

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "support/campaign.h"
#include "verify/campaigns/real_data.h"

namespace vericone::verify::assembly_real_test {
namespace {

using Eigen::Vector3d;
using testing::campaign_size, testing::from_environment;

struct Body {
  Assembly assembly;
  TruePieces pieces;
};

std::optional<Body> body(const std::string& name) {
  if (name.ends_with(".bt")) {
#ifdef VERICONE_HAVE_OCTOMAP
    const auto path = data_file(name);
    if (!path) return std::nullopt;
    octomap::OctreeMeaning meaning;
    meaning.unknown_occupied = false;
    const auto boxes = octomap::obstacle_boxes(octomap::read_octree(*path), meaning);
    return Body{Assembly::boxes(boxes), TruePieces::boxes(boxes)};
#else
    return std::nullopt;
#endif
  }
  const auto mesh = real_mesh(name);
  if (!mesh) return std::nullopt;
  if (mesh->triangles.empty()) {
    constexpr double kRadius = 0.05;
    return Body{Assembly::cloud(mesh->points, kRadius), TruePieces::balls(mesh->points, kRadius)};
  }
  return Body{Assembly::mesh(mesh->points, mesh->triangles),
              TruePieces::triangles(mesh->points, mesh->triangles)};
}

enum class AgentShape { ball, ellipsoid, box };

class Brute : public ::testing::TestWithParam<std::tuple<std::string, AgentShape>> {
 protected:
  std::uint64_t seed = from_environment("VERICONE_SEED", 1);
  std::uint64_t in = 0, on = 0, out = 0, contacts = 0, half_planes = 0, exact = 0;

  template <typename Agent>
  void check(const Agent& agent, const Body& b, SeededRandom& random, int velocities, int planes, bool miss) {
    const AssemblyOracle oracle(agent, b.assembly);
    const AssemblyTruth truth(agent, b.pieces);
    ASSERT_EQ(oracle.relation(), truth.relation());
    if (truth.relation() != Relation::disjoint) return;
    for (int k = 0; k < velocities; ++k) {
      SCOPED_TRACE(k);
      const Vector3d w = velocity(agent, b, random);
      const Membership m = truth.membership(w);
      (m == Membership::in ? in : m == Membership::on ? on : out) += 1;
      ASSERT_EQ(oracle.membership(w), m);
      const auto contact = oracle.first_contact(w);
      ASSERT_EQ(contact.has_value(), m != Membership::out);
      if (contact) {
        ++contacts;
        EXPECT_EQ(truth.touched(Motion::until(std::nextafter(contact->earliest, 0), w)), Membership::out);
        if (std::isfinite(contact->latest)) {
          EXPECT_EQ(truth.touched(Motion::at(contact->latest, w)), Membership::in);
        }
        EXPECT_LE(contact->earliest, contact->time);
        EXPECT_LE(contact->time, contact->latest);
        EXPECT_LE(contact->latest - contact->earliest, 1e-6 * contact->latest);
      }
      if (!miss) continue;
      const AssemblyMiss d = oracle.miss_distance(w);
      const Motion motion = Motion::ray(w);
      if (d.least > 0) {
        EXPECT_NE(truth.touched(motion, d.least), Membership::in);
      }
      EXPECT_NE(truth.touched(motion, d.most), Membership::out);
      EXPECT_LE(d.most - d.least, 1e-8 * (d.most + 1));
    }
    const Vector3d axis = (b.assembly.bounds().center() - center(agent)).normalized();
    const AxisFrame frame(axis);
    std::vector<ExtremeDirection> ring;
    if (planes > 0) ring = oracle.extremes(axis, planes);
    for (int k = 0; k < planes; ++k) {
      SCOPED_TRACE(k);
      const double turn = 2 * std::numbers::pi * k / planes;
      const Vector3d side = std::cos(turn) * frame.e1 + std::sin(turn) * frame.e2;
      const ExtremeDirection& e = ring[static_cast<std::size_t>(k)];
      const auto at = [&](double t) { return Vector3d(std::cos(t) * axis + std::sin(t) * side); };
      ++half_planes;
      if (e.any) {
        EXPECT_LE(e.high - e.low, 1.0000001e-4);
        EXPECT_NE(truth.membership(e.direction), Membership::out);
        EXPECT_LT((e.direction - at(e.low)).norm(), 1e-12);
      } else {
        EXPECT_EQ(e.high, 0);
      }
      // Beyond, in two sectors of less than half a turn; 1e-12 rad for the rounding of axis and side.
      const double from = e.high > 0 ? e.high + 1e-12 : 0, middle = 0.5 * (from + std::numbers::pi);
      if (from > std::numbers::pi) continue;
      EXPECT_EQ(truth.touched(Motion::any_of({at(from), at(middle)})), Membership::out);
      EXPECT_EQ(truth.touched(Motion::any_of({at(middle), Vector3d(-axis)})), Membership::out);
    }
    exact += truth.exact();
  }

  static Vector3d center(const Ellipsoid& e) { return e.center(); }
  static Vector3d center(const HullBody& h) { return 0.5 * (h.points().front() + h.points().back()); }

  /// Towards some piece, with an error, or anywhere.
  template <typename Agent>
  Vector3d velocity(const Agent& agent, const Body& b, SeededRandom& random) {
    if (random.integer(0, 3) == 0) return random.direction<3>();
    const auto n = static_cast<int>(b.pieces.hulls.size());
    const Vector3d to =
        b.pieces.hulls[static_cast<std::size_t>(random.integer(0, n - 1))].front() - center(agent);
    return to + random.uniform(0, 0.5) * to.norm() * random.direction<3>();
  }
};

TEST_P(Brute, EveryPieceAgrees) {
  const auto& [name, shape] = GetParam();
  const auto b = body(name);
  if (!b) GTEST_SKIP() << not_here(name);
  const Box bounds = b->assembly.bounds();
  const double size = bounds.half_widths().maxCoeff();
  const std::uint64_t total =
      from_environment("VERICONE_CASES", campaign_size(shape == AgentShape::box ? 100 : 1000, 1000));
  constexpr int kOfOnePlace = 50;
  std::uint64_t asked = 0, place = 0;
  for (; asked < total && place < 10 * total; ++place) {
    SCOPED_TRACE("VERICONE_SEED=" + std::to_string(seed) + ", place " + std::to_string(place));
    SeededRandom random(940 + static_cast<std::uint32_t>(shape), seed, place);
    const Vector3d at = bounds.center() + random.uniform(0.3, 2) * size * random.direction<3>();
    const double reach = random.uniform(0.01, 0.1) * size;
    const std::uint64_t before = in + on + out;
    // The first place with half-planes.
    const int planes = asked == 0 ? 64 : 0;
    if (shape == AgentShape::ball) {
      check(Ellipsoid::from_axes(at, Vector3d::Constant(reach)), *b, random, kOfOnePlace, planes, true);
    } else if (shape == AgentShape::ellipsoid) {
      const Vector3d axes(reach, 0.5 * reach, 0.2 * reach);
      check(Ellipsoid::from_axes(at, axes, random.rotation()), *b, random, kOfOnePlace, planes, false);
    } else {
      check(HullBody::box(at - Vector3d(reach, reach / 2, reach / 5),
                          at + Vector3d(reach, reach / 2, reach / 5)),
            *b, random, kOfOnePlace, planes, false);
    }
    asked += in + on + out - before;
    if (HasFatalFailure()) return;
  }
  std::printf(
      "%s: %zu pieces, %llu places, in %llu on %llu out %llu, %llu half-planes, %llu pieces decided "
      "exactly\n",
      name.c_str(), b->assembly.size(), static_cast<unsigned long long>(place),
      static_cast<unsigned long long>(in), static_cast<unsigned long long>(on),
      static_cast<unsigned long long>(out), static_cast<unsigned long long>(half_planes),
      static_cast<unsigned long long>(exact));
  EXPECT_GE(asked, total);
  EXPECT_GT(in, total / 20);
  EXPECT_GT(out, total / 20);
  EXPECT_GE(half_planes, 64);
}

std::string test_name(const ::testing::TestParamInfo<std::tuple<std::string, AgentShape>>& info) {
  std::string name;
  for (char c : std::filesystem::path(std::get<0>(info.param)).stem().string())
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  constexpr const char* kShapes[] = {"ball", "ellipsoid", "box"};
  return name + "_" + kShapes[static_cast<int>(std::get<1>(info.param))];
}

using ::testing::Combine;
using ::testing::Values;

INSTANTIATE_TEST_SUITE_P(Ball, Brute,
                         Combine(Values("ycb_006_mustard_bottle.obj", "data/meshes/armadillo.off",
                                        "small_gicp_source.ply", "geb079.bt"),
                                 Values(AgentShape::ball)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Box, Brute,
                         Combine(Values("216Kleopatra.obj", "small_gicp_source.ply", "geb079.bt"),
                                 Values(AgentShape::box)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Ellipsoid, Brute,
                         Combine(Values("ycb_006_mustard_bottle.obj", "216Kleopatra.obj"),
                                 Values(AgentShape::ellipsoid)),
                         test_name);

}  // namespace
}  // namespace vericone::verify::assembly_real_test
