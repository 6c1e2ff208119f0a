// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/cones/pair.h>

#include <bit>
#include <cstdio>
#include <random>

#include "verify/corpus/corpus_answers.h"

namespace vericone::verify {
namespace {

using Eigen::Vector3d;

/// Numbers that no library's sine or exponential has a part in: the same bits on every machine.
class Numbers {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Vector3d in_box(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return {x, y, z};
  }
  Eigen::Matrix3d rotation() {
    Eigen::Vector4d q;
    do
      for (double& x : q) x = uniform(-1, 1);
    while (q.squaredNorm() < 0.1);
    return rotation_3d(
        Eigen::Vector4d(q / std::sqrt((q(0) * q(0) + q(1) * q(1)) + (q(2) * q(2) + q(3) * q(3)))));
  }
  std::vector<Vector3d> points(int count) {
    std::vector<Vector3d> list;
    for (int i = 0; i < count; ++i) list.push_back(in_box(1));
    return list;
  }

 private:
  std::mt19937_64 engine_{20260317};
};

Ellipsoid ellipsoid(Numbers& numbers) {
  const double a = numbers.uniform(0.2, 1.5), b = numbers.uniform(0.2, 1.5), c = numbers.uniform(0.2, 1.5);
  const Vector3d center = numbers.in_box(0.2);
  return Ellipsoid::from_axes(center, {a, b, c}, numbers.rotation());
}

Body body(Numbers& numbers, BodyKind kind) {
  switch (kind) {
    case BodyKind::ellipsoid:
      return ellipsoid(numbers);
    case BodyKind::combined: {
      const Ellipsoid whole = ellipsoid(numbers);
      return CombinedEllipsoid(whole, {hyperboloid(2, {0.15, 0.3, 0.3}, numbers.rotation())});
    }
    case BodyKind::hull:
      return HullBody(numbers.points(9));
    case BodyKind::mesh:
      return Assembly::mesh(numbers.points(6), {{0, 1, 2}, {1, 2, 3}, {3, 4, 5}});
    case BodyKind::cloud:
      return Assembly::cloud(numbers.points(7), 0.25);
    case BodyKind::boxes: {
      std::vector<Box> boxes;
      for (const Vector3d& x : numbers.points(5)) boxes.push_back({x, x + Vector3d(0.25, 0.5, 0.125)});
      return Assembly::boxes(std::move(boxes));
    }
    case BodyKind::convex:
      return Convex::cylinder(0.5, 1.5);
    case BodyKind::pieces:
      break;
  }
  return Body::pieces({ellipsoid(numbers), ellipsoid(numbers)});
}

/// Of all that was added, in order.
class Sum {
 public:
  void add(std::uint64_t x) { value_ = (value_ ^ x) * 0x9E3779B97F4A7C15U + (value_ >> 29); }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  [[nodiscard]] unsigned long long value() const { return value_; }

 private:
  std::uint64_t value_ = 1;
};

}  // namespace

void print_random_answers() {
  constexpr int kPairs = 10, kVelocities = 208;  // of each two kinds: 64 * 10 * 208 = 133,120 verdicts
  Numbers numbers;
  for (const BodyKind first : kBodyKinds)
    for (const BodyKind second : kBodyKinds) {
      const std::string kinds = std::string(to_string(first)) + ' ' + to_string(second);
      Sum asked, verdicts, contacts, misses;
      int colliding = 0;
      for (int i = 0; i < kPairs; ++i) {
        const Pose here{numbers.in_box(1), numbers.rotation()},
            there{numbers.in_box(2) + Vector3d(4, 1, 0), numbers.rotation()};
        const Body agent = body(numbers, first),
                   obstacle = body(numbers, second);  // no order of arguments is given
        const Pair pair(Placed(agent, here), Placed(obstacle, there));
        for (int k = 0; k < kVelocities; ++k) {
          const Vector3d v = numbers.in_box(4) + (pair.obstacle().pose.position - pair.agent().pose.position);
          for (const double x : v) asked.add(x);
          const Verdict verdict = pair.verdict(v, Vector3d::Zero());
          verdicts.add(std::uint64_t(verdict));
          colliding += may_collide(verdict);
          if (k > 0) continue;
          const auto contact = pair.contact(v, Vector3d::Zero());
          if (contact) contacts.add(contact->time);
          misses.add(pair.miss(v, Vector3d::Zero()).distance);
        }
      }
      std::printf("random %s | asked %llx verdicts %llx colliding %d\n", kinds.c_str(), asked.value(),
                  verdicts.value(), colliding);
      std::printf("contacts %s | %llx\nmisses %s | %llx\n", kinds.c_str(), contacts.value(), kinds.c_str(),
                  misses.value());
    }
}

}  // namespace vericone::verify
