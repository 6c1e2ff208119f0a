// SPDX-License-Identifier: BSD-3-Clause
//
// The search for a proof: pieces of time from the first to the last, halved until each is certified or the
// bodies are found to meet. Why a certificate holds: docs/explanation/proof-of-runs.md.
#include <vericone/simulation/proof.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "proof/meeting.h"
#include "proof/nearness.h"
#include "proof/padding.h"
#include "proof/separation.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Pieces tried at most to raise the bound on the least distance.
constexpr int kMostRefinements = 60, kMostByDistances = 200;

/// Of one pair. Of bodies as long as a town that turn, pieces of any length prove little; without an end the
/// search takes all memory.
constexpr std::size_t kMostPieces = 200'000;

struct Span {
  Moment from, to;
  Vector3d normal = Vector3d::Zero();  // that of the piece it was cut from
};

/// A piece that is proved.
struct Leaf {
  Span span;
  double bound = 0;  // of the distance, metres
  double gap = kNone;
  bool by_planes = true;  // or by distances; not by inflation
};

class Search {
 public:
  Search(const MovingPair& pair, const ProofOptions& options)
      : pair_(pair),
        distances_(by_distances(pair)),
        resolution_(options.resolution),
        padding_({2 * options.padding, options.resolution, options.drift},
                 std::min(pair.a().appears(), pair.b().appears())) {}

  PairProof run(double from, double to) {
    const Moment first = pair_.at(from), last = pair_.at(to);
    if (meeting(pair_, first) == Meeting::meet) return touched(from, first, Vector3d::Zero());
    open_.push_back({first, last});
    while (!open_.empty()) {
      checkpoint();
      const Span span = open_.back();
      open_.pop_back();
      if (step(span)) return proof_;
    }
    if (horizon_) return touched(horizon_->t, *horizon_, Vector3d::Zero());
    if (unresolved_) return undecided();
    return avoided(from, to);
  }

 private:
  /// Pieces shorter than this are not halved. Once one has been left undecided, only a meeting is still
  /// looked for, ever more coarsely.
  double shortest(double t) const {
    const double since = unresolved_ ? t - unresolved_->from.t : 0;
    return std::max(resolution_, since / 16);
  }

  Certificate certificate(const Piece& piece, const Vector3d& previous) const {
    return distances_ ? by_distance(pair_, piece) : separate(pair_, piece, previous);
  }

  /// One piece. True: the answer is there.
  bool step(const Span& span) {
    const Piece piece{span.from, pair_.at(0.5 * (span.from.t + span.to.t)), span.to};
    const Certificate found = certificate(piece, span.normal);
    const Vector3d normal = found.normal.isZero(0) ? span.normal : found.normal;
    const double padding = padding_.until(span.to.t);
    if (found.bound > padding) {
      leaves_.push_back({span, found.bound - padding, found.gap - padding_.drifted(piece.middle.t), true});
      leaves_.back().span.normal = normal;
      return false;
    }
    const bool halved = piece.middle.t > span.from.t && piece.middle.t < span.to.t &&
                        piece.duration() > shortest(span.from.t) &&
                        (leaves_.size() < kMostPieces || unresolved_);
    if (found.gap <= padding) {
      const Meeting now = meeting(pair_, piece.middle);
      if (now == Meeting::meet) return met(span, piece.middle, normal, halved);
      if (now == Meeting::apart && !distances_ && delimited(pair_, piece.middle))
        if (apart_by_inflation(pair_, piece, padding, false)) {
          leaves_.push_back({span, 0, kNone, false});
          return false;
        }
    }
    if (halved) {
      open_.push_back({piece.middle, span.to, normal});
      open_.push_back({span.from, piece.middle, normal});
      return false;
    }
    if ((horizon_ && span.to.t == horizon_->t) || meeting(pair_, span.to) == Meeting::meet) {
      touched(unresolved_ ? unresolved_->from.t : span.from.t, span.to, normal);
      return true;
    }
    if (!unresolved_) unresolved_ = span;
    return false;
  }

  /// They meet at `at`, within the span: what comes later does not matter any more.
  bool met(const Span& span, const Moment& at, const Vector3d& normal, bool halved) {
    open_.clear();
    horizon_ = at;
    if (!halved) {
      touched(unresolved_ ? unresolved_->from.t : span.from.t, at, normal);
      return true;
    }
    open_.push_back({span.from, at, normal});
    return false;
  }

  PairProof touched(double apart_before, const Moment& at, const Vector3d& normal) {
    proof_.verdict = ProofVerdict::touched;
    proof_.from = apart_before;
    proof_.to = at.t;
    proof_.place =
        distances_ ? place_of_touch(pair_, pair_.at(apart_before), at) : place_of_meeting(pair_, at, normal);
    proof_.pieces = leaves_.size();
    return proof_;
  }

  PairProof undecided() {
    proof_.verdict = ProofVerdict::undecided;
    proof_.from = unresolved_->from.t;
    proof_.to = unresolved_->to.t;
    proof_.place = distances_ ? place_of_nearest(pair_, unresolved_->from)
                              : place_of_meeting(pair_, unresolved_->from, unresolved_->normal);
    proof_.pieces = leaves_.size();
    return proof_;
  }

  PairProof avoided(double from, double to) {
    refine();
    proof_.verdict = ProofVerdict::avoided;
    proof_.from = from;
    proof_.to = to;
    const Leaf& least = *std::min_element(leaves_.begin(), leaves_.end(), lower);
    const Leaf& nearest = *std::min_element(leaves_.begin(), leaves_.end(), nearer);
    proof_.least_distance = least.bound;
    const Leaf& there = nearest.gap < kNone ? nearest : least;
    const Moment when = middle_of(there.span);
    proof_.least_time = when.t;
    proof_.place = distances_        ? place_of_nearest(pair_, when)
                   : there.by_planes ? place_between(pair_, when, there.span.normal)
                                     : place_of_meeting(pair_, when, there.span.normal);
    proof_.pieces = leaves_.size();
    return proof_;
  }

  static bool lower(const Leaf& x, const Leaf& y) { return x.bound < y.bound; }
  static bool nearer(const Leaf& x, const Leaf& y) { return x.gap < y.gap; }
  Moment middle_of(const Span& span) const { return pair_.at(0.5 * (span.from.t + span.to.t)); }

  /// Halves the piece of the least bound until that is near a distance that the bodies do come to.
  void refine() {
    double nearest = std::min_element(leaves_.begin(), leaves_.end(), nearer)->gap;
    for (int i = 0; i < (distances_ ? kMostByDistances : kMostRefinements); ++i) {
      const auto least = std::min_element(leaves_.begin(), leaves_.end(), lower);
      if (least->bound >= (least->by_planes ? 0.99 : 0.8) * nearest - 1e-6) return;
      const Leaf parent = *least;
      const Moment middle = middle_of(parent.span);
      if (!(middle.t > parent.span.from.t) || !(middle.t < parent.span.to.t)) return;
      *least = half(parent, parent.span.from, middle);
      nearest = std::min(nearest, least->gap);
      leaves_.push_back(half(parent, middle, parent.span.to));
      nearest = std::min(nearest, leaves_.back().gap);
    }
  }

  /// What holds for the whole holds for the half.
  Leaf half(const Leaf& whole, const Moment& from, const Moment& to) const {
    const Piece piece{from, pair_.at(0.5 * (from.t + to.t)), to};
    const double padding = padding_.until(to.t), drifted = padding_.drifted(piece.middle.t);
    if (!whole.by_planes) {
      Leaf leaf{{from, to, whole.span.normal}, whole.bound, kNone, false};
      if (const auto inflation = apart_by_inflation(pair_, piece, padding, true)) {
        leaf.bound = std::max(leaf.bound, inflation->bound);
        leaf.gap = inflation->gap - drifted;
      }
      return leaf;
    }
    const Certificate c = certificate(piece, whole.span.normal);
    const double bound = c.bound - padding;
    const double gap = c.gap > 0 ? c.gap - drifted : kNone;
    Leaf leaf{{from, to, whole.span.normal}, std::max(bound, whole.bound), gap, true};
    if (bound > whole.bound) leaf.span.normal = c.normal;
    return leaf;
  }

  const MovingPair& pair_;
  bool distances_;  // certificates by distances, not by planes
  double resolution_;
  Padding padding_;         // of both bodies together
  std::vector<Span> open_;  // the earliest last
  std::vector<Leaf> leaves_;
  std::optional<Span> unresolved_;  // the first
  std::optional<Moment> horizon_;   // they meet then
  PairProof proof_;
};

}  // namespace

const char* to_string(ProofVerdict verdict) {
  switch (verdict) {
    case ProofVerdict::avoided:
      return "avoided";
    case ProofVerdict::touched:
      return "touched";
    case ProofVerdict::undecided:
      return "undecided";
  }
  return "";
}

void check(const ProofOptions& options) {
  if (!(options.padding >= 0)) throw InputError("padding", to_text(options.padding), "not negative (m)");
  if (!(options.resolution > 0))
    throw InputError("resolution", to_text(options.resolution), "a positive number (s)");
  if (!(options.drift >= 0) || !std::isfinite(options.drift))
    throw InputError("drift", to_text(options.drift), "not negative (m/s)");
}

void require_time(double first, double last, double from, double to) {
  if (!(from >= first)) throw InputError("from", to_text(from), "not before " + to_text(first) + " s");
  if (!(to >= from) || !(to <= last))
    throw InputError("to", to_text(to), "between from and " + to_text(last) + " s");
}

PairProof prove(const Track& a, const Track& b, double from, double to, const ProofOptions& options) {
  require_time(std::max(a.appears(), b.appears()), std::min(a.end(), b.end()), from, to);
  check(options);
  const MovingPair pair(a, b);
  return Search(pair, options).run(from, to);
}

}  // namespace vericone::simulation
