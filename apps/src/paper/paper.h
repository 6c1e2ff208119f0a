// SPDX-License-Identifier: BSD-3-Clause
//
// A paper: a folder with scenarios, figures.yaml, claims.yaml and references.bib (docs/reference/papers.md).
#pragma once

#include <vericone/geometry/error.h>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "json/json_value.h"
#include "paper/claim.h"
#include "simulate/run_text.h"

namespace vericone::paper {

/// `make()`, with the name of a file before the field of an error: "claims.yaml: claims[3].ours".
template <typename Make>
auto naming(const std::string& file, Make make) -> decltype(make()) {
  try {
    return make();
  } catch (const InputError& e) {
    throw InputError(file + ": " + e.field(), e.value(), e.requirement());
  }
}

/// A curve of a panel, or one for each word of a column.
struct Line {
  Series series;
  std::string each;  // column of words; empty: one line
  std::string name;  // in the legend; empty: the word, or the body
  Expression x, y;
  bool dashed = false, filled = false;
};

struct Panel {
  Json look;  // label and what else the drawing is told
  std::vector<Line> lines;
};

/// A figure as it stands in figures.yaml. One of panels, drawing, script and command says how it is made.
struct Figure {
  std::string id;                                         // of the source, "5.6"; of ours "laws-6.5"
  std::string caption;                                    // in our words
  std::vector<std::pair<std::string, std::string>> runs;  // role and scenario
  std::vector<std::pair<std::string, std::string>> data;  // role and command, whose tables a script reads
  std::vector<Panel> panels;
  std::string drawing, script;          // one of ours for all papers; one in the paper's folder figures
  std::string command, picture, table;  // of another command: its files
  Json parameters;                      // what a drawing or script is told beyond the runs
  double columns = 0;                   // 1 or 2 of a page; 0: by the number of panels

  std::string name() const { return "fig-" + id; }  // of its files, without extension
};

class Paper {
 public:
  /// Reads and checks both files; a claim's figures have to be there. `given`: papers_folder.h. Throws
  /// InputError naming the file and the field.
  explicit Paper(const std::string& given);

  std::filesystem::path folder;
  std::string title, references;  // of the report; the text of references.bib
  std::vector<Figure> figures;
  Scope figure_values;

  std::string name() const {
    return std::filesystem::absolute(folder).lexically_normal().filename().string();
  }
  /// In the file's order; all where `ids` is empty. An id also names those below it: 7 is 7.1, 7.2, ...
  /// Throws InputError naming "figures".
  std::vector<Figure> chosen(const std::vector<std::string>& ids) const;
  const std::vector<ClaimEntry>& claims() const { return claims_.entries; }
  const std::vector<std::shared_ptr<Fit>>& fits() const { return claims_.fits; }
  /// Those that `ids` name, by their own id or by a section: 7 is all of chapter 7. All where it is empty.
  /// Throws InputError naming "claims".
  Which claims_named(const std::vector<std::string>& ids) const;
  std::vector<Claim> measured_claims(Sources& sources, const Which& which);
  [[nodiscard]] std::map<std::string, int> left_out(const Which& which) const {
    return paper::left_out(claims_, which);
  }

 private:
  ClaimsFile claims_;
};

/// What the figures or the claims of a paper's file are, one a line, in plain words.
void describe(const Paper& paper, const std::string& file, scenario::Facts& facts);

/// The parts that figures.yaml is made of. Throws InputError naming the field.
std::vector<Figure> read_figures(const Json& fields);

/// What claims.json holds. `changed`: null, or inputs that are not the paper's.
Json claims_json(const std::vector<Claim>& claims, const Paper& paper, const Which& which,
                 const std::string& command_line, const Json& changed);

}  // namespace vericone::paper
