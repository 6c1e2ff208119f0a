// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two ellipsoids or ellipses: how they lie, velocities on the boundary of their cone, and contacts at the
// ends of a horizon. Frame of all constructions: the common normal is the last axis e; a factor G from
// random_factor() has its support point along e in its last column, at the height k = G(D, D).
// (docs/explanation/corpus.md)
#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/geometry/exact/rational.h>

#include <optional>

#include "corpus/build.h"

namespace vericone::verify::corpus {
namespace {

constexpr std::uint32_t kPosition = 0xc0501, kRelation = 0xc0502, kMembership = 0xc0503, kSector = 0xc0504,
                        kHorizon = 0xc0508;

/// Columns, of which the last is scaled: G' = a G with an integer a, so that fractions become integers.
template <int D>
Mat<D> scaled(const Mat<D>& g, const Rational& a) {
  return product<D>(identity<D>(a), g);
}

CorpusCase start(const char* predicate, const char* family, const std::string& kind, std::uint64_t index,
                 std::string truth) {
  CorpusCase c;
  c.predicate = predicate;
  c.family = family;
  c.kind = kind;
  c.index = index;
  c.truth = std::move(truth);
  c.source = "construction";
  c.rung = "any";
  return c;
}

template <int D>
Vec<D> unit(const Rational& x) {
  Vec<D> v;
  v[D - 1] = x;
  return v;
}

/// Rotation about the last axis (D = 3) by a Pythagorean angle; of D = 2 the identity.
template <int D>
Mat<D> spin(SeededRandom& random) {
  Mat<D> r = identity<D>(1);
  if constexpr (D == 3) {
    const int m = random.integer(2, 4);
    const int n = random.integer(1, m - 1);
    const Rational h = m * m + n * n, c = Rational(m * m - n * n) / h, s = Rational(2 * m * n) / h;
    r[0][0] = r[1][1] = c;
    r[0][1] = -s;
    r[1][0] = s;
  }
  return r;
}

template <int D>
void add_pair(CorpusCase& c, const Map<D>& map, const Body<D>& a, const Body<D>& b, bool swapped) {
  add_body<D>(c, "a", map, swapped ? b : a);
  add_body<D>(c, "b", map, swapped ? a : b);
  if (!swapped) return;
  if (c.truth.starts_with("b_inside_a")) c.truth.replace(0, 10, "a_inside_b");
}

/// B along the normal from where it touches A, by `gap` (negative: into A).
template <int D>
void outside(std::vector<CorpusCase>& cases, SeededRandom& random, std::uint64_t index) {
  const Map<D> map = random_map<D>(random, index);
  Body<D> a{{}, random_factor<D>(random)}, b{{}, random_factor<D>(random)};
  const int kind = random.integer(0, 3);
  if (kind == 0) {  // spheres where the map is a rotation
    a.factor = identity<D>(random.integer(1, 9));
    b.factor = identity<D>(random.integer(1, 9));
  } else if (kind == 1) {  // congruent
    b.factor = a.factor;
  } else if (kind == 2) {  // nearly equal
    b.factor = scaled<D>(a.factor, 1 + power_of_two(-random.integer(8, 20)));
  }
  const Vec<D> contact = sum<D>(column<D>(a.factor, D - 1), column<D>(b.factor, D - 1));
  const bool swapped = random.coin();
  const auto add = [&](const char* family, const char* truth, const Rational& gap) {
    b.center = sum<D>(contact, unit<D>(gap));
    CorpusCase c = start("position", family, map.kind, index, truth);
    if (gap == 0) c.rung = "exact";
    add_pair<D>(c, map, a, b, swapped);
    if (fits(c)) cases.push_back(std::move(c));
  };
  add("touch-outside", "touching", 0);
  const Rational gap = power_of_two(-random.integer(5, 48));
  add("touch-outside-nudged", "disjoint", gap);
  // e - gap G^{-1} e is inside the unit ball while gap < 2 k, k = G(D, D), over |G^{-1} e|^2 k^2: small
  // enough.
  add("touch-outside-nudged", "crossing", -gap * power_of_two(-12));
}

/// B = A's image of an ellipsoid in the unit ball that touches it at e: semi-axes p across and r along,
/// centre (1 - r) e. It is inside iff p^2 <= r; p^2 = r osculates.
template <int D>
void inside(std::vector<CorpusCase>& cases, SeededRandom& random, std::uint64_t index) {
  const Map<D> map = random_map<D>(random, index);
  const Mat<D> turn = spin<D>(random);
  Rational common = 1;
  for (const auto& row : turn)
    for (const auto& x : row) common = Rational(lcm(numerator(common), denominator(x)));
  // 16 makes all of the fractions below integers.
  const Mat<D> ga = scaled<D>(random_factor<D>(random), common * 16);
  const Rational q(random.integer(1, 3), 4), r = q * q;
  const int below = random.integer(1, 3);
  const bool swapped = random.coin();
  const auto add = [&](const char* family, const char* truth, const Rational& p, const Rational& height,
                       const char* rung) {
    Mat<D> g = identity<D>(p);
    if (D == 3 && random.coin()) g[0][0] = q / 2;  // the other axis well inside
    g[D - 1][D - 1] = r;
    const Body<D> a{{}, ga}, b{apply<D>(ga, unit<D>(height)), product<D>(ga, product<D>(turn, g))};
    CorpusCase c = start("position", family, map.kind, index, truth);
    c.rung = rung;
    add_pair<D>(c, map, a, b, swapped);
    if (fits(c)) cases.push_back(std::move(c));
  };
  add("touch-inside", "b_inside_a_touching", q * Rational(below, 4), 1 - r, "exact");
  add("osculating", "b_inside_a_touching", q, 1 - r, "exact");
  add("touch-inside-crossing", "crossing", q + Rational(1, 4 << random.integer(0, 2)), 1 - r, "any");
  const Rational nudge = power_of_two(-random.integer(4, 40));
  add("touch-inside-nudged", "b_inside_a", q * Rational(below, 4), 1 - r - nudge, "any");
  add("touch-inside-nudged", "crossing", q * Rational(below, 4), 1 - r + nudge, "any");
}

/// Concentric: B = (1 - d) A, equal, and neighbours of equal.
template <int D>
void nested(std::vector<CorpusCase>& cases, SeededRandom& random, std::uint64_t index) {
  const Map<D> map = random_map<D>(random, index);
  const Body<D> a{{}, random_factor<D>(random)};
  const bool swapped = random.coin();
  const auto add = [&](const char* family, const char* truth, const Body<D>& b) {
    CorpusCase c = start("position", family, map.kind, index, truth);
    if (c.truth == "equal") c.rung = "exact";
    add_pair<D>(c, map, a, b, swapped);
    if (fits(c)) cases.push_back(std::move(c));
  };
  const Rational d = power_of_two(-random.integer(1, 20));
  add("nested", "b_inside_a", {{}, scaled<D>(a.factor, 1 - d)});
  add("equal", "equal", a);
  // A translate by less than a diameter, |G^{-1} d| < 2, sticks out on one side and leaves a gap on the
  // other.
  add("equal-shifted", "crossing", {unit<D>(power_of_two(-random.integer(8, 30))), a.factor});
}

/// Grazing pair: `w` lies in the common supporting plane and carries A's support point to B's.
template <int D>
struct Grazing {
  Map<D> map;
  Body<D> a, b;
  Vec<D> w;
};

template <int D>
Grazing<D> grazing(SeededRandom& random, std::uint64_t index) {
  Grazing<D> g;
  g.map = random_map<D>(random, index);
  g.a.factor = random_factor<D>(random);
  g.b.factor = random_factor<D>(random);
  switch (random.integer(0, 4)) {
    case 0:
      g.a.factor = identity<D>(random.integer(1, 9));
      g.b.factor = identity<D>(random.integer(1, 9));
      break;
    case 1:
      g.b.factor = g.a.factor;
      break;
    case 2:
      g.b.factor = scaled<D>(g.a.factor, 1 + power_of_two(-random.integer(8, 20)));
      break;
    default:
      break;
  }
  do
    for (int i = 0; i + 1 < D; ++i) g.w[i] = random.integer(-20, 20);
  while (inner<D>(g.w, g.w) == 0);
  if (D == 3 && random.integer(0, 3) == 0) g.w[random.integer(0, 1)] = 0;
  if (inner<D>(g.w, g.w) == 0) g.w[0] = 1;
  g.b.center = sum<D>(g.w, sum<D>(column<D>(g.a.factor, D - 1), column<D>(g.b.factor, D - 1)));
  return g;
}

template <int D>
CorpusCase cone_case(const char* predicate, const char* family, const Grazing<D>& g, std::uint64_t index,
                     const char* truth, const Vec<D>& w) {
  CorpusCase c = start(predicate, family, g.map.kind, index, truth);
  if (c.truth == "on") c.rung = "exact";
  add_body<D>(c, "a", g.map, g.a);
  add_body<D>(c, "b", g.map, g.b);
  add_direction<D>(c, "w", g.map, w);
  return c;
}

/// The cases of one grazing pair that are known without computing: w grazes; the line of centres c is inside
/// the convex cone, so w + e c is inside and w - e c outside; -w leads away.
template <int D>
std::vector<CorpusCase> known_cases(const char* predicate, const Grazing<D>& g, SeededRandom& random,
                                    std::uint64_t index) {
  std::vector<CorpusCase> cases{cone_case<D>(predicate, "tangent", g, index, "on", g.w)};
  for (const int least : {3, 24}) {
    const Rational e = power_of_two(-random.integer(least, least + 14));
    cases.push_back(cone_case<D>(predicate, "nudged", g, index, "in", sum<D>(g.w, times<D>(e, g.b.center))));
    cases.push_back(
        cone_case<D>(predicate, "nudged", g, index, "out", sum<D>(g.w, times<D>(-e, g.b.center))));
  }
  cases.push_back(cone_case<D>(predicate, "behind", g, index, "out", times<D>(-1, g.w)));
  return cases;
}

template <int D>
std::string exact_relation_text(const CorpusCase& c) {
  return to_string(exact::relation<D>(c.rational_body<D>("a"), c.rational_body<D>("b")));
}

/// The same engagement with lengths divided by seven: numbers that no double holds.
CorpusCase sevenths(CorpusCase c) {
  c.family = "sevenths";
  for (CorpusField& field : c.fields) {
    const Rational by = field.name.ends_with(".shape") ? 49 : 7;
    for (Rational& x : field.values) x /= by;
  }
  return c;
}

/// Two bodies that touch at one point at the time `contact`, the agent moving along w.
struct Meeting {
  Map<3> map;
  Body<3> a, b;
  Vec<3> w, v_b;
  Rational contact;
};

/// By `number`: coming, going, or gliding along the common plane.
Meeting meeting(SeededRandom& random, std::uint64_t index, std::uint64_t number) {
  Meeting m;
  m.map = random_map<3>(random, index);
  m.a.factor = random_factor<3>(random);
  m.b.factor = random_factor<3>(random);
  for (auto& x : m.w) x = random.integer(-9, 9);
  const int along = random.integer(1, 9);
  m.w[2] = number % 3 == 0 ? along : number % 3 == 1 ? -along : 0;
  if (m.w[0] == 0 && m.w[1] == 0) m.w[0] = 1;
  m.contact = Rational(random.integer(1, 16), 1 << random.integer(0, 2));
  const int turned = random.coin() ? random.integer(0, 40) : 0;
  for (auto& x : m.v_b) x = turned != 0 ? random.integer(-3, 3) * power_of_two(turned) : Rational();
  m.b.center = sum<3>(sum<3>(column<3>(m.a.factor, 2), column<3>(m.b.factor, 2)), times<3>(m.contact, m.w));
  return m;
}

/// `until`: nothing for ever.
CorpusCase meeting_case(const Meeting& m, const char* family, std::uint64_t index, const char* truth,
                        const Rational& from, const std::optional<Rational>& until) {
  CorpusCase c = start("horizon", family, m.map.kind, index, truth);
  if (c.truth == "on") c.rung = "exact";
  add_body<3>(c, "a", m.map, m.a);
  add_body<3>(c, "b", m.map, m.b);
  add_direction<3>(c, "v_a", m.map, sum<3>(m.w, m.v_b));
  add_direction<3>(c, "v_b", m.map, m.v_b);
  c.fields.push_back({"horizon", {from}});
  if (until) c.fields.back().values.push_back(*until);
  return c;
}

/// Of a contact at one time all that lies before, at and after it is known: before it they are apart where
/// they come, overlap where they go, and the other way round after it.
std::vector<CorpusCase> horizons(const Meeting& m, SeededRandom& random, std::uint64_t index) {
  std::vector<CorpusCase> cases;
  const Rational& t = m.contact;
  const auto add = [&](const char* family, const char* truth, const Rational& from,
                       const std::optional<Rational>& until) {
    cases.push_back(meeting_case(m, family, index, truth, from, until));
  };
  const auto ulps = [&](int sign) {
    return Rational(moved_by_ulps(*as_double(t), sign * random.integer(1, 8)));
  };
  const auto near = [&](int sign) { return t * (1 + sign * power_of_two(-random.integer(3, 40))); };
  const bool coming = m.w[2] > 0, going = m.w[2] < 0;
  add("instant", "on", t, t);
  add("onward", coming ? "in" : "on", t, std::nullopt);
  if (!going) add("ends", "on", 0, t);
  for (const bool close : {false, true}) {
    const char* family = close ? "ulps" : "nudged";
    const Rational sooner = close ? ulps(-1) : near(-1), later = close ? ulps(1) : near(1);
    if (!going) add(family, "out", 0, sooner);
    if (going) add(family, "in", sooner, t);
    add(family, coming ? "in" : "on", t, later);
    if (!coming) add(family, "out", later, std::nullopt);
    if (coming) add(family, "in", 0, later);
  }
  return cases;
}

}  // namespace

std::vector<CorpusCase> position_cases(std::uint64_t seed, int size) {
  std::vector<CorpusCase> cases;
  for (std::uint64_t i = 0; i < 36U * static_cast<unsigned>(size); ++i) {
    SeededRandom random(kPosition, seed, i);
    outside<3>(cases, random, i);
    inside<3>(cases, random, i);
    nested<3>(cases, random, i);
    outside<2>(cases, random, i);
    inside<2>(cases, random, i);
    nested<2>(cases, random, i);
  }
  return cases;
}

std::vector<CorpusCase> relation_cases(std::uint64_t seed, int size) {
  std::vector<CorpusCase> cases;
  const auto add = [&](auto dimension, SeededRandom& random, std::uint64_t i) {
    constexpr int kD = decltype(dimension)::value;
    std::vector<CorpusCase> built;
    outside<kD>(built, random, i);
    if (built.empty() || built.front().truth != "touching") return;
    CorpusCase touching = built.front();
    touching.predicate = "relation";
    for (const char* field : {"b.center", "a.center"})
      for (CorpusCase& c : neighbours(touching, field, 3, random)) {
        c.truth = exact_relation_text<kD>(c);
        if (c.truth == "touching") c.rung = "exact";
        cases.push_back(std::move(c));
      }
  };
  for (std::uint64_t i = 0; i < 36U * static_cast<unsigned>(size); ++i) {
    SeededRandom random(kRelation, seed, i);
    add(std::integral_constant<int, 3>(), random, i);
    add(std::integral_constant<int, 2>(), random, i);
  }
  return cases;
}

std::vector<CorpusCase> membership_cases(std::uint64_t seed, int size) {
  std::vector<CorpusCase> cases;
  for (std::uint64_t i = 0; i < 72U * static_cast<unsigned>(size); ++i) {
    SeededRandom random(kMembership, seed, i);
    const Grazing<3> g = grazing<3>(random, i);
    auto known = known_cases<3>("membership", g, random, i);
    if (!fits(known.front())) continue;
    for (CorpusCase& c : neighbours(known.front(), "w", 4, random)) {
      const auto& w = c.values("w");
      c.truth =
          to_string(exact::membership(c.rational_body<3>("a"), c.rational_body<3>("b"), {w[0], w[1], w[2]}));
      if (c.truth == "on") c.rung = "exact";
      known.push_back(std::move(c));
    }
    if (i % 8 == 0) known.push_back(sevenths(known.front()));
    for (CorpusCase& c : known)
      if (c.family == "sevenths" || fits(c)) cases.push_back(std::move(c));
  }
  return cases;
}

std::vector<CorpusCase> sector_cases(std::uint64_t seed, int size) {
  std::vector<CorpusCase> cases;
  for (std::uint64_t i = 0; i < 72U * static_cast<unsigned>(size); ++i) {
    SeededRandom random(kSector, seed, i);
    const Grazing<2> g = grazing<2>(random, i);
    auto known = known_cases<2>("sector", g, random, i);
    if (!fits(known.front())) continue;
    // A neighbour of the edge w is inside when it lies between w and the line of centres, and outside when
    // the edge separates it from that line: signs of two products.
    const auto edge = known.front().values("w");
    const auto &pa = known.front().values("a.center"), &pb = known.front().values("b.center");
    const std::array<Rational, 2> line{pb[0] - pa[0], pb[1] - pa[1]};
    const auto turn = [](const auto& x, const auto& y) { return Rational(x[0] * y[1] - x[1] * y[0]).sign(); };
    for (CorpusCase& c : neighbours(known.front(), "w", 4, random)) {
      const auto& w = c.values("w");
      const int inward = turn(edge, line), side = turn(edge, w);
      c.source = "construction";
      c.truth = side == 0 ? "on" : side == inward ? "in" : "out";
      if (c.truth == "on") c.rung = "exact";
      known.push_back(std::move(c));
    }
    for (CorpusCase& c : known)
      if (fits(c)) cases.push_back(std::move(c));
  }
  return cases;
}

std::vector<CorpusCase> horizon_cases(std::uint64_t seed, int size) {
  std::vector<CorpusCase> cases;
  for (std::uint64_t i = 0; i < 36U * static_cast<unsigned>(size); ++i) {
    SeededRandom random(kHorizon, seed, i);
    // One that doubles hold: nearly all are.
    for (int tries = 0; tries < 8; ++tries) {
      const Meeting m = meeting(random, i, i / 4);
      const auto all = horizons(m, random, i);
      if (!fits(all.front())) continue;
      for (const CorpusCase& c : all)
        if (fits(c)) cases.push_back(c);
      break;
    }
  }
  return cases;
}

}  // namespace vericone::verify::corpus
