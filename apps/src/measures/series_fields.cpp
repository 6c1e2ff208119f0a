// SPDX-License-Identifier: BSD-3-Clause
#include "measures/series_fields.h"

namespace vericone::paper {

using input::required;

Json text_schema() { return {{"type", "string"}}; }
Json number_schema() { return {{"type", "number"}}; }
Json mapping_schema() { return {{"type", "object"}}; }

Json reference(const char* name) { return {{"$ref", std::string("#/$defs/") + name}}; }
Json either(const char* title, Json one, Json other) {
  return {{"title", title}, {"anyOf", {std::move(one), std::move(other)}}};
}
Json formula() { return either("formula", text_schema(), number_schema()); }
Json list_of(Json items, int least) {
  Json list{{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) list["minItems"] = least;
  return list;
}
Json texts() { return either("text, or a list of it", text_schema(), list_of(text_schema())); }
Json numbers() { return either("number, or a list of them", number_schema(), list_of(number_schema(), 1)); }

/// Which rows of a series, of the table.
PaperFields& with_series(PaperFields& rows) {
  rows.special("run", text_schema(), {},
               "A scenario, by the name of its file in scenarios without extension.")
      .special("command", text_schema(), {},
               "A command of vericone, without --out, carried out in the paper's folder.")
      .special("table", text_schema(), {},
               "bodies, encounters, planes, events, looks or proofs of a run; a CSV file of a command.");
  for (const char* column : {"body", "agent", "obstacle", "orifice", "event", "status"})
    rows.special(column, text_schema(), {}, "Only rows with this word in the column.");
  return rows.special("trial", reference("trial"), {}, "The table of a trial.")
      .special("ascent", reference("ascent"), {}, "The table of an ascent.")
      .special("range", reference("range"), {}, "Numbers s, evenly spaced.")
      .special("beside", mapping_schema(), {},
               "Names and series: the columns of the row with the same t, as NAME.column.")
      .special("with", mapping_schema(), {}, "Names and their formulas.")
      .special("where", formula(), {}, "Only rows where it holds.");
}

const PaperFields& series_fields() {
  static const PaperFields fields = [] {
    PaperFields rows("series");
    return with_series(rows);
  }();
  return fields;
}

const PaperFields& value_fields() {
  static const PaperFields fields = [] {
    PaperFields rows("value");
    with_series(rows);
    for (const auto& [name, sentence] :
         {std::pair("first", "Of the formula over the rows: in the first row."),
          std::pair("last", "Of the formula over the rows: in the last row."),
          std::pair("least", "Of the formula over the rows: the least."),
          std::pair("greatest", "Of the formula over the rows: the greatest."),
          std::pair("mean", "Of the formula over the rows: the mean."),
          std::pair("sum", "Of the formula over the rows: the sum."),
          std::pair("count", "Of the formula over the rows: rows where it holds.")})
      rows.special(name, formula(), {}, sentence);
    return rows
        .special("field", texts(), {},
                 "A number of the scenario, or of what the command prints with --json: a path, or paths of "
                 "which the first that is there counts.")
        .special("length", texts(), {},
                 "The number of elements of a list there: a path, or paths of which the first that is there "
                 "counts.")
        .special("course", formula(), {},
                 "Whether agent and obstacle are on a collision course at that time, s.");
  }();
  return fields;
}

const PaperFields& trial_fields() {
  static const PaperFields fields =
      PaperFields("trial")
          .special("until", input::positive("s").schema, {}, "The end.")
          .special("sets", list_of(mapping_schema(), 1), {}, "Parameters by name, all sets the same ones.")
          .special("with", mapping_schema(), {}, "Names and their formulas.")
          .special("command", formula(), {}, "Acceleration of the agent, m/s^2, positive to the left.");
  return fields;
}

const input::Fields<Ascent>& ascent_fields() {
  using A = Ascent;
  static const input::Fields<A> fields =
      input::Fields<A>("ascent")
          .row("boxes", &A::boxes, input::list("numbers of boxes", input::count(1, 10'000), 1),
               "How many boxes, of 5 by 2 m in a square of 100 m.", required("a list of numbers of boxes"))
          .row("draws", &A::draws, input::count(1, 1000), "Of each number of boxes.")
          .row("tolerance", &A::tolerance, input::positive(), "Of the area, relative.",
               required("a positive number, of the area"))
          .row("seed", &A::seed, input::count(0, 2'000'000'000), "Of the places and attitudes.");
  return fields;
}

const PaperFields& range_fields() {
  static const PaperFields fields = PaperFields("range")
                                        .special("from", formula(), {}, "The first.")
                                        .special("to", formula(), {}, "The last.")
                                        .special("count", input::count(2, 100'000).schema, {}, "How many.");
  return fields;
}

}  // namespace vericone::paper
