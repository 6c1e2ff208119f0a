// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_text.h"

#include <cstdio>
#include <filesystem>
#include <ostream>

#include "json/json_value.h"

namespace vericone::fit {
namespace {

std::string number(const Json& x, const char* format = "%.6g") {
  char text[48];
  std::snprintf(text, sizeof text, format, x.get<double>());
  return text;
}

void row(std::ostream& out, std::string label, const std::string& text) {
  label.resize(20, ' ');
  out << label << text << '\n';
}

std::string hull(const Json& fit) {
  const std::size_t pieces = fit["pieces"].size();
  std::string text = fit["shape"].get<std::string>() + ", " + fit["mode"].get<std::string>();
  if (pieces > 1) text += ", union of " + std::to_string(pieces) + " pieces";
  return text;
}

void print_sizes(const Json& fit, std::ostream& out) {
  if (!fit["area"].is_null()) row(out, "footprint", number(fit["area"]) + " m^2");
  if (fit["volume"].is_null()) return;
  const double volume = fit["volume"].get<double>();
  std::string text = number(fit["volume"]) + " m^3";
  for (const auto& [field, what] :
       {std::pair("scan_volume", "the scan's"), std::pair("convex_hull_volume", "the convex hull's"),
        std::pair("ellipsoid_volume", "the least ellipsoid's")})
    if (!fit[field].is_null() && fit[field].get<double>() > 0)
      text += ", " + number(volume / fit[field].get<double>(), "%.4g") + " x " + what;
  row(out, "volume", text);
  if (!fit["volume_ratio_bound"].is_null())
    row(out, "least volume",
        "proved to within " + number(fit["volume_ratio_bound"].get<double>() - 1, "%.2g"));
}

void print_surfaces(const Json& fit, std::ostream& out) {
  for (std::size_t i = 0; i < fit["pieces"].size(); ++i) {
    const Json& piece = fit["pieces"][i];
    if (piece["noise"].is_null()) continue;
    const std::string which = fit["pieces"].size() > 1 ? " " + std::to_string(i) : "";
    std::string text = "noise " + number(piece["noise"], "%.3g") + " m";
    if (!piece["inliers"].is_null())
      text += ", inliers " + number(100 * piece["inliers"].get<double>(), "%.3g") + " %";
    if (!piece["seen"].is_null())
      text += ", seen " + number(100 * piece["seen"].get<double>(), "%.3g") + " % of the surface";
    if (!piece["converged"].get<bool>()) text += "; NOT CONVERGED";
    row(out, "surface" + which, text);
    for (const Json& u : piece["unknown"])
      row(out, "not determined" + which,
          u["what"].get<std::string>() + ": " + (u["value"].is_null() ? "?" : number(u["value"], "%.3g")) +
              " +- " + (u["error"].is_null() ? "?" : number(u["error"], "%.2g")) + " m");
  }
}

}  // namespace

void print_fit(const Json& fit, const std::string& scan, std::ostream& out) {
  const std::string file = std::filesystem::path(fit["file"].get<std::string>()).filename().string();
  row(out, "scan", scan + " (" + file + ")");
  row(out, "hull", hull(fit));
  if (!fit["why"].is_null()) row(out, "why", fit["why"].get<std::string>());
  print_sizes(fit, out);
  row(out, "scan to hull",
      "mean " + number(fit["mean_distance"], "%.4g") + " m, at most " + number(fit["max_distance"], "%.4g") +
          " m");
  if (const Json& back = fit["hull_distance"]; !back.is_null())
    row(out, "hull to scan",
        "mean " + number(back["mean"], "%.4g") + " m, at most " + number(back["max"], "%.4g") + " m");
  print_surfaces(fit, out);
  row(out, "certified",
      (fit["certified"].get<bool>() ? "yes: " : "no: ") + fit["certificate"]["statement"].get<std::string>());
  for (const Json& note : fit["notes"]) row(out, "note", note.get<std::string>());
  row(out, "time", number(fit["seconds"], "%.3g") + " s");
}

}  // namespace vericone::fit
