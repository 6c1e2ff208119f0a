// SPDX-License-Identifier: BSD-3-Clause
//
// Proofs of pairs. Why a certificate holds: docs/explanation/proof-of-runs.md.
#include <vericone/simulation/proof.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "proof/meeting.h"
#include "proof/nearness.h"
#include "proof/padding.h"
#include "proof/separation.h"
#include "proof/time_search.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Pieces tried at most to raise the bound on the least distance.
constexpr int kMostRefinements = 60, kMostByDistances = 200;

/// Of one pair.
constexpr std::size_t kMostPieces = 200'000;

/// A span that is proved.
struct Leaf {
  TimeSpan<Moment> span;
  double bound = 0;  // of the distance, metres
  double gap = kNone;
  bool by_planes = true;  // or by distances; not by inflation
};

/// That two bodies are apart: by planes or distances, and by inflation where those do not tell.
class Apart {
 public:
  using Moment = simulation::Moment;
  using Leaf = simulation::Leaf;
  using Span = TimeSpan<Moment>;

  Apart(const MovingPair& pair, const ProofOptions& options)
      : pair_(pair),
        distances_(by_distances(pair)),
        padding_({2 * options.padding, options.resolution, options.drift},
                 std::min(pair.a().appears(), pair.b().appears())) {}

  bool distances() const { return distances_; }
  Moment at(double t) const { return pair_.at(t); }
  bool meets(const Moment& moment) const { return meeting(pair_, moment) == Meeting::meet; }

  TimeLook<Leaf> look(const Span& span, const Moment& middle) {
    const Piece piece{span.from, middle, span.to};
    const Certificate found = certificate(piece, span.normal);
    TimeLook<Leaf> look{std::nullopt, false, found.normal.isZero(0) ? span.normal : found.normal};
    const double padding = padding_.until(span.to.t);
    if (found.bound > padding) {
      look.proved = noted({{span.from, span.to, look.normal},
                           found.bound - padding,
                           found.gap - padding_.drifted(middle.t),
                           true});
    } else if (found.gap <= padding) {
      const Meeting now = meeting(pair_, middle);
      look.meets = now == Meeting::meet;
      if (now == Meeting::apart && !distances_ && delimited(pair_, middle) &&
          apart_by_inflation(pair_, piece, padding, false))
        look.proved = Leaf{span, 0, kNone, false};
    }
    return look;
  }

  bool measured(const Leaf&) const { return true; }
  bool near_enough(const Leaf& leaf) const {
    return leaf.bound >= (leaf.by_planes ? 0.99 : 0.8) * nearest_ - 1e-6;
  }

  Leaf half(const Leaf& whole, const Span& span) {
    const Piece piece{span.from, pair_.at(0.5 * (span.from.t + span.to.t)), span.to};
    const double padding = padding_.until(span.to.t), drifted = padding_.drifted(piece.middle.t);
    if (!whole.by_planes) {
      Leaf leaf{span, whole.bound, kNone, false};
      if (const auto inflation = apart_by_inflation(pair_, piece, padding, true)) {
        leaf.bound = std::max(leaf.bound, inflation->bound);
        leaf.gap = inflation->gap - drifted;
      }
      return noted(leaf);
    }
    const Certificate c = certificate(piece, span.normal);
    const double bound = c.bound - padding;
    Leaf leaf{span, std::max(bound, whole.bound), c.gap > 0 ? c.gap - drifted : kNone, true};
    if (bound > whole.bound) leaf.span.normal = c.normal;
    return noted(leaf);
  }

 private:
  Certificate certificate(const Piece& piece, const Vector3d& previous) const {
    return distances_ ? by_distance(pair_, piece) : separate(pair_, piece, previous);
  }
  const Leaf& noted(const Leaf& leaf) {
    nearest_ = std::min(nearest_, leaf.gap);
    return leaf;
  }

  const MovingPair& pair_;
  bool distances_;          // certificates by distances, not by planes
  Padding padding_;         // of both bodies together
  double nearest_ = kNone;  // a distance that the bodies come to, about
};

PairProof prove(const MovingPair& pair, double from, double to, const ProofOptions& options) {
  Apart apart(pair, options);
  TimeSearch search(apart, options.resolution, kMostPieces);
  const TimeEnd end = search.run(from, to);
  PairProof proof;
  if (end == TimeEnd::apart) {
    search.refine(apart.distances() ? kMostByDistances : kMostRefinements);
    proof.verdict = ProofVerdict::avoided;
    proof.from = from;
    proof.to = to;
    const auto nearer = [](const Leaf& x, const Leaf& y) { return x.gap < y.gap; };
    const Leaf& nearest = *std::min_element(search.leaves().begin(), search.leaves().end(), nearer);
    const Leaf& there = nearest.gap < kNone ? nearest : search.least();
    const Moment when = search.middle(there.span);
    proof.least_distance = search.least().bound;
    proof.least_time = when.t;
    proof.place = apart.distances() ? place_of_nearest(pair, when)
                  : there.by_planes ? place_between(pair, when, there.span.normal)
                                    : place_of_meeting(pair, when, there.span.normal);
  } else {
    const bool touched = end == TimeEnd::touched;
    const TimeSpan<Moment>& found = search.found();
    proof.verdict = touched ? ProofVerdict::touched : ProofVerdict::undecided;
    proof.from = found.from.t;
    proof.to = found.to.t;
    proof.place = !apart.distances() ? place_of_meeting(pair, touched ? found.to : found.from, found.normal)
                  : touched          ? place_of_touch(pair, pair.at(found.from.t), found.to)
                                     : place_of_nearest(pair, found.from);
  }
  proof.pieces = search.leaves().size();
  return proof;
}

}  // namespace

const char* to_string(ProofVerdict verdict) {
  constexpr const char* kWords[] = {"avoided", "touched", "undecided"};
  return kWords[std::size_t(verdict)];
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
  return prove(MovingPair(a, b, from, to), from, to, options);
}

}  // namespace vericone::simulation
