// SPDX-License-Identifier: BSD-3-Clause
#include "round/silhouette.h"

#include <algorithm>
#include <utility>

#include "round/branches.h"

namespace vericone::round {
namespace {

Integer form(const IntegerMatrix<3>& s, const IntegerVector<3>& x, const IntegerVector<3>& y) {
  Integer sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s[i][j] != 0) sum += s[i][j] * x[i] * y[j];
  return sum;
}

IntegerVector<3> minus(const IntegerVector<3>& x) { return {-x[0], -x[1], -x[2]}; }

/// How often the bracket is halved before roots are looked for: nearly all least values are decided before.
constexpr int kBisections = 72;

/// h_K on the line u + t v.
class SupportOnLine {
 public:
  SupportOnLine(const LatticeDifference& k, const IntegerVector<3>& u, const IntegerVector<3>& v) {
    const auto add = [&](const std::vector<LatticePiece>& pieces, std::vector<Branch>& terms) {
      for (const LatticePiece& piece : pieces) {
        Branch term{{inner(u, piece.p), inner(v, piece.p)}, {}};
        if (piece.round) {
          Quadratic q{form(piece.shape, u, u), 2 * form(piece.shape, u, v), form(piece.shape, v, v)};
          if (q[0] != 0 || q[2] != 0) term.q.push_back(std::move(q));
        }
        if (std::find(terms.begin(), terms.end(), term) == terms.end()) terms.push_back(std::move(term));
      }
    };
    add(k.obstacle, obstacle_);
    add(k.agent, agent_);
    if (k.squared_margin > 0)
      margin_.q.push_back({k.squared_margin * inner(u, u), 2 * k.squared_margin * inner(u, v),
                           k.squared_margin * inner(v, v)});
  }

  /// Sign of the least value, of a function that grows beyond all bounds at both ends of the line.
  int least_sign() {
    Dyadic t{0, 0};
    Integer step = 1;
    for (int round = 0;; ++round) {
      const Fraction point{t.numerator, Integer(1) << t.exponent};
      const Probe at = probe(point, 64 + 2 * t.exponent);
      if (at.sign < 0) return -1;
      if (at.sign == 0) return least_sign_about_zero(zeros(point), point);
      if (at.slope > 0) hi_ = t;
      if (at.slope < 0) lo_ = t;
      if (positive_on_bracket(at, point)) return 1;
      if (round >= kBisections && lo_ && hi_ && !no_zero_) {
        if (const auto s = least_sign_by_roots()) return *s;
        no_zero_ = true;
      }
      t = next(t, at.slope, step);
    }
  }

  /// Of a function that is 0 at infinity (that is, h_K(v) = 0), where it falls towards its least value: the
  /// sign of the limit, -1 for minus infinity.
  int limit_sign() const {
    int largest = -1;
    for (const Branch& b : obstacle_)
      for (const Branch& a : agent_) largest = std::max(largest, limit_sign(sum(b, a)));
    return largest;
  }

 private:
  struct Probe {
    int sign = 0;
    int slope = 0;  // its sign, of a pair that is positive there; 0: not told from 0
    Range value, slope_range;
    unsigned bits = 0;
  };

  [[nodiscard]] Branch sum(const Branch& b, const Branch& a) const {
    Branch f{{b.l[0] + a.l[0], b.l[1] + a.l[1]}, b.q};
    f.q.insert(f.q.end(), a.q.begin(), a.q.end());
    f.q.insert(f.q.end(), margin_.q.begin(), margin_.q.end());
    return f;
  }

  static int limit_sign(const Branch& f) {
    RootSum lead{f.l[1], {}};
    for (const Quadratic& q : f.q) lead.squares.push_back(q[2]);
    if (sign(lead) < 0) return -1;
    // All roots are whole: sqrt(q) -> sqrt(q_2) t + q_1 / (2 sqrt(q_2)).
    Integer denominator = 1;
    for (const Quadratic& q : f.q)
      if (q[2] > 0) denominator = lcm(denominator, Integer(2 * floor_root(q[2])));
    RootSum limit{f.l[0] * denominator, {}};
    for (const Quadratic& q : f.q) {
      if (q[2] > 0)
        limit.whole += q[1] * (denominator / (2 * floor_root(q[2])));
      else
        limit.squares.push_back(q[0] * denominator * denominator);
    }
    return sign(limit);
  }

  static std::vector<Range> enclosures(const std::vector<Branch>& terms, const Fraction& t, unsigned bits) {
    std::vector<Range> r;
    for (const Branch& f : terms) r.push_back(enclose(value(f, t), bits));
    return r;
  }

  Probe probe(const Fraction& t, unsigned bits) const {
    const auto b = enclosures(obstacle_, t, bits), a = enclosures(agent_, t, bits);
    const Range margin = enclose(value(margin_, t), bits);
    const auto lowest = [](const Range& x, const Range& y) { return x.lo < y.lo; };
    auto i = static_cast<std::size_t>(std::max_element(b.begin(), b.end(), lowest) - b.begin());
    auto j = static_cast<std::size_t>(std::max_element(a.begin(), a.end(), lowest) - a.begin());
    Probe at;
    at.sign = -1;
    if (b[i].lo + a[j].lo + margin.lo > 0) {
      at.sign = 1;
    } else {
      for (std::size_t bi = 0; bi < b.size() && at.sign < 1; ++bi)
        for (std::size_t aj = 0; aj < a.size() && at.sign < 1; ++aj) {
          if (b[bi].hi + a[aj].hi + margin.hi < 0) continue;
          at.sign = std::max(at.sign, sign(value(sum(obstacle_[bi], agent_[aj]), t)));
          i = bi;
          j = aj;
        }
    }
    if (at.sign < 1) return at;
    const Branch f = sum(obstacle_[i], agent_[j]);
    for (int more = 0; more < 3; ++more, bits *= 2) {
      at.bits = bits;
      at.value = enclose(value(f, t), bits);
      at.slope_range = enclose_slope(f, t, bits);
      at.slope = at.slope_range.lo > 0 ? 1 : at.slope_range.hi < 0 ? -1 : 0;
      if (at.slope != 0 || (lo_ && hi_)) break;
    }
    return at;
  }

  /// By the tangent at `point`, which is an end of the bracket or has a slope that is not told from 0.
  [[nodiscard]] bool positive_on_bracket(const Probe& at, const Fraction& point) const {
    if (at.slope_range.lo == 0 && at.slope_range.hi == 0) return true;
    if (!lo_ || !hi_) return false;
    const unsigned e = std::max(lo_->exponent, hi_->exponent);
    const Integer width = (hi_->numerator << (e - hi_->exponent)) - (lo_->numerator << (e - lo_->exponent));
    const Integer slope = std::max(abs(at.slope_range.lo), abs(at.slope_range.hi));
    return (at.value.lo << e) > slope * width * point.d;
  }

  [[nodiscard]] Dyadic next(const Dyadic& t, int slope, Integer& step) const {
    if (lo_ && hi_) {
      if (lo_->numerator < 0 && hi_->numerator > 0 && slope != 0 && t.numerator != 0) return {0, 0};
      if (slope == 0) return middle(*lo_, t);
      return lo_->numerator < 0 && hi_->numerator > 0 ? middle(*lo_, *hi_) : exact::between(*lo_, *hi_);
    }
    if (slope == 0) return {16 * t.numerator + (Integer(5) << t.exponent), t.exponent + 4};
    const Integer by = step << t.exponent;
    step *= 4;
    return {slope < 0 ? t.numerator + by : t.numerator - by, t.exponent};
  }

  static Dyadic middle(const Dyadic& x, const Dyadic& y) {
    const unsigned e = std::max(x.exponent, y.exponent);
    return {(x.numerator << (e - x.exponent)) + (y.numerator << (e - y.exponent)), e + 1};
  }

  /// The pairs that are not surely negative at t.
  [[nodiscard]] std::vector<Branch> candidates(const std::vector<Fraction>& points, unsigned bits) const {
    std::vector<std::vector<Range>> b, a;
    std::vector<Range> margin;
    for (const Fraction& t : points) {
      b.push_back(enclosures(obstacle_, t, bits));
      a.push_back(enclosures(agent_, t, bits));
      margin.push_back(enclose(value(margin_, t), bits));
    }
    std::vector<Branch> found;
    for (std::size_t i = 0; i < obstacle_.size(); ++i)
      for (std::size_t j = 0; j < agent_.size(); ++j) {
        bool negative = true;  // at all points: then, being convex, between them
        for (std::size_t k = 0; k < points.size(); ++k)
          negative = negative && b[k][i].hi + a[k][j].hi + margin[k].hi < 0;
        if (negative) continue;
        for (Branch& f : simplified(sum(obstacle_[i], agent_[j])))
          if (std::find(found.begin(), found.end(), f) == found.end()) found.push_back(std::move(f));
      }
    return found;
  }

  /// At a point where the support function is 0.
  [[nodiscard]] std::vector<Branch> zeros(const Fraction& t) const {
    auto found = candidates({t}, 64);
    std::erase_if(found, [&](const Branch& f) { return sign(value(f, t)) != 0; });
    return found;
  }

  /// The support function is 0 at t, by `zeros`: is that its least value?
  static int least_sign_about_zero(const std::vector<Branch>& zeros, const Fraction& t) {
    Slopes slopes{1, -1};
    for (const Branch& f : zeros) {
      const Slopes s = slopes_at_zero(f, t);
      slopes = {std::min(slopes.left, s.left), std::max(slopes.right, s.right)};
    }
    return slopes.left <= 0 && slopes.right >= 0 ? 0 : -1;
  }

  /// The sign of the least value where the support function has a zero in the bracket at a root of one of the
  /// polynomials that a least value of 0 needs; nothing where it has none, so that the least value is not 0.
  [[nodiscard]] std::optional<int> least_sign_by_roots() const {
    const Fraction ends[2] = {{lo_->numerator, Integer(1) << lo_->exponent},
                              {hi_->numerator, Integer(1) << hi_->exponent}};
    const unsigned bits = 64 + 2 * std::max(lo_->exponent, hi_->exponent);
    const std::vector<Branch> branches = candidates({ends[0], ends[1]}, bits);
    std::vector<Fraction> corners;
    for (const Branch& f : branches)
      for (Fraction& t : kinks(f)) corners.push_back(std::move(t));
    for (const Fraction& t : corners) {
      if (t.m * ends[0].d < ends[0].m * t.d || t.m * ends[1].d > ends[1].m * t.d) continue;
      int largest = -1;
      for (const Branch& f : branches) largest = std::max(largest, sign(value(f, t)));
      if (largest < 0) return -1;
      if (largest == 0) return least_sign_about_zero(zeros(t), t);
    }
    std::vector<Polynomial> norms;
    for (const Branch& f : branches) norms.push_back(norm(f));
    for (std::size_t i = 0; i < norms.size(); ++i)
      for (std::size_t j = i; j < norms.size(); ++j) {
        if (norms[i].size() == 1 || norms[j].size() == 1) continue;  // without a root
        if (i == j && norms[i].empty()) continue;  // f = 0 everywhere: where others cross it
        const Polynomial common = exact::gcd(norms[i], j == i ? exact::derivative(norms[i]) : norms[j]);
        if (common.size() < 2) continue;
        for (RealRoot& x : exact::real_roots_in(common, *lo_, *hi_))
          if (const auto s = least_sign_at_root(branches, norms, corners, x)) return s;
      }
    return std::nullopt;
  }

  /// Nothing where the support function is positive at x.
  static std::optional<int> least_sign_at_root(const std::vector<Branch>& branches,
                                               const std::vector<Polynomial>& norms,
                                               const std::vector<Fraction>& corners, RealRoot& x) {
    for (const Fraction& t : corners)
      if (exact::sign_at(Polynomial{-t.m, t.d}, x) == 0) return std::nullopt;  // tried before
    std::vector<std::size_t> zeros;
    for (std::size_t i = 0; i < branches.size(); ++i) {
      const int s = sign_at(branches[i], norms[i], x);
      if (s > 0) return std::nullopt;
      if (s == 0) zeros.push_back(i);
    }
    if (zeros.empty()) return -1;
    int least = 1, most = -1;
    for (const std::size_t i : zeros) {
      const int s = slope_sign_at_zero(branches[i], norms[i], x);
      least = std::min(least, s);
      most = std::max(most, s);
    }
    return least <= 0 && most >= 0 ? 0 : -1;
  }

  std::vector<Branch> obstacle_, agent_;
  Branch margin_;
  std::optional<Dyadic> lo_, hi_;  // the support function is positive there and beyond
  bool no_zero_ = false;
};

}  // namespace

int support_sign(const LatticeDifference& k, const IntegerVector<3>& n) {
  const auto sums = [&](const std::vector<LatticePiece>& pieces) {
    std::vector<RootSum> r;
    for (const LatticePiece& piece : pieces) {
      RootSum sum{inner(n, piece.p), {}};
      if (piece.round) sum.squares.push_back(form(piece.shape, n, n));
      r.push_back(std::move(sum));
    }
    return r;
  };
  const auto b = sums(k.obstacle), a = sums(k.agent);
  const Integer margin = k.squared_margin * inner(n, n);
  const auto highest = [](const std::vector<RootSum>& sums_of, std::vector<Range>& ranges) {
    Integer highest_lo;
    for (const RootSum& x : sums_of) {
      ranges.push_back(enclose(x, 64));
      if (ranges.size() == 1 || ranges.back().lo > highest_lo) highest_lo = ranges.back().lo;
    }
    return highest_lo;
  };
  std::vector<Range> b_ranges, a_ranges;
  const Range root = enclose_root(margin, 64);
  if (highest(b, b_ranges) + highest(a, a_ranges) + root.lo > 0) return 1;
  int largest = -1;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (b_ranges[i].hi + a_ranges[j].hi + root.hi < 0) continue;
      RootSum sum{b[i].whole + a[j].whole, b[i].squares};
      sum.squares.insert(sum.squares.end(), a[j].squares.begin(), a[j].squares.end());
      sum.squares.push_back(margin);
      largest = std::max(largest, sign(sum));
    }
  return largest;
}

int least_support_sign(const LatticeDifference& k, const IntegerVector<3>& u, const IntegerVector<3>& v) {
  const int ahead = support_sign(k, v), behind = support_sign(k, minus(v));
  if (ahead < 0 || behind < 0) return -1;
  const IntegerVector<3> minus_u = minus(u);
  if (ahead == 0 || behind == 0) {
    // The two lines u + t v and -u + t v fall towards their limits at that end.
    const IntegerVector<3> end = ahead == 0 ? v : minus(v);
    const bool negative =
        SupportOnLine(k, u, end).limit_sign() < 0 || SupportOnLine(k, minus_u, end).limit_sign() < 0;
    return negative ? -1 : 0;
  }
  const int first = SupportOnLine(k, u, v).least_sign();
  return first < 0 ? -1 : std::min(first, SupportOnLine(k, minus_u, v).least_sign());
}

}  // namespace vericone::round
