// SPDX-License-Identifier: BSD-3-Clause
#include "containing/partition.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kTurns = 20;

/// Groups of items by number, and the ellipsoid of each.
struct Grouping {
  std::vector<int> group;  // of each item
  std::vector<Ellipsoid> bodies;
  double volume = 0;
};

class Partitioner {
 public:
  explicit Partitioner(const CanonicalSample& sample) : sample_(sample) {}

  std::size_t items() const { return sample_.is_mesh() ? sample_.triangles.size() : sample_.points.size(); }

  /// Nothing where a group is flat or empty.
  std::optional<Grouping> grouping(std::vector<int> group, int count) const {
    Grouping result;
    std::vector<std::vector<Vector3d>> points(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < items(); ++i) {
      auto& list = points[std::size_t(group[i])];
      if (sample_.is_mesh())
        for (const std::uint32_t corner : sample_.triangles[i]) list.push_back(sample_.points[corner]);
      else
        list.push_back(sample_.points[i]);
    }
    for (const auto& list : points) {
      try {
        result.bodies.push_back(min_volume_ellipsoid<3>(list).body);
      } catch (const InputError&) {
        return std::nullopt;
      }
      result.volume += result.bodies.back().volume();
    }
    result.group = std::move(group);
    return result;
  }

  /// One group more: the largest that can be halved along one of its axes.
  std::optional<Grouping> split(const Grouping& now) const {
    const int count = int(now.bodies.size());
    std::vector<int> order(now.bodies.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return now.bodies[std::size_t(a)].volume() > now.bodies[std::size_t(b)].volume();
    });
    for (const int largest : order) {
      const Ellipsoid& body = now.bodies[std::size_t(largest)];
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d direction = body.axis_directions().col(axis);
        std::vector<int> group = now.group;
        for (std::size_t i = 0; i < items(); ++i)
          if (group[i] == largest && (middle(i) - body.center()).dot(direction) > 0) group[i] = count;
        if (auto result = grouping(std::move(group), count + 1)) return result;
      }
    }
    return std::nullopt;
  }

  Grouping settle(Grouping best) const {
    for (int turn = 0; turn < kTurns; ++turn) {
      std::vector<Matrix3d> forms;
      for (const Ellipsoid& body : best.bodies) forms.push_back(body.shape().inverse());
      std::vector<int> group(items(), 0);
      for (std::size_t i = 0; i < items(); ++i) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < forms.size(); ++k) {
          double most = 0;
          const auto offer = [&](const Vector3d& x) {
            const Vector3d y = x - best.bodies[k].center();
            most = std::max(most, y.dot(forms[k] * y));
          };
          if (sample_.is_mesh())
            for (const std::uint32_t corner : sample_.triangles[i]) offer(sample_.points[corner]);
          else
            offer(sample_.points[i]);
          if (most < least) {
            least = most;
            group[i] = int(k);
          }
        }
      }
      auto next = grouping(std::move(group), int(best.bodies.size()));
      if (!next || !(next->volume < best.volume * (1 - 1e-9))) break;
      best = std::move(*next);
    }
    return best;
  }

 private:
  Vector3d middle(std::size_t i) const {
    if (!sample_.is_mesh()) return sample_.points[i];
    const auto& t = sample_.triangles[i];
    return (sample_.points[t[0]] + sample_.points[t[1]] + sample_.points[t[2]]) / 3;
  }

  const CanonicalSample& sample_;
};

/// The points that are marked and the triangles that are listed.
Part part_of(const CanonicalSample& sample, const std::vector<char>& kept, std::vector<std::uint32_t> items) {
  Part part;
  part.sample.frame = sample.frame;
  std::vector<std::uint32_t> index(sample.points.size(), 0);
  for (std::size_t i = 0; i < sample.points.size(); ++i)
    if (kept[i]) {
      index[i] = std::uint32_t(part.sample.points.size());
      part.sample.points.push_back(sample.points[i]);
      part.sample.weights.push_back(sample.weights[i]);
      part.sample.original.push_back(sample.original[i]);
    }
  if (sample.is_mesh())
    for (const std::uint32_t t : items) {
      const auto& corner = sample.triangles[t];
      part.sample.triangles.push_back({index[corner[0]], index[corner[1]], index[corner[2]]});
    }
  part.items = std::move(items);
  return part;
}

}  // namespace

Part kept_part(const CanonicalSample& sample, const std::vector<char>& kept) {
  std::vector<std::uint32_t> items;
  if (sample.is_mesh()) {
    for (std::uint32_t t = 0; t < sample.triangles.size(); ++t) {
      const auto& corner = sample.triangles[t];
      if (kept[corner[0]] && kept[corner[1]] && kept[corner[2]]) items.push_back(t);
    }
  } else {
    for (std::uint32_t i = 0; i < sample.points.size(); ++i)
      if (kept[i]) items.push_back(i);
  }
  return part_of(sample, kept, std::move(items));
}

std::vector<Part> partition(const Part& whole, int count) {
  if (count == 1) return {whole};
  const Partitioner partitioner(whole.sample);
  std::optional<Grouping> groups = partitioner.grouping(std::vector<int>(partitioner.items(), 0), 1);
  for (int k = 1; groups && k < count; ++k) {
    std::optional<Grouping> next = partitioner.split(*groups);
    if (!next)
      throw InputError("pieces", std::to_string(count),
                       "at most " + std::to_string(k) + ": a further part would be flat");
    groups = partitioner.settle(std::move(*next));
  }
  if (!groups)
    throw InputError("points", "a plane of them", "points in space where there are several pieces");
  std::vector<Part> parts;
  for (int k = 0; k < count; ++k) {
    std::vector<char> kept(whole.sample.points.size(), 0);
    std::vector<std::uint32_t> local, items;
    for (std::uint32_t i = 0; i < partitioner.items(); ++i) {
      if (groups->group[i] != k) continue;
      local.push_back(i);
      items.push_back(whole.items[i]);
      if (whole.sample.is_mesh())
        for (const std::uint32_t corner : whole.sample.triangles[i]) kept[corner] = 1;
      else
        kept[i] = 1;
    }
    parts.push_back(part_of(whole.sample, kept, std::move(local)));
    parts.back().items = std::move(items);
  }
  return parts;
}

}  // namespace vericone::fitting
