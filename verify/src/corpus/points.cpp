// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points on quadrics, hulls of points grazed by a body, and a sphere that grazes the rim of an orifice.
#include <algorithm>
#include <array>

#include "corpus/build.h"

namespace vericone::verify::corpus {
namespace {

constexpr std::uint32_t kSide = 0xc0505, kHull = 0xc0506, kOrifice = 0xc0507;

CorpusCase start_point(const char* predicate, const std::string& family, const std::string& kind,
                       std::uint64_t index, const char* truth) {
  CorpusCase c;
  c.predicate = predicate;
  c.family = family;
  c.kind = kind;
  c.index = index;
  c.truth = truth;
  c.source = "construction";
  c.rung = c.truth == "zero" || c.truth == "on" || c.truth == "grazes" ? "exact" : "any";
  return c;
}

const char* sign_text(int sign) { return sign < 0 ? "negative" : sign > 0 ? "positive" : "zero"; }

/// Stereographic: a rational point of the unit circle or sphere, and its denominator.
template <int D>
std::pair<Vec<D>, Rational> sphere_point(SeededRandom& random) {
  Vec<D> u;
  Rational square = 0;
  for (int i = 0; i + 1 < D; ++i) {
    const int x = random.integer(-3, 3);
    u[i] = 2 * x;
    square += x * x;
  }
  u[D - 1] = square - 1;
  return {times<D>(1 / (square + 1), u), square + 1};
}

/// Sign of (x - p)^T S^{-1} (x - p) - 1, from det [[S, x - p], [(x - p)^T, 1]] = det S (1 - ...).
template <int D>
int bordered_sign(const CorpusCase& c) {
  const auto body = c.rational_body<D>("a");
  const auto& x = c.values("point");
  Mat<D + 1> m;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) m[i][j] = body.shape[i][j];
    m[i][D] = m[D][i] = x[i] - body.center[i];
  }
  m[D][D] = 1;
  return -exact::determinant<D + 1>(m).sign();
}

template <int D>
void point_on_body(std::vector<CorpusCase>& cases, SeededRandom& random, std::uint64_t index) {
  const Map<D> map = random_map<D>(random, index);
  const auto [u, n] = sphere_point<D>(random);
  const Body<D> body{{}, product<D>(identity<D>(n), random_factor<D>(random))};
  const Vec<D> on = apply<D>(body.factor, u);
  const auto add = [&](const char* family, const char* truth, const Rational& radius) {
    CorpusCase c = start_point("side", family, map.kind, index, truth);
    add_body<D>(c, "a", map, body);
    add_point<D>(c, "point", map, times<D>(radius, on));
    if (fits(c)) cases.push_back(std::move(c));
  };
  const std::size_t before = cases.size();
  add("surface", "zero", 1);
  if (cases.size() == before) return;
  const CorpusCase zero = cases.back();
  const Rational e = power_of_two(-random.integer(3, 46));
  add("surface-nudged", "negative", 1 - e);
  add("surface-nudged", "positive", 1 + e);
  for (CorpusCase& c : neighbours(zero, "point", 3, random)) {
    c.truth = sign_text(bordered_sign<D>(c));
    if (c.truth == "zero") c.rung = "exact";
    cases.push_back(std::move(c));
  }
}

/// x~^T Q x~, Q by its upper triangle: what the predicate means, word for word.
template <int D>
int value_sign(const CorpusCase& c) {
  const auto& q = c.values("quadric");
  std::array<Rational, D + 1> x;
  for (int i = 0; i < D; ++i) x[i] = c.values("point")[i];
  x[D] = 1;
  Rational sum = 0;
  for (int i = 0, at = 0; i <= D; ++i)
    for (int j = i; j <= D; ++j, ++at) sum += (i == j ? 1 : 2) * q[at] * x[i] * x[j];
  return sum.sign();
}

/// Canonical quadrics with a rational point: hyperboloids of one and two sheets, cone, paraboloid.
void point_on_quadric(std::vector<CorpusCase>& cases, SeededRandom& random, std::uint64_t index) {
  const Map<3> map = random_map<3>(random, index);
  const int t = random.integer(-5, 5), a = random.integer(2, 5);
  const int b = random.integer(1, a - 1);
  Mat<4> q;
  Vec<3> x;
  std::string family;
  q[0][0] = q[1][1] = 1;
  q[2][2] = -1;
  switch (random.integer(0, 3)) {
    case 0:
      family = "one-sheet";  // x^2 + y^2 - z^2 = 1 has the lines (1, t, t)
      q[3][3] = -1;
      x = {1, t, t};
      break;
    case 1:
      family = "two-sheets";  // z^2 = 1 + x^2 + y^2
      q[3][3] = 1;
      x = {Rational(2 * a * b, a * a - b * b), 0, Rational(a * a + b * b, a * a - b * b)};
      break;
    case 2:
      family = "cone";
      x = {a * a - b * b, 2 * a * b, a * a + b * b};
      break;
    default:
      family = "paraboloid";  // x^2 + y^2 = 2 z
      q[2][2] = 0;
      q[2][3] = q[3][2] = -1;
      x = {a, t, Rational(a * a + t * t, 2)};
  }
  // Q' = T^{-T} Q T^{-1} for x' = T x; adj instead of the inverse is a positive factor det^2.
  Mat<4> forward;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) forward[i][j] = map.m[i][j];
    forward[i][3] = map.offset[i];
  }
  forward[3][3] = 1;
  Mat<4> back;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {  // cofactor
      Mat<3> minor;
      for (int r = 0, rr = 0; r < 4; ++r) {
        if (r == j) continue;
        for (int s = 0, ss = 0; s < 4; ++s)
          if (s != i) minor[rr][ss++] = forward[r][s];
        ++rr;
      }
      back[i][j] = ((i + j) % 2 ? -1 : 1) * exact::determinant<3>(minor);
    }
  const Mat<4> image = product<4>(transposed<4>(back), product<4>(q, back));
  CorpusField field{"quadric", {}};
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j) field.values.push_back(image[i][j]);
  CorpusCase c = start_point("side", family, map.kind, index, "zero");
  c.fields.push_back(field);
  add_point<3>(c, "point", map, x);
  if (!fits(c)) return;
  const CorpusCase zero = c;
  cases.push_back(std::move(c));
  for (CorpusCase& n : neighbours(zero, "point", 3, random)) {
    n.truth = sign_text(value_sign<3>(n));
    if (n.truth == "zero") n.rung = "exact";
    cases.push_back(std::move(n));
  }
}

void add_points(CorpusCase& c, const std::string& name, const Map<3>& map,
                const std::vector<Vec<3>>& points) {
  CorpusField field{name, {}};
  for (const Vec<3>& p : points) {
    const Vec<3> x = sum<3>(apply<3>(map.m, p), map.offset);
    field.values.insert(field.values.end(), x.begin(), x.end());
  }
  c.fields.push_back(std::move(field));
}

Rational turn(const Vec<3>& x, const Vec<3>& y) { return x[0] * y[1] - x[1] * y[0]; }

/// A body below the plane z = 0 and a hull above it; both touch the plane: the agent at x <= 0, the hull at
/// x > 0. A direction in the plane meets K exactly when it lies between the directions from touching points
/// to touching points.
void grazed_hull(std::vector<CorpusCase>& cases, SeededRandom& random, std::uint64_t index) {
  const Map<3> map = random_map<3>(random, index);
  const bool ellipsoid = random.integer(0, 2) != 0;
  static constexpr std::array<const char*, 3> kFeatures = {"vertex", "edge", "face"};
  const int touched = random.integer(1, 3);
  const auto point = [&](int x0, int x1, int z0, int z1) {
    Vec<3> p;
    p[0] = random.integer(x0, x1);
    p[1] = random.integer(-9, 9);
    p[2] = random.integer(z0, z1);
    return p;
  };
  std::vector<Vec<3>> obstacle, agent, agent_touching;
  for (int i = 0; i < touched; ++i) obstacle.push_back(point(3, 20, 0, 0));
  const std::vector<Vec<3>> touching = obstacle;
  const Vec<3> corner = point(3, 20, 1, 9);
  obstacle.push_back(corner);
  for (int i = 0; i < 3; ++i) {  // a full tetrahedron: K has interior
    Vec<3> p = corner;
    p[i] += random.integer(1, 5);
    obstacle.push_back(p);
  }
  for (int i = random.integer(0, 6); i > 0; --i) obstacle.push_back(point(0, 30, 1, 30));
  Body<3> body;
  Vec<3> agent_middle;
  if (ellipsoid) {
    body.factor = random_factor<3>(random);
    body.center = times<3>(-1, column<3>(body.factor, 2));  // its support point is the origin
    agent_middle = body.center;
    agent_touching.emplace_back();
  } else {
    for (int i = random.integer(1, 3); i > 0; --i) agent.push_back(point(-9, 0, 0, 0));
    agent_touching = agent;
    for (int i = random.integer(1, 5); i > 0; --i) agent.push_back(point(-9, 9, -9, -1));
    for (const Vec<3>& p : agent)
      agent_middle = sum<3>(agent_middle, times<3>(Rational(1, static_cast<int>(agent.size())), p));
  }
  const auto add = [&](const std::string& family, const char* truth, const Vec<3>& w) -> CorpusCase* {
    CorpusCase c = start_point("hull", family, map.kind + (ellipsoid ? "/ellipsoid" : "/hull"), index, truth);
    if (ellipsoid)
      add_body<3>(c, "a", map, body);
    else
      add_points(c, "a.points", map, agent);
    add_points(c, "b.points", map, obstacle);
    add_direction<3>(c, "w", map, w);
    if (!fits(c)) return nullptr;
    cases.push_back(std::move(c));
    return &cases.back();
  };
  Vec<3> w, leftmost;
  bool first = true;
  for (const Vec<3>& q : touching)
    for (const Vec<3>& p : agent_touching) {
      const Vec<3> d = sum<3>(q, times<3>(-1, p));
      if (first || turn(leftmost, d) > 0) leftmost = d;
      first = false;
      w = sum<3>(w, times<3>(random.integer(1, 4), d));
    }
  const std::string name = std::string("graze-") + kFeatures[touched - 1];
  const CorpusCase* on = add(name, "on", w);
  if (!on) return;
  const CorpusCase known = *on;
  add(name + "-end", "on", leftmost);
  // Beyond the last touching point, still in the supporting plane.
  const Rational turned = power_of_two(-random.integer(1, 40));
  add(name + "-missed", "out", sum<3>(leftmost, {-turned * leftmost[1], turned * leftmost[0], 0}));
  add(name + "-behind", "out", times<3>(-1, w));
  Vec<3> inside = times<3>(-1, agent_middle);
  for (int i = touched; i < touched + 4; ++i) inside = sum<3>(inside, times<3>(Rational(1, 4), obstacle[i]));
  if (!ellipsoid) {  // whole numbers
    inside = times<3>(60, inside);
  }
  const Rational e = power_of_two(-random.integer(3, 40));
  add(name + "-nudged", "in", sum<3>(w, times<3>(e, inside)));
  add(name + "-nudged", "out", sum<3>(w, times<3>(-e, inside)));
  // Neighbours on the far side of the supporting plane n.x >= 0, n = det(M) M^{-T} e_z.
  const Vec<3> m0 = column<3>(map.m, 0), m1 = column<3>(map.m, 1);
  const int orientation = exact::determinant<3>(map.m).sign();
  const Vec<3> n = {orientation * (m0[1] * m1[2] - m0[2] * m1[1]),
                    orientation * (m0[2] * m1[0] - m0[0] * m1[2]),
                    orientation * (m0[0] * m1[1] - m0[1] * m1[0])};
  for (CorpusCase& c : neighbours(known, "w", 6, random)) {
    const auto& v = c.values("w");
    if (inner<3>(n, {v[0], v[1], v[2]}) >= 0) continue;
    c.truth = "out";
    c.source = "construction";
    cases.push_back(std::move(c));
  }
}

/// Seen along w a rim of radius R is an ellipse with semi-axes R and b = R |w_z| / |w|, and a ball of radius
/// r a disc. A disc that touches an ellipse at one point from inside lies inside it when r is below its least
/// radius of curvature b^2 / R. The touching point is q = R e_r; the disc's centre lies at q - r d, with d a
/// unit vector normal to w and to the rim's tangent t at q.
void grazed_rim(std::vector<CorpusCase>& cases, SeededRandom& random, std::uint64_t index) {
  // Similarities only: the rotations among the maps (1 Pythagorean, 2 Cayley, 3 axes), not stretched.
  static constexpr std::array<std::uint64_t, 5> kSettings = {0, 5, 6, 7, 8};
  const Map<3> map = random_map<3>(random, 1 + index % 3 + 4 * kSettings[(index / 3) % 5]);
  Rational square = 0;
  for (int i = 0; i < 3; ++i) square += map.m[i][0] * map.m[i][0];
  const Rational scale(sqrt(numerator(square)), sqrt(denominator(square)));
  const auto [circle, n0] = sphere_point<2>(random);
  const auto [tilt, n1] = sphere_point<2>(random);
  if (tilt[1] == 0) return;
  const Rational n = n0 * n1 * 8;  // all numbers below become whole
  const Rational rim = n * random.integer(2, 9);
  const Vec<3> radial = {circle[0], circle[1], 0}, tangent = {-circle[1], circle[0], 0};
  const Rational cosine = abs(tilt[1]), sine = tilt[0];
  const Vec<3> d = sum<3>(times<3>(cosine, radial), {0, 0, sine});
  const Vec<3> u = sum<3>(times<3>(-sine, radial), {0, 0, cosine});
  const int along = random.integer(-3, 3), forward = random.integer(1, 5) * (random.coin() ? 1 : -1);
  const Vec<3> w = times<3>(n0 * n1, sum<3>(times<3>(along, tangent), times<3>(forward, u)));
  const Rational curvature_radius = rim * w[2] * w[2] / inner<3>(w, w);
  const Rational r = n * Rational(random.integer(1, 12), 8);
  if (r >= curvature_radius) return;
  const Vec<3> foot = sum<3>(times<3>(rim, radial), times<3>(-r, d));
  // Far enough back that the ball is clear of the plane.
  const Rational back(random.integer(0, 2) + static_cast<int>(Rational(2 + (r + abs(foot[2])) / abs(w[2]))));
  const auto add = [&](const char* family, const char* truth, const Rational& outwards, int direction) {
    CorpusCase c = start_point("orifice", family, map.kind, index, truth);
    const Vec<3> center = sum<3>(sum<3>(foot, times<3>(outwards, d)), times<3>(-back, w));
    add_point<3>(c, "a.center", map, center);
    c.fields.push_back({"a.radius", {r * scale}});
    add_point<3>(c, "orifice.center", map, {});
    add_direction<3>(c, "orifice.axis", map, {0, 0, 1});
    c.fields.push_back({"orifice.radius", {rim * scale}});
    add_direction<3>(c, "w", map, times<3>(direction, w));
    if (!fits(c)) return false;
    cases.push_back(std::move(c));
    return true;
  };
  if (!add("rim", "grazes", 0, 1)) return;
  add("rim-away", "blocked", 0, -1);
  for (const int least : {2, 20}) {
    const Rational e = n * power_of_two(-random.integer(least, least + 20));
    if (r + e < curvature_radius) add("rim-nudged", "passes", -e, 1);
    if (e < r) add("rim-nudged", "blocked", e, 1);
  }
}

}  // namespace

std::vector<CorpusCase> side_cases(std::uint64_t seed, int size) {
  std::vector<CorpusCase> cases;
  for (std::uint64_t i = 0; i < 72U * static_cast<unsigned>(size); ++i) {
    SeededRandom random(kSide, seed, i);
    if (i % 2 == 0) point_on_body<3>(cases, random, i / 2);
    if (i % 2 == 1) point_on_body<2>(cases, random, i / 2);
    point_on_quadric(cases, random, i);
  }
  return cases;
}

std::vector<CorpusCase> hull_cases(std::uint64_t seed, int size) {
  std::vector<CorpusCase> cases;
  for (std::uint64_t i = 0; i < 72U * static_cast<unsigned>(size); ++i) {
    SeededRandom random(kHull, seed, i);
    grazed_hull(cases, random, i);
  }
  return cases;
}

std::vector<CorpusCase> orifice_cases(std::uint64_t seed, int size) {
  std::vector<CorpusCase> cases;
  for (std::uint64_t i = 0; i < 120U * static_cast<unsigned>(size); ++i) {
    SeededRandom random(kOrifice, seed, i);
    grazed_rim(cases, random, i);
  }
  return cases;
}

}  // namespace vericone::verify::corpus
