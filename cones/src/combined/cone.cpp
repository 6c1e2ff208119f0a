// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/cone_size.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "combined/tracer.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

/// Half-planes to begin with, and the most there may be.
constexpr int kFirstSectors = 12, kMostSectors = 4096;

}  // namespace

CombinedCone combined_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance,
                           std::uint64_t most_boxes) {
  // Chords that stand off by less than the rounding of their ends prove nothing.
  if (!(tolerance >= 1e-9) || !(tolerance < 1))
    throw InputError("tolerance", to_text(tolerance), "at least 1e-9 and below 1");
  const CombinedOracle oracle(a, b, std::min(1e-4, 1e-2 * tolerance));
  CombinedCone cone;
  cone.relation = oracle.relation();
  const Vector3d c = b.center() - a.center();
  if (!c.isZero(0)) cone.axis = c.normalized();
  if (cone.relation != Relation::disjoint) {
    if (!cone.relation) return cone;
    const double whole = (*cone.relation == Relation::touching ? 2 : 4) * std::numbers::pi;
    cone.solid_angle = cone.inner.solid_angle = cone.outer.solid_angle = whole;
    cone.cross_section_area = cone.inner.cross_section_area = cone.outer.cross_section_area =
        std::numeric_limits<double>::infinity();
    return cone;
  }

  Tracer tracer(oracle, tolerance, kFirstSectors);
  std::vector<ConeWedge> heap, done;
  double inner = 0, outer = 0;
  int unbounded = 0;
  const auto count = [&](const ConeWedge& s, int sign) {
    inner += sign * s.inner;
    if (std::isinf(s.outer)) {
      unbounded += sign;
    } else {
      outer += sign * s.outer;
    }
  };
  const auto add = [&](int first, int last) {
    std::vector<std::pair<int, int>> waiting{{first, last}};
    while (!waiting.empty()) {
      checkpoint();
      const auto [from, to] = waiting.back();
      waiting.pop_back();
      const ConeWedge s = tracer.wedge(from, to);
      const std::vector<int> moved = tracer.take_moved();
      if (!moved.empty()) {
        // The wedges on both sides of an end that has moved are others now.
        waiting.emplace_back(from, to);
        for (std::vector<ConeWedge>* list : {&heap, &done}) {
          const auto touched = [&](const ConeWedge& other) {
            return std::any_of(moved.begin(), moved.end(),
                               [&](int k) { return other.first == k || other.last == k; });
          };
          for (const ConeWedge& other : *list)
            if (touched(other)) {
              count(other, -1);
              waiting.emplace_back(other.first, other.last);
            }
          list->erase(std::remove_if(list->begin(), list->end(), touched), list->end());
        }
        std::make_heap(heap.begin(), heap.end());
        continue;
      }
      count(s, 1);
      heap.push_back(s);
      std::push_heap(heap.begin(), heap.end());
    }
  };
  for (int i = 0; i < kFirstSectors; ++i) add(i, (i + 1) % kFirstSectors);
  while (!heap.empty() && heap.size() + done.size() < kMostSectors && oracle.boxes_searched() < most_boxes &&
         (unbounded > 0 || outer - inner > tolerance * outer)) {
    std::pop_heap(heap.begin(), heap.end());
    const ConeWedge s = heap.back();
    heap.pop_back();
    // Too narrow to gain anything: the ends themselves are all the gap.
    const double width = tracer.ends()[s.last].azimuth - tracer.ends()[s.first].azimuth;
    if (width >= 0 && width < 1e-5) {
      done.push_back(s);
      continue;
    }
    count(s, -1);
    const int middle = tracer.divide(s);
    add(s.first, middle);
    add(middle, s.last);
  }
  heap.insert(heap.end(), done.begin(), done.end());
  std::sort(heap.begin(), heap.end(), [&](const ConeWedge& x, const ConeWedge& y) {
    return tracer.ends()[x.first].azimuth < tracer.ends()[y.first].azimuth;
  });

  cone.boxes = oracle.boxes_searched();
  for (const ConeWedge& s : heap) {
    const ConeEnd &first = tracer.ends()[s.first], &last = tracer.ends()[s.last];
    cone.inner.directions.push_back(tracer.direction(first.azimuth, s.in.first));
    cone.inner.directions.push_back(tracer.direction(last.azimuth, s.in.last));
    cone.outer.directions.push_back(tracer.direction(first.azimuth, s.out.first));
    cone.outer.directions.push_back(tracer.direction(last.azimuth, s.out.last));
  }
  // Areas are rounded; what they may lose is a part of the bound.
  constexpr double kRounding = 1e-12;
  for (PolyhedralCone* p : {&cone.inner, &cone.outer}) {
    p->solid_angle = polygon_solid_angle(cone.axis, p->directions);
    p->cross_section_area = polygon_section_area(cone.axis, p->directions);
  }
  if (unbounded > 0) cone.outer.solid_angle = 4 * std::numbers::pi;
  cone.solid_angle = 0.5 * (cone.inner.solid_angle + cone.outer.solid_angle);
  cone.solid_angle_error =
      0.5 * (cone.outer.solid_angle - cone.inner.solid_angle) + kRounding * cone.outer.solid_angle;
  cone.cross_section_area = std::isinf(cone.outer.cross_section_area)
                                ? cone.outer.cross_section_area
                                : 0.5 * (cone.inner.cross_section_area + cone.outer.cross_section_area);
  cone.cross_section_area_error =
      std::isinf(cone.cross_section_area)
          ? cone.cross_section_area
          : 0.5 * (cone.outer.cross_section_area - cone.inner.cross_section_area) +
                kRounding * cone.outer.cross_section_area;
  return cone;
}

std::vector<PlaneInterval> plane_intervals(const CombinedOracle& oracle, const Vector3d& x_axis,
                                           const Vector3d& y_axis, double resolution) {
  if (!(resolution >= 1e-12) || !(resolution < 1))
    throw InputError("resolution", to_text(resolution), "between 1e-12 and 1 (radians)");
  std::vector<PlaneInterval> result;
  const auto direction = [&](double t) -> Vector3d { return std::cos(t) * x_axis + std::sin(t) * y_axis; };
  const auto append = [&](double from, double to, Certified answer) {
    if (!result.empty() && result.back().answer == answer) {
      result.back().to = to;
    } else {
      result.push_back({from, to, answer});
    }
  };
  const auto resolve = [&](const auto& self, double from, double to) -> void {
    checkpoint();
    const Certified middle = oracle.membership(direction(0.5 * (from + to)));
    const bool all = middle == Certified::in
                         ? oracle.all_in(direction(from), direction(to))
                         : middle == Certified::out && oracle.all_out(direction(from), direction(to));
    const Certified answer = all ? middle : Certified::undecided;
    if (answer != Certified::undecided || to - from <= resolution) {
      append(from, to, answer);
      return;
    }
    const double half = 0.5 * (from + to);
    self(self, from, half);
    self(self, half, to);
  };
  constexpr int kFirst = 16;
  for (int i = 0; i < kFirst; ++i)
    resolve(resolve, std::numbers::pi * (2.0 * i / kFirst - 1),
            std::numbers::pi * (2.0 * (i + 1) / kFirst - 1));
  return result;
}

}  // namespace vericone
