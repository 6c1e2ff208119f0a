// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_text.h"

#include <cmath>
#include <filesystem>
#include <ostream>

#include "fit/fit_json.h"
#include "output/number_text.h"

namespace vericone::fit {
namespace {

void row(std::ostream& out, std::string label, const std::string& text) {
  label.resize(20, ' ');
  out << label << text << '\n';
}

std::string hull(const fitting::FitResult& fit) {
  std::string text = std::string(fitting::to_string(fit.shape)) + ", " + to_string(fit.mode);
  if (fit.pieces.size() > 1) text += ", union of " + std::to_string(fit.pieces.size()) + " pieces";
  return text;
}

void print_sizes(const fitting::FitResult& fit, std::ostream& out) {
  if (fit.area) row(out, "footprint", number_text(*fit.area) + " m^2");
  if (!fit.volume) return;
  const double volume = fit.volume->value;
  std::string text = number_within(volume, fit.volume->error) + " m^3";
  for (const auto& [of, what] :
       {std::pair(fit.scan_volume, "the scan's"), std::pair(fit.convex_hull_volume, "the convex hull's"),
        std::pair(fit.ellipsoid_volume, "the least ellipsoid's")})
    if (of && *of > 0) text += ", " + number_text(volume / *of, 4) + " x " + what;
  row(out, "volume", text);
  if (fit.volume_ratio_bound > 0)
    row(out, "least volume", "proved to within " + at_most_text(fit.volume_ratio_bound - 1, 2));
}

std::string known(double x, int digits) { return std::isfinite(x) ? number_text(x, digits) : "?"; }

void print_surfaces(const fitting::FitResult& fit, std::ostream& out) {
  for (std::size_t i = 0; i < fit.surfaces.size(); ++i) {
    const fitting::SurfaceFit& surface = fit.surfaces[i];
    if (!std::isfinite(surface.noise)) continue;
    const std::string which = fit.pieces.size() > 1 ? " " + std::to_string(i) : "";
    std::string text = "noise " + number_text(surface.noise, 3) + " m";
    if (std::isfinite(surface.inliers)) text += ", inliers " + number_text(100 * surface.inliers, 3) + " %";
    if (std::isfinite(surface.seen))
      text += ", seen " + number_text(100 * surface.seen, 3) + " % of the surface";
    if (!surface.converged) text += "; NOT CONVERGED";
    row(out, "surface" + which, text);
    for (const fitting::Unknown& u : surface.unknown)
      row(out, "not determined" + which,
          u.what + ": " + known(u.value, 3) + " +- " + known(u.error, 2) + " m");
  }
}

std::string distances(const fitting::DistanceStatistics& d) {
  return "mean " + number_text(d.mean, 4) + " m, at most " + at_most_text(d.max, 4) + " m";
}

}  // namespace

void print_fit(const fits::Scan& scan, const fitting::FitResult& fit, double seconds, std::ostream& out) {
  row(out, "certified", (fit.certified ? "yes: " : "no: ") + statement(fit, scan));
  row(out, "scan",
      fits::describe(scan) + " (" + std::filesystem::path(scan.file).filename().string() +
          "), whose unit is taken as the metre");
  row(out, "hull", hull(fit));
  if (!fit.why.empty()) row(out, "why", fit.why);
  print_sizes(fit, out);
  row(out, "scan to hull", distances(fit.scan_to_hull));
  if (fit.hull_to_scan) row(out, "hull to scan", distances(*fit.hull_to_scan));
  print_surfaces(fit, out);
  for (const auto* list : {&scan.notes, &fit.notes})
    for (const std::string& note : *list) row(out, "note", note);
  row(out, "time", number_text(seconds, 3) + " s");
}

}  // namespace vericone::fit
