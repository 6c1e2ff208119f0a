// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/containing.h>
#include <vericone/internal/fitting/convex_hull.h>
#include <vericone/internal/fitting/fit_surface.h>
#include <vericone/internal/fitting/signed_distance.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>

#include "containing/partition.h"
#include "containing/trim.h"
#include "explain.h"
#include "to_world.h"

namespace vericone::fitting {
namespace {

using Eigen::Vector3d;

constexpr int kMostPieces = 64;
/// Where there is a choice: half of what dents or a waist must take away to be chosen. A first search misses
/// less than the other half.
constexpr double kPromise = 0.5 * 6 * kPricePerParameter;

void require_valid(const FitOptions& options) {
  if (options.coverage && !(*options.coverage > 0 && *options.coverage <= 1))
    throw InputError("coverage", to_text(*options.coverage), "above 0 and at most 1");
  if (!(options.margin >= 0 && options.margin <= 1e100))
    throw InputError("margin", to_text(options.margin), "a finite number, 0 or more (m)");
  if (options.margin > 0 && options.mode != Mode::containing && !options.coverage)
    throw InputError(
        "margin", to_text(options.margin),
        "0 for a surface near the points, or a coverage besides: only what is contained has one");
  if (options.pieces < 1 || options.pieces > kMostPieces)
    throw InputError("pieces", std::to_string(options.pieces), "1 to " + std::to_string(kMostPieces));
}

void require_enough(const CanonicalSample& sample, Shape shape, const FitOptions& options, int pieces) {
  const bool flat = shape == Shape::ellipse;
  // Containing ellipses and ellipsoids of least volume are unique whatever the number of points.
  int needed = flat ? 3 : 4;
  std::string why = flat ? "3 or more that are not on a line" : "4 or more that are not in a plane";
  if (options.margin > 0 && options.mode == Mode::containing) {  // balls span space
    needed = 2;
    why = "2 or more";
  }
  if (options.mode != Mode::containing) {
    needed = parameters(shape);
    why = std::to_string(needed) + " or more, as many as parameters";
  } else if (!flat && shape != Shape::ellipsoid && !sample.is_mesh()) {
    needed = parameters(shape);
    why = std::to_string(needed) +
          " or more, as many as parameters (a mesh may have fewer: its triangles count)";
  }
  if (int(std::min<std::size_t>(sample.points.size(), 1u << 30)) < needed * pieces)
    throw InputError(
        "points", std::to_string(sample.points.size()) + " different points",
        why + (pieces > 1 ? " for each of the pieces" : "") + ", for the shape " + to_string(shape));
}

/// The bodies of one shape, in the frame of the sample.
struct Trial {
  Shape shape = Shape::ellipsoid;
  std::vector<Piece> pieces;
  std::vector<SurfaceFit> surfaces;
  Candidate candidate;
  double volume_ratio_bound = 0, stationarity = 0;
};

Trial try_shape(const std::vector<Part>& parts, Shape shape, const FitOptions& options, double scale) {
  Trial trial;
  trial.shape = shape;
  trial.candidate = {.shape = shape, .converged = true, .parameters = 0};
  double weight = 0;
  for (const Part& part : parts) {
    Candidate& c = trial.candidate;
    if (options.mode == Mode::containing) {
      ContainingFit fit = containing_fit(
          part.sample, shape, {.margin = options.margin / scale, .promise = options.shape ? 0 : kPromise});
      c.converged = c.converged && fit.converged;
      c.volume += fit.volume;
      trial.volume_ratio_bound = parts.size() == 1 ? fit.volume_ratio_bound : 0;
      trial.stationarity = std::max(trial.stationarity, fit.stationarity);
      trial.pieces.push_back(std::move(fit.piece));
    } else {
      SurfaceFit fit =
          fit_surface(part.sample, shape, {.robust = options.mode == Mode::robust, .seed = options.seed});
      c.converged = c.converged && fit.converged;
      const double share = std::accumulate(part.sample.weights.begin(), part.sample.weights.end(), 0.0);
      c.noise = std::sqrt((c.noise * c.noise * weight + fit.noise * fit.noise * share) / (weight + share));
      weight += share;
      if (fit.piece.footprint)
        c.volume += fit.piece.footprint->volume();
      else
        c.volume += volume(fit.piece.body).value;
      trial.pieces.push_back(fit.piece);
      trial.surfaces.push_back(std::move(fit));
    }
    c.parameters +=
        shape == Shape::ellipse
            ? 5
            : std::max(parameters(shape), 9 + 6 * int(trial.pieces.back().body.delimiters().size()));
  }
  return trial;
}

/// What each point and triangle of the sample belongs to: the part that its triangle or itself is in.
Assignment assignment_of(const Sample& sample, const CanonicalSample& canon, const std::vector<char>& kept,
                         const std::vector<Part>& parts, const std::vector<Piece>& pieces) {
  Assignment result;
  const std::size_t n = canon.points.size();
  std::vector<int> of_point(n, -1);
  if (parts.size() == 1) {
    for (std::size_t i = 0; i < n; ++i) of_point[i] = kept[i] ? 0 : -1;
    result.triangles.assign(sample.triangles.size(), -1);
    for (std::size_t t = 0; t < sample.triangles.size(); ++t) {
      const auto& corner = sample.triangles[t];
      if (kept[canon.index[corner[0]]] && kept[canon.index[corner[1]]] && kept[canon.index[corner[2]]])
        result.triangles[t] = 0;
    }
  } else {
    std::vector<std::pair<std::array<std::uint32_t, 3>, int>> known;
    const auto sorted = [](std::array<std::uint32_t, 3> t) {
      std::sort(t.begin(), t.end());
      return t;
    };
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (const std::uint32_t item : parts[k].items) {
        if (!canon.is_mesh()) {
          of_point[item] = int(k);
          continue;
        }
        known.emplace_back(sorted(canon.triangles[item]), int(k));
        for (const std::uint32_t corner : canon.triangles[item]) of_point[corner] = int(k);
      }
    std::sort(known.begin(), known.end());
    for (const auto& t : sample.triangles) {
      const std::array<std::uint32_t, 3> key =
          sorted({canon.index[t[0]], canon.index[t[1]], canon.index[t[2]]});
      const auto found = std::lower_bound(known.begin(), known.end(), std::make_pair(key, 0));
      const bool is_there = found != known.end() && found->first == key;
      result.triangles.push_back(is_there ? found->second : -1);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!kept[i] || of_point[i] >= 0) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < pieces.size(); ++k)
        if (const double d = signed_distance({pieces[k]}, sample.points[canon.original[i]]); d < nearest) {
          nearest = d;
          of_point[i] = int(k);
        }
    }
  }
  for (const std::uint32_t i : canon.index)
    result.points.push_back(i == CanonicalSample::kUnused ? -1 : of_point[i]);
  return result;
}

/// Of a surface near the points: those that it must be inflated least for, each to the piece that it is
/// nearest to.
Assignment nearest_points(const Sample& sample, const CanonicalSample& canon,
                          const std::vector<Piece>& pieces, double coverage) {
  struct Place {
    double distance;
    std::uint32_t point;
    int piece;
  };
  std::vector<Place> places;
  for (std::uint32_t i = 0; i < sample.points.size(); ++i) {
    if (canon.index[i] == CanonicalSample::kUnused) continue;
    Place best{std::numeric_limits<double>::infinity(), canon.index[i], 0};
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (const double d = signed_distance({pieces[k]}, sample.points[i]); d < best.distance)
        best = {d, canon.index[i], int(k)};
    places.push_back({best.distance, i, best.piece});
  }
  std::stable_sort(places.begin(), places.end(), [&](const Place& a, const Place& b) {
    return a.distance != b.distance ? a.distance < b.distance : canon.index[a.point] < canon.index[b.point];
  });
  Assignment result;
  result.points.assign(sample.points.size(), -1);
  result.triangles.assign(sample.triangles.size(), -1);
  const std::size_t wanted = std::size_t(std::ceil(coverage * double(places.size()) * (1 - 1e-12)));
  for (std::size_t k = 0; k < std::min(wanted, places.size()); ++k)
    result.points[places[k].point] = places[k].piece;
  return result;
}

/// Of least volume among the ellipsoids that contain every ball about a point of this one and have its centre
/// and axes: a thin one cannot be scaled to that without growing out of all bounds.
template <int D>
BasicEllipsoid<D> swollen(const BasicEllipsoid<D>& body, double radius) {
  const Eigen::Matrix<double, D, 1> a = body.semi_axes();
  // (|a| + r)^2 <= (1 + s) a^2 + (1 + 1/s) r^2 along each direction; convex in log s.
  const auto squares = [&](double log_s) -> Eigen::Array<double, D, 1> {
    return (1 + std::exp(log_s)) * a.array().square() + (1 + std::exp(-log_s)) * radius * radius;
  };
  double low = std::log(radius / a.maxCoeff()), high = std::log(radius / a.minCoeff());
  for (int step = 0; step < 60; ++step) {
    const double third = (high - low) / 3;
    if (squares(low + third).log().sum() < squares(high - third).log().sum())
      high -= third;
    else
      low += third;
  }
  return BasicEllipsoid<D>::from_axes(body.center(), squares(0.5 * (low + high)).sqrt().matrix(),
                                      body.axis_directions());
}

class Progress {
 public:
  Progress(const FitOptions& options, int steps) : options_(options), steps_(steps) {}
  void next(const std::string& what) {
    if (options_.progress && !options_.progress(what, double(done_) / steps_)) throw Interrupted{};
    ++done_;
  }

 private:
  const FitOptions& options_;
  int steps_, done_ = 0;
};

std::string three_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

bool is_determined(const Trial& trial) {
  return std::none_of(trial.surfaces.begin(), trial.surfaces.end(),
                      [](const SurfaceFit& s) { return s.overreach.has_value(); });
}

/// Throws where a surface goes on far beyond its points.
void require_determined(const Trial& trial) {
  for (const SurfaceFit& s : trial.surfaces)
    if (s.overreach)
      throw InputError("points",
                       "a surface that is not determined by these points: it reaches " +
                           three_digits(s.overreach->reach) + " m from its centre where they are " +
                           three_digits(s.overreach->width) + " m wide",
                       "points from more sides, another shape, or a containing fit");
}

/// A shape that does not apply to the points is no candidate where there is a choice.
std::vector<Trial> try_all(const std::vector<Part>& parts, const CanonicalSample& sample,
                           const FitOptions& options, Progress& progress) {
  std::vector<Trial> trials;
  if (options.shape) {
    progress.next("fitting " + to_string(*options.shape));
    require_enough(sample, *options.shape, options, options.pieces);
    trials.push_back(try_shape(parts, *options.shape, options, sample.frame.scale));
    require_determined(trials.front());
    return trials;
  }
  require_enough(sample, Shape::ellipsoid, options, options.pieces);
  // Of a star each delimiter takes away no more than the one before, and all of them must take away two or
  // three prices: the first more than one. Near the points it is a body where dents or a waist alone are one.
  const auto star_pays = [&] {
    return std::any_of(trials.begin() + 1, trials.end(), [&](const Trial& t) {
      return options.mode == Mode::containing
                 ? t.candidate.volume < std::exp(-kPromise) * trials.front().candidate.volume
                 : is_determined(t);
    });
  };
  for (const Shape shape : {Shape::ellipsoid, Shape::biconcave, Shape::biconvex, Shape::star}) {
    progress.next("fitting " + to_string(shape));
    if (shape == Shape::star && !star_pays()) continue;
    try {
      require_enough(sample, shape, options, options.pieces);
      trials.push_back(try_shape(parts, shape, options, sample.frame.scale));
    } catch (const InputError&) {
      if (shape == Shape::ellipsoid) throw;
    }
  }
  std::vector<Trial> determined;
  for (Trial& trial : trials)
    if (is_determined(trial)) determined.push_back(std::move(trial));
  if (determined.empty()) require_determined(trials.front());
  return determined;
}

void measure(const Sample& sample, const CanonicalSample& canon, FitResult& result) {
  result.volume = volume(result.pieces);
  if (const auto& footprint = result.pieces.front().footprint; footprint && result.pieces.size() == 1)
    result.area = footprint->volume();
  if (sample.is_mesh()) result.scan_volume = enclosed_volume(sample);
  const double unit = std::pow(canon.frame.scale, 3);
  try {
    result.convex_hull_volume = unit * convex_hull(canon.points).volume;
    result.ellipsoid_volume = unit * min_volume_ellipsoid<3>(canon.points).body.volume();
  } catch (const InputError&) {  // in a plane: no volumes
    result.convex_hull_volume.reset();
  }
  result.scan_to_hull = scan_to_hull(result.pieces, sample);
  result.hull_to_scan = hull_to_scan(result.pieces, sample);
}

}  // namespace

FitResult fit(const Sample& sample, const FitOptions& options) {
  require_valid(options);
  Progress progress(options, options.shape ? 4 : 7);
  progress.next("reading the points");
  const CanonicalSample canon = canonical(sample);
  const bool containing = options.mode == Mode::containing;
  const bool is_footprint = options.shape == Shape::ellipse;
  const double coverage = options.coverage.value_or(1);
  std::vector<char> kept(canon.points.size(), 1);
  if (containing && coverage < 1) {
    require_enough(canon, options.shape.value_or(Shape::ellipsoid), options, 1);
    kept = trim(canon, coverage, is_footprint);
  }
  const std::vector<Part> parts = partition(kept_part(canon, kept), options.pieces);
  std::vector<Trial> trials = try_all(parts, canon, options, progress);
  for (Trial& t : trials) score(t.candidate, options.mode);
  Trial& best = *std::min_element(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
    return a.candidate.score < b.candidate.score;
  });

  FitResult result;
  result.mode = options.mode;
  result.shape = best.shape;
  result.volume_ratio_bound = best.volume_ratio_bound;
  result.stationarity = best.stationarity;
  for (const Trial& t : trials) {
    result.candidates.push_back(t.candidate);
    result.candidates.back().volume *= std::pow(canon.frame.scale, t.pieces.front().footprint ? 0 : 3);
    result.candidates.back().noise *= canon.frame.scale;
  }
  for (Piece& piece : best.pieces) result.pieces.push_back(to_world(piece, canon.frame));
  for (SurfaceFit& surface : best.surfaces) result.surfaces.push_back(to_world(surface, canon.frame));

  progress.next("proving");
  if (!containing && options.margin > 0)
    for (Piece& piece : result.pieces) {
      if (piece.footprint)
        piece.footprint = swollen(*piece.footprint, options.margin);
      else
        piece.body = CombinedEllipsoid::trusted(swollen(piece.body.ellipsoid(), options.margin),
                                                piece.body.delimiters());
    }
  if (containing || options.coverage) {
    const Assignment assignment = containing ? assignment_of(sample, canon, kept, parts, result.pieces)
                                             : nearest_points(sample, canon, result.pieces, coverage);
    result.inflation = enclose(result.pieces, sample, assignment, options.margin);
  } else {
    for (Piece& piece : result.pieces) set_quadrics(piece);
  }
  std::vector<std::vector<Quadric>> quadrics;
  for (const Piece& piece : result.pieces) quadrics.push_back(piece.quadrics);
  result.certificate = check(quadrics, sample, options.margin);
  const Certificate& c = result.certificate;
  const bool all = containing && !(coverage < 1);
  result.certified = (containing || options.coverage) && c.coverage() >= coverage * (1 - 1e-12) &&
                     (!all || c.all_inside()) &&
                     double(c.margins_inside) >= coverage * double(c.points) * (1 - 1e-12);

  progress.next("measuring");
  measure(sample, canon, result);
  if (!options.shape) result.why = explain_choice(result.candidates, result.shape, options.mode);
  result.notes = remarks(sample, canon, kept, result, options);
  return result;
}

}  // namespace vericone::fitting
