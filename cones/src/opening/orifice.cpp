// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/opening/orifice.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/requires.h>
#include <cmath>
#include <string>
#include <type_traits>

#include "answers/elementary.h"
#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/containment.h"
#include "ellipsoids/pair_on_grid.h"

namespace vericone {

const char* to_string(WallSide side) {
  switch (side) {
    case WallSide::clear:
      return "clear";
    case WallSide::touching:
      return "touching";
    case WallSide::cut:
      return "cut";
  }
  return "";
}

const char* to_string(Transit transit) {
  switch (transit) {
    case Transit::passes:
      return "passes";
    case Transit::grazes:
      return "grazes";
    case Transit::blocked:
      return "blocked";
  }
  return "";
}

namespace {

void require_finite(const Eigen::Vector3d& v, const char* field, const char* requirement) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(v(i)))
      throw InputError(std::string(field) + "[" + std::to_string(i) + "]", to_text(v(i)), requirement);
}
constexpr const char* kLength = "a finite number (m)";
constexpr const char* kSpeed = "a finite number (m/s)";

void require_positive(double x, const char* field) {
  if (!(x > 0 && std::isfinite(x))) throw InputError(field, to_text(x), "a positive finite number (m)");
}

/// What the constructor leaves to do for one velocity w = w_k (u, v, 1), in the order i, j, k: forms of the
/// two shadows along w and of their centre line, all times n.n, and whether w leads to the wall.
template <typename N>
struct ShadowPair {
  PairForms<2, N> forms;
  std::array<N, 2> line;
  N toward;  // n.w / w_k
};

/// `a(r, c)`, `c(r)`, `n(r)`: the agent's shape, the line of centres and the normal; `r2` the squared radius.
template <typename N, typename Shape, typename Line, typename Normal>
constexpr ShadowPair<N> shadow_pair(const Shape& a, const Line& c, const Normal& n, const N& r2,
                                    const N& minus_u, const N& minus_v, int i, int j, int k) {
  const N nn = n(0) * n(0) + n(1) * n(1) + n(2) * n(2);
  const auto disc = [&](int row, int column) {
    const N product = n(row) * n(column);
    return r2 * (row == column ? nn - product : -product);
  };
  const auto agent = affine_shadow<N>(a, minus_u, minus_v, i, j, k),
             opening = affine_shadow<N>(disc, minus_u, minus_v, i, j, k);
  ShadowPair<N> pair;
  pair.line = {c(i) + minus_u * c(k), c(j) + minus_v * c(k)};
  const N x = nn * pair.line[0], y = nn * pair.line[1];
  pair.forms.a.entry = {nn * agent.a, nn * agent.b, nn * agent.c};
  pair.forms.b.entry = {opening.a, opening.b, opening.c};
  pair.forms.c.entry = {x * pair.line[0], x * pair.line[1], y * pair.line[1]};
  pair.toward = (n(k) - n(i) * minus_u) - n(j) * minus_v;
  return pair;
}

/// G S G^T.
template <typename N, typename Map>
constexpr SymmetricForm<2, N> mapped(const Map& g, const SymmetricForm<2, N>& s) {
  SymmetricForm<2, N> r;
  for (int i = 0; i < 2; ++i) {
    const N h0 = g(i, 0) * s(0, 0) + g(i, 1) * s(1, 0), h1 = g(i, 0) * s(0, 1) + g(i, 1) * s(1, 1);
    for (int j = i; j < 2; ++j) r(i, j) = h0 * g(j, 0) + h1 * g(j, 1);
  }
  return r;
}

struct OrificeCounts {
  CertificateCounts<2> certificate;
  RoundingCount toward;
};
constexpr OrificeCounts kOrificeCounts = [] {
  // F F^T takes three roundings, p_B - p_A and w_i / w_k one.
  const auto shape = [](int, int) { return RoundingCount{3}; };
  const auto line = [](int) { return RoundingCount{1}; };
  const auto input = [](int) { return RoundingCount{}; };
  const auto pair = shadow_pair<RoundingCount>(shape, line, input, RoundingCount{1}, RoundingCount{1},
                                               RoundingCount{1}, 0, 1, 2);
  const auto g = [](int, int) { return RoundingCount{}; };
  RoundingCount longest{};
  for (const auto* form : {&pair.forms.a, &pair.forms.b, &pair.forms.c}) {
    const auto in_frame = mapped<RoundingCount>(g, *form);
    for (const RoundingCount& x : in_frame.entry)
      if (x.roundings > longest.roundings) longest = x;
  }
  return OrificeCounts{CertificateCounts<2>::of(longest, {}, longest), pair.toward};
}();

double midpoint(const Tracked& x) { return x.value(); }
double midpoint(const Interval& x) { return x.mid(); }

Tracked minus_quotient(double x, double y, const Tracked*) { return Tracked::minus(x / y); }
Interval minus_quotient(double x, double y, const Interval*) { return -(Interval(x) / Interval(y)); }

/// The frame in which the first form is the identity and the second diagonal, in plain doubles.
struct ShadowFrame {
  Eigen::Matrix2d map;
  Eigen::Vector2d diagonal;

  ShadowFrame(const SymmetricForm<2, double>& a, const SymmetricForm<2, double>& b) {
    const double l11 = std::sqrt(a(0, 0)), l21 = a(0, 1) / l11, l22 = std::sqrt(a(1, 1) - l21 * l21);
    Eigen::Matrix2d inverse;
    inverse << 1 / l11, 0, -l21 / (l11 * l22), 1 / l22;
    Eigen::Matrix2d full;
    full << b(0, 0), b(0, 1), b(0, 1), b(1, 1);
    const Eigen::Matrix2d k = inverse * full * inverse.transpose();
    const double angle = 0.5 * std::atan2(2 * k(0, 1), k(0, 0) - k(1, 1)), c = std::cos(angle),
                 s = std::sin(angle);
    Eigen::Matrix2d turn;
    turn << c, s, -s, c;
    map = turn * inverse;
    diagonal = (turn * k * turn.transpose()).diagonal();
  }
};

}  // namespace

OrificeOracle::OrificeOracle(const Ellipsoid& agent, const Orifice& orifice)
    : agent_(agent), orifice_(orifice) {
  require_finite(orifice.center, "orifice.center", kLength);
  require_finite(orifice.normal, "orifice.normal", "a finite number");
  if (orifice.normal.isZero(0)) throw InputError("orifice.normal", "[0, 0, 0]", "a vector that is not zero");
  require_positive(orifice.radius, "orifice.radius");

  const exact::PairOnGrid<3> pair(
      agent, Ellipsoid::from_axes(orifice.center, Eigen::Vector3d::Constant(orifice.radius)));
  const auto n = exact::direction_on_grid<3>(orifice.normal);
  exact::Integer height = 0, reach2 = 0;
  for (int i = 0; i < 3; ++i) {
    height += n[i] * pair.c[i];
    for (int j = 0; j < 3; ++j) reach2 += n[i] * pair.a[i][j] * n[j];
  }
  toward_ = height.sign();
  const int outside = (height * height).compare(reach2);
  side_ = outside > 0 ? WallSide::clear : outside == 0 ? WallSide::touching : WallSide::cut;

  const int e = std::ilogb(std::max(agent.factor().cwiseAbs().maxCoeff(), orifice.radius));
  normal_scale_ = std::ldexp(1.0, -std::ilogb(orifice.normal.cwiseAbs().maxCoeff()));
  usable_ = std::abs(e) <= 510 && std::isfinite(normal_scale_);
  if (usable_) scale_ = std::ldexp(1.0, -e);
}

template <typename N>
std::optional<Transit> OrificeOracle::certified(const Eigen::Vector3d& w) const noexcept {
  if (!w.allFinite()) return std::nullopt;
  if (side_ == WallSide::cut || w.isZero(0)) return Transit::blocked;
  if (!usable_) return std::nullopt;
  const auto tag = static_cast<const N*>(nullptr);
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(w(i)) > std::abs(w(k))) k = i;
  const int i = (k + 1) % 3, j = (k + 2) % 3;

  const bool by_factor = agent_.defined_by_factor();
  const auto shape = [&](int r, int c) {
    if (!by_factor) return scaled(agent_.shape()(r, c), scale_ * scale_, tag);
    const auto f = [&](int row, int column) { return scaled(agent_.factor()(row, column), scale_, tag); };
    return f(r, 0) * f(c, 0) + f(r, 1) * f(c, 1) + f(r, 2) * f(c, 2);
  };
  const auto difference = [&](int r) {
    if constexpr (std::is_same_v<N, Tracked>)
      return Tracked::of(orifice_.center(r) * scale_ - agent_.center()(r) * scale_);
    else
      return scaled(orifice_.center(r), scale_, tag) - scaled(agent_.center()(r), scale_, tag);
  };
  SymmetricForm<3, N> a;
  std::array<N, 3> line, normal;
  for (int r = 0; r < 3; ++r) {
    for (int c = r; c < 3; ++c) a(r, c) = shape(r, c);
    line[r] = difference(r);
    normal[r] = scaled(orifice_.normal(r), normal_scale_, tag);
  }
  const N radius = scaled(orifice_.radius, scale_, tag);
  const ShadowPair<N> pair = shadow_pair<N>(
      a, [&](int r) { return line[r]; }, [&](int r) { return normal[r]; }, radius * radius,
      minus_quotient(w(i), w(k), tag), minus_quotient(w(j), w(k), tag), i, j, k);

  const N toward = (toward_ > 0) == (w(k) > 0) ? pair.toward : -pair.toward;
  if (surely_positive(-toward, kOrificeCounts.toward)) return Transit::blocked;
  if (!surely_positive(toward, kOrificeCounts.toward)) return std::nullopt;

  SymmetricForm<2, double> mid_a, mid_b;
  double nn = 0;
  for (int x = 0; x < 3; ++x) {
    mid_a.entry[x] = midpoint(pair.forms.a.entry[x]);
    mid_b.entry[x] = midpoint(pair.forms.b.entry[x]);
    nn += midpoint(normal[x]) * midpoint(normal[x]);
  }
  const ShadowFrame frame(mid_a, mid_b);
  const Eigen::Vector2d center =
      frame.map * Eigen::Vector2d(midpoint(pair.line[0]), midpoint(pair.line[1])) * std::sqrt(nn);
  const double stretch = frame.map.cwiseAbs().sum();
  double reach = 0;
  for (int r = 0; r < 3; ++r) reach = std::max(reach, std::abs(midpoint(line[r])));
  // See kFormUnderflow. All lengths of agent and opening are at most about one.
  if (!(stretch < 0x1p40 && stretch * reach < 0x1p76 && frame.diagonal.allFinite())) return std::nullopt;
  const auto g = [&](int r, int c) { return lift<N>(frame.map(r, c)); };
  const PairForms<2, N> forms{mapped<N>(g, pair.forms.a), mapped<N>(g, pair.forms.b),
                              mapped<N>(g, pair.forms.c)};
  const auto guess = search_containment<2>(Eigen::Vector2d::Ones(), frame.diagonal, center);
  if (guess.inside) {
    if (surely_inside<2, N>(forms, guess.s, kOrificeCounts.certificate)) return Transit::passes;
  } else if (surely_reaches_beyond<2, N>(forms, guess.normal, kOrificeCounts.certificate)) {
    return Transit::blocked;
  }
  return std::nullopt;
}

std::optional<Transit> OrificeOracle::triage_transit(const Eigen::Vector3d& w) const noexcept {
  return certified<Tracked>(w);
}

std::optional<Transit> OrificeOracle::interval_transit(const Eigen::Vector3d& w) const noexcept {
  return certified<Interval>(w);
}

Transit OrificeOracle::exact_transit(const Eigen::Vector3d& w) const {
  VERICONE_REQUIRES(w.allFinite());
  using exact::Integer;
  if (side_ == WallSide::cut || w.isZero(0)) return Transit::blocked;
  const auto n = exact::direction_on_grid<3>(orifice_.normal), v = exact::direction_on_grid<3>(w);
  const Integer along = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
  if (along.sign() != toward_) return Transit::blocked;
  const exact::PairOnGrid<3> pair(
      agent_, Ellipsoid::from_axes(orifice_.center, Eigen::Vector3d::Constant(orifice_.radius)));
  const Integer nn = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  const int k = v[0] != 0 ? 0 : v[1] != 0 ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
  const auto agent = [&](int r, int c) { return Integer(nn * pair.a[r][c]); };
  const auto disc = [&](int r, int c) {
    return Integer(pair.b[0][0] * (r == c ? nn - n[r] * n[c] : Integer(-n[r] * n[c])));
  };
  const Integer x = v[k] * pair.c[i] - v[i] * pair.c[k], y = v[k] * pair.c[j] - v[j] * pair.c[k];
  const auto contained = exact::containment(shadow<Integer>(agent, v[i], v[j], v[k], i, j, k),
                                            shadow<Integer>(disc, v[i], v[j], v[k], i, j, k),
                                            Symmetric2<Integer>{nn * x * x, nn * x * y, nn * y * y});
  return contained == exact::Containment::inside     ? Transit::passes
         : contained == exact::Containment::touching ? Transit::grazes
                                                     : Transit::blocked;
}

Transit OrificeOracle::transit(const Eigen::Vector3d& w, Rung* rung) const {
  return climb<OrificeTransit>(
      rung, [&] { return triage_transit(w); }, [&] { return interval_transit(w); },
      [&] {
        require_finite(w, "agent_velocity", kSpeed);
        return exact_transit(w);
      });
}

namespace {

/// |c x w|^2 - q^2 |w|^2 and c.w, with q the difference of the radii. (2.2)
template <typename N>
struct FacingSigns {
  N excess, along;

  template <typename V>
  constexpr FacingSigns(const V& c, const N& q, const V& w) {
    N cross2{}, w2{};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const N x = c[j] * w[k] - c[k] * w[j];
      cross2 = i == 0 ? x * x : cross2 + x * x;
      w2 = i == 0 ? w[i] * w[i] : w2 + w[i] * w[i];
    }
    excess = cross2 - q * q * w2;
    along = c[0] * w[0] + c[1] * w[1] + c[2] * w[2];
  }
};
constexpr FacingSigns<RoundingCount> kFacingCounts(std::array<RoundingCount, 3>{}, RoundingCount{1},
                                                   std::array<RoundingCount, 3>{});

template <typename N>
std::optional<Transit> certified_facing(const Eigen::Vector3d& c, double agent_radius, double opening_radius,
                                        const Eigen::Vector3d& w) noexcept {
  if (!w.allFinite() || !c.allFinite() || !std::isfinite(agent_radius) || !std::isfinite(opening_radius))
    return std::nullopt;
  if (w.isZero(0) || c.isZero(0) || opening_radius < agent_radius) return Transit::blocked;
  const int e = std::ilogb(std::max({c.cwiseAbs().maxCoeff(), agent_radius, opening_radius})),
            e_w = std::ilogb(w.cwiseAbs().maxCoeff());
  const auto entry = [&](double x, int exponent) {
    if constexpr (std::is_same_v<N, Interval>)
      return Interval(std::ldexp(x, -exponent), Interval::kTiny);
    else
      return Tracked::of(std::ldexp(x, -exponent));
  };
  std::array<N, 3> line, velocity;
  for (int i = 0; i < 3; ++i) {
    line[i] = entry(c(i), e);
    velocity[i] = entry(w(i), e_w);
  }
  N q;
  if constexpr (std::is_same_v<N, Interval>)
    q = entry(opening_radius, e) - entry(agent_radius, e);
  else
    q = Tracked::of(std::ldexp(opening_radius, -e) - std::ldexp(agent_radius, -e));
  const FacingSigns<N> signs(line, q, velocity);
  if (surely_positive(-signs.along, kFacingCounts.along) ||
      surely_positive(signs.excess, kFacingCounts.excess))
    return Transit::blocked;
  if (surely_positive(-signs.excess, kFacingCounts.excess) &&
      surely_positive(signs.along, kFacingCounts.along))
    return Transit::passes;
  return std::nullopt;
}

}  // namespace

std::optional<Transit> triage_facing_orifice_transit(const Eigen::Vector3d& center_line, double agent_radius,
                                                     double opening_radius,
                                                     const Eigen::Vector3d& w) noexcept {
  return certified_facing<Tracked>(center_line, agent_radius, opening_radius, w);
}

std::optional<Transit> interval_facing_orifice_transit(const Eigen::Vector3d& center_line,
                                                       double agent_radius, double opening_radius,
                                                       const Eigen::Vector3d& w) noexcept {
  return certified_facing<Interval>(center_line, agent_radius, opening_radius, w);
}

Transit exact_facing_orifice_transit(const Eigen::Vector3d& center_line, double agent_radius,
                                     double opening_radius, const Eigen::Vector3d& w) {
  using exact::Integer;
  if (opening_radius < agent_radius) return Transit::blocked;
  Eigen::Matrix<double, 5, 1> lengths;
  lengths << center_line, agent_radius, opening_radius;
  const auto length = exact::direction_on_grid<5>(lengths);
  const exact::IntegerVector<3> c{length[0], length[1], length[2]}, v = exact::direction_on_grid<3>(w);
  const FacingSigns<Integer> signs(c, length[4] - length[3], v);
  if (signs.along.sign() <= 0 || signs.excess.sign() > 0) return Transit::blocked;
  return signs.excess == 0 ? Transit::grazes : Transit::passes;
}

Transit facing_orifice_transit(const Eigen::Vector3d& center_line, double agent_radius, double opening_radius,
                               const Eigen::Vector3d& w, Rung* rung) {
  require_positive(agent_radius, "agent_radius");
  require_positive(opening_radius, "opening_radius");
  require_finite(center_line, "center_line", kLength);
  require_finite(w, "agent_velocity", kSpeed);
  return climb<FacingOrificeTransit>(
      rung, [&] { return triage_facing_orifice_transit(center_line, agent_radius, opening_radius, w); },
      [&] { return interval_facing_orifice_transit(center_line, agent_radius, opening_radius, w); },
      [&] { return exact_facing_orifice_transit(center_line, agent_radius, opening_radius, w); });
}

}  // namespace vericone
