// SPDX-License-Identifier: BSD-3-Clause
//
// What proves that the bodies of a run stayed apart, in a form that a program checks which knows nothing of
// this library (docs/reference/certificates.md).
#pragma once

#include <vericone/simulation/run.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vericone::simulation {

enum class RunClaim : std::uint8_t {
  apart,   // all the time, by more than a distance
  near,    // no farther apart than a distance, at a time
  meet,    // in contact, at a time
  passed,  // a body goes through an orifice
  stays,   // a body stays in a corridor
};

/// Of pairs that are apart over the same time by the same distance, or of one that comes nearer: the claim,
/// with their bodies and tracks, and its proof.
struct RunCertificate {
  std::string text;         // one JSON object, on one line
  double by = 0;            // m: farther apart than this; near: no farther
  double from = 0, to = 0;  // s
  /// Bodies of the scenario; beyond these its orifices, and beyond these the run's corridors.
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  RunClaim says = RunClaim::apart;
};

/// A pair, or a body and an orifice, of which there is no certificate, or of less than the run says.
struct WithoutCertificate {
  std::string what, reason;
};

struct RunCertificates {
  std::vector<RunCertificate> made;  // by time and distance
  std::vector<WithoutCertificate> none;
};

/// Of all pairs of a run that are proved apart (PairProof), by what is required of them where that is kept;
/// of bodies without dents that meet or come nearer than required, that they do: that ellipsoids and bodies
/// with margins meet, of others that they come as near as their tubes are wide. Bodies stand in it as they
/// are in their own frames; planar ones as bodies of space of which they are the section by z = 0, those
/// whose dents change as a body that contains them all the time. Each has a track of polynomials and a radius
/// that holds the run's track and all motions that its proof holds for (ProofOptions), proved. Planes between
/// bodies, or groups of their pieces, were checked in exact arithmetic: there is a right certificate, or
/// none. Of many pieces (a map) boxes stand for runs of them. Of passages: that the body keeps off the rim,
/// wall or mesh all the time, and that it goes through a hole in a wall, which lies within the opening
/// (of an ellipse a polygon of 64 corners). Of corridors: that all of a body, as a ball about its reference
/// point, stays within. There is none where one body is in the other's dent, and of outlines that are not
/// star-shaped. `goes_on`: called with the share that is done before each
/// pair; false ends it there, the rest left out. Cost: 1 ms for a pair and second, mostly checks. Throws
/// InputError for a run that is not the scenario's.
[[nodiscard]] RunCertificates certificates(const Scenario& scenario, const Run& run,
                                           const std::function<bool(double)>& goes_on = {});

}  // namespace vericone::simulation
