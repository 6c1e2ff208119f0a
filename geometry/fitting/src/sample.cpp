// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/hull.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/geometry/decompositions.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLargest = 1e100;

bool before(const Vector3d& a, const Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

void require_valid(const Sample& sample) {
  if (sample.points.empty()) throw InputError("points", "no point", "one point or more");
  for (std::size_t i = 0; i < sample.points.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(sample.points[i](k)) <= kLargest))
        throw InputError("points[" + std::to_string(i) + "]", to_text(sample.points[i](k)),
                         "coordinates of at most 1e100 in magnitude (m)");
}

struct Distinct {
  std::vector<std::uint32_t>
      original;                      // one index for each distinct point, in increasing order of coordinates
  std::vector<double> count;         // how many there are
  std::vector<std::uint32_t> which;  // for each point of the sample
};

Distinct distinct_points(const Sample& sample) {
  std::vector<std::uint32_t> used = used_points(sample);
  // Adding 0 turns -0 into 0, so that the two are one point.
  const auto point = [&](std::uint32_t i) -> Vector3d { return sample.points[i].array() + 0.0; };
  std::sort(used.begin(), used.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vector3d x = point(a), y = point(b);
    return x == y ? a < b : before(x, y);
  });
  Distinct result;
  result.which.assign(sample.points.size(), CanonicalSample::kUnused);
  for (const std::uint32_t i : used) {
    if (result.original.empty() || point(result.original.back()) != point(i)) {
      result.original.push_back(i);
      result.count.push_back(0);
    }
    ++result.count.back();
    result.which[i] = std::uint32_t(result.original.size() - 1);
  }
  return result;
}

/// Principal axes in decreasing order. Signs such that third moments are positive; along the axis where that
/// is least telling (the sample may be symmetric) such that the axes are a rotation.
Frame principal_frame(const std::vector<Vector3d>& points) {
  const Vector3d offset = points.front();
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& x : points) mean += x - offset;
  mean /= double(points.size());
  Frame frame;
  frame.origin = offset + mean;
  double reach = 0;
  for (const Vector3d& x : points) reach = std::max(reach, (x - frame.origin).norm());
  if (!(reach > 0)) throw InputError("points", "all equal", "points that differ");
  frame.scale = reach;

  Matrix3d second = Matrix3d::Zero();
  for (const Vector3d& x : points) {
    const Vector3d y = (x - frame.origin) / reach;
    second += y * y.transpose();
  }
  const auto solver = symmetric_eigen<3>(second / double(points.size()));
  frame.axes = solver.vectors.rowwise().reverse();
  Vector3d third = Vector3d::Zero();
  for (const Vector3d& x : points)
    third += (frame.axes.transpose() * (x - frame.origin) / reach).array().cube().matrix();
  Eigen::Index least = 0;
  third.cwiseAbs().minCoeff(&least);
  for (int k = 0; k < 3; ++k)
    if (k != least && third(k) < 0) frame.axes.col(k) = -frame.axes.col(k);
  if (frame.axes.determinant() < 0) frame.axes.col(least) = -frame.axes.col(least);
  return frame;
}

/// Drops triangles without area (in doubles: they add nothing to a fit) and turns each so that its least
/// corner comes first.
std::vector<std::array<std::uint32_t, 3>> canonical_triangles(const Sample& sample,
                                                              const std::vector<std::uint32_t>& index,
                                                              const std::vector<Vector3d>& points,
                                                              std::vector<double>& weights) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(sample.triangles.size());
  for (const auto& t : sample.triangles) {
    std::array<std::uint32_t, 3> corner{index[t[0]], index[t[1]], index[t[2]]};
    std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
    triangles.push_back(corner);
  }
  std::sort(triangles.begin(), triangles.end());
  std::erase_if(triangles, [&](const auto& t) {
    const double area = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm() / 2;
    for (const std::uint32_t corner : t) weights[corner] += area / 3;
    return !(area > 0);
  });
  return triangles;
}

}  // namespace

std::vector<std::uint32_t> used_points(const Sample& sample) {
  std::vector<char> used(sample.points.size(), !sample.is_mesh());
  for (std::size_t t = 0; t < sample.triangles.size(); ++t)
    for (const std::uint32_t i : sample.triangles[t]) {
      if (i >= used.size())
        throw InputError("triangles[" + std::to_string(t) + "]", std::to_string(i),
                         "indices below the number of points, " + std::to_string(used.size()));
      used[i] = 1;
    }
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(sample.points[i](k)))
        throw InputError("points[" + std::to_string(i) + "]", to_text(sample.points[i](k)),
                         "a finite number (metres)");
    all.push_back(i);
  }
  return all;
}

Vector3d rounded(const Vector3d& y) {
  constexpr double kGrid = 1 << 26;
  return (y * kGrid).array().round() / kGrid;
}

CanonicalSample canonical(const Sample& sample) {
  require_valid(sample);
  const Distinct distinct = distinct_points(sample);
  const std::size_t n = distinct.original.size();
  std::vector<Vector3d> world;
  world.reserve(n);
  for (const std::uint32_t i : distinct.original) world.push_back(sample.points[i]);

  CanonicalSample result;
  result.frame = principal_frame(world);
  std::vector<Vector3d> framed(n);
  for (std::size_t i = 0; i < n; ++i) framed[i] = result.frame.to_frame(world[i]);
  std::vector<std::uint32_t> order(n), rank(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vector3d x = rounded(framed[a]), y = rounded(framed[b]);
    return x == y ? before(framed[a], framed[b]) : before(x, y);
  });
  for (std::size_t i = 0; i < n; ++i) {
    rank[order[i]] = std::uint32_t(i);
    result.points.push_back(framed[order[i]]);
    result.original.push_back(distinct.original[order[i]]);
    result.weights.push_back(sample.is_mesh() ? 0 : distinct.count[order[i]]);
  }
  result.index = distinct.which;
  for (std::uint32_t& i : result.index)
    if (i != CanonicalSample::kUnused) i = rank[i];
  if (sample.is_mesh())
    result.triangles = canonical_triangles(sample, result.index, result.points, result.weights);
  double total = std::accumulate(result.weights.begin(), result.weights.end(), 0.0);
  if (!(total > 0)) {  // a mesh without area: its points are all there is
    result.weights.assign(n, 1);
    total = double(n);
  }
  for (double& w : result.weights) w /= total;
  return result;
}

}  // namespace vericone::fitting
