// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of every kind in both worlds: as the C interface has them and as C++ has.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/internal/geometry/body_numbers.h>
#include <vericone/testing/random_bodies.h>
#include <vericone_c.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

namespace vericone::c_test {

using Eigen::Matrix3d, Eigen::Vector3d;
using ::testing::HasSubstr, ::testing::StartsWith;
using testing::RandomBodies;

template <typename T, void (*free)(T*)>
struct Free {
  void operator()(T* p) const { free(p); }
};
using BodyHandle = std::unique_ptr<vericone_body, Free<vericone_body, vericone_body_free>>;
using PairHandle = std::unique_ptr<vericone_pair, Free<vericone_pair, vericone_pair_free>>;
using ConeHandle = std::unique_ptr<vericone_cone, Free<vericone_cone, vericone_cone_free>>;
using NavigatorHandle =
    std::unique_ptr<vericone_navigator, Free<vericone_navigator, vericone_navigator_free>>;

using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

struct Both {
  BodyHandle c;
  vericone::Body cpp;
};

inline std::vector<double> flat(const std::vector<Vector3d>& points) {
  std::vector<double> list;
  for (const Vector3d& x : points) list.insert(list.end(), x.begin(), x.end());
  return list;
}

inline std::vector<Vector3d> points(RandomBodies& random, int count) {
  std::vector<Vector3d> list(std::size_t(count), Vector3d::Zero());
  for (Vector3d& x : list) x = random.in_box(1);
  return list;
}

inline Both ellipsoid(RandomBodies& random) {
  const Vector3d center = random.in_box(0.3),
                 axes(random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2));
  const Matrix3d turn = random.rotation();
  const Rows rows = turn;
  return {BodyHandle(vericone_body_ellipsoid(center.data(), axes.data(), rows.data())),
          Ellipsoid::from_axes(center, axes, turn)};
}

inline Both combined(RandomBodies& random) {
  const Vector3d axes(1.5, 1, 0.8);
  const Matrix3d turn = random.rotation();
  const Rows rows = turn;
  const int sheets = random.integer(1, 2);
  vericone_hyperboloid cut{{0.6, 0.5, 0.5}, {}, sheets};
  return {
      BodyHandle(vericone_body_combined(Vector3d::Zero().eval().data(), axes.data(), rows.data(), &cut, 1)),
      CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), axes, turn),
                        {hyperboloid(sheets, {0.6, 0.5, 0.5}, turn)})};
}

inline Both hull(RandomBodies& random) {
  const auto list = points(random, 9);
  return {BodyHandle(vericone_body_hull(flat(list).data(), list.size())), HullBody(list)};
}

inline Both mesh(RandomBodies& random) {
  const auto list = points(random, 8);
  std::vector<Assembly::Triangle> triangles;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < 6; ++i) {
    triangles.push_back({i, i + 1, i + 2});
    corners.insert(corners.end(), {i, i + 1, i + 2});
  }
  return {BodyHandle(vericone_body_mesh(flat(list).data(), list.size(), corners.data(), triangles.size())),
          Assembly::mesh(list, triangles)};
}

inline Both cloud(RandomBodies& random) {
  const auto list = points(random, 7);
  return {BodyHandle(vericone_body_cloud(flat(list).data(), list.size(), 0.25)), Assembly::cloud(list, 0.25)};
}

inline Both boxes(RandomBodies& random) {
  std::vector<Box> list;
  std::vector<Vector3d> ends;
  for (int i = 0; i < 5; ++i) {
    const Vector3d low = random.in_box(1), high = low + Vector3d(0.3, 0.2, 0.4);
    list.push_back({low, high});
    ends.insert(ends.end(), {low, high});
  }
  return {BodyHandle(vericone_body_boxes(flat(ends).data(), list.size())), Assembly::boxes(list)};
}

inline Both pieces(RandomBodies& random) {
  const Both one = ellipsoid(random), other = combined(random);
  const vericone_body* list[] = {one.c.get(), other.c.get()};
  return {BodyHandle(vericone_body_union(list, 2)),
          vericone::Body::pieces({*one.cpp.quadric(), *other.cpp.quadric()})};
}

inline Both hulls(RandomBodies& random) {
  const Both one = hull(random);
  const Vector3d low(-0.5, -1.5, 0.2), high(0.5, -0.6, 0.7);
  const BodyHandle box(vericone_body_box(low.data(), high.data()));
  const vericone_body* list[] = {one.c.get(), box.get()};
  return {BodyHandle(vericone_body_union(list, 2)),
          Assembly::polyhedra({*one.cpp.hull(), HullBody::box(low, high)})};
}

inline std::vector<double> numbers_of(const vericone_body* body) {
  std::vector<double> numbers(std::size_t(vericone_body_numbers(body, nullptr, 0)));
  EXPECT_EQ(vericone_body_numbers(body, numbers.data(), numbers.size()), std::int64_t(numbers.size()));
  return numbers;
}

/// Of kinds that have a maker of their own in C++ alone.
inline Both of_numbers(const vericone::Body& body) {
  const auto numbers = body_numbers(body);
  return {BodyHandle(vericone_body_of_numbers(numbers.data(), numbers.size())), body};
}
inline Both rounded(RandomBodies& random) {
  return of_numbers(Convex::rounded(*hull(random).cpp.hull(), 0.2));
}
inline Both cylinders(RandomBodies& random) {
  return of_numbers(Assembly::convexes(
      {Convex::cylinder(0.4, random.uniform(0.2, 1)), Convex::capsule(0.2, 1).translated(random.in_box(1))}));
}
inline Both shaped(RandomBodies& random) {
  const Matrix3d factor = random.rotation() * Eigen::DiagonalMatrix<double, 3>(1, 0.5, 0.3);
  const Matrix3d square = factor * factor.transpose();
  return of_numbers(Ellipsoid::from_shape(random.in_box(1), (square + square.transpose()) / 2));
}

inline constexpr auto kKinds = {ellipsoid, combined, hull,    mesh,      cloud, boxes,
                                pieces,    hulls,    rounded, cylinders, shaped};

inline void expect_same(const std::optional<Vector3d>& expected, const double* found) {
  for (int k = 0; k < 3; ++k) {
    if (expected)
      EXPECT_EQ((*expected)(k), found[k]);
    else
      EXPECT_TRUE(std::isnan(found[k]));
  }
}
inline void expect_same(double expected, double found) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(expected), std::bit_cast<std::uint64_t>(found));
}

}  // namespace vericone::c_test
