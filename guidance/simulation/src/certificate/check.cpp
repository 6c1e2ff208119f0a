// SPDX-License-Identifier: BSD-3-Clause
//
// A form is a list of c_k, which means sum c_k s^(N-k) t^k times a power of two: Bernstein coefficients times
// binomials. Products are convolutions; no negative c_k proves that it is nowhere negative.
#include <vericone/internal/geometry/exact/integer.h>
#include <algorithm>
#include <optional>
#include <utility>

#include "certificate/stated.h"

namespace vericone::simulation::certified {
namespace {

using exact::Integer;
using Coefficients = std::vector<Integer>;

constexpr int kNoGrid = 1 << 20;

struct Form {
  Coefficients c;
  int exponent = 0;  // c is in units of 2^exponent
};

int grid_of(double x) { return exact::grid_exponent(x, kNoGrid); }
int grid_of(const Eigen::Vector3d& x) { return std::min({grid_of(x.x()), grid_of(x.y()), grid_of(x.z())}); }
int some(int grid) { return grid == kNoGrid ? 0 : grid; }

std::int64_t binomial(std::size_t n, std::size_t k) {
  std::int64_t value = 1;
  for (std::size_t i = 0; i < k; ++i)
    value = value * static_cast<std::int64_t>(n - i) / static_cast<std::int64_t>(i + 1);
  return value;
}

Coefficients product(const Coefficients& a, const Coefficients& b) {
  Coefficients r(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) r[i + j] += a[i] * b[j];
  return r;
}

Coefficients raised(const Coefficients& a, std::size_t size) {
  if (a.size() >= size) return a;
  Coefficients by(size - a.size() + 1);
  for (std::size_t k = 0; k < by.size(); ++k) by[k] = binomial(by.size() - 1, k);
  return product(a, by);
}

void add(Coefficients& to, const Coefficients& other, const Integer& factor) {
  const std::size_t size = std::max(to.size(), other.size());
  to = raised(to, size);
  const Coefficients more = raised(other, size);
  for (std::size_t k = 0; k < size; ++k) to[k] += factor * more[k];
}

void add(Form& to, const Form& other, const Integer& factor) {
  const int exponent = std::min(to.exponent, other.exponent);
  if (to.exponent > exponent)
    for (Integer& x : to.c) x <<= static_cast<unsigned>(to.exponent - exponent);
  to.exponent = exponent;
  add(to.c, other.c, factor << static_cast<unsigned>(other.exponent - exponent));
}

bool not_negative(const Coefficients& a) {
  return std::none_of(a.begin(), a.end(), [](const Integer& x) { return x.sign() < 0; });
}
bool positive(const Coefficients& a) {
  return not_negative(a) && a.front().sign() > 0 && a.back().sign() > 0;
}

/// A part of a segment: from start / unit to end / unit.
struct Part {
  Integer start, end, unit;
};

Part part_of(double first, double last, double from, double to) {
  const int grid = std::min({grid_of(first), grid_of(last), grid_of(from), grid_of(to)});
  const Integer zero = exact::on_grid(first, grid);
  Part part{exact::on_grid(from, grid) - zero, exact::on_grid(to, grid) - zero,
            exact::on_grid(last, grid) - zero};
  const Integer common = gcd(gcd(part.start, part.end), part.unit);
  part.start /= common;
  part.end /= common;
  part.unit /= common;
  return part;
}

/// The polynomial of one coordinate on a part, times unit^degree.
Coefficients restricted(const Coefficients& a, const Part& part) {
  const Coefficients s{part.unit - part.start, part.unit - part.end}, t{part.start, part.end};
  Coefficients result, power{1};
  for (const Integer& x : a) {
    result = result.empty() ? Coefficients{0} : product(result, s);
    for (std::size_t k = 0; k < power.size(); ++k) result[k] += x * power[k];
    power = product(power, t);
  }
  return result;
}

template <std::size_t N>
std::array<Coefficients, N> columns_of(const std::vector<std::array<std::int64_t, N>>& list,
                                       const Part& part) {
  std::array<Coefficients, N> columns;
  for (std::size_t i = 0; i < N; ++i) {
    Coefficients column(list.size());
    for (std::size_t k = 0; k < list.size(); ++k)
      column[k] = Integer(list[k][i]) * binomial(list.size() - 1, k);
    columns[i] = restricted(column, part);
  }
  return columns;
}

/// N(q)^T n, and q.q: R = N(q) / q.q.
struct Unturned {
  std::array<Coefficients, 3> normal;
  Coefficients square;
};

Unturned unturned(const std::array<Coefficients, 4>& q, const std::array<std::int64_t, 3>& n) {
  std::array<std::array<Coefficients, 4>, 4> p;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i; j < 4; ++j) p[i][j] = product(q[i], q[j]);
  const auto sum = [](std::initializer_list<std::pair<const Coefficients*, std::int64_t>> terms) {
    Coefficients total(terms.begin()->first->size());
    for (const auto& [form, factor] : terms)
      for (std::size_t k = 0; k < total.size(); ++k) total[k] += factor * (*form)[k];
    return total;
  };
  const Coefficients *ww = &p[0][0], *xx = &p[1][1], *yy = &p[2][2], *zz = &p[3][3], *wx = &p[0][1],
                     *wy = &p[0][2], *wz = &p[0][3], *xy = &p[1][2], *xz = &p[1][3], *yz = &p[2][3];
  const auto [a, b, c] = n;
  return {{sum({{ww, a}, {xx, a}, {yy, -a}, {zz, -a}, {xy, 2 * b}, {wz, 2 * b}, {xz, 2 * c}, {wy, -2 * c}}),
           sum({{xy, 2 * a}, {wz, -2 * a}, {ww, b}, {xx, -b}, {yy, b}, {zz, -b}, {yz, 2 * c}, {wx, 2 * c}}),
           sum({{xz, 2 * a}, {wy, 2 * a}, {yz, 2 * b}, {wx, -2 * b}, {ww, c}, {xx, -c}, {yy, -c}, {zz, c}})},
          sum({{ww, 1}, {xx, 1}, {yy, 1}, {zz, 1}})};
}

Form linear(const std::array<double, 2>& limit) {
  Form form{{}, some(std::min(grid_of(limit[0]), grid_of(limit[1])))};
  for (const double x : limit) form.c.push_back(exact::on_grid(x, form.exponent));
  return form;
}

/// n'.S n', n' the normal seen from the body.
Form square(const Unturned& seen, const Eigen::Matrix3d& matrix, bool factor) {
  int grid = kNoGrid;
  for (int i = 0; i < 9; ++i) grid = std::min(grid, grid_of(matrix(i / 3, i % 3)));
  grid = some(grid);
  Form sum{{0}, 0};
  const auto on = [&](int i, int j) { return exact::on_grid(matrix(i, j), grid); };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) {
      Integer s = factor ? on(i, 0) * on(j, 0) + on(i, 1) * on(j, 1) + on(i, 2) * on(j, 2) : on(i, j);
      if (s.is_zero()) continue;
      if (i != j) s *= 2;
      add(sum, {product(seen.normal[i], seen.normal[j]), factor ? 2 * grid : grid}, s);
    }
  return sum;
}

Form product(const Form& a, const Form& b) { return {product(a.c, b.c), a.exponent + b.exponent}; }

/// r is nowhere below sqrt(q1) + sqrt(q2), nor negative.
bool covers(const Form& r, const std::vector<Form>& squares) {
  if (!not_negative(r.c)) return false;
  Form rest = product(r, r);
  for (const Form& q : squares) add(rest, q, -1);
  if (!squares.empty() && !not_negative(rest.c)) return false;
  if (squares.size() < 2) return true;
  rest = product(rest, rest);
  add(rest, product(squares[0], squares[1]), -4);
  return not_negative(rest.c);
}

bool covers(const Form& r, const Unturned& seen, const Ellipsoid& body) {
  const bool factor = body.defined_by_factor();
  return covers(r, {square(seen, factor ? body.factor() : body.shape(), factor)});
}

/// l q.q less the largest of n'.x over these points, coefficient by coefficient.
Form less_points(const Form& limit, const Unturned& seen, const std::vector<Eigen::Vector3d>& points) {
  int grid = kNoGrid;
  for (const Eigen::Vector3d& x : points) grid = std::min(grid, grid_of(x));
  if (grid == kNoGrid) return limit;
  Form r = limit;
  const int exponent = std::min(r.exponent, grid);
  for (Integer& x : r.c) x <<= static_cast<unsigned>(r.exponent - exponent);
  r.exponent = exponent;
  std::array<Coefficients, 3> normal;
  for (int i = 0; i < 3; ++i) normal[i] = raised(seen.normal[i], r.c.size());
  std::vector<exact::IntegerVector<3>> on;
  for (const Eigen::Vector3d& x : points)
    on.push_back({exact::on_grid(x.x(), grid), exact::on_grid(x.y(), grid), exact::on_grid(x.z(), grid)});
  for (std::size_t k = 0; k < r.c.size(); ++k) {
    std::optional<Integer> most;
    for (const auto& x : on) {
      const Integer value = normal[0][k] * x[0] + normal[1][k] * x[1] + normal[2][k] * x[2];
      if (!most || value > *most) most = value;
    }
    r.c[k] -= *most << static_cast<unsigned>(grid - exponent);
  }
  return r;
}

using IntegerMatrix = std::array<std::array<Integer, 3>, 3>;

/// Whole numbers in units of 2^exponent.
struct OnGrid {
  IntegerMatrix m;
  int exponent;
};

OnGrid on_grid(const Eigen::Matrix3d& matrix) {
  int grid = kNoGrid;
  for (int i = 0; i < 9; ++i) grid = std::min(grid, grid_of(matrix(i / 3, i % 3)));
  OnGrid found{{}, some(grid)};
  for (int i = 0; i < 9; ++i) found.m[i / 3][i % 3] = exact::on_grid(matrix(i / 3, i % 3), found.exponent);
  return found;
}

IntegerMatrix adjugate(const IntegerMatrix& m) {
  IntegerMatrix found;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      found[i][j] = m[(j + 1) % 3][(i + 1) % 3] * m[(j + 2) % 3][(i + 2) % 3] -
                    m[(j + 1) % 3][(i + 2) % 3] * m[(j + 2) % 3][(i + 1) % 3];
  return found;
}

Integer inner(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

OnGrid shape_of(const Ellipsoid& body) {
  if (!body.defined_by_factor()) return on_grid(body.shape());
  const OnGrid f = on_grid(body.factor());
  OnGrid s{{}, 2 * f.exponent};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) s.m[i][j] = inner(f.m[i], f.m[j]);
  return s;
}

/// D Q and D L, D > 0, of the sum of the body's forms with these multipliers: y.Q y <= L for its points y
/// about its center.
struct Weighted {
  OnGrid q;
  Integer level;
  int level_exponent;
};

void rescale(Integer& x, int from, int to) { x <<= static_cast<unsigned>(from - to); }

std::optional<Weighted> weighted(const CombinedEllipsoid& body, const std::vector<double>& multipliers) {
  const auto& delimiters = body.delimiters();
  if (multipliers.size() != delimiters.size() + 1) return std::nullopt;
  if (std::any_of(multipliers.begin(), multipliers.end(), [](double x) { return !(x >= 0); }))
    return std::nullopt;
  const OnGrid s = shape_of(body.ellipsoid());
  const IntegerMatrix adjoint = adjugate(s.m);
  const Integer determinant = inner(s.m[0], {adjoint[0][0], adjoint[1][0], adjoint[2][0]});
  if (determinant.sign() <= 0) return std::nullopt;
  int units = kNoGrid, q_exponent = -s.exponent, level_exponent = 0;
  for (const double x : multipliers) units = std::min(units, grid_of(x));
  units = some(units);
  for (const auto& one : delimiters) {
    q_exponent = std::min(q_exponent, on_grid(one.matrix).exponent);
    level_exponent = std::min(level_exponent, some(grid_of(one.level)));
  }
  Weighted sum{{{}, q_exponent + units}, {}, level_exponent + units};
  const auto add = [&](const OnGrid& form, const Integer& scale, const Integer& level, double multiplier) {
    const Integer factor = exact::on_grid(multiplier, units);
    for (std::size_t i = 0; i < 9; ++i) {
      Integer x = factor * scale * form.m[i / 3][i % 3];
      rescale(x, form.exponent, q_exponent);
      sum.q.m[i / 3][i % 3] += x;
    }
    sum.level += factor * determinant * level;
  };
  add({adjoint, -s.exponent}, 1, Integer(1) << static_cast<unsigned>(-level_exponent), multipliers[0]);
  for (std::size_t k = 0; k < delimiters.size(); ++k)
    add(on_grid(delimiters[k].matrix), determinant, exact::on_grid(delimiters[k].level, level_exponent),
        multipliers[k + 1]);
  return sum;
}

/// [[Q, m], [m, r^2 / L]] is positive definite everywhere, m the normal seen from the body: of each k the
/// matrix of the c_k is.
bool definite(const Form& r, const Unturned& seen, const CombinedEllipsoid& body,
              const std::vector<double>& multipliers) {
  const std::optional<Weighted> sum = weighted(body, multipliers);
  if (!sum || sum->level.sign() <= 0) return false;
  const IntegerMatrix adjoint = adjugate(sum->q.m);
  const auto& q = sum->q.m;
  const Integer determinant = inner(q[0], {adjoint[0][0], adjoint[1][0], adjoint[2][0]});
  if (q[0][0].sign() <= 0 || adjoint[2][2].sign() <= 0 || determinant.sign() <= 0) return false;
  const Coefficients square = product(r.c, r.c);
  std::array<Coefficients, 3> normal;
  for (std::size_t i = 0; i < 3; ++i) normal[i] = raised(seen.normal[i], square.size());
  // D cancels: (r^2)_k C(N,k) / L > m_k . Q^-1 m_k with D Q and D L in their places.
  const int shift = 2 * r.exponent + sum->q.exponent - sum->level_exponent;
  for (std::size_t k = 0; k < square.size(); ++k) {
    const std::array<Integer, 3> m{normal[0][k], normal[1][k], normal[2][k]};
    Integer left = square[k] * binomial(square.size() - 1, k) * determinant;
    Integer right =
        (m[0] * inner(adjoint[0], m) + m[1] * inner(adjoint[1], m) + m[2] * inner(adjoint[2], m)) *
        sum->level;
    if (shift > 0) rescale(left, shift, 0);
    if (shift < 0) rescale(right, -shift, 0);
    if (!(left > right)) return false;
  }
  return true;
}

std::vector<Eigen::Vector3d> corners_of(const Side& side) {
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t piece : *side.group)
    numbers.insert(numbers.end(), side.solid->pieces[piece].begin(), side.solid->pieces[piece].end());
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<Eigen::Vector3d> corners;
  for (const std::uint32_t i : numbers) corners.push_back(side.solid->points[i]);
  return corners;
}

/// Of each part of a piece.
bool covers(const Form& limit, const Unturned& seen, const vericone::Convex& body) {
  const auto squares_of = [&](const vericone::Convex::Piece& part) {
    std::vector<Form> squares;
    if (part.rank > 0) squares.push_back(square(seen, part.shape.value_or(part.factor), !part.shape));
    if (body.margin() > 0) squares.push_back(square(seen, body.margin() * Eigen::Matrix3d::Identity(), true));
    return squares;
  };
  return std::all_of(body.pieces().begin(), body.pieces().end(), [&](const auto& part) {
    return covers(less_points(limit, seen, {part.center}), squares_of(part));
  });
}

/// n.R b <= limit for the points b of the pieces, R the rotation of q.
bool bounds(const Side& side, const std::array<Coefficients, 4>& q, const std::array<std::int64_t, 3>& n,
            const Form& most, const std::vector<double>& multipliers) {
  const Unturned seen = unturned(q, n);
  if (!positive(seen.square)) return false;
  const Form limit{product(most.c, seen.square), most.exponent};
  const Solid& solid = *side.solid;
  if (solid.rounds.empty() && !multipliers.empty()) return false;
  if (solid.cornered()) {
    std::vector<Form> squares;
    if (solid.radius > 0) squares.push_back(square(seen, solid.radius * Eigen::Matrix3d::Identity(), true));
    return covers(less_points(limit, seen, corners_of(side)), squares);
  }
  if (!solid.convexes.empty())
    return std::all_of(side.group->begin(), side.group->end(),
                       [&](std::uint32_t piece) { return covers(limit, seen, solid.convexes[piece]); });
  return std::all_of(side.group->begin(), side.group->end(), [&](std::uint32_t piece) {
    const Ellipsoid& body = solid.rounds[piece].ellipsoid();
    const Form r = less_points(limit, seen, {body.center()});
    if (!multipliers.empty())
      return side.group->size() == 1 && not_negative(r.c) &&
             definite(r, seen, solid.rounds[piece], multipliers);
    return covers(r, seen, body);
  });
}

/// A body's position, times `scale`, and a multiple of its quaternion.
struct Moved {
  std::array<Form, 3> position;
  Integer scale = 1;
  std::array<Coefficients, 4> turn;
};

std::optional<Moved> motion_of(const StatedTrack& track, double from, double to) {
  const std::size_t k = track.segment_of(from, to);
  if (k == track.segments.size()) return std::nullopt;
  const Part part = part_of(track.times[k], track.times[k + 1], from, to);
  const Segment& segment = track.segments[k];
  Moved motion;
  std::array<Coefficients, 3> columns = columns_of(segment.position, part);
  for (std::size_t i = 0; i < 3; ++i) motion.position[i] = {std::move(columns[i]), -track.grid};
  for (std::size_t i = 1; i < segment.position.size(); ++i) motion.scale *= part.unit;
  if (track.turned)
    motion.turn = columns_of(segment.turn, part);
  else
    motion.turn = {Coefficients{1}, {0}, {0}, {0}};
  return motion;
}

Form constant(double x) {
  const int grid = some(grid_of(x));
  return {{exact::on_grid(x, grid)}, grid};
}

}  // namespace

Box Solid::bounds(std::uint32_t piece) const {
  if (!boxes.empty()) return boxes[piece];
  if (!convexes.empty()) return convexes[piece].bounds();
  if (!rounds.empty()) {
    const Ellipsoid& body = rounds[piece].ellipsoid();
    const Eigen::Vector3d half = body.shape().diagonal().cwiseSqrt();
    return {body.center() - half, body.center() + half};
  }
  Box box{points[pieces[piece].front()], points[pieces[piece].front()]};
  for (const std::uint32_t i : pieces[piece]) box.include({points[i], points[i]});
  const Eigen::Vector3d about = Eigen::Vector3d::Constant(radius);
  return {box.low - about, box.high + about};
}

bool Solid::is_ball() const {
  if (rounds.size() != 1 || !rounds.front().is_ellipsoid()) return false;
  const Ellipsoid& body = rounds.front().ellipsoid();
  const Eigen::Matrix3d& m = body.defined_by_factor() ? body.factor() : body.shape();
  return body.center().isZero(0) && m == m(0, 0) * Eigen::Matrix3d::Identity();
}

std::size_t StatedTrack::segment_of(double from, double to) const {
  for (std::size_t k = 0; k < segments.size(); ++k)
    if (times[k] <= from && to <= times[k + 1] && times[k + 1] > from) return k;
  return segments.size();
}

bool separates(const Side& a, const Side& b, double by, double from, double to, const StatedPlane& plane) {
  const auto [x, y, z] = plane.normal;
  const Integer length = plane.length;
  if (plane.length < 0 || length * length < Integer(x) * x + Integer(y) * y + Integer(z) * z) return false;
  if (a.group->empty() || b.group->empty() || !(by >= 0)) return false;
  const std::optional<Moved> of_a = motion_of(*a.track, from, to), of_b = motion_of(*b.track, from, to);
  if (!of_a || !of_b || !(from < to)) return false;
  const Form most_a = linear(plane.most_a), most_b = linear(plane.most_b);
  const Integer scale = of_a->scale * of_b->scale;
  Form gap{{0}, 0};
  for (const double distance : {by, a.track->radius, b.track->radius})
    add(gap, constant(distance), -scale * length);
  add(gap, most_a, -scale);
  add(gap, most_b, -scale);
  for (std::size_t i = 0; i < 3; ++i) {
    add(gap, of_a->position[i], -of_b->scale * plane.normal[i]);
    add(gap, of_b->position[i], of_a->scale * plane.normal[i]);
  }
  return positive(gap.c) && bounds(a, of_a->turn, plane.normal, most_a, plane.multipliers[0]) &&
         bounds(b, of_b->turn, {-x, -y, -z}, most_b, plane.multipliers[1]);
}

bool proves(const Side& a, const Side& b, double by, double from, double to, const StatedPieces& pieces) {
  if (pieces.planes.empty() || pieces.times.size() != pieces.planes.size() + 1) return false;
  if (pieces.times.front() != from || pieces.times.back() != to) return false;
  for (std::size_t k = 0; k < pieces.planes.size(); ++k)
    if (!separates(a, b, by, pieces.times[k], pieces.times[k + 1], pieces.planes[k])) return false;
  return true;
}

}  // namespace vericone::simulation::certified
