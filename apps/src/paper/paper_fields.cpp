// SPDX-License-Identifier: BSD-3-Clause
#include "paper/paper_fields.h"

#include "output/schemas.h"
#include "paper/claim.h"

namespace vericone::paper {
namespace {

using input::required;

Json schema_like(const PaperFields& fields) {
  Json schema = fields.schema(), like = texts();
  like["description"] =
      "The name of a template, or a list of names: all fields that this does not have itself.";
  schema["properties"]["like"] = std::move(like);
  schema.erase("required");  // a template may have them
  return schema;
}

/// A file whose entries may take from templates; `names` are those of its $defs that are its own.
Json file_schema(const PaperFields& file, const char* title, Json names) {
  const PaperFields of = PaperFields("of")
                             .special("run", text_schema(), {}, "A scenario.")
                             .special("agent", text_schema(), {}, "As of a series.")
                             .special("obstacle", text_schema(), {}, "As of a series.")
                             .special("orifice", text_schema(), {}, "As of a series.")
                             .special("body", text_schema(), {}, "As of a series.");
  names.update({{"of", of.schema()},
                {"trial", trial_fields().schema()},
                {"ascent", ascent_fields().schema()},
                {"range", range_fields().schema()}});
  Json schema = file.schema();
  schema["properties"]["templates"] = {{"type", "object"},
                                       {"description", "What entries have in common, by name."}};
  schema["$defs"] = std::move(names);
  return input::schema_of(title, "docs/reference/papers.md", std::move(schema));
}

Json text() {
  const Json part{{"type", "object"},
                  {"properties", {{"if", formula()}, {"text", text_schema()}}},
                  {"required", {"if", "text"}},
                  {"additionalProperties", false}};
  return either("text, or a list of parts", text_schema(),
                list_of(either("text, or a part", text_schema(), part)));
}

}  // namespace

input::Value<std::string> drawings() {
  return input::choice<std::string>({{"plane_trajectory", "plane_trajectory"},
                                     {"plane_snapshots", "plane_snapshots"},
                                     {"space_trajectory", "space_trajectory"},
                                     {"planes", "planes"}});
}

input::Value<Verdict> otherwise_verdict() {
  return input::choice<Verdict>({{"differs", Verdict::differs},
                                 {"not decided", Verdict::not_decided},
                                 {"source wrong", Verdict::source_wrong}});
}

const PaperFields& line_fields() {
  static const PaperFields fields = [] {
    PaperFields rows("line");
    return with_series(rows)
        .special("each", text_schema(), {}, "A column of words: a curve for each word in it.")
        .special("name", text_schema(), {}, "In the legend.")
        .special("x", formula(), {}, "Of the columns; t, or s of a range, if left out.")
        .special("y", formula(), {}, "Of the columns.")
        .special("dashed", input::flag().schema, {}, "How it is drawn.")
        .special("filled", input::flag().schema, {}, "The same.");
  }();
  return fields;
}

const PaperFields& look_fields() {
  static const PaperFields fields =
      PaperFields("panel")
          .special("label", text_schema(), {}, "Of the axis, with its unit.")
          .special("x_label", text_schema(), {}, "Where x is no time.")
          .special("zero", input::flag().schema, {}, "With a line at 0.")
          .special("equal", input::flag().schema, {}, "Both axes in one scale.")
          .special("symlog", input::positive().schema, {},
                   "A logarithmic axis to both sides, linear below this.")
          .special("least_height", input::positive().schema, {}, "Of the axis.");
  return fields;
}

const PaperFields& figure_fields() {
  static const PaperFields fields =
      PaperFields("figure")
          .special("id", text_schema(), {}, "The figure's number or name, in quotes.")
          .special("caption", text_schema(), {}, "What it shows, in our words.")
          .special("runs", mapping_schema(), {}, "Scenarios, each by a role.")
          .special("data", mapping_schema(), {},
                   "Commands of vericone, without --out, each by a role; a script reads what they write.")
          .special("of", reference("of"), {}, "What all curves that do not say otherwise are taken from.")
          .special("panels", list_of(reference("panel"), 1), {}, "Curves, one panel above the other.")
          .special("drawing", drawings().schema, {}, "Of the paths of a run.")
          .special("script", text_schema(), {}, "A file in the paper's figures.")
          .special("command", text_schema(), {}, "A command of vericone, one that draws, without --out.")
          .special("picture", text_schema(), {}, "Which of its pictures, without extension.")
          .special("table", text_schema(), {}, "Which of its tables.")
          .special("parameters", mapping_schema(), {}, "What a drawing or script is told.")
          .special("columns", input::count(1, 2).schema, {}, "Of the report, that it takes.");
  return fields;
}

const PaperFields& figures_file_fields() {
  static const PaperFields fields =
      PaperFields("figures")
          .special("title", text_schema(), {}, "What the report is called.",
                   required("what the report is called, as text"))
          .special("values", mapping_schema(), {}, "Names and what they stand for.")
          .special("figures", list_of(reference("figure"), 1), {}, "In the order of the report.",
                   required("a list of figures"));
  return fields;
}

const PaperFields& claim_fields() {
  static const PaperFields fields =
      PaperFields("claim")
          .special("id", text_schema(), {}, "A name of the claim's own.")
          .special("section", text_schema(), {}, "Where the paper prints it.")
          .special("figures", list_of(text_schema(), 1), {},
                   "Ids of the figures beside which the report shows it.")
          .special("what", text_schema(), {}, "What is printed, in words.")
          .special("printed", either("text, or numbers", text_schema(), list_of(number_schema(), 1)), {},
                   "As printed, in quotes; of what goes in also a list of numbers.")
          .special("unit", text_schema(), {}, "Of the number.")
          .special("given", input::flag().schema, {}, "Goes into the run, or is ordered by the scenario.")
          .special("code", input::flag().schema, {},
                   "Rests on values that are not printed but stand in the authors' program.")
          .special("ours", {{"anyOf", {text_schema(), number_schema(), list_of(formula())}}}, {},
                   "Formula of our number; as many as numbers are printed.")
          .special("holds", formula(), {}, "Whether the statement holds.")
          .special("text", text(), {}, "What the report says of it; {FORMULA:3} is a number in three digits.")
          .special("tolerance", reference("tolerance"), {}, "Within which ours agrees.",
                   input::absent("half a unit of the last printed digit"))
          .special("fit", texts(), {}, "Names of fits on which it rests, met or not.")
          .special("otherwise", otherwise_verdict().schema, {}, "The verdict where it does not agree.")
          .special("engaged", formula(), {}, "Where it does not hold the verdict is not engaged.")
          .special("note", text(), {}, "What else is to be said.")
          .special("values", mapping_schema(), {},
                   "Names and what they stand for: formulas, or numbers taken from tables.")
          .special("of", reference("of"), {}, "What all values that do not say otherwise are taken from.")
          .special("needs", text_schema(), {},
                   "A command in a program of its own: where that is not there, the claim is not measured.");
  return fields;
}

const PaperFields& body_claim_fields() {
  static const PaperFields fields =
      PaperFields("body")
          .special("body", text_schema(), {}, "Each printed number of it becomes a claim.")
          .special("run", text_schema(), {}, "Its scenario.")
          .special("section", text_schema(), {}, "Where the paper prints it.")
          .special("figures", list_of(text_schema(), 1), {}, "As of a claim.")
          .special("semi_axes", numbers(), {}, "As printed, m.")
          .special("k", numbers(), {}, "As printed.")
          .special("position", numbers(), {}, "As printed, m.")
          .special("speed", numbers(), {}, "As printed, m/s.")
          .special("heading_deg", numbers(), {}, "As printed, degrees.")
          .special("appears", numbers(), {}, "As printed, s.");
  return fields;
}

const PaperFields& tolerance_fields() {
  static const PaperFields fields =
      PaperFields("tolerance")
          .special("value", formula(), {}, "Of the number.", required("a number or a formula"))
          .special("reason", text(), {}, "Why so much.", required("why, as text"))
          .special("one_sided", input::flag().schema, {}, "Later or more is as good.");
  return fields;
}

const PaperFields& fit_fields() {
  static const PaperFields fields =
      PaperFields("fit")
          .special("in", texts(), {}, "Files of the paper.", required("files of the paper"))
          .special("at", texts(), {}, "Paths of the numbers.", required("paths of numbers"))
          .special("from", numbers(), {}, "The least of each.", required("a number of each"))
          .special("to", numbers(), {}, "The most of each.", required("a number of each"))
          .special("whole", input::flag().schema, {}, "Whole numbers.")
          .special("logarithmic", input::flag().schema, {}, "By their logarithms.");
  return fields;
}

const PaperFields& claims_file_fields() {
  static const PaperFields fields =
      PaperFields("claims")
          .special(
              "fits", mapping_schema(), {},
              "Values that are not printed, chosen so that printed numbers come out: by name, each how many "
              "numbers it is, or where they stand (`fit`).")
          .special("values", mapping_schema(), {}, "Names and what they stand for.")
          .special("claims", list_of(reference("claim")), {}, "In the order of the report.",
                   required("a list of claims"));
  return fields;
}

Json claims_schema() {
  Json claim = schema_like(body_claim_fields());  // a body's numbers are claims too
  claim["title"] = "claim";
  claim["properties"].update(claim_fields().schema()["properties"]);
  return file_schema(claims_file_fields(), "the claims of a paper",
                     {{"claim", std::move(claim)},
                      {"value", schema_like(value_fields())},
                      {"tolerance", tolerance_fields().schema()},
                      {"fit", fit_fields().schema()}});
}

Json figures_schema() {
  Json line = schema_like(line_fields()), panel = line;
  panel["title"] = "panel";
  panel["properties"].update(look_fields().schema()["properties"]);
  panel["properties"]["lines"] = list_of(reference("line"), 1);
  return file_schema(
      figures_file_fields(), "the figures of a paper",
      {{"figure", schema_like(figure_fields())}, {"panel", std::move(panel)}, {"line", std::move(line)}});
}

}  // namespace vericone::paper
