// SPDX-License-Identifier: GPL-3.0-or-later
//
// B is connected, so if A's boundary has no point of B, then B lies inside A or apart from it, which B's
// centre tells. The boundary is covered by curves of one parameter, each subdivided until every piece is
// proved to be off A (another conic of A) or off B, or a point of both is found:
//
//   x(t) = +-r(t) u(t),  u = (1, t) or (t, 1),  r = sqrt(level / C(u)):  a conic C of A about its centre,
//   x(t) = t u,  u a root of C:                                          its lines, where the level is 0.
#include "planar/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone::verify::planar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxPieces = 200'000;
constexpr double kShortest = 0x1p-50;

struct Curve {
  int conic;
  bool line;
  bool x_first;  // u = (1, t)
  double sign;
  Point<Interval> u;  // of a line
};

Interval middle_of(const Interval& t) { return Interval(0.5 * (t.inf() + t.sup())); }

class Separation {
 public:
  Separation(const std::vector<Conic<Interval>>& a, const std::vector<Conic<Interval>>& b,
             const Point<Interval>& c)
      : a_(a), b_(b), c_(c) {}

  std::optional<bool> answer() {
    if (inside(a_, c_) == Answer::yes || inside(b_, {-c_.x, -c_.y}) == Answer::yes) return false;
    if (inside(a_, c_) == Answer::unknown) return std::nullopt;
    for (const Curve& curve : curves()) {
      const double end = curve.line ? reach_ : 1;
      const Answer free = clear(curve, Interval(-end, end));
      if (common_) return false;
      if (free != Answer::yes) return std::nullopt;
    }
    return true;
  }

 private:
  static Answer inside(const std::vector<Conic<Interval>>& body, const Point<Interval>& p) {
    Answer answer = Answer::yes;
    for (const auto& conic : body) answer = both(answer, not_positive(conic.square(p) - conic.level));
    return answer;
  }

  std::vector<Curve> curves() {
    std::vector<Curve> all;
    for (int i = 0; i < static_cast<int>(a_.size()); ++i) {
      const auto& conic = a_[i];
      if (conic.level.sup() > 0) {
        for (const bool x_first : {true, false})
          for (const double sign : {1.0, -1.0}) all.push_back({i, false, x_first, sign, {}});
        continue;
      }
      const Interval discriminant = conic.xy * conic.xy - conic.xx * conic.yy;
      if (discriminant.sup() <= 0) continue;
      const Interval s = root(discriminant);
      const Interval q = looks_negative(conic.xy) ? s - conic.xy : -s - conic.xy;
      for (const Point<Interval>& u : {Point<Interval>{q, conic.xx}, Point<Interval>{conic.yy, q}}) {
        const double size = std::max(CGAL::abs(u.x).sup(), CGAL::abs(u.y).sup());
        const Point<Interval> unit{u.x / Interval(size), u.y / Interval(size)};
        all.push_back({i, true, true, 1, unit});
        // As far as the ellipse, generously.
        reach_ = std::max(reach_, 2 * root(Interval(a_[0].level / a_[0].square(unit))).sup());
      }
    }
    return all;
  }

  /// The points of a piece that can be on A at all, and whether there are any.
  bool place(const Curve& curve, const Interval& t, Point<Interval>& x, Point<Interval>& slope,
             bool& smooth) const {
    smooth = true;
    if (curve.line) {
      x = {t * curve.u.x, t * curve.u.y};
      slope = curve.u;
    } else {
      const Point<Interval> u = curve.x_first ? Point<Interval>{1, t} : Point<Interval>{t, 1};
      const Point<Interval> turn = curve.x_first ? Point<Interval>{0, 1} : Point<Interval>{1, 0};
      const auto& conic = a_[curve.conic];
      const Interval value = conic.square(u);
      if (value.sup() <= 0) return false;
      const double most = root(Interval(a_[0].level / a_[0].square(u))).sup();
      const Interval lo_part = root(Interval(conic.level / Interval(value.sup())));
      const double least = lo_part.inf();
      if (least > most) return false;
      // The mean value theorem below wants the whole piece of the curve, also what is off the ellipse.
      const double largest =
          value.inf() > 0 ? root(Interval(conic.level / Interval(value.inf()))).sup() : kInfinity;
      const Interval r = Interval(curve.sign) * Interval(least, std::max(least, std::min(most, largest)));
      x = {r * u.x, r * u.y};
      smooth = largest <= most;
      if (smooth) {
        const Interval change = -r * conic.form(u, turn) / value;
        slope = {change * u.x + r * turn.x, change * u.y + r * turn.y};
      }
    }
    for (int k = 0; k < static_cast<int>(a_.size()); ++k)
      if (k != curve.conic && positive(a_[k].square(x) - a_[k].level) == Answer::yes) return false;
    return true;
  }

  /// Yes: no point of the piece is on both bodies.
  Answer clear(const Curve& curve, const Interval& t) {
    if (++pieces_ > kMaxPieces) return Answer::unknown;
    Point<Interval> x, slope, at_middle, unused;
    bool smooth = false, ignored = false;
    if (!place(curve, t, x, slope, smooth)) return Answer::yes;
    const Interval middle = middle_of(t);
    const bool middle_on_curve = place(curve, middle, at_middle, unused, ignored);
    const Point<Interval> y{x.x - c_.x, x.y - c_.y};
    for (const auto& conic : b_) {
      if (positive(conic.square(y) - conic.level) == Answer::yes) return Answer::yes;
      if (!smooth || !middle_on_curve) continue;
      const Point<Interval> z{at_middle.x - c_.x, at_middle.y - c_.y};
      const Interval mean_value =
          conic.square(z) - conic.level + Interval(2) * conic.form(y, slope) * (t - middle);
      if (positive(mean_value) == Answer::yes) return Answer::yes;
    }
    if (middle_on_curve && look_at(at_middle)) {
      common_ = true;
      return Answer::no;
    }
    const double m = middle.inf();
    if (t.sup() - t.inf() < kShortest * std::max(1.0, std::abs(m))) return Answer::unknown;
    const Answer first = clear(curve, Interval(t.inf(), m));
    if (first != Answer::yes) return first;
    return clear(curve, Interval(m, t.sup()));
  }

  /// A point near this one, moved inwards or, for the lines of level 0, aside, that is certainly of both
  /// bodies.
  bool look_at(const Point<Interval>& p) const {
    const double px = 0.5 * (p.x.inf() + p.x.sup()), py = 0.5 * (p.y.inf() + p.y.sup());
    for (const double shrink : {1e-14, 1e-9, 1e-4})
      for (const double aside : {0.0, 1e-12, -1e-12, 1e-7, -1e-7}) {
        const Point<Interval> x{Interval((1 - shrink) * px - aside * py),
                                Interval((1 - shrink) * py + aside * px)};
        if (inside(a_, x) == Answer::yes && inside(b_, {x.x - c_.x, x.y - c_.y}) == Answer::yes) return true;
      }
    return false;
  }

  const std::vector<Conic<Interval>>&a_, &b_;
  Point<Interval> c_;
  double reach_ = 0;
  int pieces_ = 0;
  bool common_ = false;
};

}  // namespace

std::optional<bool> separated(const std::vector<Conic<Interval>>& a, const std::vector<Conic<Interval>>& b,
                              const Point<Interval>& c) {
  return Separation(a, b, c).answer();
}

}  // namespace vericone::verify::planar
