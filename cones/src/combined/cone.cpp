// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/combined/cone.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Vector3d;

/// Half-planes to begin with, and the most there may be.
constexpr int kFirstSectors = 12, kMostSectors = 4096;

/// The end of the cone on one half-plane: angles from the axis that are in and out.
struct End {
  double azimuth = 0, in = 0, out = std::numbers::pi;
};

/// Between two neighbouring half-planes: on both, how far the chords stand off the ends.
struct Wedge {
  End first, last;
  double inwards = 0, outwards = 0;  // radians
  double inner = 0, outer = 0;       // solid angles of the triangles with the axis, steradian
  double gap() const { return outer - inner; }
  bool operator<(const Wedge& other) const { return gap() < other.gap(); }
};

class Tracer {
 public:
  Tracer(const CombinedOracle& oracle, double tolerance)
      : oracle_(oracle), frame_(oracle.b().center() - oracle.a().center()), tolerance_(tolerance) {}

  const AxisFrame& frame() const { return frame_; }

  Vector3d direction(double azimuth, double angle) const {
    return std::cos(angle) * frame_.axis +
           std::sin(angle) * (std::cos(azimuth) * frame_.e1 + std::sin(azimuth) * frame_.e2);
  }

  /// By bisection: the axis is in and its opposite out, whatever the bodies (docs/theory.md, 7).
  End end(double azimuth, double guess, double spread) const {
    End e{azimuth, 0, std::numbers::pi};
    const auto ask = [&](double angle) {
      const Certified answer = oracle_.membership(direction(azimuth, angle));
      if (answer == Certified::in) e.in = angle;
      if (answer == Certified::out) e.out = angle;
      return answer;
    };
    // Closing in from the guess.
    for (double step = spread; e.out == std::numbers::pi && guess + step < std::numbers::pi; step *= 4)
      if (ask(guess + step) != Certified::in) break;
    for (double step = spread; e.in == 0 && guess - step > 0; step *= 4)
      if (ask(guess - step) != Certified::out) break;
    for (int step = 0; step < 60 && e.out - e.in > tolerance_ * 0.05 * std::sin(0.5 * (e.in + e.out)); ++step)
      if (ask(0.5 * (e.in + e.out)) == Certified::undecided) break;
    return e;
  }

  Wedge sector(const End& first, const End& last, double standoff) const {
    Wedge s{first, last, 0, 0, 0, 0};
    s.outwards =
        least_standoff(standoff, std::numbers::pi - 1e-6 - std::max(first.out, last.out), [&](double d) {
          return oracle_.all_out(direction(first.azimuth, first.out + d),
                                 direction(last.azimuth, last.out + d));
        });
    s.inwards = least_standoff(standoff, std::min(first.in, last.in), [&](double d) {
      return oracle_.all_in(direction(first.azimuth, first.in - d), direction(last.azimuth, last.in - d));
    });
    // What could not be proved at any distance: nothing is known to be out, nothing but the axis to be in.
    s.outer = s.outwards < 0 ? std::numeric_limits<double>::infinity()
                             : triangle(first, last, first.out + s.outwards, last.out + s.outwards);
    s.inner = s.inwards < 0 ? 0 : triangle(first, last, first.in - s.inwards, last.in - s.inwards);
    return s;
  }

 private:
  /// The least of a few distances at which the chord is certified; -1 for none up to `most`.
  template <typename Holds>
  static double least_standoff(double first, double most, const Holds& holds) {
    for (double d = 0.5 * first; d < most; d *= 2)
      if (holds(d)) return d;
    return -1;
  }

  double triangle(const End& first, const End& last, double angle_first, double angle_last) const {
    const Vector3d b = direction(first.azimuth, angle_first), c = direction(last.azimuth, angle_last);
    const Vector3d& a = frame_.axis;
    return 2 * std::atan2(a.dot((b - a).cross(c - a)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }

  const CombinedOracle& oracle_;
  AxisFrame frame_;
  double tolerance_;
};

/// Where a chord stands off little, the ends are what matters; where it bends, its sagitta.
double expected_standoff(const End& first, const End& last) {
  const double width = last.azimuth - first.azimuth, angle = 0.5 * (first.in + last.in);
  return std::max({0.125 * width * width * std::sin(angle), first.out - first.in, last.out - last.in, 1e-9});
}

}  // namespace

CombinedCone combined_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance,
                           std::uint64_t most_boxes) {
  if (!(tolerance > 0) || !(tolerance < 1))
    throw InputError("tolerance", to_text(tolerance), "between 0 and 1");
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

  const Tracer tracer(oracle, tolerance);
  std::vector<End> ends;
  // What the ellipsoids around would show is a fair first guess.
  double guess = std::atan2(a.ellipsoid().semi_axes()(1) + b.ellipsoid().semi_axes()(1), c.norm());
  for (int i = 0; i < kFirstSectors; ++i) {
    ends.push_back(tracer.end(2 * std::numbers::pi * i / kFirstSectors, guess, 0.1 * guess));
    guess = 0.5 * (ends.back().in + ends.back().out);
  }
  std::vector<Wedge> heap;
  double inner = 0, outer = 0;
  int unbounded = 0;
  const auto count = [&](const Wedge& s, int sign) {
    inner += sign * s.inner;
    if (std::isinf(s.outer)) {
      unbounded += sign;
    } else {
      outer += sign * s.outer;
    }
  };
  const auto add = [&](const Wedge& s) {
    count(s, 1);
    heap.push_back(s);
    std::push_heap(heap.begin(), heap.end());
  };
  for (int i = 0; i < kFirstSectors; ++i) {
    End last = ends[(i + 1) % kFirstSectors];
    if (i + 1 == kFirstSectors) last.azimuth += 2 * std::numbers::pi;
    add(tracer.sector(ends[i], last, expected_standoff(ends[i], last)));
  }
  std::vector<Wedge> done;
  while (!heap.empty() && heap.size() + done.size() < kMostSectors && oracle.boxes_searched() < most_boxes &&
         (unbounded > 0 || outer - inner > tolerance * outer)) {
    std::pop_heap(heap.begin(), heap.end());
    const Wedge s = heap.back();
    heap.pop_back();
    // Too narrow to gain anything: the ends themselves are all the gap.
    if (s.last.azimuth - s.first.azimuth < 1e-5) {
      done.push_back(s);
      continue;
    }
    count(s, -1);
    const double between = 0.5 * (s.first.azimuth + s.last.azimuth);
    const double around = 0.25 * (s.first.in + s.first.out + s.last.in + s.last.out);
    const End middle = tracer.end(between, around, std::max(expected_standoff(s.first, s.last), 1e-6));
    add(tracer.sector(s.first, middle, expected_standoff(s.first, middle)));
    add(tracer.sector(middle, s.last, expected_standoff(middle, s.last)));
  }
  heap.insert(heap.end(), done.begin(), done.end());
  std::sort(heap.begin(), heap.end(),
            [](const Wedge& x, const Wedge& y) { return x.first.azimuth < y.first.azimuth; });

  for (const Wedge& s : heap) {
    // An outer chord that was not found: out is only what lies straight behind.
    const double far_first = s.outwards < 0 ? std::numbers::pi : s.first.out + s.outwards,
                 far_last = s.outwards < 0 ? std::numbers::pi : s.last.out + s.outwards;
    const double near_first = s.inwards < 0 ? 0 : s.first.in - s.inwards,
                 near_last = s.inwards < 0 ? 0 : s.last.in - s.inwards;
    cone.inner.directions.push_back(tracer.direction(s.first.azimuth, near_first));
    cone.inner.directions.push_back(tracer.direction(s.last.azimuth, near_last));
    cone.outer.directions.push_back(tracer.direction(s.first.azimuth, far_first));
    cone.outer.directions.push_back(tracer.direction(s.last.azimuth, far_last));
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
  if (!(resolution > 0) || !(resolution < 1))
    throw InputError("resolution", to_text(resolution), "between 0 and 1 (radians)");
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
