// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_check.h"

#include <vericone/fitting/hull.h>
#include <fstream>
#include <ostream>
#include <sstream>

#include <vericone/fits/fit_files.h>
#include <vericone/internal/fitting/solids.h>
#include "fit/solid_json.h"
#include "input/fields.h"
#include "json/json_value.h"
#include "output/output_file.h"

namespace vericone {
namespace {

/// What a written result says of itself.
struct Claim {
  std::vector<std::vector<Quadric>> pieces;
  std::vector<fitting::Solid> solids;  // in place of pieces
  bool certified = false;
  double coverage = 1, margin = 0;
  std::size_t points = 0, points_inside = 0, triangles = 0, triangles_inside = 0, margins_inside = 0;
};

Json read_json(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) throw InputError(path, "no readable file", "the fit.json of a fit");
  try {
    return Json::parse(text.str());
  } catch (const Json::exception&) {
    throw InputError(path, "no JSON", "the fit.json of a fit");
  }
}

std::size_t read_count(const Json& value, const char* field) {
  const std::string path = std::string("certificate.") + field;
  const Json& count = input::require_field(value, "certificate", field, "a whole number");
  if (count.is_null()) return 0;
  if (!count.is_number_unsigned()) throw InputError(path, input::quoted(count), "a whole number");
  return count.get<std::size_t>();
}

std::vector<Quadric> read_quadrics(const Json& piece, const std::string& path) {
  input::require_object(piece, path);
  const Json& list = input::require_field(piece, path, "quadrics", "a list of symmetric 4x4 matrices");
  const std::string field = path + ".quadrics";
  if (!list.is_array() || list.empty())
    throw InputError(field, input::quoted(list), "a list of symmetric 4x4 matrices");
  std::vector<Quadric> quadrics;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Eigen::Matrix4d q = input::read_matrix<4>(list[i], input::at(field, i), "");
    quadrics.push_back(input::within(input::at(field, i), [&] { return Quadric(q); }));
  }
  return quadrics;
}

/// Its body says what is proved; other pieces have quadrics.
bool is_solid(const Json& piece) {
  return piece.is_object() && piece.contains("quadrics") && piece["quadrics"].is_null();
}

Claim claim_of(const Json& json) {
  input::require_object(json, "the result");
  const Json& pieces = input::require_field(json, "", "pieces", "a list of pieces, each with quadrics");
  if (!pieces.is_array() || pieces.empty())
    throw InputError("pieces", input::quoted(pieces), "a list of pieces, each with quadrics");
  Claim claim;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string path = input::at("pieces", i);
    if (is_solid(pieces[i]))
      claim.solids.push_back(
          fit::solid_of(input::require_field(pieces[i], path, "body", "a body"), path + ".body"));
    else
      claim.pieces.push_back(read_quadrics(pieces[i], path));
  }
  if (!claim.pieces.empty() && !claim.solids.empty())
    throw InputError("pieces", "some with quadrics", "all or none with quadrics");
  const Json& certified = input::require_field(json, "", "certified", "true or false");
  if (!certified.is_boolean()) throw InputError("certified", input::quoted(certified), "true or false");
  claim.certified = certified.get<bool>();
  if (const Json& c = input::require_field(json, "", "coverage", "a share or null"); !c.is_null())
    claim.coverage = input::read_number(c, "coverage", "");
  claim.margin =
      input::read_number(input::require_field(json, "", "margin", "metres"), "margin", " (metres)");
  const Json& certificate = input::require_field(json, "", "certificate", "what is claimed");
  input::require_object(certificate, "certificate");
  claim.points = read_count(certificate, "points");
  claim.points_inside = read_count(certificate, "points_inside");
  claim.triangles = read_count(certificate, "triangles");
  claim.triangles_inside = read_count(certificate, "triangles_inside");
  claim.margins_inside = read_count(certificate, "margins_inside");
  return claim;
}

fitting::Certificate found_of(const Claim& claim, const fitting::Sample& sample) {
  return claim.solids.empty() ? fitting::check(claim.pieces, sample, claim.margin)
                              : fitting::check(claim.solids, sample, claim.margin);
}

bool holds(const Claim& claim, const fitting::Certificate& found) {
  return claim.certified && found.points == claim.points && found.triangles == claim.triangles &&
         found.points_inside >= claim.points_inside && found.triangles_inside >= claim.triangles_inside &&
         found.margins_inside >= claim.margins_inside && found.coverage() >= claim.coverage;
}

Json found_json(const Claim& claim, const fitting::Certificate& found) {
  return {{"holds", holds(claim, found)},
          {"claimed", claim.certified},
          {"points", found.points},
          {"points_inside", found.points_inside},
          {"triangles", found.triangles},
          {"triangles_inside", found.triangles_inside},
          {"margin", claim.margin},
          {"margins_inside", found.margins_inside},
          {"points_outside", found.points - found.points_inside},
          {"triangles_outside", found.triangles - found.triangles_inside},
          {"by_exact", found.by_exact}};
}

void add_certificate(Json& answer, const fitting::InsideCertificate& proved, const std::string& file) {
  answer["certificate"] = proved.text.empty() ? Json(nullptr) : Json(file);
  if (proved.text.empty()) answer["no_certificate"] = proved.reason;
}

}  // namespace

int check_fit(const std::string& file, const std::string& result, const std::string& certificate, bool json,
              std::ostream& out) {
  const Json written = read_json(result);
  const Claim claim = [&] {
    try {
      return claim_of(written);
    } catch (const InputError& e) {
      throw InputError(result, e.field() + ": " + e.value(), e.requirement());
    }
  }();
  const fits::Scan scan = fits::read_scan(file);
  const fitting::Certificate found = found_of(claim, scan.sample);
  const bool good = holds(claim, found);
  fitting::InsideCertificate proved;
  if (!certificate.empty())
    proved = claim.solids.empty() ? fitting::inside_certificate(claim.pieces, scan.sample)
                                  : fitting::inside_certificate(claim.solids, scan.sample);
  if (!proved.text.empty()) write_whole(certificate, proved.text + "\n");
  if (json) {
    Json answer = found_json(claim, found);
    if (!certificate.empty()) add_certificate(answer, proved, certificate);
    out << answer.dump(1) << '\n';
    return good ? 0 : 1;
  }
  const auto row = [&](const char* label, std::size_t inside, std::size_t all) {
    out << label << inside << " of " << all << " inside, " << all - inside << " outside\n";
  };
  out << "scan                " << fits::describe(scan) << '\n';
  row("points              ", found.points_inside, found.points);
  if (scan.sample.is_mesh()) row("triangles           ", found.triangles_inside, found.triangles);
  if (claim.margin > 0) row("with the margin     ", found.margins_inside, found.points);
  out << "decided             in exact arithmetic, " << found.by_exact << " of them beyond intervals\n"
      << "certificate         "
      << (good              ? "holds"
          : claim.certified ? "does NOT hold"
                            : "claims nothing")
      << " (" << result << ")\n";
  if (!proved.text.empty()) out << "written             " << certificate << '\n';
  if (!proved.reason.empty()) out << "not written         " << proved.reason << '\n';
  return good ? 0 : 1;
}

}  // namespace vericone
