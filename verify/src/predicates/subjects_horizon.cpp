// SPDX-License-Identifier: GPL-3.0-or-later
//
// Verdicts within a horizon: bodies that come to touch, leave or graze each other exactly at one of its ends,
// up to rounding or exactly.
#include <vericone/cones/pair.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/verify/predicates/hull_truth.h>
#include <vericone/internal/verify/predicates/truth.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "predicates/cases.h"
#include "predicates/subjects.h"

namespace vericone::verify {
namespace {

using cases::Kind;
using cases::kind_of;
using cases::log_uniform;
using cases::Tangency;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kEver = std::numeric_limits<double>::infinity();

bool on_boundary(int answer) { return answer == code(Membership::on); }

/// Of bodies that are apart now or asked about a later time.
Membership membership_of(Verdict verdict) {
  return verdict == Verdict::in ? Membership::in : verdict == Verdict::on ? Membership::on : Membership::out;
}

/// Where the obstacle stands from the place where it touches: the agent, moving along w, is there at `time`.
struct Course {
  Vector3d w;
  double time = 1;
};

/// Along the common plane, towards the obstacle or away from it, by some sizes a second.
Course course(SeededRandom& random, Kind kind, double size, const Vector3d& normal, const Vector3d& grazing) {
  Course c;
  if (kind == Kind::exact) {
    if (random.integer(0, 2) == 0) {
      c.w = grazing;
    } else {
      do
        for (int k = 0; k < 3; ++k) c.w(k) = size * random.integer(-9, 9);
      while (c.w.isZero(0));
    }
    c.time = std::ldexp(random.integer(1, 63), -random.integer(0, 5));
    return c;
  }
  c.w = random.direction<3>();
  if (random.integer(0, 2) == 0) c.w -= c.w.dot(normal) * normal;
  c.time = log_uniform(random, -3, 3) * (kind == Kind::scaled ? log_uniform(random, -100, 100) : 1);
  c.w *= size * random.uniform(5, 50) / c.time;
  return c;
}

struct Question {
  Vector3d v_a, v_b = Vector3d::Zero();
  Horizon horizon;
};

/// Question i of a block: the contact exactly at an end, a few ulps from it, near it, anywhere from `hard`
/// on.
Question question(SeededRandom& random, const Course& at, const Vector3d& c, Kind kind, int i, int hard,
                  bool& is_random) {
  Question q{at.w, Vector3d::Zero(), {0, at.time}};
  is_random = false;
  const auto beside = [&](int most) { return cases::moved_by_ulps(at.time, random.integer(-most, most)); };
  switch (i < hard ? i : kCasesPerBlock) {
    case 0:
      return q;
    case 1:
      q.horizon = {at.time, random.coin() ? kEver : 2 * at.time};
      return q;
    case 2:
      q.horizon = {at.time, at.time};
      return q;
    case 3:
      q.horizon = {0.5 * at.time, at.time};
      return q;
    case 4:
      q.horizon.until = beside(1);
      return q;
    case 5:
      q.horizon = {beside(8), random.coin() ? kEver : 1.5 * at.time};
      return q;
    case 6:
      q.v_a = cases::jittered<3>(random, q.v_a, random.coin() ? 1 : 8);
      return q;
    case 7: {
      // A difference that no double is; exactly w again where numbers are whole.
      const double most = at.w.cwiseAbs().maxCoeff();
      for (int k = 0; k < 3; ++k) q.v_b(k) = std::ldexp(most, random.integer(-40, 40));
      if (kind == Kind::exact)
        for (int k = 0; k < 3; ++k) q.v_b(k) = std::ldexp(at.w(k), random.integer(0, 20));
      q.v_a += q.v_b;
      return q;
    }
    case 8:
    case 9: {
      const double off = log_uniform(random, -16, -3);
      const double near = at.time * (random.coin() ? 1 + off : 1 - off);
      q.horizon = i == 8 ? Horizon{0, near} : Horizon{near, near * random.uniform(1, 2)};
      return q;
    }
    default:
      break;
  }
  is_random = kind == Kind::regular;
  // Aimed more or less, for a part of the way to the obstacle or more; now and then not from now.
  const double speed = c.norm() * log_uniform(random, -2, 2);
  q.v_a = speed * (c / c.norm() + random.uniform(0, 1.5) * random.direction<3>());
  const double time = random.uniform(0, 2) * c.norm() / speed;
  q.horizon = {random.integer(0, 3) ? 0 : time * random.uniform(0, 1), time};
  if (random.coin()) {
    q.v_b = speed * random.direction<3>();
    q.v_a += q.v_b;
  }
  return q;
}

/// The exact rung takes up to a millisecond: one block in 64 is hard, of whole numbers one more in eight has
/// the contact exactly at an end.
int hard_cases(std::uint64_t number) {
  const std::uint64_t round = number / cases::kKinds;
  return round % 64 == 0 ? 10 : round % 8 == 0 && kind_of(number) == Kind::exact ? 4 : 0;
}

bool finite(const Question& q) {
  return q.v_a.allFinite() && q.v_b.allFinite() && (q.v_a - q.v_b).allFinite() && q.v_a != q.v_b &&
         std::isfinite(q.horizon.from) && q.horizon.until >= q.horizon.from && q.horizon.from >= 0;
}

std::array<Question, kCasesPerBlock> questions(SeededRandom& random, const Course& at, const Vector3d& c,
                                               Kind kind, int hard, Block& block) {
  std::array<Question, kCasesPerBlock> all;
  for (int i = 0; i < kCasesPerBlock; ++i) do
      all[i] = question(random, at, c, kind, i, hard, block.cases[i].random);
    while (!finite(all[i]));
  return all;
}

void run_ellipsoids(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  SeededRandom random(370, seed, number);
  const Kind kind = kind_of(number);
  for (;;) {
    const Tangency<3> t = cases::tangency<3>(random, kind, false);
    const Course at = course(random, kind, t.size, t.normal, t.grazing);
    // Where they touch, and from there as far as the agent comes.
    const Vector3d place = t.b.center() - t.grazing + at.time * at.w, c = place - t.a.center();
    if (!place.allFinite() || !at.w.allFinite() || !(at.time > 0) || at.w.isZero(0)) continue;
    const Ellipsoid b = cases::moved_to<3>(t.b, place);
    const ConeOracle oracle(t.a, b);
    if (oracle.relation() != Relation::disjoint) continue;
    const auto all = questions(random, at, c, kind, hard_cases(number), block);
    climb_all(block, [&](int i, Rung* rung) {
      return code(membership_of(oracle.verdict(all[i].v_a, all[i].v_b, all[i].horizon, rung)));
    });
    const ConeTruth* truth = nullptr;
    std::optional<ConeTruth> asked;
    if (depth.truth) truth = &asked.emplace(t.a, b);
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& one = block.cases[i];
      const auto& [v_a, v_b, horizon] = all[i];
      one.interval = code(interval_within(t.a, b, v_a, v_b, horizon));
      if (depth.exact) one.exact = code(exact_within(t.a, b, v_a, v_b, horizon));
      if (truth) one.truth = code(truth->within(v_a, v_b, horizon));
    }
    return;
  }
}

/// Points on one side of the plane { normal.x = 0 }, one of them in it; whole numbers: one, two or three in
/// { z = 0 }.
Points points(SeededRandom& random, Kind kind, double size, const Vector3d& normal) {
  const int n = random.integer(0, 5) ? random.integer(4, 8) : random.integer(1, 3);
  const int in_plane = random.integer(1, 3);
  Points r;
  Vector3d stretch(1, 1, 1);
  if (kind == Kind::thin) stretch(random.integer(0, 2)) = log_uniform(random, -8, 0);
  for (int i = 0; i < n; ++i) {
    Vector3d x;
    for (int k = 0; k < 3; ++k)
      x(k) = kind == Kind::exact ? random.integer(-9, 9) : 5 * size * stretch(k) * random.uniform(-1, 1);
    if (kind == Kind::exact) x.z() = i < in_plane ? 0 : std::abs(x.z());
    r.push_back(x);
  }
  Vector3d lowest = r.front();
  if (kind != Kind::exact)
    for (const Vector3d& x : r)
      if (normal.dot(x) < normal.dot(lowest)) lowest = x;
  for (Vector3d& x : r) x -= lowest;
  return r;
}

template <typename Agent>
void ask_hulls(SeededRandom& random, std::uint64_t number, Kind kind, const Course& at, const Agent& a,
               const HullBody& b, const Vector3d& c, Depth depth, Block& block) {
  const auto all = questions(random, at, c, kind, hard_cases(number), block);
  const Pair pair{Placed(Body(a)), Placed(Body(b))};
  climb_all(block, [&](int i, Rung*) {
    return code(membership_of(pair.verdict(all[i].v_a, all[i].v_b, all[i].horizon)));
  });
  const HullOracle oracle(a, b);
  const AssemblyOracle pieces(a, Assembly::polyhedra({b}));
  std::optional<HullTruth> truth;
  if (depth.truth) truth.emplace(a, b);
  for (int i = 0; i < kCasesPerBlock; ++i) {
    PredicateCase& one = block.cases[i];
    const auto& [v_a, v_b, horizon] = all[i];
    Effort effort;
    const Membership as_piece = membership_of(pieces.verdict(v_a, v_b, horizon, &effort));
    const bool out = horizon.from == 0 && oracle.surely_out(v_a, v_b, horizon);
    one.rung = out ? Rung::triage : effort.exact == 0 ? Rung::interval : Rung::exact;
    if (out) one.triage = code(Membership::out);
    if (effort.exact == 0) one.interval = code(as_piece);
    if (depth.exact) one.exact = code(oracle.exact_within(v_a, v_b, horizon));
    if (truth) one.truth = code(truth->within(v_a, v_b, horizon));
  }
}

void run_hulls(std::uint32_t stream, bool with_ellipsoid, std::uint64_t seed, std::uint64_t number,
               Depth depth, Block& block) {
  SeededRandom random(stream, seed, number);
  const Kind kind = kind_of(number);
  for (;;) {
    Vector3d normal = random.direction<3>(), home, touching = Vector3d::Zero();
    double size = kind == Kind::scaled ? log_uniform(random, -100, 100) : 1;
    Matrix3d m = Matrix3d::Identity();
    std::optional<Ellipsoid> round;
    for (int k = 0; k < 3; ++k)
      home(k) = kind == Kind::exact
                    ? random.integer(-9, 9)
                    : size * random.uniform(-1, 1) * (kind == Kind::far ? log_uniform(random, 3, 12) : 10);
    if (kind == Kind::exact) {
      do
        for (int i = 0; i < 9; ++i) m(i) = random.integer(-3, 3);
      while (std::abs(m.determinant()) < 0.5);
      m *= std::ldexp(1.0, random.integer(0, 2) ? 0 : random.integer(-300, 300));
      normal = Vector3d::UnitZ();
    }
    if (with_ellipsoid && kind == Kind::exact) {
      const Vector3d axes(random.integer(1, 9), random.integer(1, 9), random.integer(1, 9));
      round = Ellipsoid::from_shape(m * home, m * axes.cwiseAbs2().asDiagonal() * m.transpose());
      touching.z() = axes.z();
    } else if (with_ellipsoid) {
      const Tangency<3> t = cases::tangency<3>(random, kind, true);
      round = t.a;
      size = t.size;
      normal = t.normal;
      home = t.a.center();
      touching = t.a.support_point(normal);
    }
    Points a, b = points(random, kind, size, normal);
    if (!with_ellipsoid) a = points(random, kind, size, normal);
    Vector3d along;
    for (int k = 0; k < 3; ++k) along(k) = random.integer(-9, 9);
    along.z() = 0;
    if (kind == Kind::exact && along.isZero(0)) continue;
    Course at = course(random, kind, kind == Kind::exact ? 1 : size, normal, along);
    at.w = m * at.w;
    const Vector3d to = at.time * at.w;
    for (Vector3d& x : a) x = m * (home - x);
    for (Vector3d& x : b) x = m * (home + touching + x) + to;
    const Vector3d c = to + m * touching;
    if (!c.allFinite() || c.isZero(0) || !(at.time > 0) || at.w.isZero(0)) continue;
    const HullBody obstacle(b);
    if (with_ellipsoid) {
      if (HullOracle(*round, obstacle).relation() != Relation::disjoint) continue;
      ask_hulls(random, number, kind, at, *round, obstacle, c, depth, block);
    } else {
      const HullBody agent(a);
      if (HullOracle(agent, obstacle).relation() != Relation::disjoint) continue;
      ask_hulls(random, number, kind, at, agent, obstacle, c, depth, block);
    }
    return;
  }
}

void run_ellipsoid_and_hull(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  run_hulls(371, true, seed, number, depth, block);
}
void run_two_hulls(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  run_hulls(372, false, seed, number, depth, block);
}

constexpr Subject kSubjects[] = {
    {"horizon, two ellipsoids", run_ellipsoids, on_boundary},
    {"horizon, ellipsoid and hull", run_ellipsoid_and_hull, on_boundary},
    {"horizon, two hulls", run_two_hulls, on_boundary},
};

}  // namespace

std::span<const Subject> horizon_subjects() { return kSubjects; }

}  // namespace vericone::verify
