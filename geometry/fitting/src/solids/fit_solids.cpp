// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/convex_hull.h>
#include <vericone/internal/fitting/solids.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "containing/partition.h"
#include "distance/distance_sum.h"
#include "distance/scan_distance.h"
#include "solids/corners.h"
#include "solids/solid_check.h"
#include "solids/solid_partition.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr int kMostSolids = 64;

void require_valid(const SolidOptions& options) {
  if (options.kinds.empty()) throw InputError("kinds", "none", "one kind or more");
  if (options.pieces < 1 || options.pieces > kMostSolids)
    throw InputError("pieces", std::to_string(options.pieces), "1 to " + std::to_string(kMostSolids));
  if (!(options.margin >= 0 && options.margin <= 1e100))
    throw InputError("margin", to_text(options.margin), "a finite number, 0 or more (m)");
  const auto& kinds = options.kinds;
  if (options.margin > 0 && std::find(kinds.begin(), kinds.end(), SolidKind::ellipsoid) != kinds.end())
    throw InputError("margin", to_text(options.margin), "0 where ellipsoids are among several kinds (m)");
}

/// Groups of the sample's items, the solids of which are in its frame.
struct Grouped {
  SolidGroups groups;
  std::vector<Solid> solids;
};

using Chords = std::vector<std::vector<Vector3d>>;

std::vector<Vector3d> points_of(const CanonicalSample& sample, const Chords& chords,
                                const SolidGroups& groups, int group) {
  std::vector<char> wanted(sample.points.size(), 0);
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < groups.group.size(); ++i) {
    if (groups.group[i] != group) continue;
    if (!sample.is_mesh()) {
      wanted[i] = 1;
    } else {
      for (const std::uint32_t corner : sample.triangles[i]) wanted[corner] = 1;
      points.insert(points.end(), chords[i].begin(), chords[i].end());
    }
  }
  // Corners of triangles without area alone, which are in no group.
  if (sample.is_mesh() && group == 0) {
    std::vector<char> grouped(sample.points.size(), 0);
    for (const auto& t : sample.triangles)
      for (const std::uint32_t corner : t) grouped[corner] = 1;
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = char(wanted[i] || !grouped[i]);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i]) points.push_back(sample.points[i]);
  return points;
}

Grouped with_solids(const CanonicalSample& sample, const Chords& chords, SolidGroups groups,
                    const SolidOptions& options) {
  Grouped result{std::move(groups), {}};
  for (int k = 0; k < result.groups.count; ++k) {
    const Solid found =
        smallest_of(corners_of(points_of(sample, chords, result.groups, k)), options.kinds, Effort::full);
    result.solids.push_back(options.margin > 0 ? grown(found, options.margin / sample.frame.scale) : found);
  }
  return result;
}

/// The parts of partition(), which are small for ellipsoids.
std::optional<SolidGroups> groups_of_ellipsoids(const CanonicalSample& sample, int count) {
  try {
    const std::vector<Part> parts =
        partition(kept_part(sample, std::vector<char>(sample.points.size(), 1)), count);
    SolidGroups groups;
    groups.count = count;
    groups.group.assign(sample.is_mesh() ? sample.triangles.size() : sample.points.size(), 0);
    for (int k = 0; k < count; ++k)
      for (const std::uint32_t item : parts[std::size_t(k)].items) groups.group[item] = k;
    return groups;
  } catch (const InputError&) {  // a part would be flat
    return std::nullopt;
  }
}

Grouped best_groups(const CanonicalSample& sample, const SolidOptions& options,
                    const std::function<void(const char*, double)>& told) {
  const Chords chords =
      chord_ends(sample, options.pieces > 1 ? some_items(sample) : std::vector<std::uint32_t>());
  const auto cutting = [&](double share) { told("cutting into pieces", 0.8 * share); };
  Grouped best = with_solids(sample, chords,
                             solid_groups(sample, chords, options.kinds, options.pieces, cutting), options);
  told("fitting the pieces", 0.8);
  if (options.pieces == 1) return best;
  double least = volume(best.solids).value;
  const auto offer = [&](SolidGroups groups) {
    Grouped tried = with_solids(sample, chords, std::move(groups), options);
    const double tried_volume = volume(tried.solids).value;
    if (!(tried_volume < least)) return;
    least = tried_volume;
    best = std::move(tried);
  };
  SolidGroups one = best.groups;
  one.count = 1;
  std::fill(one.group.begin(), one.group.end(), 0);
  offer(std::move(one));
  if (auto others = groups_of_ellipsoids(sample, options.pieces)) offer(std::move(*others));
  return best;
}

Solid solid_to_world(const Solid& solid, const Frame& frame) {
  Solid result = solid;
  result.center = frame.to_world(solid.center);
  result.rotation =
      solid.kind == SolidKind::sphere ? Matrix3d::Identity() : Matrix3d(frame.axes * solid.rotation);
  result.sizes = frame.scale * solid.sizes;
  return result;
}

/// What each of the sample's own points and triangles belongs to. Triangles without area go to a piece that a
/// corner belongs to, or to the first where one belongs to none.
Assignment assignment_of_solids(const Sample& sample, const CanonicalSample& canon,
                                const SolidGroups& groups) {
  std::vector<int> of_point(canon.points.size(), -1);
  std::vector<std::pair<std::array<std::uint32_t, 3>, int>> known;
  const auto sorted = [](std::array<std::uint32_t, 3> t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  for (std::size_t i = 0; i < groups.group.size(); ++i) {
    if (!canon.is_mesh()) {
      of_point[i] = groups.group[i];
      continue;
    }
    known.emplace_back(sorted(canon.triangles[i]), groups.group[i]);
    for (const std::uint32_t corner : canon.triangles[i]) of_point[corner] = groups.group[i];
  }
  std::sort(known.begin(), known.end());
  Assignment result;
  for (const auto& t : sample.triangles) {
    const std::array<std::uint32_t, 3> key =
        sorted({canon.index[t[0]], canon.index[t[1]], canon.index[t[2]]});
    const auto found = std::lower_bound(known.begin(), known.end(), std::make_pair(key, 0));
    const bool is_there = found != known.end() && found->first == key;
    int home = is_there ? found->second : -1;
    if (std::any_of(key.begin(), key.end(), [&](std::uint32_t corner) { return of_point[corner] < 0; }))
      home = 0;
    for (const std::uint32_t corner : key)
      if (home < 0) home = of_point[corner];
    result.triangles.push_back(std::max(home, 0));
  }
  for (const std::uint32_t i : canon.index)
    result.points.push_back(i == CanonicalSample::kUnused ? -1 : std::max(of_point[i], 0));
  return result;
}

/// Of points at equal steps of area over the boundary of the union from the scan.
DistanceStatistics protrusion_of(const std::vector<Solid>& solids, const Sample& sample) {
  constexpr int kSteps = 6000;
  struct Flat {
    std::array<Vector3d, 3> corners;
    std::size_t solid;
    double area_before;
  };
  std::vector<Flat> triangles;
  double area = 0;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const CombinedSurface s = surface(solids[k]);
    for (const auto& t : s.triangles) {
      Flat flat{{}, k, area};
      for (std::size_t i = 0; i < 3; ++i) flat.corners[i] = s.vertices[std::size_t(t.vertices[i])];
      const double own =
          0.5 * (flat.corners[1] - flat.corners[0]).cross(flat.corners[2] - flat.corners[0]).norm();
      if (!(own > 0)) continue;
      triangles.push_back(flat);
      area += own;
    }
  }
  const ScanDistance distance(sample);
  DistanceSum all;
  const auto part = [](double x) { return x - std::floor(x); };
  for (int step = 0; step < kSteps && !triangles.empty(); ++step) {
    const double at = area * (step + 0.5) / kSteps;
    const auto next = std::upper_bound(triangles.begin(), triangles.end(), at,
                                       [](double a, const Flat& f) { return a < f.area_before; });
    const Flat& flat = *std::prev(next);
    double u = part(0.7548776662466927 * (step + 1)), v = part(0.5698402909980532 * (step + 1));
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto& [a, b, c] = flat.corners;
    const Vector3d x = a + u * (b - a) + v * (c - a);
    bool covered = false;
    for (std::size_t k = 0; k < solids.size() && !covered; ++k)
      covered = k != flat.solid && solids[k].depth(x) > 1e-12 * solids[k].reach();
    if (!covered) all.add(distance(x));
  }
  return all.result();
}

void measure_solids(const Sample& sample, const CanonicalSample& canon, SolidFit& fit) {
  fit.volume = volume(fit.pieces);
  if (sample.is_mesh()) fit.scan_volume = enclosed_volume(sample);
  const double unit = std::pow(canon.frame.scale, 3);
  try {
    fit.convex_hull_volume = unit * convex_hull(canon.points).volume;
    fit.ellipsoid_volume = unit * min_volume_ellipsoid<3>(canon.points).body.volume();
  } catch (const InputError&) {  // in a plane: no volumes
    fit.convex_hull_volume.reset();
  }
  DistanceSum depths;
  for (const std::uint32_t i : used_points(sample)) {
    double deepest = 0;
    for (const Solid& s : fit.pieces) deepest = std::max(deepest, s.depth(sample.points[i]));
    depths.add(deepest);
  }
  fit.scan_to_hull = depths.result();
  fit.protrusion = protrusion_of(fit.pieces, sample);
}

}  // namespace

SolidFit fit_solids(const Sample& sample, const SolidOptions& options) {
  require_valid(options);
  const auto told = [&](const char* what, double share) {
    if (options.progress && !options.progress(what, share)) throw Interrupted{};
  };
  told("reading the points", 0);
  const CanonicalSample canon = canonical(sample);
  Grouped best = best_groups(canon, options, told);
  told("proving", 0.9);
  SolidFit result;
  for (const Solid& solid : best.solids) result.pieces.push_back(solid_to_world(solid, canon.frame));
  enclose(result.pieces, sample, assignment_of_solids(sample, canon, best.groups), options.margin,
          options.slack);
  result.certificate = check(result.pieces, sample, options.margin);
  result.certified = result.certificate.all_inside();
  told("measuring", 0.95);
  measure_solids(sample, canon, result);
  return result;
}

}  // namespace vericone::fitting
