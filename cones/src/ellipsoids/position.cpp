// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>

#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <cmath>

#include "answers/elementary.h"
#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/containment.h"
#include "ellipsoids/pair_on_grid.h"

namespace vericone {

const char* to_string(Position position) {
  switch (position) {
    case Position::disjoint:
      return "disjoint";
    case Position::touching:
      return "touching";
    case Position::crossing:
      return "crossing";
    case Position::a_inside_b:
      return "a inside b";
    case Position::a_inside_b_touching:
      return "a inside b, touching";
    case Position::b_inside_a:
      return "b inside a";
    case Position::b_inside_a_touching:
      return "b inside a, touching";
    case Position::equal:
      return "equal";
  }
  return "";
}

Position swapped(Position position) {
  switch (position) {
    case Position::a_inside_b:
      return Position::b_inside_a;
    case Position::a_inside_b_touching:
      return Position::b_inside_a_touching;
    case Position::b_inside_a:
      return Position::a_inside_b;
    case Position::b_inside_a_touching:
      return Position::a_inside_b_touching;
    default:
      return position;
  }
}

Relation relation_of(Position position) {
  return position == Position::disjoint   ? Relation::disjoint
         : position == Position::touching ? Relation::touching
                                          : Relation::overlapping;
}

namespace {

/// The pair in coordinates that nearly make A a unit ball and B axis-aligned: x -> G x with the doubles G
/// taken as they are, so that any G gives certificates of the bodies themselves. (Where G is singular no
/// certificate is found.)
template <int D, typename N>
struct FramedPair {
  PairForms<D, N> forms;
  std::array<N, D> c;
};

/// A sum of products, left to right.
template <typename N, int D, typename X, typename Y>
constexpr N inner(const X& x, const Y& y) {
  N sum = x(0) * y(0);
  for (int k = 1; k < D; ++k) sum = sum + x(k) * y(k);
  return sum;
}

/// G S G^T for S = F F^T (m = F) or for S itself (m = S).
template <int D, typename N, typename Map, typename Entry>
constexpr SymmetricForm<D, N> framed_shape(const Map& g, const Entry& m, bool by_factor) {
  std::array<std::array<N, D>, D> h{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      h[i][j] = inner<N, D>([&](int k) { return g(i, k); }, [&](int k) { return m(k, j); });
  SymmetricForm<D, N> s;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      s(i, j) = by_factor ? inner<N, D>([&](int k) { return h[i][k]; }, [&](int k) { return h[j][k]; })
                          : inner<N, D>([&](int k) { return h[i][k]; }, [&](int k) { return g(j, k); });
  return s;
}

template <int D>
constexpr CertificateCounts<D> kCounts = [] {
  const auto input = [](int, int) { return RoundingCount{}; };
  const auto longest = [&](bool by_factor) {
    return framed_shape<D, RoundingCount>(input, input, by_factor)(0, 0).roundings;
  };
  const RoundingCount shape{std::max(longest(true), longest(false))};
  const RoundingCount center = inner<RoundingCount, D>([](int) { return RoundingCount{}; },
                                                       [](int) { return RoundingCount{1}; });  // p_B - p_A
  return CertificateCounts<D>::of(shape, center, center * center);
}();

/// A difference times a power of two.
Tracked scaled_difference(double x, double y, double scale, const Tracked*) {
  return Tracked::of(x * scale - y * scale);
}
Interval scaled_difference(double x, double y, double scale, const Interval*) {
  return Interval(x * scale, Interval::kTiny) - Interval(y * scale, Interval::kTiny);
}

/// The search of one pair, shared by the rungs: everything that needs no certainty.
template <int D>
struct PositionSearch {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  const BasicEllipsoid<D>&a, &b;
  bool usable = false;
  double scale = 1;  // a power of two that makes the larger body's size about one
  Matrix map;        // G, of scaled lengths
  bool apart = false;
  Vector normal;  // separates, in the frame
  Vector common;  // a point of both, in the frame, from A's centre
  ContainmentGuess<D> a_in_b, b_in_a;

  /// A is the larger body.
  PositionSearch(const BasicEllipsoid<D>& body_a, const BasicEllipsoid<D>& body_b) : a(body_a), b(body_b) {
    const int e = std::ilogb(a.factor().cwiseAbs().maxCoeff());
    if (std::abs(e) > 510) return;
    scale = std::ldexp(1.0, -e);
    const ContactFrame<D> frame(a, b);
    map = frame.to_frame * std::ldexp(1.0, e);
    const double stretch = map.cwiseAbs().sum(), reach = frame.center_line.cwiseAbs().maxCoeff() * scale;
    // See kFormUnderflow. All lengths of both bodies are at most about one.
    usable = stretch < 0x1p42 && stretch * reach < 0x1p80 && frame.contact >= 0 &&
             frame.contact < std::numeric_limits<double>::max();
    if (!usable) return;
    apart = frame.contact > 1;
    if (apart) {
      normal = frame.center.cwiseQuotient(frame.bounding_shape());
      normal /= normal.cwiseAbs().maxCoeff();
      return;
    }
    const Vector sigma2 = frame.sigma.cwiseAbs2(), one = Vector::Ones();
    common = frame.center.cwiseQuotient(one + frame.ratio * sigma2);
    a_in_b = search_containment<D>(one, sigma2, frame.center);
    b_in_a = search_containment<D>(sigma2, one, frame.center);
  }

  template <typename N>
  FramedPair<D, N> framed() const {
    const auto tag = static_cast<const N*>(nullptr);
    const auto g = [&](int i, int j) { return lift<N>(map(i, j)); };
    const auto shape = [&](const BasicEllipsoid<D>& body) {
      const bool by_factor = body.defined_by_factor();
      const Matrix& m = by_factor ? body.factor() : body.shape();
      const double unit = by_factor ? scale : scale * scale;
      return framed_shape<D, N>(
          g, [&](int i, int j) { return scaled(m(i, j), unit, tag); }, by_factor);
    };
    FramedPair<D, N> pair;
    pair.forms.a = shape(a);
    pair.forms.b = shape(b);
    std::array<N, D> line;
    for (int i = 0; i < D; ++i) line[i] = scaled_difference(b.center()(i), a.center()(i), scale, tag);
    for (int i = 0; i < D; ++i)
      pair.c[i] = inner<N, D>([&](int k) { return g(i, k); }, [&](int k) { return line[k]; });
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) pair.forms.c(i, j) = pair.c[i] * pair.c[j];
    return pair;
  }

  template <typename N>
  std::optional<Position> certified() const {
    if (!usable) return std::nullopt;
    const auto& counts = kCounts<D>;
    const FramedPair<D, N> pair = framed<N>();
    if (apart) {
      const auto signs = apart_signs<D, N>(pair.forms, lift<D, N>(normal));
      if (surely_positive(signs[0], counts.apart[0]) && surely_positive(signs[1], counts.apart[1]))
        return Position::disjoint;
      return std::nullopt;
    }
    if (a_in_b.inside) {
      if (surely_inside<D, N>(pair.forms, a_in_b.s, counts)) return Position::a_inside_b;
      return std::nullopt;
    }
    const PairForms<D, N> other{pair.forms.b, pair.forms.a, pair.forms.c};
    if (b_in_a.inside) {
      if (surely_inside<D, N>(other, b_in_a.s, counts)) return Position::b_inside_a;
      return std::nullopt;
    }
    const std::array<N, D> y = lift<D, N>(common);
    std::array<N, D> z = y;
    for (int i = 0; i < D; ++i) z[i] = y[i] - pair.c[i];
    if (surely_reaches_beyond<D, N>(pair.forms, a_in_b.normal, counts) &&
        surely_reaches_beyond<D, N>(other, b_in_a.normal, counts) &&
        surely_positive(depth_sign<D, N>(pair.forms.a, y), counts.depth_a) &&
        surely_positive(depth_sign<D, N>(pair.forms.b, z), counts.depth_b))
      return Position::crossing;
    return std::nullopt;
  }
};

/// The larger body becomes the unit ball: the other's shape then has no large entry.
template <int D>
bool a_first(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) {
  return !(a.factor().cwiseAbs().maxCoeff() < b.factor().cwiseAbs().maxCoeff());
}

template <int D, typename N>
std::optional<Position> certified(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) {
  if (a_first<D>(a, b)) return PositionSearch<D>(a, b).template certified<N>();
  const auto mirrored = PositionSearch<D>(b, a).template certified<N>();
  if (!mirrored) return std::nullopt;
  return swapped(*mirrored);
}

exact::Integer determinant_of(const exact::IntegerMatrix<2>& m) {
  return m[0][0] * m[1][1] - m[0][1] * m[1][0];
}
exact::Integer determinant_of(const exact::IntegerMatrix<3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// adj(X) : Y.
exact::Integer mixed(const exact::IntegerMatrix<3>& x, const exact::IntegerMatrix<3>& y) {
  exact::Integer sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
      sum += (x[r0][c0] * x[r1][c1] - x[r0][c1] * x[r1][c0]) * y[i][j];
    }
  return sum;
}

/// A in B from the contact polynomial p at x = -s.
template <int D>
exact::Containment contained(const exact::PairOnGrid<D>& pair, const exact::Polynomial& contact,
                             const exact::Integer& det_a, const exact::Integer& det_b, bool concentric) {
  exact::Polynomial whole = contact, pencil;
  if constexpr (D == 3) {
    pencil.resize(4);
    pencil[0] = -det_a;
    pencil[1] = mixed(pair.a, pair.b);
    pencil[2] = -mixed(pair.b, pair.a);
    pencil[3] = det_b;
    for (std::size_t i = 1; i < whole.size(); i += 2) whole[i] = -whole[i];
  } else {
    const exact::Integer ab =
        pair.a[0][0] * pair.b[1][1] + pair.a[1][1] * pair.b[0][0] - 2 * pair.a[0][1] * pair.b[0][1];
    pencil.resize(3);
    pencil[0] = det_a;
    pencil[1] = -ab;
    pencil[2] = det_b;
    for (std::size_t i = 0; i < whole.size(); i += 2) whole[i] = -whole[i];
  }
  return exact::containment(whole, pencil, concentric);
}

template <int D>
Position decide_exactly(exact::PairOnGrid<D> pair) {
  using exact::Containment;
  bool concentric = true;
  for (int i = 0; i < D; ++i) concentric = concentric && pair.c[i] == 0;
  if (concentric && pair.a == pair.b) return Position::equal;
  exact::Polynomial contact = exact::contact_polynomial<D>(pair);
  if (!concentric) {
    const int roots = exact::distinct_positive_roots(contact);
    if (roots > 0) return roots == 1 ? Position::touching : Position::disjoint;
  }
  // Of different bodies only the smaller one can lie in the other.
  const exact::Integer det_a = determinant_of(pair.a), det_b = determinant_of(pair.b);
  const int larger = det_a.compare(det_b);
  if (larger == 0) return Position::crossing;
  if (larger < 0) {
    const Containment in = contained<D>(pair, contact, det_a, det_b, concentric);
    return in == Containment::inside     ? Position::a_inside_b
           : in == Containment::touching ? Position::a_inside_b_touching
                                         : Position::crossing;
  }
  std::swap(pair.a, pair.b);
  // The contact polynomial of the swapped pair has the coefficients in reverse order.
  std::reverse(contact.begin(), contact.end());
  const Containment in = contained<D>(pair, contact, det_b, det_a, concentric);
  return in == Containment::inside     ? Position::b_inside_a
         : in == Containment::touching ? Position::b_inside_a_touching
                                       : Position::crossing;
}

}  // namespace

template <int D>
std::optional<Position> triage_position(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) noexcept {
  return certified<D, Tracked>(a, b);
}

template <int D>
std::optional<Position> interval_position(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) noexcept {
  return certified<D, Interval>(a, b);
}

template <int D>
Position exact_position(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) {
  return decide_exactly<D>(exact::PairOnGrid<D>(a, b));
}

template <int D>
Position position(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, Rung* rung) {
  const bool in_order = a_first<D>(a, b);
  const PositionSearch<D> search = in_order ? PositionSearch<D>(a, b) : PositionSearch<D>(b, a);
  const auto turned = [in_order](std::optional<Position> answer) {
    if (answer && !in_order) answer = swapped(*answer);
    return answer;
  };
  return climb<PositionOf<D>>(
      rung, [&] { return turned(search.template certified<Tracked>()); },
      [&] { return turned(search.template certified<Interval>()); }, [&] { return exact_position<D>(a, b); });
}

template std::optional<Position> triage_position<2>(const Ellipse&, const Ellipse&) noexcept;
template std::optional<Position> triage_position<3>(const Ellipsoid&, const Ellipsoid&) noexcept;
template std::optional<Position> interval_position<2>(const Ellipse&, const Ellipse&) noexcept;
template std::optional<Position> interval_position<3>(const Ellipsoid&, const Ellipsoid&) noexcept;
template Position exact_position<2>(const Ellipse&, const Ellipse&);
template Position exact_position<3>(const Ellipsoid&, const Ellipsoid&);
template Position position<2>(const Ellipse&, const Ellipse&, Rung*);
template Position position<3>(const Ellipsoid&, const Ellipsoid&, Rung*);

namespace exact {

template <int D>
Position position(const RationalBody<D>& a, const RationalBody<D>& b) {
  return decide_exactly<D>(PairOnGrid<D>(a, b));
}
template Position position<2>(const RationalBody<2>&, const RationalBody<2>&);
template Position position<3>(const RationalBody<3>&, const RationalBody<3>&);

}  // namespace exact
}  // namespace vericone
