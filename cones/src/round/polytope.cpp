// SPDX-License-Identifier: BSD-3-Clause
#include "round/polytope.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace vericone::round {
namespace {

double triple(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
  return x.dot(y.cross(z));
}

}  // namespace

Polytope::Polytope(const std::array<Eigen::Vector3d, 4>& corners) : corners_(corners.begin(), corners.end()) {
  if (triple(corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0]) > 0)
    std::swap(corners_[1], corners_[2]);
  // Face i is without corner i; the face beyond an edge is that without the third corner of it.
  append(1, 3, 2, {0, 0, 0});
  append(0, 2, 3, {0, 0, 0});
  append(0, 3, 1, {0, 0, 0});
  append(0, 1, 2, {0, 0, 0});
  for (Face& face : faces_)
    for (int i = 0; i < 3; ++i) face.beyond[i] = face.corner[(i + 2) % 3];
}

void Polytope::append(int a, int b, int c, std::array<int, 3> beyond) {
  Face face;
  face.corner = {a, b, c};
  face.beyond = beyond;
  const Eigen::Vector3d &x = corners_[a], &y = corners_[b], &z = corners_[c];
  const Eigen::Vector3d n = (y - x).cross(z - x);
  const double length = n.norm();
  if (length > 1e-300) face.normal = n / length;
  const auto least = [&](const Eigen::Vector3d& m) { return std::min({m.dot(x), m.dot(y), m.dot(z)}); };
  face.distance = least(face.normal);
  // All but an edge, where points lie along a ruling: its normal is rounding, and may put it next to the
  // origin. What points at the edge's nearest point bounds it too.
  constexpr double kThin = 1e-10;
  std::array<std::pair<const Eigen::Vector3d*, const Eigen::Vector3d*>, 3> edges{
      {{&x, &y}, {&y, &z}, {&z, &x}}};
  const auto [from, to] = *std::max_element(edges.begin(), edges.end(), [](const auto& e, const auto& f) {
    return (*e.second - *e.first).squaredNorm() < (*f.second - *f.first).squaredNorm();
  });
  const Eigen::Vector3d along = *to - *from;
  if (length < kThin * along.squaredNorm()) {
    const double part = std::clamp(-from->dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Eigen::Vector3d m = (*from + part * along).normalized();
    if (const double distance = least(m); distance > face.distance) {
      face.normal = m;
      face.distance = distance;
    }
  }
  faces_.push_back(std::move(face));
}

int Polytope::nearest() const {
  int best = -1;
  for (std::size_t i = 0; i < faces_.size(); ++i)
    if (faces_[i].alive && (best < 0 || faces_[i].distance < faces_[best].distance))
      best = static_cast<int>(i);
  return best;
}

bool Polytope::add(const Eigen::Vector3d& x, int from) {
  // The faces that are seen from x, connected to the first one, and the edges at which they end.
  std::vector<int> seen{from};
  std::vector<bool> is_seen(faces_.size(), false);
  is_seen[from] = true;
  struct Edge {
    int from, to, beyond;
  };
  std::vector<Edge> border;
  for (std::size_t k = 0; k < seen.size(); ++k)
    for (const int next : faces_[seen[k]].beyond)
      if (!is_seen[next] && faces_[next].normal.dot(x) > faces_[next].distance) {
        is_seen[next] = true;
        seen.push_back(next);
      }
  for (const int f : seen)
    for (int i = 0; i < 3; ++i)
      if (!is_seen[faces_[f].beyond[i]])
        border.push_back({faces_[f].corner[i], faces_[f].corner[(i + 1) % 3], faces_[f].beyond[i]});
  // In the order of a loop.
  for (std::size_t k = 1; k < border.size(); ++k) {
    const auto next = std::find_if(border.begin() + static_cast<std::ptrdiff_t>(k), border.end(),
                                   [&](const Edge& e) { return e.from == border[k - 1].to; });
    if (next == border.end()) return false;
    std::swap(border[k], *next);
  }
  if (border.size() < 3 || border.back().to != border.front().from) return false;
  for (std::size_t k = 1; k < border.size(); ++k)
    if (border[k].from == border.front().from) return false;
  const int corner = static_cast<int>(corners_.size()), first = static_cast<int>(faces_.size()),
            count = static_cast<int>(border.size());
  corners_.push_back(x);
  for (int k = 0; k < count; ++k) {
    append(border[k].from, border[k].to, corner,
           {border[k].beyond, first + (k + 1) % count, first + (k + count - 1) % count});
    Face& other = faces_[border[k].beyond];
    for (int i = 0; i < 3; ++i)
      if (other.corner[i] == border[k].to && other.corner[(i + 1) % 3] == border[k].from)
        other.beyond[i] = first + k;
  }
  for (const int f : seen) faces_[f].alive = false;
  return true;
}

bool Polytope::closed() const {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!faces_[f].alive) continue;
    for (int i = 0; i < 3; ++i) {
      const Face& other = faces_[faces_[f].beyond[i]];
      if (!other.alive) return false;
      bool back = false;
      for (int j = 0; j < 3; ++j)
        back = back ||
               (other.beyond[j] == static_cast<int>(f) && other.corner[j] == faces_[f].corner[(i + 1) % 3] &&
                other.corner[(j + 1) % 3] == faces_[f].corner[i]);
      if (!back) return false;
    }
  }
  return true;
}

int Polytope::crossings(const Eigen::Vector3d& ray) const {
  int sum = 0;
  for (const Face& face : faces_) {
    if (!face.alive) continue;
    int positive = 0, negative = 0;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d &x = corners_[face.corner[i]], &y = corners_[face.corner[(i + 1) % 3]];
      // Twelve roundings of products of entries.
      const double value = triple(ray, x, y), doubt = 0x1p-48 * ray.norm() * x.norm() * y.norm() + 1e-290;
      positive += value > doubt;
      negative += value < -doubt;
    }
    if (positive > 0 && negative > 0) continue;  // beside it
    if (positive < 3 && negative < 3) return 0;
    // On this side or on the other one? All points of the face have normal.x > 0.
    const double along = face.normal.dot(ray);
    if (std::abs(along) <= 0x1p-48 * ray.norm()) return 0;
    if (along > 0) sum += positive == 3 ? 1 : -1;
  }
  return sum;
}

bool Polytope::surrounds_origin() const {
  if (!closed()) return false;
  for (const Face& face : faces_)
    if (face.alive && !(face.distance > 0)) return false;
  int tried = 0;
  for (auto face = faces_.rbegin(); face != faces_.rend() && tried < 8; ++face) {
    if (!face->alive) continue;
    ++tried;
    // Off the middle, where no symmetry has its edges.
    const Eigen::Vector3d ray = 0.31 * corners_[face->corner[0]] + 0.33 * corners_[face->corner[1]] +
                                0.36 * corners_[face->corner[2]];
    if (crossings(ray) > 0) return true;
  }
  return false;
}

}  // namespace vericone::round
