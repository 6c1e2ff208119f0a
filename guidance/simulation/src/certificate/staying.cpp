// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/staying.h"

#include <vericone/geometry/error.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "certificate/tube.h"

namespace vericone::simulation::certified {
namespace {

using Eigen::Vector3d;

constexpr double kRoundedUp = 1 + 1e-9;
constexpr double kLeast = 1e-3;           // s, of a piece that is divided
constexpr std::int64_t kParts = 1 << 20;  // of a leg, in which weights are written

double largest(const Eigen::Matrix3d& shape) {
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(shape).eigenvalues()(2));
}

class Staying {
 public:
  explicit Staying(const PairQuestion& question)
      : question_(question), core_(question.b.convexes.front()), reach_(kRoundedUp * reach_of(question.a)) {
    room_ = core_.margin() - kRoundedUp * (reach_ + question.track_a.radius + question.track_b.radius);
  }

  std::optional<std::string> proof() {
    if (!(room_ > 0) || !over(question_.from, question_.to)) return std::nullopt;
    return R"({"rule": "chords", "reach": )" + text_of(reach_) + ", \"times\": [" + text_of(question_.from) +
           times_ + "], \"means\": [" + means_ + "]}";
  }

 private:
  bool over(double from, double to) {
    checkpoint();
    if (question_.track_a.segment_of(from, to) < question_.track_a.segments.size()) {
      std::string means;
      if (near(from, to, means)) {
        times_ += ", " + text_of(to);
        means_ += (means_.empty() ? "[" : ", [") + means + "]";
        return true;
      }
      if (to - from < kLeast) return false;
    }
    const double middle = cut(from, to);
    return from < middle && middle < to && over(from, middle) && over(middle, to);
  }

  /// Where segments meet, if they do in between.
  [[nodiscard]] double cut(double from, double to) const {
    const double middle = 0.5 * (from + to);
    double best = middle, off = to - from;
    for (const double t : question_.track_a.times)
      if (t > from && t < to && std::abs(t - middle) < off) {
        best = t;
        off = std::abs(t - middle);
      }
    return best;
  }

  [[nodiscard]] bool near(double from, double to, std::string& means) const {
    const Vector3d a = core_.pieces().front().center, leg = core_.pieces().back().center - a;
    for (const Vector3d& x : control_points(question_.track_a, from, to)) {
      const double share = leg.isZero(0) ? 0 : std::clamp((x - a).dot(leg) / leg.squaredNorm(), 0.0, 1.0);
      const std::int64_t part = std::llround(share * kParts);
      const double rounded = static_cast<double>(part) / kParts;
      const double spare = 1e-9 * (x.norm() + a.norm() + leg.norm());
      if (!((x - a - rounded * leg).norm() < room_ - spare)) return false;
      const std::string first = "[0, " + text_of(1 - rounded) + "]", second = "[1, " + text_of(rounded) + "]";
      means.append(means.empty() ? "[" : ", [");
      means += (part == 0 ? first : part == kParts ? second : first + ", " + second) + "]";
    }
    return true;
  }

  const PairQuestion& question_;
  const vericone::Convex& core_;
  double reach_, room_ = 0;  // m
  std::string times_, means_;
};

}  // namespace

double reach_of(const Solid& solid) {
  double most = 0;
  for (const CombinedEllipsoid& one : solid.rounds)
    most = std::max(most, one.ellipsoid().center().norm() + largest(one.ellipsoid().shape()));
  for (const vericone::Convex& one : solid.convexes)
    for (const vericone::Convex::Piece& part : one.pieces())
      most = std::max(most, part.center.norm() +
                                largest(part.shape.value_or(part.factor * part.factor.transpose())) +
                                one.margin());
  for (const Vector3d& x : solid.points) most = std::max(most, x.norm() + solid.radius);
  for (const Box& box : solid.boxes)
    most = std::max(most, box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).norm());
  return most * kRoundedUp;
}

std::optional<std::string> proof_of_staying(const PairQuestion& question) {
  return Staying(question).proof();
}

}  // namespace vericone::simulation::certified
