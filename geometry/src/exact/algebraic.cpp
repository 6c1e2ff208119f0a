// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/exact/algebraic.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vericone::exact {
namespace {

/// Lehmer's algorithm: many division steps are found from the leading digits and applied at once. (The binary
/// algorithm of the library is slow for numbers of thousands of digits.)
Integer common_divisor(Integer a, Integer b) {
  a = abs(a);
  b = abs(b);
  if (a < b) std::swap(a, b);
  while (b != 0 && log2_floor(b) >= 64) {
    const auto shift = static_cast<unsigned>(log2_floor(a) - 61);
    auto x = static_cast<std::int64_t>(Integer(a >> shift)),
         y = static_cast<std::int64_t>(Integer(b >> shift));
    std::int64_t xa = 1, xb = 0, ya = 0, yb = 1;
    while (y + ya != 0 && y + yb != 0) {
      const std::int64_t q = (x + xa) / (y + ya);
      if (q != (x + xb) / (y + yb)) break;
      x = std::exchange(y, x - q * y);
      xa = std::exchange(ya, xa - q * ya);
      xb = std::exchange(yb, xb - q * yb);
    }
    if (xb == 0) {
      a = std::exchange(b, a % b);
    } else {
      // Of determinant +-1, so the divisor is the same whatever the digits left out.
      Integer next = xa * a + xb * b;
      b = abs(Integer(ya * a + yb * b));
      a = abs(next);
      if (a < b) std::swap(a, b);
    }
  }
  return b == 0 ? a : gcd(b, Integer(a % b));
}

/// Brings both to one exponent.
void align(Dyadic& x, Dyadic& y) {
  Dyadic& coarse = x.exponent < y.exponent ? x : y;
  const unsigned exponent = std::max(x.exponent, y.exponent);
  coarse.numerator <<= exponent - coarse.exponent;
  coarse.exponent = exponent;
}

Dyadic reduced(Dyadic x) {
  if (x.numerator == 0) return {0, 0};
  const unsigned zeros = std::min(static_cast<unsigned>(lsb(Integer(abs(x.numerator)))), x.exponent);
  x.numerator = x.numerator < 0 ? Integer(-(Integer(-x.numerator) >> zeros)) : Integer(x.numerator >> zeros);
  x.exponent -= zeros;
  return x;
}

/// Bounds of scaled_value() on [lo, hi], lo.exponent == hi.exponent: sign of all values, 0 if they differ or
/// are not told apart.
int sign_on(const Polynomial& p, Dyadic lo, Dyadic hi) {
  align(lo, hi);
  Integer least = 0, most = 0;
  unsigned shift = 0;
  for (auto it = p.rbegin(); it != p.rend(); ++it) {
    const auto [low, high] = std::minmax({Integer(least * lo.numerator), Integer(least * hi.numerator),
                                          Integer(most * lo.numerator), Integer(most * hi.numerator)});
    const Integer term = *it << shift;
    least = low + term;
    most = high + term;
    shift += lo.exponent;
  }
  return least > 0 ? 1 : most < 0 ? -1 : 0;
}

/// A positive multiple of -(a mod b): every elimination step is scaled by |leading coefficient of b|.
Polynomial negative_remainder(Polynomial a, const Polynomial& b) {
  const Integer lead = abs(b.back());
  const int lead_sign = b.back().sign();
  while (a.size() >= b.size()) {
    const Integer f = lead_sign > 0 ? a.back() : Integer(-a.back());
    const std::size_t shift = a.size() - b.size();
    for (auto& x : a) x *= lead;
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= f * b[i];
    a.pop_back();
  }
  trim(a);
  // Without its content the chain's numbers stay a few times as long as the coefficients.
  a = primitive_part(std::move(a));
  for (auto& x : a) x = -x;
  return a;
}

template <typename Sign>
int sign_changes(const std::vector<Polynomial>& chain, Sign&& sign_of) {
  int changes = 0, last = 0;
  for (const Polynomial& p : chain) {
    const int s = sign_of(p);
    if (s != 0 && last != 0 && s != last) ++changes;
    if (s != 0) last = s;
  }
  return changes;
}

/// All roots are smaller than 2^e in absolute value: twice the largest |a_i / a_n|^(1 / (n - i)) (Fujiwara).
/// p has at least two terms.
int log2_root_bound(const Polynomial& p) {
  const int n = static_cast<int>(p.size()) - 1, lead = log2_floor(p.back());
  int e = std::numeric_limits<int>::min();
  for (int i = 0; i < n; ++i)
    if (p[i] != 0) e = std::max(e, static_cast<int>(std::ceil((log2_floor(p[i]) + 1.0 - lead) / (n - i))));
  return e + 1;
}

/// Roots in (lo, hi), none of them at the ends, appended in increasing order.
void isolate(const std::shared_ptr<const Polynomial>& p, const std::vector<Polynomial>& chain,
             const Dyadic& lo, const Dyadic& hi, int changes_lo, int changes_hi,
             std::vector<RealRoot>& roots) {
  if (changes_lo == changes_hi) return;
  if (changes_lo - changes_hi == 1) {
    roots.emplace_back(p, lo, hi);
    return;
  }
  std::vector<Dyadic> cuts{between(lo, hi)};
  if (sign_at(*p, cuts[0]) == 0) {
    // A cut on each side of the root, so that it ends up inside an interval and all parts are smaller.
    Dyadic left = between(lo, cuts[0]), right = between(cuts[0], hi);
    while (sign_at(*p, left) == 0) left = between(left, cuts[0]);
    while (sign_at(*p, right) == 0) right = between(cuts[0], right);
    cuts = {std::move(left), std::move(right)};
  }
  cuts.push_back(hi);
  Dyadic from = lo;
  int changes_from = changes_lo;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const int changes_to = i + 1 == cuts.size() ? changes_hi : sign_changes_at(chain, cuts[i]);
    isolate(p, chain, from, cuts[i], changes_from, changes_to, roots);
    from = std::move(cuts[i]);
    changes_from = changes_to;
  }
}

enum Side { kNegative = 1, kPositive = 2, kBoth = 3 };

std::vector<RealRoot> roots_on(const Polynomial& polynomial, int sides) {
  std::vector<RealRoot> roots;
  Polynomial stripped = squarefree_part(polynomial);
  const bool zero = stripped.front() == 0;
  if (zero) stripped.erase(stripped.begin());
  const auto p = std::make_shared<const Polynomial>(std::move(stripped));
  const auto chain = p->size() > 1 ? sturm_chain(*p) : std::vector<Polynomial>{};
  const auto search = [&](int sign) {
    if (chain.empty()) return;
    const Polynomial reversed(p->rbegin(), p->rend());
    Dyadic near = Dyadic::power_of_two(-log2_root_bound(reversed)),
           far = Dyadic::power_of_two(log2_root_bound(*p));
    near.numerator *= sign;
    far.numerator *= sign;
    const Dyadic &lo = sign > 0 ? near : far, &hi = sign > 0 ? far : near;
    isolate(p, chain, lo, hi, sign_changes_at(chain, lo), sign_changes_at(chain, hi), roots);
  };
  if (sides & kNegative) search(-1);
  if (zero && sides == kBoth) roots.emplace_back(Dyadic{0, 0});
  if (sides & kPositive) search(1);
  return roots;
}

/// x rounded towards zero, and away from it.
Interval enclosure_of_magnitude(const Integer& m, unsigned exponent) {
  if (m == 0) return 0;
  const int shift = log2_floor(m) - 52;
  const Integer top =
      shift > 0 ? Integer(m >> static_cast<unsigned>(shift)) : Integer(m << static_cast<unsigned>(-shift));
  const long long e = shift - static_cast<long long>(exponent);
  const auto bits = static_cast<double>(static_cast<long long>(top));
  if (e > 2000) return {0, std::numeric_limits<double>::infinity()};
  const double lo = e < -2000 ? 0 : std::ldexp(bits, static_cast<int>(e));
  const bool rounded = shift > 0 && (top << static_cast<unsigned>(shift)) != m;
  const bool normal = e >= -1074 && e <= 971;
  if (!rounded && normal) return lo;
  if (!std::isfinite(lo)) return {0, std::numeric_limits<double>::infinity()};
  const double inf = std::numeric_limits<double>::infinity();
  const double below = normal ? lo : std::max(std::nextafter(lo, -inf), 0.0), above = std::nextafter(lo, inf);
  if (!std::isfinite(above)) return {0, inf};
  return Interval::between(below, above);
}

}  // namespace

int log2_floor(const Integer& x) { return static_cast<int>(msb(Integer(abs(x)))); }
int log2_floor(const Dyadic& x) { return log2_floor(x.numerator) - static_cast<int>(x.exponent); }

Dyadic Dyadic::power_of_two(int e) {
  return e >= 0 ? Dyadic{Integer(1) << static_cast<unsigned>(e), 0}
                : Dyadic{1, 0U - static_cast<unsigned>(e)};
}

Dyadic Dyadic::of(double finite) {
  const int e = grid_exponent(finite, 0);
  return e >= 0 ? Dyadic{on_grid(finite, 0), 0} : Dyadic{on_grid(finite, e), static_cast<unsigned>(-e)};
}

int compare(const Dyadic& x, const Dyadic& y) {
  return x.exponent < y.exponent ? (x.numerator << (y.exponent - x.exponent)).compare(y.numerator)
                                 : x.numerator.compare(y.numerator << (x.exponent - y.exponent));
}

Dyadic between(Dyadic lo, Dyadic hi) {
  if (lo.numerator != 0 && hi.numerator != 0) {
    const int small = std::min(log2_floor(lo), log2_floor(hi)),
              large = std::max(log2_floor(lo), log2_floor(hi));
    if (large - small >= 2) {
      Dyadic mid = Dyadic::power_of_two(static_cast<int>(std::floor((small + large + 1) / 2.0)));
      if (lo.numerator < 0) mid.numerator = -mid.numerator;
      return mid;
    }
  }
  align(lo, hi);
  return reduced({lo.numerator + hi.numerator, lo.exponent + 1});
}

Interval enclosure(const Dyadic& x) {
  const Interval m = enclosure_of_magnitude(abs(x.numerator), x.exponent);
  return x.numerator < 0 ? -m : m;
}

void trim(Polynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

Polynomial primitive_part(Polynomial p) {
  Integer content = 0;
  for (const auto& x : p) {
    content = common_divisor(content, x);
    if (content == 1) return p;
  }
  for (auto& x : p) x /= content;
  return p;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<long>(i));
  return d;
}

Polynomial operator+(const Polynomial& p, const Polynomial& q) {
  Polynomial r = p.size() < q.size() ? q : p;
  const Polynomial& s = p.size() < q.size() ? p : q;
  for (std::size_t i = 0; i < s.size(); ++i) r[i] += s[i];
  trim(r);
  return r;
}

Polynomial operator-(const Polynomial& p, const Polynomial& q) { return p + q * Integer(-1); }

Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return {};
  Polynomial r(p.size() + q.size() - 1, Integer(0));
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
  return r;
}

Polynomial operator*(const Polynomial& p, const Integer& factor) {
  if (factor == 0) return {};
  Polynomial r = p;
  for (auto& x : r) x *= factor;
  return r;
}

bool surely_coprime(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return false;
  static constexpr std::uint64_t kPrime = (1u << 31) - 1;
  const auto reduced = [](const Polynomial& f) {
    std::vector<std::uint64_t> r;
    for (const Integer& x : f) {
      const auto m = static_cast<std::int64_t>(Integer(x % kPrime));
      r.push_back(static_cast<std::uint64_t>(m < 0 ? m + static_cast<std::int64_t>(kPrime) : m));
    }
    return r;
  };
  auto a = reduced(p), b = reduced(q);
  if (a.back() == 0 || b.back() == 0) return false;
  while (!b.empty()) {
    while (a.size() >= b.size()) {  // scaled by the leading coefficient of b
      const std::uint64_t lead = b.back(), top = kPrime - a.back();
      const std::size_t shift = a.size() - b.size();
      for (std::size_t i = 0; i < a.size(); ++i)
        a[i] = (a[i] * lead + (i >= shift ? top * b[i - shift] : 0)) % kPrime;
      while (!a.empty() && a.back() == 0) a.pop_back();
    }
    std::swap(a, b);
  }
  return a.size() == 1;
}

Polynomial gcd(Polynomial p, Polynomial q) {
  if (surely_coprime(p, q)) return {Integer(1)};
  p = primitive_part(std::move(p));
  q = primitive_part(std::move(q));
  if (p.size() < q.size()) std::swap(p, q);
  while (!q.empty()) {
    Polynomial r = negative_remainder(std::move(p), q);
    p = std::move(q);
    q = std::move(r);
  }
  if (p.back() < 0)
    for (auto& x : p) x = -x;
  return p;
}

Polynomial squarefree_part(const Polynomial& p) {
  Polynomial primitive = primitive_part(p);
  if (p.size() < 3) return primitive;
  const Polynomial repeated = gcd(primitive, derivative(primitive));
  return repeated.size() == 1 ? primitive : divide_exactly(std::move(primitive), repeated);
}

Polynomial divide_exactly(Polynomial a, const Polynomial& b) {
  Polynomial q(a.size() - b.size() + 1);
  for (std::size_t i = q.size(); i-- > 0;) {
    q[i] = a[i + b.size() - 1] / b.back();
    for (std::size_t j = 0; j < b.size(); ++j) a[i + j] -= q[i] * b[j];
  }
  return q;
}

std::vector<Polynomial> sturm_chain(const Polynomial& p) {
  std::vector<Polynomial> chain{p, derivative(p)};
  while (chain.back().size() > 1) {
    Polynomial next = negative_remainder(chain[chain.size() - 2], chain.back());
    if (next.empty()) break;
    chain.push_back(std::move(next));
  }
  return chain;
}

Integer scaled_value(const Polynomial& p, const Dyadic& x) {
  // sum p_i m^i 2^(k (n - i)), by Horner.
  Integer sum = 0;
  unsigned shift = 0;
  for (auto it = p.rbegin(); it != p.rend(); ++it) {
    sum = sum * x.numerator + (*it << shift);
    shift += x.exponent;
  }
  return sum;
}

int sign_at(const Polynomial& p, const Dyadic& x) { return scaled_value(p, x).sign(); }

int sign_changes_at(const std::vector<Polynomial>& chain, const Dyadic& x) {
  return sign_changes(chain, [&](const Polynomial& p) { return sign_at(p, x); });
}

int sign_changes_at_zero(const std::vector<Polynomial>& chain) {
  return sign_changes(chain, [](const Polynomial& p) { return p.front().sign(); });
}

int sign_changes_at_infinity(const std::vector<Polynomial>& chain) {
  return sign_changes(chain, [](const Polynomial& p) { return p.back().sign(); });
}

RealRoot::RealRoot(Dyadic x) { set(std::move(x)); }

RealRoot::RealRoot(std::shared_ptr<const Polynomial> p, Dyadic lo, Dyadic hi)
    : p_(p && !p->empty() ? std::move(p) : throw InputError("p", "no polynomial", "one with coefficients")),
      lo_(std::move(lo)),
      hi_(std::move(hi)),
      sign_lo_(exact::sign_at(*p_, lo_)) {}

void RealRoot::set(Dyadic x) {
  x = reduced(std::move(x));
  p_ = std::make_shared<const Polynomial>(Polynomial{-x.numerator, Integer(1) << x.exponent});
  lo_ = x;
  hi_ = std::move(x);
  sign_lo_ = 0;
}

int RealRoot::sign() const { return is_dyadic() ? lo_.numerator.sign() : lo_.numerator < 0 ? -1 : 1; }

bool RealRoot::narrow(int bits) const {
  if (is_dyadic()) return true;
  Dyadic lo = lo_, hi = hi_;
  align(lo, hi);
  const Integer least = std::min(abs(lo.numerator), abs(hi.numerator)), width = hi.numerator - lo.numerator;
  return width << static_cast<unsigned>(std::max(bits, 0)) <= least;
}

void RealRoot::refine(int bits) {
  while (!narrow(bits)) {
    Dyadic mid;
    if (log2_cuts_ > 1) {
      // The secant names one of 2^k parts; if the root is there, the next step is twice as bold.
      align(lo_, hi_);
      const auto k = static_cast<unsigned>(log2_cuts_);
      const Integer at_lo = abs(scaled_value(*p_, lo_)), at_hi = abs(scaled_value(*p_, hi_));
      const Integer width = hi_.numerator - lo_.numerator, parts = Integer(1) << k;
      Integer part = (at_lo << k) / (at_lo + at_hi);
      if (part >= parts) part = parts - 1;
      const Dyadic from{(lo_.numerator << k) + part * width, lo_.exponent + k},
          to{from.numerator + width, from.exponent};
      const int sign_from = part == 0 ? sign_lo_ : exact::sign_at(*p_, from),
                sign_to = part == parts - 1 ? -sign_lo_ : exact::sign_at(*p_, to);
      if (sign_from == 0) return set(from);
      if (sign_to == 0) return set(to);
      if (sign_from == sign_lo_ && sign_to != sign_lo_) {
        lo_ = from;
        hi_ = to;
        log2_cuts_ *= 2;
      } else {
        // Which side of the part is known all the same.
        (sign_from == sign_lo_ ? lo_ : hi_) = sign_from == sign_lo_ ? to : from;
        log2_cuts_ /= 2;
      }
      lo_ = reduced(std::move(lo_));
      hi_ = reduced(std::move(hi_));
      continue;
    }
    mid = between(lo_, hi_);
    const int sign_mid = exact::sign_at(*p_, mid);
    if (sign_mid == 0) return set(mid);
    (sign_mid == sign_lo_ ? lo_ : hi_) = std::move(mid);
    if (narrow(2)) log2_cuts_ = 2;
  }
}

std::vector<RealRoot> real_roots(const Polynomial& p) { return roots_on(p, kBoth); }
std::vector<RealRoot> positive_roots(const Polynomial& p) { return roots_on(p, kPositive); }

std::vector<RealRoot> real_roots_in(const Polynomial& p, const Dyadic& lo, const Dyadic& hi) {
  std::vector<RealRoot> roots = real_roots(p);
  std::erase_if(roots, [&](RealRoot& x) { return compare(x, lo) < 0 || compare(x, hi) > 0; });
  return roots;
}

int sign_at(const Polynomial& q, RealRoot& x) {
  if (q.empty()) return 0;
  if (x.is_dyadic()) return sign_at(q, x.lo());
  const auto by_interval = [&](int bits) {
    x.refine(bits);
    return sign_on(q, x.lo(), x.hi());
  };
  // Most signs are decided by the digits; a common factor is looked for where they are not.
  for (const int bits : {8, 64, 160})
    if (const int s = by_interval(bits)) return s;
  if (x.is_dyadic()) return sign_at(q, x.lo());
  const Polynomial common = gcd(x.polynomial(), q);
  if (common.size() > 1 && sign_at(common, x.lo()) != sign_at(common, x.hi())) return 0;
  for (int bits = 320;; bits *= 2)
    if (const int s = by_interval(bits)) return s;
}

int compare(RealRoot& x, const Dyadic& y) {
  if (compare(x.lo_, y) > 0) return 1;
  if (compare(x.hi_, y) < 0) return -1;
  if (x.is_dyadic()) return 0;
  if (compare(x.lo_, y) == 0) return 1;
  if (compare(x.hi_, y) == 0) return -1;
  const int s = sign_at(*x.p_, y);
  if (s == 0) {
    x.set(y);
    return 0;
  }
  (s == x.sign_lo_ ? x.lo_ : x.hi_) = y;
  return s == x.sign_lo_ ? 1 : -1;
}

int compare(RealRoot& x, RealRoot& y) {
  const auto by_interval = [&](int bits) {
    x.refine(bits);
    y.refine(bits);
    if (x.is_dyadic()) return -compare(y, x.lo());
    if (y.is_dyadic()) return compare(x, y.lo());
    // Open intervals: a common end tells them apart.
    return compare(x.hi(), y.lo()) <= 0 ? -1 : compare(y.hi(), x.lo()) <= 0 ? 1 : 0;
  };
  for (const int bits : {0, 8, 64, 160})
    if (const int s = by_interval(bits)) return s;
  if (x.is_dyadic() || y.is_dyadic()) return 0;
  // A common root in both intervals is x and y; it is simple, and no end is a root of the divisor.
  const Polynomial common = gcd(x.polynomial(), y.polynomial());
  if (common.size() > 1) {
    const Dyadic &lo = compare(x.lo(), y.lo()) > 0 ? x.lo() : y.lo(),
                 &hi = compare(x.hi(), y.hi()) < 0 ? x.hi() : y.hi();
    if (sign_at(common, lo) != sign_at(common, hi)) return 0;
  }
  for (int bits = 320;; bits *= 2)
    if (const int s = by_interval(bits)) return s;
}

int multiplicity(RealRoot& x, const Polynomial& q) {
  Polynomial p = q;
  int count = 0;
  while (!p.empty() && sign_at(p, x) == 0) {
    ++count;
    p = derivative(p);
  }
  return count;
}

Interval enclosure(RealRoot& x) {
  x.refine(56);
  return x.is_dyadic() ? enclosure(x.lo()) : hull(enclosure(x.lo()), enclosure(x.hi()));
}

}  // namespace vericone::exact
