// SPDX-License-Identifier: BSD-3-Clause
#include "explain.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace vericone::fitting {
namespace {

/// The volume without one point has to fall by this factor for it to be called alone.
constexpr double kLoneVolume = 0.75;
constexpr double kHardlySeen = 0.7;

std::string digits(double x, int count) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", count, x);
  return text;
}

/// The support point without which the minimum-volume ellipsoid of those kept is smallest.
void remark_lone_point(const CanonicalSample& canon, const std::vector<char>& kept, const Sample& sample,
                       std::vector<std::string>& notes) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < canon.points.size(); ++i)
    if (kept[i]) {
      points.push_back(canon.points[i]);
      index.push_back(i);
    }
  double least = std::numeric_limits<double>::infinity();
  std::size_t lone = 0;
  double whole = 0;
  try {
    const MinVolumeResult<3> all = min_volume_ellipsoid<3>(points);
    whole = all.body.volume();
    for (const Eigen::Index i : all.support) {
      std::vector<Eigen::Vector3d> others = points;
      others.erase(others.begin() + i);
      const double v = min_volume_ellipsoid<3>(others).body.volume();
      if (v < least) {
        least = v;
        lone = index[std::size_t(i)];
      }
    }
  } catch (const InputError&) {  // flat without it, or flat: nothing to compare
    return;
  }
  if (!(least < kLoneVolume * whole)) return;
  const std::uint32_t original = canon.original[lone];
  const Eigen::Vector3d& x = sample.points[original];
  notes.push_back("point " + std::to_string(original) + " (" + to_text(x.x()) + ", " + to_text(x.y()) + ", " +
                  to_text(x.z()) + ") alone makes the enclosing ellipsoid " + digits(whole / least, 3) +
                  " times as large; a coverage below 1 or the robust mode would leave an outlier out");
}

void remark_surface(const SurfaceFit& surface, const std::string& which, std::vector<std::string>& notes) {
  if (!surface.converged) notes.push_back("the fit" + which + " has not converged: it is no answer");
  if (surface.seen < kHardlySeen)
    notes.push_back("points lie near " + digits(100 * surface.seen, 2) + " % of the surface" + which +
                    "; the rest is what the shape says, not the points");
  for (const Unknown& u : surface.unknown)
    notes.push_back("the points do not determine " + u.what + which + ": " + digits(u.value, 4) +
                    " m, give or take " + digits(u.error, 2) + " m (one standard deviation)");
}

}  // namespace

void score(Candidate& candidate, Mode mode) {
  const double size = mode == Mode::containing ? candidate.volume : candidate.noise;
  // A containing body is proved to contain whether or not it is a minimum; a surface that is no minimum is
  // none.
  candidate.score = candidate.converged || mode == Mode::containing
                        ? std::log(std::max(size, 1e-300)) + kPricePerParameter * candidate.parameters
                        : std::numeric_limits<double>::infinity();
}

std::string explain_choice(const std::vector<Candidate>& candidates, Shape chosen, Mode mode) {
  const auto value = [&](const Candidate& c) { return mode == Mode::containing ? c.volume : c.noise; };
  const std::string what = mode == Mode::containing ? "volume" : "noise";
  const Candidate* best = nullptr;
  for (const Candidate& c : candidates)
    if (c.shape == chosen) best = &c;
  if (!best) return "";
  std::string text = to_string(chosen) + ": " + what + " " + digits(value(*best), 4) +
                     (mode == Mode::containing ? " m3" : " m") + " with " + std::to_string(best->parameters) +
                     " parameters";
  for (const Candidate& c : candidates) {
    if (&c == best) continue;
    text += "; " + to_string(c.shape);
    if (!c.converged && mode != Mode::containing) {
      text += " did not converge";
      continue;
    }
    const double change = 100 * (value(c) / value(*best) - 1);
    text += " " + std::string(change < 0 ? "" : "+") + digits(change, 3) + " % with " +
            std::to_string(c.parameters);
  }
  return text + " (each parameter has to take away 1 % of the " + what + ")";
}

std::vector<std::string> remarks(const Sample& sample, const CanonicalSample& canon,
                                 const std::vector<char>& kept, const FitResult& result,
                                 const FitOptions& options) {
  std::vector<std::string> notes;
  if (options.mode == Mode::containing && result.shape != Shape::ellipse)
    remark_lone_point(canon, kept, sample, notes);
  const auto delimiters = [&] {
    std::size_t least = 99;
    for (const Piece& piece : result.pieces) least = std::min(least, piece.body.delimiters().size());
    return least;
  };
  if (options.mode == Mode::containing && result.shape == Shape::star && delimiters() < 2)
    notes.push_back("further hyperboloids would take away less than 2 % each: the star has " +
                    std::to_string(delimiters()));
  if (options.mode == Mode::containing && delimiters() == 0 &&
      (result.shape == Shape::biconcave || result.shape == Shape::biconvex))
    notes.push_back("no " + std::string(result.shape == Shape::biconcave ? "dents" : "waist") +
                    " that would make the ellipsoid smaller: the hull is the ellipsoid");
  for (std::size_t k = 0; k < result.surfaces.size(); ++k)
    remark_surface(result.surfaces[k], result.surfaces.size() > 1 ? " of piece " + std::to_string(k) : "",
                   notes);
  if (options.mode == Mode::containing)
    for (const Candidate& c : result.candidates)
      if (c.shape == result.shape && !c.converged)
        notes.push_back("the volume is no proved minimum: first-order conditions hold to " +
                        digits(result.stationarity, 2) + " only (the points are contained all the same)");
  if ((options.mode == Mode::containing || options.coverage) && !result.certified)
    notes.push_back("not everything that was to be inside is proved to be");
  return notes;
}

}  // namespace vericone::fitting
