// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/combined/sweep.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::verify {
namespace {

using Eigen::Vector3d;
using Body = CombinedSweep::Body;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Points are taken this much inside, so that rounding cannot make a contact of none.
constexpr double kInside = 1 - 1e-9;

/// Even points of the unit sphere (Fibonacci's spiral).
std::vector<Vector3d> spiral(int count) {
  std::vector<Vector3d> all;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
    const double angle = 2 * std::numbers::pi * (2 - std::numbers::phi) * i;
    all.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return all;
}

Body body_of(const CombinedEllipsoid& body, const std::vector<Vector3d>& directions) {
  Body r;
  r.center = body.center();
  r.factor = body.ellipsoid().factor();
  const Eigen::Matrix3d inverse = r.factor.inverse();
  r.regions.push_back({inverse.transpose() * inverse, 1});
  for (const Delimiter<3>& d : body.delimiters()) {
    r.regions.push_back({d.matrix, d.level});
    // A cone is not made narrower by taking its points further inside; this does.
    if (d.level == 0) r.regions.back().m += 1e-9 * d.matrix.norm() * Eigen::Matrix3d::Identity();
  }
  for (const Vector3d& u : directions) r.boundary.push_back(r.boundary_point(u));
  return r;
}

struct Span {
  double from, to;
};

/// Times t >= 0 at which y + t d is in the body, in order; at most eight spans are kept.
struct Spans {
  std::array<Span, 8> all{Span{0, kInfinity}};
  int count = 1;

  void cut(const CombinedSweep::Region& r, const Vector3d& y, const Vector3d& d) {
    const Vector3d md = r.m * d;
    const double a = d.dot(md), b = y.dot(md), c = y.dot(r.m * y) - r.level;
    const double discriminant = b * b - a * c;
    if (a > 0) {
      if (!(discriminant > 0)) {
        count = 0;
        return;
      }
      const double root = std::sqrt(discriminant);
      keep(Span{(-b - root) / a, (-b + root) / a});
    } else if (a < 0 && discriminant > 0) {
      const double root = std::sqrt(discriminant);
      const Spans before = *this;
      keep(Span{-kInfinity, (b - root) / -a});
      Spans after = before;
      after.keep(Span{(b + root) / -a, kInfinity});
      for (int i = 0; i < after.count && count < 8; ++i) all[count++] = after.all[i];
    }
  }

 private:
  void keep(const Span& span) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      const Span s{std::max(all[i].from, span.from), std::min(all[i].to, span.to)};
      if (s.from < s.to) all[kept++] = s;
    }
    count = kept;
  }
};

/// A time just after the first at which y + t d is well inside.
std::optional<double> entry(const Body& body, const Vector3d& y, const Vector3d& d) {
  Spans spans;
  for (const CombinedSweep::Region& r : body.regions) {
    spans.cut(r, y, d);
    if (spans.count == 0) return {};
  }
  for (int i = 0; i < spans.count; ++i) {
    const Span& s = spans.all[i];
    for (const double part : {1e-6, 0.5}) {
      const double t = s.from + part * (s.to - s.from);
      if (body.gauge_squared(y + t * d) < kInside) return t;
    }
  }
  return {};
}

/// Keeps the best few of many starting points.
struct Start {
  double value;
  int direction;
  double t;
};

/// Improvement by random steps in the ball, of a length that grows with success; a fixed generator, so that
/// answers are repeated.
class Steps {
 public:
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
  }

 private:
  std::uint64_t state_ = 88172645463325252u;
};

}  // namespace

double Body::gauge_squared(const Vector3d& y) const {
  double most = 0;
  for (const Region& r : regions) {
    const double value = y.dot(r.m * y);
    if (value > 0) most = std::max(most, r.level > 0 ? value / r.level : kInfinity);
  }
  return most;
}

Vector3d Body::boundary_point(const Vector3d& u) const {
  const Vector3d y = factor * u;
  return y * (std::sqrt(kInside / gauge_squared(y)));
}

CombinedSweep::CombinedSweep(const CombinedEllipsoid& a, const CombinedEllipsoid& b, int samples)
    : directions_(spiral(samples)) {
  a_ = body_of(a, directions_);
  b_ = body_of(b, directions_);
}

std::optional<SweepHit> CombinedSweep::first(const Vector3d& w) const {
  std::optional<SweepHit> best;
  const auto take = [&](const Vector3d& x, double t) {
    if (!best || t < best->t) best = SweepHit{a_.center + x, t};
  };
  const Vector3d c = b_.center - a_.center;
  for (const Vector3d& x : a_.boundary)
    if (const auto t = entry(b_, x - c, w)) take(x, *t);
  for (const Vector3d& x : b_.boundary)
    if (const auto t = entry(a_, x + c, -w)) take(x + c - *t * w, *t);
  return best;
}

std::optional<SweepHit> CombinedSweep::search(const Vector3d& w) const {
  const Vector3d c = b_.center - a_.center;
  const Region& e = b_.regions.front();
  const Vector3d mw = e.m * w;
  const double speed2 = w.dot(mw);
  std::vector<Start> starts;
  for (std::size_t i = 0; i < a_.boundary.size(); ++i) {
    const Vector3d y = a_.boundary[i] - c;
    const double middle = -y.dot(mw) / speed2;
    for (const double off : {0.0, -0.6, 0.6}) {
      const double t = middle + off / std::sqrt(speed2);
      if (t >= 0) starts.push_back({b_.gauge_squared(y + t * w), static_cast<int>(i), t});
    }
  }
  // More samples, more starts and longer: for contacts that nearly graze.
  const std::size_t kept = std::min(8 + a_.boundary.size() / 200, starts.size());
  const int most = 250 + static_cast<int>(a_.boundary.size() / 20);
  std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(kept), starts.end(),
                    [](const Start& x, const Start& y) { return x.value < y.value; });
  Steps random;
  for (std::size_t k = 0; k < kept; ++k) {
    Vector3d u = directions_[starts[k].direction];
    double t = starts[k].t, value = starts[k].value;
    Vector3d x = a_.boundary_point(u);
    double step = 0.1;
    for (int i = 0; i < most && step > 1e-9; ++i) {
      if (value < kInside) return SweepHit{a_.center + x, t};
      Vector3d v = u;
      for (int j = 0; j < 3; ++j) v(j) += step * random.next();
      v.normalize();
      const double s = std::max(0.0, t + step * random.next() / std::sqrt(speed2));
      const Vector3d y = a_.boundary_point(v);
      const double found = b_.gauge_squared(y + s * w - c);
      if (found < value) {
        u = v, t = s, value = found, x = y;
        step *= 1.5;
      } else {
        step *= 0.9;
      }
    }
  }
  return {};
}

std::optional<SweepHit> CombinedSweep::earliest(const Vector3d& w) const {
  std::optional<SweepHit> best = first(w);
  if (!best) return best;
  const Vector3d c = b_.center - a_.center;
  const Eigen::Matrix3d inverse = a_.factor.inverse();
  Vector3d u = (inverse * (best->x - a_.center)).normalized();
  Steps random;
  double step = 0.1;
  for (int i = 0; i < 400 && step > 1e-9; ++i) {
    Vector3d v = u;
    for (int j = 0; j < 3; ++j) v(j) += step * random.next();
    v.normalize();
    const Vector3d x = a_.boundary_point(v);
    const auto t = entry(b_, x - c, w);
    if (t && *t < best->t) {
      u = v;
      best = SweepHit{a_.center + x, *t};
      step *= 1.5;
    } else {
      step *= 0.93;
    }
  }
  return best;
}

std::optional<SweepHit> CombinedSweep::march(const Vector3d& w, double duration, int steps) const {
  const Vector3d c = b_.center - a_.center;
  for (int i = 0; i <= steps; ++i) {
    const double t = duration * i / steps;
    for (const Vector3d& x : a_.boundary)
      if (b_.gauge_squared(x + t * w - c) < kInside) return SweepHit{a_.center + x, t};
    for (const Vector3d& x : b_.boundary)
      if (a_.gauge_squared(x + c - t * w) < kInside) return SweepHit{a_.center + x + c - t * w, t};
  }
  return {};
}

}  // namespace vericone::verify
