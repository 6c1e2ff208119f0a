// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/verify/predicates/hull_truth.h>

#include <Eigen/LU>
#include <cmath>

#include "predicates/cases.h"
#include "predicates/subjects.h"

namespace vericone::verify {
namespace {

using cases::Kind;
using cases::kind_of;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

bool on_boundary(int answer) { return answer == code(Membership::on); }

/// Points with a plane of support: normal.x is least at `lowest`. Integers: one, two or three points lie in
/// the plane { z = 0 }, none below.
Points points(SeededRandom& random, Kind kind, double size, const Vector3d& normal, Vector3d& lowest) {
  const int n = random.integer(0, 7) ? random.integer(4, 12) : random.integer(1, 3);
  Points r;
  Vector3d stretch(1, 1, 1);
  if (kind == Kind::thin) stretch(random.integer(0, 2)) = cases::log_uniform(random, -8, 0);
  const int in_plane = random.integer(1, 3);
  for (int i = 0; i < n; ++i) {
    Vector3d x;
    for (int k = 0; k < 3; ++k)
      x(k) = kind == Kind::exact ? random.integer(-9, 9) : 5 * size * stretch(k) * random.uniform(-1, 1);
    if (kind == Kind::exact) x.z() = i < in_plane ? 0 : std::abs(x.z());
    r.push_back(x);
  }
  lowest = r.front();
  if (kind != Kind::exact)
    for (const Vector3d& x : r)
      if (normal.dot(x) < normal.dot(lowest)) lowest = x;
  return r;
}

/// Two bodies on the two sides of a plane, and a velocity along it from one to the other.
struct HullScene {
  std::optional<Ellipsoid> ellipsoid;  // A, or the points `a`
  Points a, b;
  Vector3d grazing, c;
};

Vector3d slide(SeededRandom& random, Kind kind, double size, const Vector3d& normal) {
  Vector3d s;
  for (int k = 0; k < 3; ++k)
    s(k) = kind == Kind::exact ? random.integer(-20, 20) : 20 * size * random.uniform(-1, 1);
  if (kind == Kind::exact)
    s.z() = 0;
  else
    s -= s.dot(normal) * normal;
  return s;
}

HullScene scene(SeededRandom& random, Kind kind, bool with_ellipsoid) {
  HullScene h;
  double size = 1;
  if (with_ellipsoid) {
    // The ellipsoid A of a tangency whose B is replaced by points beyond the plane.
    const cases::Tangency<3> t = cases::tangency<3>(random, kind, false);
    h.ellipsoid = t.a;
    size = t.size;
    Vector3d lowest;
    if (kind == Kind::exact) {
      // The plane and the point of support are known to a rounding only: a body along the axes instead.
      const Vector3d axes(random.integer(1, 9), random.integer(1, 9), random.integer(1, 9));
      Matrix3d m;
      do
        for (int i = 0; i < 9; ++i) m(i) = random.integer(-3, 3);
      while (std::abs(m.determinant()) < 0.5);
      Vector3d home;
      for (int k = 0; k < 3; ++k) home(k) = random.integer(-9, 9);
      const Matrix3d s = axes.cwiseAbs2().asDiagonal();
      h.ellipsoid = Ellipsoid::from_shape(size * (m * home), size * (size * (m * s * m.transpose())));
      const Vector3d along = slide(random, kind, 1, Vector3d::Zero());
      h.b = points(random, kind, 1, Vector3d::Zero(), lowest);
      const Vector3d at = home + Vector3d(0, 0, axes.z()) + along;
      for (Vector3d& x : h.b) x = size * (m * (x - lowest + at));
      h.grazing = size * (m * along);
    } else {
      const Vector3d support = t.a.support_point(t.normal);
      h.b = points(random, kind, size, t.normal, lowest);
      for (Vector3d& x : h.b) x += support + t.grazing - lowest;
      h.grazing = t.grazing;
    }
    h.c = h.b.front() - h.ellipsoid->center();
    return h;
  }
  const Vector3d normal = random.direction<3>();
  if (kind == Kind::scaled) size = cases::log_uniform(random, -149, 146);
  Vector3d low_a, low_b, home;
  const Vector3d along = slide(random, kind, size, normal);
  h.a = points(random, kind, size, -normal, low_a);
  h.b = points(random, kind, size, normal, low_b);
  Matrix3d m = Matrix3d::Identity();
  if (kind == Kind::exact) {
    for (Vector3d& x : h.a) x.z() = -x.z();
    do
      for (int i = 0; i < 9; ++i) m(i) = random.integer(-3, 3);
    while (std::abs(m.determinant()) < 0.5);
    m *= std::ldexp(1.0, random.integer(0, 2) ? 0 : random.integer(-480, 480));
  }
  const double offset = kind == Kind::far ? cases::log_uniform(random, 3, 12) : 10;
  for (int k = 0; k < 3; ++k)
    home(k) = kind == Kind::exact ? random.integer(-9, 9) : size * offset * random.uniform(-1, 1);
  for (Vector3d& x : h.a) x = m * (x - low_a + home);
  for (Vector3d& x : h.b) x = m * (x - low_b + home + along);
  h.grazing = m * along;
  h.c = h.b.back() - h.a.back();
  return h;
}

Vector3d velocity(SeededRandom& random, const HullScene& h, Kind kind, int i, bool& is_random) {
  is_random = false;
  const Vector3d& w = h.grazing;
  if (i == 0) return w;
  if (i == 1) return -w;
  if (i < 5) return cases::jittered<3>(random, w, i == 2 ? 1 : 8);
  if (i < 7) {
    const double off = cases::log_uniform(random, -16, -3) * w.norm();
    return w + off * random.direction<3>();
  }
  if (i < 10) {
    // Between two points: through a corner, and for hulls on the cone's edges now and then.
    const Vector3d& to = h.b[static_cast<std::size_t>(random.integer(0, static_cast<int>(h.b.size()) - 1))];
    if (h.ellipsoid) return to - h.ellipsoid->center();
    return to - h.a[static_cast<std::size_t>(random.integer(0, static_cast<int>(h.a.size()) - 1))];
  }
  is_random = kind == Kind::regular;
  const Vector3d e = random.direction<3>();
  if (i < 13) return e;
  return h.c / h.c.norm() + random.uniform(0, 1) * e;
}

void run(std::uint32_t stream, bool with_ellipsoid, std::uint64_t seed, std::uint64_t number, Depth depth,
         Block& block) {
  SeededRandom random(stream, seed, number);
  const Kind kind = kind_of(number);
  for (;;) {
    const HullScene h = scene(random, kind, with_ellipsoid);
    std::array<Vector3d, kCasesPerBlock> w;
    for (int i = 0; i < kCasesPerBlock; ++i) w[i] = velocity(random, h, kind, i, block.cases[i].random);
    const bool reversed = with_ellipsoid && random.coin();
    if (h.grazing.isZero(0) || !h.c.allFinite() || h.c.isZero(0)) continue;
    if (reversed)
      for (Vector3d& v : w) v = -v;
    const HullBody b(h.b);
    const HullOracle oracle = !with_ellipsoid ? HullOracle(HullBody(h.a), b)
                              : reversed      ? HullOracle(b, *h.ellipsoid)
                                              : HullOracle(*h.ellipsoid, b);
    if (oracle.relation() != Relation::disjoint) continue;
    climb_all(block, [&](int i, Rung* rung) { return code(oracle.membership(w[i], rung)); });
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& c = block.cases[i];
      c.triage = code(oracle.triage_membership(w[i]));
      c.interval = code(oracle.interval_membership(w[i], Vector3d::Zero()));
      if (depth.exact) c.exact = code(oracle.exact_membership(w[i], Vector3d::Zero()));
    }
    if (depth.truth) {
      const HullTruth truth = !with_ellipsoid ? HullTruth(HullBody(h.a), b)
                              : reversed      ? HullTruth(b, *h.ellipsoid)
                                              : HullTruth(*h.ellipsoid, b);
      for (int i = 0; i < kCasesPerBlock; ++i)
        block.cases[i].truth = truth.relation() == Relation::disjoint
                                   ? code(truth.membership(w[i]))
                                   : code(Membership::out) + 1;  // none of the answers
    }
    return;
  }
}

void run_ellipsoid(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  run(340, true, seed, number, depth, block);
}
void run_hulls(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  run(341, false, seed, number, depth, block);
}

constexpr Subject kSubjects[] = {
    {"velocity, ellipsoid and hull", run_ellipsoid, on_boundary},
    {"velocity, two hulls", run_hulls, on_boundary},
};

}  // namespace

std::span<const Subject> hull_subjects() { return kSubjects; }

}  // namespace vericone::verify
