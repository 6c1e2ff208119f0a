// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/assembly/families.h>
#include <vericone/internal/verify/seeded_random.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace vericone::verify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using V = AssemblyVariation;

/// Sums of two squares that are squares: (y, z) at the distance m.
constexpr int kTriples[][3] = {{5, 0, 5}, {0, 5, 5}, {3, 4, 5}, {4, -3, 5}, {-5, 12, 13}, {8, 15, 17}};

/// Integers with N^T N = L^2: a rotation times L, from a quaternion of small integers.
struct Frame {
  Matrix3d n = Matrix3d::Identity();
  double length = 1;
};

Frame integer_frame(SeededRandom& random) {
  int q[4];
  double squared = 0;
  do {
    squared = 0;
    for (int& x : q) {
      x = random.integer(-2, 2);
      squared += x * x;
    }
  } while (squared == 0);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Frame f;
  f.length = squared;
  f.n << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),     //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return f;
}

/// Axes exchanged and mirrored: boxes stay boxes.
Frame permuted_axes(SeededRandom& random) {
  Frame f;
  const int first = random.integer(0, 2);
  f.n.setZero();
  for (int i = 0; i < 3; ++i) f.n((first + i) % 3, i) = random.coin() ? 1 : -1;
  return f;
}

class Maker {
 public:
  Maker(AgentKind agent, PieceKind kind, std::uint64_t seed, std::uint64_t index)
      : agent_(agent),
        random_(910 + 10 * static_cast<std::uint32_t>(agent) + static_cast<std::uint32_t>(kind), seed,
                index) {
    case_.kind = kind;
    case_.variation = static_cast<V>(index % kAssemblyVariations);
    whole_ = case_.variation == V::tangent || case_.variation == V::near || case_.variation == V::touching ||
             case_.variation == V::shared;
    // Tangency of an ellipsoid and a ball is not to be had in integers.
    if (agent == AgentKind::ellipsoid && kind == PieceKind::ball) whole_ = false;
    place_ = static_cast<int>(index / kAssemblyVariations % 3);
  }

  AssemblyCase make() {
    if (whole_) {
      whole_case();
    } else {
      random_case();
    }
    if (case_.variation == V::near) disturb();
    return case_;
  }

 private:
  // Where everything is put in the end.
  Vector3d place(const Vector3d& x) const {
    if (place_ == 1) return x + Vector3d(3'000'017, -1'000'003, 2'000'029);
    return place_ == 2 ? Vector3d(0x1p-20 * x) : x;
  }
  double scale() const { return place_ == 2 ? 0x1p-20 : 1; }
  double ulps(double x) {
    const int n = random_.integer(-3, 3);
    for (int i = 0; i < std::abs(n); ++i) x = std::nextafter(x, n > 0 ? INFINITY : -INFINITY);
    return x;
  }

  void add(const std::vector<Vector3d>& corners) {
    std::vector<Vector3d> placed;
    for (const Vector3d& x : corners) placed.push_back(place(x));
    switch (case_.kind) {
      case PieceKind::triangle:
        for (std::size_t i = 0; i + 2 < placed.size() || i == 0; ++i) {
          const auto at = static_cast<std::uint32_t>(case_.points.size());
          for (std::size_t k : {std::size_t{0}, i + 1, i + 2})
            case_.points.push_back(placed[std::min(k, placed.size() - 1)]);
          case_.triangles.push_back({at, at + 1, at + 2});
        }
        break;
      case PieceKind::ball:
        case_.points.push_back(placed.front());
        break;
      case PieceKind::box: {
        Box box{placed.front(), placed.front()};
        for (const Vector3d& x : placed) box.include({x, x});
        case_.boxes.push_back(box);
        break;
      }
      case PieceKind::hull:
        case_.hulls.emplace_back(placed);
        break;
      case PieceKind::convex:  // has a truth of its own
        break;
    }
  }

  void random_case() {
    const V v = case_.variation;
    Vector3d axes;
    for (int i = 0; i < 3; ++i) axes(i) = random_.uniform(0.3, 1.5);
    if (v == V::thin) axes = Vector3d(1.5, random_.uniform(1e-2, 1), 1.5e-4);
    const Matrix3d turn = random_.rotation();
    if (agent_ == AgentKind::ball) {
      case_.agent = Ellipsoid::from_axes(place(Vector3d::Zero()), Vector3d::Constant(scale() * axes(0)));
    } else if (agent_ == AgentKind::ellipsoid) {
      const auto e = Ellipsoid::from_axes(place(Vector3d::Zero()), scale() * axes, turn);
      case_.agent = random_.coin() || v == V::thin ? e : Ellipsoid::from_shape(e.center(), e.shape());
    } else {
      std::vector<Vector3d> corners;
      const int count = v == V::degenerate ? random_.integer(1, 3) : random_.integer(4, 10);
      for (int i = 0; i < count; ++i)
        corners.push_back(place(turn * axes.cwiseProduct(random_.direction<3>())));
      case_.agent = HullBody(corners);
    }
    case_.radius = case_.kind == PieceKind::ball ? scale() * random_.uniform(0, 0.5) : 0;
    if (v == V::degenerate) case_.radius = 0;
    const int count = v == V::enclosing ? 60 : random_.integer(1, 25);
    for (int i = 0; i < count; ++i) {
      const double away = v == V::enclosing ? 4 : random_.uniform(2, 12);
      const Vector3d center = away * random_.direction<3>();
      const double size = v == V::enclosing ? 3 : random_.uniform(0.1, 2);
      std::vector<Vector3d> corners;
      const int n = case_.kind == PieceKind::hull ? random_.integer(4, 9) : 3;
      for (int k = 0; k < n; ++k) corners.push_back(center + size * random_.direction<3>());
      if (v == V::degenerate) flatten(corners);
      add(corners);
    }
    if (v == V::enclosing && case_.kind == PieceKind::triangle) {
      // A closed octahedron.
      Vector3d tip[6];
      for (int i = 0; i < 6; ++i) tip[i] = (i % 2 ? -8 : 8) * turn.col(i / 2);
      for (int i = 0; i < 8; ++i) add({tip[i & 1], tip[2 + (i >> 1 & 1)], tip[4 + (i >> 2 & 1)]});
    }
    for (int k = 0; k < 6; ++k) case_.velocities.push_back(random_.direction<3>());
    for (int k = 0; k < 4; ++k) {
      const Vector3d towards = some_point() - agent_center();
      case_.velocities.push_back(towards + random_.uniform(0, 1.5) * scale() * random_.direction<3>());
    }
  }

  void flatten(std::vector<Vector3d>& corners) {
    const int kind = random_.integer(0, 3);
    if (kind == 0)
      for (Vector3d& x : corners) x = corners.front();
    else if (kind == 1)
      corners[1] = corners[0];
    else if (kind == 2)
      corners[2] = corners[1] + (corners[1] - corners[0]);
    else
      for (Vector3d& x : corners) x(0) = corners.front()(0);
  }

  Vector3d some_point() {
    const auto any = [&](std::size_t n) { return static_cast<std::size_t>(random_.integer(0, int(n) - 1)); };
    if (case_.kind == PieceKind::box) return case_.boxes[any(case_.boxes.size())].low;
    if (case_.kind == PieceKind::hull) {
      const auto& points = case_.hulls[any(case_.hulls.size())].points();
      return points[any(points.size())];
    }
    return case_.points[any(case_.points.size())];
  }
  Vector3d agent_center() const {
    if (const auto* e = std::get_if<Ellipsoid>(&case_.agent)) return e->center();
    return std::get<HullBody>(case_.agent).points().front();
  }

  /// Integers up to n in size.
  Vector3d integers(int n) {
    Vector3d x;
    for (int i = 0; i < 3; ++i) x(i) = random_.integer(-n, n);
    return x;
  }

  /// An agent and pieces in integers, in coordinates in which the agent is a ball of radius m L and passes
  /// along the x axis; then stretched.
  void whole_case() {
    const Frame frame = case_.kind == PieceKind::box ? permuted_axes(random_) : integer_frame(random_);
    const auto& triple = kTriples[random_.integer(0, case_.kind == PieceKind::box ? 1 : 5)];
    const double m = triple[2], reach = m * frame.length;
    Matrix3d stretch = Matrix3d::Identity();
    if (agent_ == AgentKind::ellipsoid)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j) {
          stretch(i, j) = i == j ? random_.integer(1, 4) : random_.integer(-2, 2);
          if (i != j && case_.kind == PieceKind::box) stretch(i, j) = 0;
        }
    const Matrix3d map = stretch * frame.n;
    if (agent_ == AgentKind::hull) {
      std::vector<Vector3d> corners;
      const int count = random_.integer(1, 8);
      for (int i = 0; i < count; ++i) corners.push_back(place(map * integers(static_cast<int>(m))));
      case_.agent = HullBody(corners);
      if (case_.kind == PieceKind::ball) case_.radius = scale() * random_.integer(0, 5);
    } else {
      double radius = reach;
      if (case_.kind == PieceKind::ball) {
        case_.radius = scale() * random_.integer(0, 4);
        radius -= case_.radius / scale();
      }
      const Vector3d center = place(Vector3d::Zero());
      const Matrix3d shape = radius * radius * stretch * stretch.transpose() * scale() * scale();
      case_.agent = agent_ == AgentKind::ball
                        ? Ellipsoid::from_axes(center, Vector3d::Constant(scale() * radius))
                        : Ellipsoid::from_shape(center, shape);
    }
    const Vector3d foot(0, triple[0], triple[1]), across(0, -triple[1], triple[0]);
    const int count = random_.integer(1, 8);
    for (int i = 0; i < count; ++i) {
      Vector3d at = foot;
      if (case_.variation != V::touching)
        at.x() = random_.integer(int(m) + 1, 60) * (random_.integer(0, 9) ? 1 : -1);
      if (case_.variation == V::shared && case_.kind == PieceKind::triangle) {
        fan(map, at, foot);
      } else {
        tangent(map, at, foot, across);
      }
    }
    // The direction of passing, forwards and backwards, and neighbours.
    const Vector3d w = map.col(0);
    case_.velocities = {w, Vector3d(0x1p-7 * w), Vector3d(-w)};
    for (int k = 0; k < 2; ++k) {
      Vector3d close = w;
      for (int i = 0; i < 3; ++i) close(i) = ulps(close(i));
      case_.velocities.push_back(close);
    }
    // Directions through corners, edges and faces of differences.
    for (int k = 0; k < 4; ++k) {
      Vector3d sum = Vector3d::Zero();
      for (int i = 0; i <= k % 3; ++i) sum += difference();
      case_.velocities.push_back(sum);
    }
    case_.velocities.push_back(random_.direction<3>());
  }

  Vector3d difference() {
    const Vector3d to = some_point();
    if (const auto* hull = std::get_if<HullBody>(&case_.agent))
      return to - hull->points()[static_cast<std::size_t>(random_.integer(0, int(hull->size()) - 1))];
    return to - agent_center();
  }

  /// A piece beyond the plane through `at` with the normal `foot`, with a corner, an edge or a face in it.
  void tangent(const Matrix3d& map, const Vector3d& at, const Vector3d& foot, const Vector3d& across) {
    const auto beyond = [&] {
      Vector3d x = integers(6);
      if (x.dot(foot) < 0) x = -x;
      return Vector3d(at + x);
    };
    std::vector<Vector3d> corners;
    if (case_.kind == PieceKind::box) {
      corners = {at, beyond()};
      // The other axis of the foot's plane goes either way past the foot.
      const Vector3d past = random_.integer(-4, 0) * across.cwiseAbs() / 5;
      corners.push_back(at + past);
    } else {
      const int kind = random_.integer(0, 2);
      const Vector3d along(random_.integer(-3, 3), 0, 0);
      if (kind == 0) {
        corners = {at, beyond(), beyond()};
      } else if (kind == 1) {
        corners = {at - along - across, at + 2 * (along + across), beyond()};
      } else {
        const Vector3d x(random_.integer(1, 9), 0, 0);
        corners = {at - x - across, at - x + across, at + 2 * x};
      }
      if (case_.kind == PieceKind::ball) corners = {at};
      if (case_.kind == PieceKind::hull)
        for (int k = 0; k < 3; ++k) corners.push_back(beyond());
    }
    for (Vector3d& x : corners) x = map * x;
    add(corners);
  }

  /// Triangles about a common corner, the ring closed, beyond the tangent plane or across it.
  void fan(const Matrix3d& map, const Vector3d& at, const Vector3d& foot) {
    const auto first = static_cast<std::uint32_t>(case_.points.size());
    const int n = random_.integer(3, 7);
    const bool across = random_.coin();
    case_.points.push_back(place(map * at));
    for (int i = 0; i < n; ++i) {
      Vector3d x = integers(9);
      if (x.dot(foot) < 0 && !across) x = -x;
      case_.points.push_back(place(map * (at + x)));
    }
    for (int i = 0; i < n; ++i)
      case_.triangles.push_back({first, first + 1 + static_cast<std::uint32_t>(i),
                                 first + 1 + static_cast<std::uint32_t>((i + 1) % n)});
    case_.velocities.push_back(case_.points[first] - agent_center());
  }

  void disturb() {
    for (Vector3d& x : case_.points)
      for (int i = 0; i < 3; ++i)
        if (random_.coin()) x(i) = ulps(x(i));
    for (Box& b : case_.boxes)
      for (int i = 0; i < 3; ++i) {
        const double low = ulps(b.low(i)), high = ulps(b.high(i));
        if (low <= high) b.low(i) = low, b.high(i) = high;
      }
    for (HullBody& h : case_.hulls) {
      auto points = h.points();
      for (Vector3d& x : points)
        for (int i = 0; i < 3; ++i) x(i) = ulps(x(i));
      h = HullBody(points);
    }
  }

  AgentKind agent_;
  SeededRandom random_;
  AssemblyCase case_;
  bool whole_ = false;
  int place_ = 0;
};

}  // namespace

const char* to_string(AgentKind kind) {
  return kind == AgentKind::ball ? "ball" : kind == AgentKind::ellipsoid ? "ellipsoid" : "hull";
}

const char* to_string(AssemblyVariation variation) {
  constexpr const char* kNames[] = {"regular",  "tangent",    "near", "shared",
                                    "touching", "degenerate", "thin", "enclosing"};
  return kNames[static_cast<int>(variation)];
}

Assembly AssemblyCase::assembly() const {
  switch (kind) {
    case PieceKind::triangle:
      return Assembly::mesh(points, triangles);
    case PieceKind::ball:
      return Assembly::cloud(points, radius);
    case PieceKind::box:
      return Assembly::boxes(boxes);
    default:
      return Assembly::polyhedra(hulls);
  }
}

TruePieces AssemblyCase::pieces() const {
  if (kind == PieceKind::triangle) return TruePieces::triangles(points, triangles);
  if (kind == PieceKind::ball) return TruePieces::balls(points, radius);
  if (kind == PieceKind::box) return TruePieces::boxes(boxes);
  TruePieces r;
  for (const HullBody& h : hulls) r.hulls.push_back(h.points());
  return r;
}

double AssemblyCase::agent_size() const {
  if (const auto* e = std::get_if<Ellipsoid>(&agent)) return e->semi_axes().maxCoeff();
  const auto& p = std::get<HullBody>(agent).points();
  double size = 0;
  for (const Vector3d& x : p)
    for (const Vector3d& y : p) size = std::max(size, (x - y).norm() / 2);
  return size;
}

AssemblyCase assembly_case(AgentKind agent, PieceKind pieces, std::uint64_t seed, std::uint64_t index) {
  return Maker(agent, pieces, seed, index).make();
}

}  // namespace vericone::verify
