// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs on tracks of others: prove() with a padding that holds radii, the required distance and what fitting
// changed. Where that fails, what is proved of the tracks themselves, and from when they are too near.
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/certificates_within.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/trajectory.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "foreign/pieces.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

std::string named(std::size_t body, const std::string& field) {
  return "bodies[" + std::to_string(body) + "]." + field;
}

/// What a body's points may be off the fitted track by fitting, m.
double slack(const TrackedBody& body, const FittedTrack& fitted) {
  return fitted.position_error + fitted.turn_error * reach(body.shape);
}

void check(const TrackedBody& body, std::size_t i) {
  if (!(body.radius >= 0) || !std::isfinite(body.radius))
    throw InputError(named(i, "radius"), to_text(body.radius), "a finite number, not negative (m)");
  for (const auto& [limit, name] :
       {std::pair{body.most_speed, "most_speed"}, std::pair{body.most_acceleration, "most_acceleration"}})
    if (!(limit >= 0)) throw InputError(named(i, name), to_text(limit), "not negative");
  if (!body.start.position.allFinite() || !body.start.velocity.allFinite() || !body.spin.allFinite() ||
      !body.start.rotation.allFinite())
    throw InputError(named(i, "start"), "a number that is not finite", "finite");
  if (!is_rotation(body.start.rotation))
    throw InputError(named(i, "start.rotation"), "a matrix that is none", "a rotation");
  const bool level = body.start.position.z() == 0 && body.start.velocity.z() == 0 &&
                     body.spin.head<2>().isZero(0) && body.start.rotation(2, 2) >= 1 - 1e-12;
  if (planar(body.shape) && !level)
    throw InputError(named(i, "start"), "not in the plane", "z = 0 and turned about z, of a planar body");
  try {
    check(body.shape);
  } catch (const InputError& e) {
    throw e.within(named(i, "shape"));
  }
}

void check(const CertifyOptions& options) {
  if (!(options.required >= 0) || !std::isfinite(options.required))
    throw InputError("required", to_text(options.required), "a finite number, not negative (m)");
  if (!(options.join >= 0)) throw InputError("join", to_text(options.join), "not negative (m, rad, m/s)");
  if (!(options.resolution > 0)) throw InputError("resolution", to_text(options.resolution), "positive (s)");
  for (const auto& [time, name] : {std::pair{options.from, "from"}, std::pair{options.to, "to"}})
    if (time && !std::isfinite(*time)) throw InputError(name, to_text(*time), "a finite number (s)");
}

struct Times {
  double from, to;
};

Times times_of(const std::vector<TrackedBody>& bodies, const CertifyOptions& options) {
  std::optional<double> from = options.from, to = options.to;
  for (const TrackedBody& body : bodies) {
    if (!body.trajectory || body.trajectory->position.times.empty()) continue;
    const Piecewise& p = body.trajectory->position;
    if (!options.from) from = std::min(from.value_or(p.from()), p.from());
    if (!options.to) to = std::max(to.value_or(p.to()), p.to());
  }
  if (!from || !to)
    throw InputError(from ? "to" : "from", "nothing", "a time (s), where no body has a trajectory");
  if (!(*from < *to)) throw InputError("to", to_text(*to), "after from, " + to_text(*from) + " s");
  return {*from, *to};
}

/// With a constant velocity and spin, over all of the time.
FittedTrack steady(const TrackedBody& body, const Times& times) {
  constexpr double kRounding = 1e-13;
  Motion start = body.start;
  start.position += times.from * body.start.velocity;
  const double angle = times.from * body.spin.norm();
  if (angle != 0) start.rotation = Eigen::AngleAxisd(angle, body.spin.normalized()) * start.rotation;
  Track track(body.shape, start, Orientation::fixed, times.from);
  track.append(Curve::steady(start, body.spin, times.from, times.to));
  const double size = body.start.position.norm() +
                      std::max(std::abs(times.from), std::abs(times.to)) * body.start.velocity.norm();
  const double turns = std::max(std::abs(times.from), std::abs(times.to)) * body.spin.norm();
  return {std::move(track), kRounding * size, kRounding * turns};
}

FittedTrack fitted(const TrackedBody& body, std::size_t i, const Times& times, double join) {
  try {
    return body.trajectory ? fitted_track(body.shape, *body.trajectory, join) : steady(body, times);
  } catch (const InputError& e) {
    throw e.within(named(i, body.trajectory ? "trajectory" : "start"));
  }
}

/// Two bodies over the time that both are there.
class OnePair {
 public:
  OnePair(const std::vector<TrackedBody>& bodies, const std::vector<FittedTrack>& tracks, std::size_t a,
          std::size_t b, const CertifyOptions& options)
      : a_(tracks[a].track), b_(tracks[b].track), resolution_(options.resolution) {
    found_.a = a;
    found_.b = b;
    fits_ = slack(bodies[a], tracks[a]) + slack(bodies[b], tracks[b]);
    allowed_ = bodies[a].radius + bodies[b].radius + options.required;
    required_ = options.required;
  }

  PairOnTracks answered(double from, double to) {
    const PairProof held = prove(a_, b_, from, to, proof_options(allowed_));
    found_.from = held.from;
    found_.to = held.to;
    found_.place = held.place;
    found_.pieces = held.pieces;
    if (held.verdict == ProofVerdict::avoided) {
      found_.verdict = TrackVerdict::apart;
      found_.least_distance = held.least_distance + required_;
      found_.least_time = held.least_time;
      return found_;
    }
    const PairProof itself = allowed_ > 0 ? prove(a_, b_, from, to, proof_options(0)) : held;
    found_.stated = itself;
    if (itself.verdict == ProofVerdict::touched) {
      found_.verdict = TrackVerdict::contact;
      found_.from = itself.from;
      found_.to = itself.to;
      found_.place = itself.place;
    } else if (const auto until = too_near(held.from, to, itself)) {
      found_.verdict = TrackVerdict::nearer;
      found_.to = *until;
      if (itself.verdict == ProofVerdict::avoided) found_.place = itself.place;
    }
    return found_;
  }

 private:
  /// Both bodies together; prove() takes it of each.
  [[nodiscard]] ProofOptions proof_options(double allowed) const {
    ProofOptions options;
    options.padding = 0.5 * (allowed + fits_) * (1 + 1e-12);
    options.resolution = resolution_;
    return options;
  }

  /// Proved: on the tracks they are as near as radii and the required distance allow no more.
  [[nodiscard]] bool near(double t) const {
    const Motion a = a_.motion(t), b = b_.motion(t);
    const Pair pair = pair_of(shape_at(a_.shape(), t, a.position, a.rotation),
                              shape_at(b_.shape(), t, b.position, b.rotation));
    const Miss miss = pair.miss(Vector3d::Zero(), Vector3d::Zero());
    return pair.relation() == Relation::disjoint ? miss.most > 0 && miss.most + fits_ <= allowed_ : true;
  }

  /// A time as early as can be found at which they are too near; apart before `from`.
  [[nodiscard]] std::optional<double> too_near(double from, double end, const PairProof& itself) const {
    if (!(allowed_ > fits_)) return std::nullopt;
    std::optional<double> late;
    for (double step = resolution_; !late && from + step < end; step *= 2)
      if (near(from + step)) late = from + step;
    if (itself.verdict == ProofVerdict::avoided && itself.least_time >= from && near(itself.least_time))
      late = std::min(late.value_or(end), itself.least_time);
    if (!late && near(end)) late = end;
    if (!late) return std::nullopt;
    double early = from;
    while (*late - early > resolution_) {
      const double middle = 0.5 * (early + *late);
      if (!(early < middle && middle < *late)) break;
      (near(middle) ? *late : early) = middle;
    }
    return late;
  }

  const Track &a_, &b_;
  double resolution_, required_ = 0;
  double fits_ = 0, allowed_ = 0;  // m, of both together
  PairOnTracks found_;
};

std::vector<LimitOnTrack> limits_of(const std::vector<TrackedBody>& bodies, double join) {
  std::vector<LimitOnTrack> found;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].trajectory) continue;
    for (const int derivative : {1, 2}) {
      const double limit = derivative == 1 ? bodies[i].most_speed : bodies[i].most_acceleration;
      if (std::isinf(limit)) continue;
      LimitOnTrack one{i, derivative, limit, LimitVerdict::undecided,
                       greatest(bodies[i].trajectory->position, derivative)};
      const bool jumps = derivative > 1 && one.greatest.jump > join;
      if (one.greatest.least > limit || jumps)
        one.verdict = LimitVerdict::broken;
      else if (one.greatest.most <= limit)
        one.verdict = LimitVerdict::kept;
      found.push_back(one);
    }
  }
  return found;
}

}  // namespace

const char* to_string(TrackVerdict verdict) {
  constexpr const char* kWords[] = {"contact", "nearer", "undecided", "apart"};
  return kWords[static_cast<std::size_t>(verdict)];
}

TrackVerdict CertifiedTracks::verdict() const {
  TrackVerdict worst = TrackVerdict::apart;
  for (const PairOnTracks& pair : pairs) worst = std::min(worst, pair.verdict);
  return worst;
}

CertifiedTracks certify(const std::vector<TrackedBody>& bodies, const CertifyOptions& options) {
  check(options);
  if (bodies.empty()) throw InputError("bodies", "none", "one or more");
  for (std::size_t i = 0; i < bodies.size(); ++i) check(bodies[i], i);
  for (std::size_t i = 1; i < bodies.size(); ++i)
    if (planar(bodies[i].shape) != planar(bodies[0].shape))
      throw InputError(named(i, "shape"), planar(bodies[i].shape) ? "of the plane" : "of space",
                       "like the first body, all in the plane or all in space");
  const Times times = times_of(bodies, options);
  CertifiedTracks certified;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    certified.tracks.push_back(fitted(bodies[i], i, times, options.join));
  certified.limits = limits_of(bodies, options.join);
  const std::size_t count = bodies.size() * (bodies.size() - 1) / 2;
  std::size_t done = 0;
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      if (options.goes_on && !options.goes_on(static_cast<double>(done) / static_cast<double>(count))) {
        certified.interrupted = true;
        return certified;
      }
      ++done;
      if (!bodies[a].trajectory && !bodies[b].trajectory) continue;
      const Track &x = certified.tracks[a].track, &y = certified.tracks[b].track;
      const double from = std::max({times.from, x.appears(), y.appears()}),
                   to = std::min({times.to, x.end(), y.end()});
      if (from <= to)
        certified.pairs.push_back(OnePair(bodies, certified.tracks, a, b, options).answered(from, to));
    }
  return certified;
}

RunCertificates certificates(const std::vector<TrackedBody>& bodies, const CertifiedTracks& certified,
                             const CertifyOptions& options) {
  if (certified.tracks.size() != bodies.size())
    throw InputError("certified", std::to_string(certified.tracks.size()) + " tracks",
                     std::to_string(bodies.size()) + ", one for each body");
  for (const PairOnTracks& pair : certified.pairs) {
    const auto there = [&](std::size_t body) {
      return body < bodies.size() && pair.from >= certified.tracks[body].track.appears() &&
             pair.to <= certified.tracks[body].track.end();
    };
    if (!there(pair.a) || !there(pair.b) || !(pair.from <= pair.to))
      throw InputError("certified", "a pair of bodies that are not there",
                       "what certify() says of these bodies");
  }
  // What a run is to its certificates: bodies, tracks, proofs. Of pairs that come too near, the tracks
  // themselves: what radii and the required distance allow together is the distance that they come to.
  Scenario scenario;
  scenario.name = "tracks";
  scenario.proof.padding = 0;
  Run run, itself;
  std::vector<double> radii, fits;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body body;
    body.name = bodies[i].name;
    body.shape = bodies[i].shape;
    scenario.bodies.push_back(std::move(body));
    run.tracks.push_back(certified.tracks[i].track);
    fits.push_back(slack(bodies[i], certified.tracks[i]));
    radii.push_back(bodies[i].radius + fits.back());
  }
  itself.tracks = run.tracks;
  std::vector<WithoutCertificate> none;
  for (const PairOnTracks& pair : certified.pairs) {
    PairOutcome outcome{pair.a, pair.b, {}, options.required};
    const bool contact = pair.verdict == TrackVerdict::contact;
    if (pair.verdict == TrackVerdict::nearer && pair.stated) {
      outcome.proof = *pair.stated;
      outcome.required += bodies[pair.a].radius + bodies[pair.b].radius;
      itself.proofs.push_back(outcome);
      continue;
    }
    if (pair.verdict != TrackVerdict::apart && !contact) {
      none.push_back({bodies[pair.a].name + ", " + bodies[pair.b].name, "undecided"});
      continue;
    }
    outcome.proof.verdict = contact ? ProofVerdict::touched : ProofVerdict::avoided;
    outcome.proof.from = pair.from;
    outcome.proof.to = pair.to;
    outcome.proof.least_distance = pair.least_distance;
    run.proofs.push_back(outcome);
  }
  const auto goes_on = [&](double share) { return !options.goes_on || options.goes_on(share); };
  RunCertificates made = certificates_within(scenario, run, radii, goes_on);
  RunCertificates near = certificates_within(scenario, itself, fits, goes_on);
  std::move(near.made.begin(), near.made.end(), std::back_inserter(made.made));
  made.none.insert(made.none.end(), near.none.begin(), near.none.end());
  made.none.insert(made.none.end(), none.begin(), none.end());
  return made;
}

}  // namespace vericone::simulation
