// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/opening/orifice.h>
#include <vericone/internal/cones/opening/facing_orifice.h>
#include <vericone/internal/cones/opening/placed.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/requires.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

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

/// The disc that fills a circular opening, as a quadratic form times `common`, and the wall's normal.
template <typename N>
struct DiscByNormal {
  std::array<N, 3> normal;
  N r2;
  N common;

  constexpr DiscByNormal(const std::array<N, 3>& n, const N& radius2)
      : normal(n), r2(radius2), common(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) {}

  constexpr N operator()(int row, int column) const {
    const N product = normal[row] * normal[column];
    return r2 * (row == column ? common - product : -product);
  }
};

/// The ellipse about p and q, by its semi-axes as vectors.
template <typename N>
struct DiscByAxes {
  std::array<N, 3> p, q, normal;
  N common;  // one

  constexpr N operator()(int row, int column) const { return p[row] * p[column] + q[row] * q[column]; }
};

template <typename N>
constexpr std::array<N, 3> cross3(const std::array<N, 3>& u, const std::array<N, 3>& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// What the constructor leaves to do for one velocity w = w_k (u, v, 1), in the order i, j, k: forms of the
/// two shadows along w and of their centre line, all times `common`.
template <typename N>
struct ShadowPair {
  PairForms<2, N> forms;
  std::array<N, 2> line;
};

/// `a(r, c)`, `c(r)`: the agent's shape and the line of centres.
template <typename N, typename Shape, typename Line, typename Disc>
constexpr ShadowPair<N> shadow_pair(const Shape& a, const Line& c, const Disc& disc, const N& minus_u,
                                    const N& minus_v, int i, int j, int k) {
  const N& nn = disc.common;
  const auto agent = affine_shadow<N>(a, minus_u, minus_v, i, j, k),
             opening = affine_shadow<N>(disc, minus_u, minus_v, i, j, k);
  ShadowPair<N> pair;
  pair.line = {c(i) + minus_u * c(k), c(j) + minus_v * c(k)};
  const N x = nn * pair.line[0], y = nn * pair.line[1];
  pair.forms.a.entry = {nn * agent.a, nn * agent.b, nn * agent.c};
  pair.forms.b.entry = {opening.a, opening.b, opening.c};
  pair.forms.c.entry = {x * pair.line[0], x * pair.line[1], y * pair.line[1]};
  return pair;
}

/// n.w / w_k.
template <typename N>
constexpr N toward_wall(const std::array<N, 3>& n, const N& minus_u, const N& minus_v, int i, int j, int k) {
  return (n[k] - n[i] * minus_u) - n[j] * minus_v;
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

/// G x.
template <typename N, typename Map>
constexpr std::array<N, 2> mapped(const Map& g, const std::array<N, 2>& x) {
  return {g(0, 0) * x[0] + g(0, 1) * x[1], g(1, 0) * x[0] + g(1, 1) * x[1]};
}

/// A polygonal opening seen from the agent: the agent's shadow is { x : x^T S^-1 x <= 1 }, nearly the unit
/// disc, and the vertex (a, b) is at origin + a first + b second.
template <typename N>
struct PolygonShadow {
  SymmetricForm<2, N> agent;
  std::array<N, 2> origin, first, second;

  constexpr std::array<N, 2> vertex(const N& a, const N& b) const {
    return {origin[0] + (a * first[0] + b * second[0]), origin[1] + (a * first[1] + b * second[1])};
  }
};

template <typename N, typename Shape, typename Line, typename Map>
constexpr PolygonShadow<N> polygon_shadow(const Shape& a, const Line& c, const std::array<N, 3>& first,
                                          const std::array<N, 3>& second, const N& minus_u, const N& minus_v,
                                          const Map& g, int i, int j, int k) {
  const auto agent = affine_shadow<N>(a, minus_u, minus_v, i, j, k);
  const auto flat = [&](const N& x, const N& y, const N& z) {
    return mapped<N>(g, std::array<N, 2>{x + minus_u * z, y + minus_v * z});
  };
  SymmetricForm<2, N> form;
  form.entry = {agent.a, agent.b, agent.c};
  return {mapped<N>(g, form), flat(c(i), c(j), c(k)), flat(first[i], first[j], first[k]),
          flat(second[i], second[j], second[k])};
}

/// Both positive: x lies beyond the tangent of the agent's shadow that is normal to n, whose square is
/// `radius2` = n^T S n.
template <typename N>
constexpr std::array<N, 2> beyond_signs(const N& radius2, const std::array<N, 2>& n,
                                        const std::array<N, 2>& x) {
  const N height = n[0] * x[0] + n[1] * x[1];
  return {height, height * height - radius2};
}

/// Positive: the point of the segment from x to y at t is inside the agent's shadow.
template <typename N>
constexpr N cut_sign(const SymmetricForm<2, N>& agent, const std::array<N, 2>& x, const std::array<N, 2>& y,
                     const N& t) {
  return depth_sign<2, N>(agent, {x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1])});
}

struct OrificeCounts {
  CertificateCounts<2> by_normal, by_axes;
  RoundingCount toward, toward_by_axes;
  std::array<RoundingCount, 2> beyond;
  RoundingCount cut;
};
constexpr OrificeCounts kOrificeCounts = [] {
  using Count = RoundingCount;
  // F F^T takes three roundings, p_B - p_A, w_i / w_k and a semi-axis times an axis one.
  constexpr Count kOnce{1};
  const auto shape = [](int, int) { return Count{3}; };
  const auto line = [](int) { return Count{1}; };
  const auto g = [](int, int) { return Count{}; };
  const std::array<Count, 3> input{}, product{kOnce, kOnce, kOnce};
  const std::array<Count, 3> of_axes = cross3<Count>(input, input);
  const auto certificate = [&](const auto& disc) {
    const auto pair = shadow_pair<Count>(shape, line, disc, kOnce, kOnce, 0, 1, 2);
    Count longest{};
    for (const auto* form : {&pair.forms.a, &pair.forms.b, &pair.forms.c}) {
      const auto in_frame = mapped<Count>(g, *form);
      for (const Count& x : in_frame.entry)
        if (x.roundings > longest.roundings) longest = x;
    }
    return CertificateCounts<2>::of(longest, {}, longest);
  };
  OrificeCounts counts;
  counts.by_normal = certificate(DiscByNormal<Count>{input, kOnce});
  counts.by_axes = certificate(DiscByAxes<Count>{product, product, of_axes, Count{}});
  counts.toward = toward_wall<Count>(input, kOnce, kOnce, 0, 1, 2);
  counts.toward_by_axes = toward_wall<Count>(of_axes, kOnce, kOnce, 0, 1, 2);
  const auto polygon = polygon_shadow<Count>(shape, line, input, input, kOnce, kOnce, g, 0, 1, 2);
  const std::array<Count, 2> n{}, vertex = polygon.vertex({}, {});
  counts.beyond = beyond_signs<Count>(form_at<2, Count>(polygon.agent, n), n, vertex);
  counts.cut = cut_sign<Count>(polygon.agent, vertex, vertex, {});
  return counts;
}();

double midpoint(const Tracked& x) { return x.value(); }
double midpoint(const Interval& x) { return x.mid(); }

/// Whether numbers stay where kFormUnderflow covers what products lose; lengths of agent and opening are at
/// most about one. `stretch`: of the map to a frame.
template <typename N>
bool in_range(double stretch, const std::array<N, 3>& line) {
  double reach = 0;
  for (const N& x : line) reach = std::max(reach, std::abs(midpoint(x)));
  return stretch < 0x1p40 && stretch * reach < 0x1p76;
}

Tracked minus_quotient(double x, double y, const Tracked*) { return Tracked::minus(x / y); }
Interval minus_quotient(double x, double y, const Interval*) { return -(Interval(x) / Interval(y)); }

/// The map that makes a form the identity, in plain doubles.
Eigen::Matrix2d to_unit_disc(const SymmetricForm<2, double>& a) {
  const double l11 = std::sqrt(a(0, 0)), l21 = a(0, 1) / l11, l22 = std::sqrt(a(1, 1) - l21 * l21);
  Eigen::Matrix2d inverse;
  inverse << 1 / l11, 0, -l21 / (l11 * l22), 1 / l22;
  return inverse;
}

/// The frame in which the first form is the identity and the second diagonal, in plain doubles.
struct ShadowFrame {
  Eigen::Matrix2d map;
  Eigen::Vector2d diagonal;

  ShadowFrame(const SymmetricForm<2, double>& a, const SymmetricForm<2, double>& b) {
    const Eigen::Matrix2d inverse = to_unit_disc(a);
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

namespace {
using exact::Integer;
}  // namespace

/// Agent and opening in one unit of length 2^e; shapes in units of its square.
struct OrificeOracle::InIntegers {
  exact::IntegerMatrix<3> agent;
  exact::IntegerVector<3> line;  // from the agent's centre to the opening's
  exact::IntegerVector<3> normal;
  exact::Integer common = 1;              // of a disc by its normal
  exact::IntegerMatrix<3> disc;           // times `common`; of circles and ellipses
  exact::IntegerVector<3> first, second;  // of polygons: axes for coordinates in units of 2^own
  int own = 0;

  InIntegers(const Ellipsoid& body, const Orifice& orifice) {
    const exact::PairOnGrid<3> pair(
        body, Ellipsoid::from_axes(orifice.center, Eigen::Vector3d::Constant(orifice.radius)));
    agent = pair.a;
    line = pair.c;
    normal = exact::direction_on_grid<3>(orifice.normal);
    common = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        disc[r][c] =
            pair.b[0][0] * (r == c ? common - normal[r] * normal[c] : Integer(-normal[r] * normal[c]));
  }

  InIntegers(const Ellipsoid& body, const PlacedOpening& placed) {
    constexpr int kNone = exact::PairOnGrid<3>::kNone;
    const Opening& opening = placed.opening;
    // Points of the rim are products of coordinates and axes, each on a grid of its own.
    std::array<int, 2> of_axis{kNone, kNone}, of_own{kNone, kNone};
    for (int k = 0; k < 2; ++k) {
      for (int i = 0; i < 3; ++i)
        of_axis[k] = std::min(of_axis[k], exact::grid_exponent(placed.axes(i, k), kNone));
      if (!opening.polygonal()) of_own[k] = exact::grid_exponent(opening.semi_axes()(k), kNone);
    }
    if (opening.polygonal()) {
      own = kNone;
      for (const Eigen::Vector2d& v : opening.vertices())
        own = std::min({own, exact::grid_exponent(v.x(), kNone), exact::grid_exponent(v.y(), kNone)});
      of_own = {own, own};
    }
    const int finest = std::min(of_axis[0] + of_own[0], of_axis[1] + of_own[1]);
    const exact::PairOnGrid<3> pair(body, Ellipsoid().translated(placed.center), finest);
    agent = pair.a;
    line = pair.c;
    const auto axis = [&](int k) {
      exact::IntegerVector<3> r;
      for (int i = 0; i < 3; ++i)
        r[i] = exact::on_grid(placed.axes(i, k), of_axis[k])
               << static_cast<unsigned>(of_axis[k] + of_own[k] - pair.exponent);
      return r;
    };
    first = axis(0);
    second = axis(1);
    normal = cross3<Integer>(first, second);
    if (opening.polygonal()) return;
    std::array<exact::IntegerVector<3>, 2> semi{first, second};
    for (int k = 0; k < 2; ++k)
      for (Integer& x : semi[k]) x *= exact::on_grid(opening.semi_axes()(k), of_own[k]);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) disc[r][c] = semi[0][r] * semi[0][c] + semi[1][r] * semi[1][c];
  }

  /// Along w, coordinates times w_k.
  struct Along {
    exact::IntegerVector<3> w;
    int i, j, k;
    Symmetric2<Integer> shadow;  // of the agent

    Along(const InIntegers& all, const Eigen::Vector3d& velocity)
        : w(exact::direction_on_grid<3>(velocity)),
          k(w[0] != 0   ? 0
            : w[1] != 0 ? 1
                        : 2) {
      i = (k + 1) % 3;
      j = (k + 2) % 3;
      shadow = of([&](int r, int c) -> const Integer& { return all.agent[r][c]; });
    }
    template <typename Entry>
    [[nodiscard]] Symmetric2<Integer> of(const Entry& shape) const {
      return vericone::shadow<Integer>(shape, w[i], w[j], w[k], i, j, k);
    }
    [[nodiscard]] std::array<Integer, 2> of(const exact::IntegerVector<3>& x) const {
      return {w[k] * x[i] - w[i] * x[k], w[k] * x[j] - w[j] * x[k]};
    }
  };

  [[nodiscard]] std::array<Integer, 2> vertex(const Along& along, const Eigen::Vector2d& x) const {
    const Integer a = exact::on_grid(x.x(), own), b = exact::on_grid(x.y(), own);
    exact::IntegerVector<3> at;
    for (int i = 0; i < 3; ++i) at[i] = line[i] + a * first[i] + b * second[i];
    return along.of(at);
  }
};

namespace {

/// An edge of the rim and the agent's swept shadow.
enum class Meeting : std::uint8_t { apart, touches, cuts };

/// The ellipse { x : x^T adj(S) x <= det S } and the segment from p to q. The form is least over the segment
/// at an end, or else where the line through it is nearest: that meets the ellipse iff (p x q)^2 <= n^T S n
/// for its normal n of the length of q - p.
Meeting meeting(const Symmetric2<Integer>& s, const std::array<Integer, 2>& p,
                const std::array<Integer, 2>& q) {
  const Integer det = s.a * s.c - s.b * s.b;
  const auto form = [&](const std::array<Integer, 2>& x, const std::array<Integer, 2>& y) {
    return Integer(s.c * x[0] * y[0] - s.b * (x[0] * y[1] + x[1] * y[0]) + s.a * x[1] * y[1]);
  };
  const std::array<Integer, 2> e{q[0] - p[0], q[1] - p[1]};
  const auto against = [](const Integer& value, const Integer& bound) {
    const int sign = value.compare(bound);
    return sign > 0 ? Meeting::apart : sign == 0 ? Meeting::touches : Meeting::cuts;
  };
  if (form(p, e).sign() < 0 && form(q, e).sign() > 0) {
    const Integer area = p[0] * q[1] - p[1] * q[0];
    return against(area * area, s.a * e[1] * e[1] - 2 * s.b * e[0] * e[1] + s.c * e[0] * e[0]);
  }
  return std::max(against(form(p, p), det), against(form(q, q), det));
}

/// The power of two that takes the largest entry to [1, 2); the infinity of a number that has none.
template <typename Vector>
double unit_scale(const Vector& v) {
  return std::ldexp(1.0, -std::ilogb(v.cwiseAbs().maxCoeff()));
}

}  // namespace

OrificeOracle::OrificeOracle(const Ellipsoid& agent, const Orifice& orifice)
    : agent_(agent), orifice_(orifice), normal_(orifice.normal) {
  require_finite(orifice.center, "orifice.center", kLength);
  require_finite(orifice.normal, "orifice.normal", "a finite number");
  if (orifice.normal.isZero(0)) throw InputError("orifice.normal", "[0, 0, 0]", "a vector that is not zero");
  require_positive(orifice.radius, "orifice.radius");
  exact_ = std::make_shared<InIntegers>(agent, orifice);
  normal_scale_ = unit_scale(orifice.normal);
  prepare(orifice.radius);
}

OrificeOracle::OrificeOracle(const Ellipsoid& agent, PlacedOpening opening)
    : agent_(agent), placed_(std::move(opening)) {
  try {
    require_placed(*placed_);
  } catch (const InputError& e) {
    throw e.within("orifice");
  }
  exact_ = std::make_shared<InIntegers>(agent, *placed_);
  for (int k = 0; k < 2; ++k) axis_scale_(k) = unit_scale(placed_->axes.col(k));
  const Eigen::Matrix<double, 3, 2> axes = placed_->axes * axis_scale_.asDiagonal();
  normal_ = Eigen::Vector3d(axes.col(0)).cross(Eigen::Vector3d(axes.col(1)));
  const Eigen::Vector2d most = placed_->opening.polygonal()
                                   ? Eigen::Vector2d::Constant(placed_->opening.reach())
                                   : placed_->opening.semi_axes();
  prepare(most.cwiseQuotient(axis_scale_).maxCoeff());
}

void OrificeOracle::prepare(double opening_reach) {
  Integer height = 0, reach2 = 0;
  for (int i = 0; i < 3; ++i) {
    height += exact_->normal[i] * exact_->line[i];
    for (int j = 0; j < 3; ++j) reach2 += exact_->normal[i] * exact_->agent[i][j] * exact_->normal[j];
  }
  toward_ = height.sign();
  const int outside = (height * height).compare(reach2);
  side_ = outside > 0 ? WallSide::clear : outside == 0 ? WallSide::touching : WallSide::cut;

  const int e = std::ilogb(std::max(agent_.factor().cwiseAbs().maxCoeff(), opening_reach));
  usable_ = std::abs(e) <= 510 && std::isfinite(normal_scale_) && axis_scale_.maxCoeff() <= 0x1p500 &&
            axis_scale_.minCoeff() >= 0x1p-500;
  if (usable_) scale_ = std::ldexp(1.0, -e);
}

/// What every certificate starts from, in the numbers of one rung: w = w_k (u, v, 1), in the order i, j, k.
template <typename N>
struct OrificeOracle::Seen {
  const N* tag = nullptr;
  int i, j, k;
  N minus_u, minus_v;
  SymmetricForm<3, N> agent;
  std::array<N, 3> line;
  std::array<N, 3> first, second;  // axes of a PlacedOpening
  std::array<N, 3> normal;
  bool leads = false, leaves = false;  // to the wall; neither: not sure
};

template <typename N>
OrificeOracle::Seen<N> OrificeOracle::seen_along(const Eigen::Vector3d& w) const noexcept {
  Seen<N> seen;
  const auto tag = seen.tag;
  int& k = seen.k = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(w(i)) > std::abs(w(k))) k = i;
  const int i = seen.i = (k + 1) % 3, j = seen.j = (k + 2) % 3;
  seen.minus_u = minus_quotient(w(i), w(k), tag);
  seen.minus_v = minus_quotient(w(j), w(k), tag);

  const bool by_factor = agent_.defined_by_factor();
  const auto shape = [&](int r, int c) {
    if (!by_factor) return scaled(agent_.shape()(r, c), scale_ * scale_, tag);
    const auto f = [&](int row, int column) { return scaled(agent_.factor()(row, column), scale_, tag); };
    return f(r, 0) * f(c, 0) + f(r, 1) * f(c, 1) + f(r, 2) * f(c, 2);
  };
  const auto difference = [&](int r) {
    if constexpr (std::is_same_v<N, Tracked>)
      return Tracked::of(center()(r) * scale_ - agent_.center()(r) * scale_);
    else
      return scaled(center()(r), scale_, tag) - scaled(agent_.center()(r), scale_, tag);
  };
  for (int r = 0; r < 3; ++r) {
    for (int c = r; c < 3; ++c) seen.agent(r, c) = shape(r, c);
    seen.line[r] = difference(r);
    if (placed_) {
      seen.first[r] = scaled(placed_->axes(r, 0), axis_scale_(0), tag);
      seen.second[r] = scaled(placed_->axes(r, 1), axis_scale_(1), tag);
    } else {
      seen.normal[r] = scaled(orifice_->normal(r), normal_scale_, tag);
    }
  }
  if (placed_) seen.normal = cross3<N>(seen.first, seen.second);
  const N along = toward_wall<N>(seen.normal, seen.minus_u, seen.minus_v, i, j, k);
  const N toward = (toward_ > 0) == (w(k) > 0) ? along : -along;
  const RoundingCount count = placed_ ? kOrificeCounts.toward_by_axes : kOrificeCounts.toward;
  seen.leaves = surely_positive(-toward, count);
  seen.leads = surely_positive(toward, count);
  return seen;
}

template <typename N>
std::optional<Transit> OrificeOracle::certified(const Eigen::Vector3d& w) const noexcept {
  if (!w.allFinite()) return std::nullopt;
  if (side_ == WallSide::cut || w.isZero(0)) return Transit::blocked;
  if (!usable_) return std::nullopt;
  const Seen<N> seen = seen_along<N>(w);
  if (seen.leaves) return Transit::blocked;
  if (!seen.leads) return std::nullopt;
  if (polygonal()) return through_polygon(seen, [](std::size_t) { return std::optional<Meeting>(); });
  if (orifice_) {
    const N radius = scaled(orifice_->radius, scale_, seen.tag);
    return through_disc(seen, DiscByNormal<N>{seen.normal, radius * radius});
  }
  DiscByAxes<N> disc{{}, {}, seen.normal, lift<N>(1)};
  const N a = scaled(placed_->opening.semi_axes().x(), scale_ / axis_scale_(0), seen.tag),
          b = scaled(placed_->opening.semi_axes().y(), scale_ / axis_scale_(1), seen.tag);
  for (int r = 0; r < 3; ++r) {
    disc.p[r] = a * seen.first[r];
    disc.q[r] = b * seen.second[r];
  }
  return through_disc(seen, disc);
}

template <typename N, typename Disc>
std::optional<Transit> OrificeOracle::through_disc(const Seen<N>& seen, const Disc& disc) const noexcept {
  const ShadowPair<N> pair = shadow_pair<N>(
      seen.agent, [&](int r) { return seen.line[r]; }, disc, seen.minus_u, seen.minus_v, seen.i, seen.j,
      seen.k);
  const auto& counts = orifice_ ? kOrificeCounts.by_normal : kOrificeCounts.by_axes;

  SymmetricForm<2, double> mid_a, mid_b;
  for (int x = 0; x < 3; ++x) {
    mid_a.entry[x] = midpoint(pair.forms.a.entry[x]);
    mid_b.entry[x] = midpoint(pair.forms.b.entry[x]);
  }
  const double nn = midpoint(disc.common);
  const ShadowFrame frame(mid_a, mid_b);
  const Eigen::Vector2d center =
      frame.map * Eigen::Vector2d(midpoint(pair.line[0]), midpoint(pair.line[1])) * std::sqrt(nn);
  const double stretch = frame.map.cwiseAbs().sum();
  if (!in_range(stretch, seen.line) || !frame.diagonal.allFinite()) return std::nullopt;
  const auto g = [&](int r, int c) { return lift<N>(frame.map(r, c)); };
  const PairForms<2, N> forms{mapped<N>(g, pair.forms.a), mapped<N>(g, pair.forms.b),
                              mapped<N>(g, pair.forms.c)};
  const auto guess = search_containment<2>(Eigen::Vector2d::Ones(), frame.diagonal, center);
  if (guess.inside) {
    if (surely_inside<2, N>(forms, guess.s, counts)) return Transit::passes;
  } else if (surely_reaches_beyond<2, N>(forms, guess.normal, counts)) {
    return Transit::blocked;
  }
  return std::nullopt;
}

/// Edge after edge, in the coordinates in which the agent's shadow is about the unit disc. A tangent of the
/// shadow serves all edges in a row that lie beyond it. Each edge is in a half-plane n.x > 0, so the outline
/// winds about the agent's centre as that of its rounded vertices does; where an edge goes from one side of
/// the first axis to the other, it meets the half of that which is in the half-plane: n_x says which.
///
/// `unsure(e)` says of the edge to vertex e what rounding does not let certificates say; nothing ends it all.
template <typename N, typename Unsure>
std::optional<Transit> OrificeOracle::through_polygon(const Seen<N>& seen, const Unsure& unsure) const {
  SymmetricForm<2, double> rounded;
  const auto flat = affine_shadow<N>(seen.agent, seen.minus_u, seen.minus_v, seen.i, seen.j, seen.k);
  rounded.entry = {midpoint(flat.a), midpoint(flat.b), midpoint(flat.c)};
  const Eigen::Matrix2d map = to_unit_disc(rounded);
  if (!in_range(map.cwiseAbs().sum(), seen.line)) return std::nullopt;
  const PolygonShadow<N> shadow = polygon_shadow<N>(
      seen.agent, [&](int r) { return seen.line[r]; }, seen.first, seen.second, seen.minus_u, seen.minus_v,
      [&](int r, int c) { return lift<N>(map(r, c)); }, seen.i, seen.j, seen.k);

  const Eigen::Vector2d own = scale_ * axis_scale_.cwiseInverse();
  const auto vertex = [&](const Eigen::Vector2d& x) {
    return shadow.vertex(scaled(x.x(), own.x(), seen.tag), scaled(x.y(), own.y(), seen.tag));
  };
  const auto middle = [](const std::array<N, 2>& x) {
    return Eigen::Vector2d(midpoint(x[0]), midpoint(x[1]));
  };
  Eigen::Vector2d n = Eigen::Vector2d::Zero();
  std::array<N, 2> normal{};
  N radius2{};
  const auto ahead = [&](const std::array<N, 2>& x) {
    return surely_positive(beyond_signs<N>(radius2, normal, x)[0], kOrificeCounts.beyond[0]);
  };
  const auto beyond = [&](const std::array<N, 2>& x) {
    const auto signs = beyond_signs<N>(radius2, normal, x);
    return surely_positive(signs[0], kOrificeCounts.beyond[0]) &&
           surely_positive(signs[1], kOrificeCounts.beyond[1]);
  };

  const std::vector<Eigen::Vector2d>& vertices = placed_->opening.vertices();
  std::array<N, 2> from = vertex(vertices.back());
  Eigen::Vector2d from_middle = middle(from);
  bool inside = false, touches = false, covered = false;  // the vertex before, by the tangent at hand
  for (std::size_t e = 0; e < vertices.size(); ++e) {
    const std::array<N, 2> to = vertex(vertices[e]);
    const Eigen::Vector2d to_middle = middle(to);
    if (!covered || !beyond(to)) {
      const Eigen::Vector2d edge = to_middle - from_middle;
      const double t = std::clamp(-from_middle.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      const Eigen::Vector2d nearest = from_middle + t * edge;
      const double distance = nearest.norm();
      n = nearest / distance;
      normal = lift<2, N>(n);
      radius2 = form_at<2, N>(shadow.agent, normal);
      covered = beyond(to);
      if (!covered || !beyond(from)) {
        if (distance < 1 &&
            surely_positive(cut_sign<N>(shadow.agent, from, to, lift<N>(t)), kOrificeCounts.cut))
          return Transit::blocked;
        const std::optional<Meeting> meets = unsure(e);
        if (!meets) return std::nullopt;
        if (*meets == Meeting::cuts) return Transit::blocked;
        touches = touches || *meets == Meeting::touches;
        if (!ahead(from) || !ahead(to)) return std::nullopt;
      }
    }
    if ((from_middle.y() > 0) != (to_middle.y() > 0)) inside = inside != (n.x() > 0);
    from = to;
    from_middle = to_middle;
  }
  return !inside ? Transit::blocked : touches ? Transit::grazes : Transit::passes;
}

std::optional<Transit> OrificeOracle::triage_transit(const Eigen::Vector3d& w) const noexcept {
  return certified<Tracked>(w);
}

std::optional<Transit> OrificeOracle::interval_transit(const Eigen::Vector3d& w) const noexcept {
  return certified<Interval>(w);
}

Transit OrificeOracle::exact_transit(const Eigen::Vector3d& w) const {
  VERICONE_REQUIRES(w.allFinite());
  if (side_ == WallSide::cut || w.isZero(0)) return Transit::blocked;
  const InIntegers& all = *exact_;
  const InIntegers::Along along(all, w);
  const auto& v = along.w;
  const Integer toward = all.normal[0] * v[0] + all.normal[1] * v[1] + all.normal[2] * v[2];
  if (toward.sign() != toward_) return Transit::blocked;
  if (polygonal()) {
    // All edges, and how often the outline crosses a ray from the agent's centre.
    const std::vector<Eigen::Vector2d>& vertices = placed_->opening.vertices();
    std::array<Integer, 2> from = all.vertex(along, vertices.back());
    bool inside = false, touches = false;
    for (const Eigen::Vector2d& x : vertices) {
      const std::array<Integer, 2> to = all.vertex(along, x);
      const Meeting meets = meeting(along.shadow, from, to);
      if (meets == Meeting::cuts) return Transit::blocked;
      touches = touches || meets == Meeting::touches;
      if ((from[1].sign() > 0) != (to[1].sign() > 0)) {
        const bool right = (from[0] * to[1]).compare(from[1] * to[0]) > 0;  // turns left about the centre
        inside = inside != (right == (to[1].sign() > 0));
      }
      from = to;
    }
    return !inside ? Transit::blocked : touches ? Transit::grazes : Transit::passes;
  }
  const Symmetric2<Integer>& agent = along.shadow;
  const auto line = along.of(all.line);
  const auto contained = exact::containment(
      Symmetric2<Integer>{all.common * agent.a, all.common * agent.b, all.common * agent.c},
      along.of([&](int r, int c) -> const Integer& { return all.disc[r][c]; }),
      Symmetric2<Integer>{all.common * line[0] * line[0], all.common * line[0] * line[1],
                          all.common * line[1] * line[1]});
  return contained == exact::Containment::inside     ? Transit::passes
         : contained == exact::Containment::touching ? Transit::grazes
                                                     : Transit::blocked;
}

/// The first rung for all edges but those that it is not sure of, which climb alone.
std::optional<Transit> OrificeOracle::climb_by_edges(const Eigen::Vector3d& w, Rung& rung) const {
  rung = Rung::triage;
  if (!w.allFinite()) return std::nullopt;
  if (side_ == WallSide::cut || w.isZero(0)) return Transit::blocked;
  if (!usable_) return std::nullopt;
  const Seen<Tracked> seen = seen_along<Tracked>(w);
  if (seen.leaves) return Transit::blocked;
  if (!seen.leads) return std::nullopt;
  std::optional<InIntegers::Along> along;
  const std::vector<Eigen::Vector2d>& vertices = placed_->opening.vertices();
  return through_polygon(seen, [&](std::size_t e) -> std::optional<Meeting> {
    rung = Rung::exact;
    if (!along) along.emplace(*exact_, w);
    return meeting(along->shadow, exact_->vertex(*along, vertices[e == 0 ? vertices.size() - 1 : e - 1]),
                   exact_->vertex(*along, vertices[e]));
  });
}

Transit OrificeOracle::transit(const Eigen::Vector3d& w, Rung* rung) const {
  if (polygonal()) {
    Rung by{};
    if (const auto answer = climb_by_edges(w, by)) {
      decided_by<OrificeTransit>(by, rung);
      return *answer;
    }
  }
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
