// SPDX-License-Identifier: BSD-3-Clause
#include "paper/paper.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <set>

#include "input/field_table.h"
#include "input/fields.h"
#include "input/scene.h"
#include "output/output_file.h"
#include "paper/paper_fields.h"
#include "paper/papers_folder.h"
#include "simulate/run_text.h"
#include "work/provenance.h"

namespace vericone::paper {
namespace {

namespace fs = std::filesystem;
using input::at, input::quoted, input::require_field, input::require_known, input::require_object;
using input::if_given, input::join;

std::string read_id(const Json& value, const std::string& path) {
  if (value.is_number()) throw InputError(path, quoted(value), "the figure's number or name, in quotes");
  const std::string id = input::text("the figure's number or name").read(value, path);
  if (id.find_first_of("/ ") != std::string::npos || id[0] == '.')
    throw InputError(path, quoted(value), "fit for the name of a file: no slash, no space, no dot first");
  return id;
}

const Json& text_field(const Json& fields, const std::string& path, const char* field, const char* what) {
  const Json& value = require_field(fields, path, field, what);
  input::text(what).read(value, join(path, field));
  return value;
}

Line read_line(const Json& fields, const std::string& path) {
  require_object(fields, path);
  line_fields().require_known(fields, path);
  Line line{read_series(fields, path), "", "",
            Expression(fields.value("x", Json(fields.contains("range") ? "s" : "t")), path + ".x"),
            Expression(require_field(fields, path, "y", "a formula of columns"), path + ".y")};
  if_given(fields, path, "each", [&](const Json& v, const std::string& p) {
    line.each = input::text("a column of words").read(v, p);
  });
  if_given(fields, path, "name",
           [&](const Json& v, const std::string& p) { line.name = input::text("a name").read(v, p); });
  if_given(fields, path, "dashed",
           [&](const Json& v, const std::string& p) { line.dashed = input::flag().read(v, p); });
  if_given(fields, path, "filled",
           [&](const Json& v, const std::string& p) { line.filled = input::flag().read(v, p); });
  return line;
}

Panel read_panel(const Json& fields, const std::string& path, const Json& of) {
  require_object(fields, path);
  Panel panel;
  Json own = Json::object();
  for (const auto& [key, value] : fields.items()) (look_fields().has(key) ? panel.look : own)[key] = value;
  for (const char* field : {"label", "x_label"})
    if_given(panel.look, path, field, [&](const Json& v, const std::string& p) {
      input::text("what the axis shows, with its unit").read(v, p);
    });
  for (const char* field : {"zero", "equal"})
    if_given(panel.look, path, field, [&](const Json& v, const std::string& p) { input::flag().read(v, p); });
  for (const char* field : {"symlog", "least_height"})
    if_given(panel.look, path, field,
             [&](const Json& v, const std::string& p) { input::positive().read(v, p); });
  text_field(fields, path, "label", "what the axis shows, with its unit, as text");
  if (!own.contains("lines")) {
    panel.lines.push_back(read_line(with_defaults(own, of), path));
    return panel;
  }
  require_known(own, path, {"lines"});
  if (!own["lines"].is_array()) throw InputError(path + ".lines", quoted(own["lines"]), "a list of lines");
  for (std::size_t i = 0; i < own["lines"].size(); ++i)
    panel.lines.push_back(read_line(with_defaults(own["lines"][i], of), at(path + ".lines", i)));
  return panel;
}

Figure read_figure(const Json& fields, const std::string& path) {
  require_object(fields, path);
  figure_fields().require_known(fields, path);
  Figure figure;
  figure.id =
      read_id(require_field(fields, path, "id", "the figure's number or name, in quotes"), path + ".id");
  figure.caption = text_field(fields, path, "caption", "what it shows, as text").get<std::string>();
  if_given(fields, path, "runs", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    for (const auto& [role, scenario] : v.items())
      figure.runs.emplace_back(role, input::text("the name of a scenario").read(scenario, p + "." + role));
  });
  if_given(fields, path, "data", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    for (const auto& [role, words] : v.items())
      figure.data.emplace_back(role, input::text("a command of vericone").read(words, p + "." + role));
  });
  int ways = 0;
  for (const auto& [field, target] :
       {std::pair("drawing", &figure.drawing), std::pair("script", &figure.script),
        std::pair("command", &figure.command)})
    if_given(fields, path, field, [&, t = target](const Json& v, const std::string& p) {
      *t = input::text("a name").read(v, p);
      ++ways;
    });
  if (!figure.drawing.empty()) figure.drawing = drawings().read(fields["drawing"], path + ".drawing");
  if_given(fields, path, "panels", [&](const Json& v, const std::string& p) {
    ++ways;
    if (!v.is_array() || v.empty()) throw InputError(p, quoted(v), "a list of panels");
    Json of = fields.value("of", Json::object());
    if (figure.runs.size() == 1 && of.is_object() && !of.contains("run")) of["run"] = figure.runs[0].second;
    for (std::size_t i = 0; i < v.size(); ++i) figure.panels.push_back(read_panel(v[i], at(p, i), of));
  });
  if (ways != 1)
    throw InputError(path, std::to_string(ways) + " of them", "one of panels, drawing, script and command");
  for (const auto& [field, target] :
       {std::pair("picture", &figure.picture), std::pair("table", &figure.table)}) {
    if (figure.command.empty() && fields.contains(field))
      throw InputError(path + "." + field, quoted(fields[field]), "given with command");
    if (fields.contains(field))
      *target = text_field(fields, path, field, "the name of a file of the command").get<std::string>();
  }
  if (!figure.command.empty() && figure.picture.empty())
    throw InputError(path + ".picture", "nothing", "the name of a picture of the command, without .png");
  if_given(fields, path, "parameters", [&](const Json& v, const std::string& p) {
    require_object(v, p);
    figure.parameters = v;
  });
  if_given(fields, path, "columns",
           [&](const Json& v, const std::string& p) { figure.columns = input::count(1, 2).read(v, p); });
  return figure;
}

/// What `read` makes of a file's fields, with the file's name before the field of an error.
template <typename Read>
auto reading(const fs::path& file, Read read) {
  const Json fields = input::read_scene_fields(file.string());
  return naming(file.filename().string(), [&] { return read(fields); });
}

}  // namespace

std::vector<Figure> read_figures(const Json& fields) {
  const Json& list = require_field(fields, "", "figures", "a list of figures");
  if (!list.is_array() || list.empty()) throw InputError("figures", quoted(list), "a list of figures");
  std::vector<Figure> figures;
  std::set<std::string> ids;
  for (std::size_t i = 0; i < list.size(); ++i) {
    figures.push_back(read_figure(list[i], at("figures", i)));
    if (!ids.insert(figures.back().id).second)
      throw InputError(at("figures", i) + ".id", figures.back().id,
                       "a name of the figure's own: another figure has it");
  }
  return figures;
}

Paper::Paper(const std::string& given) : folder(paper_folder(given)), figure_values(Json(), "") {
  reading(folder / "figures.yaml", [&](const Json& file) {
    require_object(file, "figures.yaml");
    const Json fields = with_templates(file);
    figures_file_fields().require_known(fields, "");
    title = text_field(fields, "", "title", "what the report is called, as text").get<std::string>();
    figure_values = Scope(fields.value("values", Json()), "values");
    figures = read_figures(fields);
    for (std::size_t i = 0; i < figures.size(); ++i)
      if (!figures[i].script.empty() && !fs::exists(folder / "figures" / figures[i].script))
        throw InputError(at("figures", i) + ".script", figures[i].script,
                         "a file in the paper's folder figures");
    return 0;
  });
  claims_ = reading(folder / "claims.yaml", [](const Json& file) { return read_claims(file); });
  for (const ClaimEntry& entry : claims_.entries)
    for (const std::string& id : entry.claim.figures)
      if (std::none_of(figures.begin(), figures.end(), [&](const Figure& f) { return f.id == id; }))
        throw InputError("claims.yaml: " + entry.claim.id + ".figures", id,
                         "the id of a figure of figures.yaml");
  references = content_of(folder / "references.bib");
}

Which Paper::claims_named(const std::vector<std::string>& ids) const {
  const auto names = [](const std::string& id, const Claim& claim) {
    return claim.id == id || claim.section == id || claim.id.starts_with(id + "/") ||
           claim.section.starts_with(id + ".");
  };
  for (const std::string& id : ids)
    if (std::none_of(claims_.entries.begin(), claims_.entries.end(),
                     [&](const ClaimEntry& entry) { return names(id, entry.claim); }))
      throw InputError("claims", id, "a claim or a section of " + (folder / "claims.yaml").string());
  return [ids, names](const Claim& claim) {
    return ids.empty() ||
           std::any_of(ids.begin(), ids.end(), [&](const std::string& id) { return names(id, claim); });
  };
}

std::vector<Claim> Paper::measured_claims(Sources& sources, const Which& which) {
  return naming("claims.yaml", [&] { return measure(claims_, sources, which); });
}

std::vector<Figure> Paper::chosen(const std::vector<std::string>& ids) const {
  // "7" is all of chapter 7: 7.1, 7.2, ...
  const auto names = [](const std::string& id, const Figure& f) {
    return f.id == id || f.id.starts_with(id + ".");
  };
  for (const std::string& id : ids) {
    if (std::any_of(figures.begin(), figures.end(), [&](const Figure& f) { return names(id, f); })) continue;
    std::string known;
    for (const Figure& f : figures) known.append(known.empty() ? "" : ", ").append(f.id);
    throw InputError("figures", id, "among " + known);
  }
  std::vector<Figure> list;
  for (const Figure& figure : figures)
    if (ids.empty() ||
        std::any_of(ids.begin(), ids.end(), [&](const std::string& id) { return names(id, figure); }))
      list.push_back(figure);
  return list;
}

void describe(const Paper& paper, const std::string& file, scenario::Facts& facts) {
  facts.add("paper", paper.title);
  if (fs::path(file).filename() == "figures.yaml")
    for (const Figure& figure : paper.figures) {
      std::string runs;
      for (const auto& [role, run] : figure.runs) runs.append(runs.empty() ? " of " : ", ").append(run);
      const std::string how = !figure.command.empty()  ? "by vericone " + figure.command
                              : !figure.script.empty() ? "by figures/" + figure.script
                              : figure.panels.empty()  ? figure.drawing
                                                       : std::to_string(figure.panels.size()) + " panels";
      facts.add(figure.id, how + runs);
    }
  else
    for (const ClaimEntry& entry : paper.claims()) {
      const Claim& claim = entry.claim;
      std::string fits;
      for (const auto& fit : claim.fits) fits += "; rests on the fit " + fit->name;
      facts.add(claim.id, std::string(claim.kind == Kind::given ? "goes in: "
                                      : entry.holds             ? "a statement: "
                                                                : "a number: ") +
                              claim.printed + fits + "; if it does not agree: " + to_string(entry.otherwise));
    }
}

Json claims_json(const std::vector<Claim>& claims, const Paper& paper, const Which& which,
                 const std::string& command_line, const Json& changed) {
  Json list = Json::array();
  for (const Claim& claim : claims) list.push_back(to_json(claim));
  Json origin = provenance(command_line, 1, files_of(paper.folder));
  if (!changed.is_null()) origin["changed"] = changed;
  Json result{{"claims", list}, {"verdicts", count_verdicts(claims)}, {"provenance", origin}};
  if (const auto missing = paper.left_out(which); !missing.empty()) result["not_measured"] = missing;
  return result;
}

}  // namespace vericone::paper
