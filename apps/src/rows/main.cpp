// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone-rows`, which links HDF5 (BSD): large tables from text to HDF5 and back, and what is
// in them.
#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command/program.h"
#include "json/json_value.h"
#include "json/plain_text.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "rows/csv_rows.h"
#include "rows/hdf5_table.h"

namespace vericone::rows {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostWords = 1000, kMostColumns = 1024;

std::optional<double> number_in(std::string_view cell) {
  double x = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
  // As it would be written again, so that going there and back changes no byte.
  if (error != std::errc() || end != cell.data() + cell.size() || std::isnan(x)) return std::nullopt;
  return to_text(x) == cell ? std::optional(x) : std::nullopt;
}

/// As an integer is written, of a magnitude that a double holds.
std::optional<double> whole_in(std::string_view cell) {
  std::int64_t n = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), n);
  if (error != std::errc() || end != cell.data() + cell.size() || std::abs(double(n)) >= 0x1p53)
    return std::nullopt;
  return std::to_string(n) == cell ? std::optional(double(n)) : std::nullopt;
}

/// What stands in a column, found in a first reading.
struct Column {
  ColumnKind kind;
  std::map<std::string, std::uint16_t, std::less<>> words;
  bool whole = true, numbers = true, few = true;  // few words, none that an enumeration cannot hold
  std::size_t bytes = 0;                          // of the words
  std::uint64_t filled = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0;

  void look(std::string_view cell) {
    kind.width = std::max(kind.width, cell.size());
    if (few && !words.contains(cell)) {
      bytes += cell.size() + 8;
      few = words.size() < kMostWords && bytes <= kLongestWords && cell != "(empty)";
      if (few) {
        words.emplace(cell, std::uint16_t(words.size()));
        kind.words.emplace_back(cell);
      }
    }
    if (cell.empty()) whole = false;
    if (cell.empty() || (!whole && !numbers)) return;
    const auto n = whole ? whole_in(cell) : std::nullopt;
    whole = n.has_value();
    // Integers and doubles differ from 100000 on (1e+05), and a table has either in a column.
    std::optional<double> x = n && std::abs(*n) < 1e5 ? n : std::nullopt;
    if (numbers && !x) x = number_in(cell);
    numbers = numbers && x;
    if (whole || numbers) add(whole ? *n : *x);
  }
  void settle(std::uint64_t rows) {
    kind.cell = whole ? Cell::whole : Cell::number;
    if ((!whole && !numbers) || (rows > 0 && filled == 0)) kind.cell = few ? Cell::word : Cell::text;
    if (kind.cell != Cell::word) kind.words.clear();
  }
  void add(double x) {
    if (std::isnan(x)) return;
    ++filled;
    least = std::min(least, x);
    most = std::max(most, x);
    sum += x;
  }
};

struct Found {
  std::string comments;
  std::vector<Column> columns;
  std::uint64_t rows = 0;
};

Found look_csv(const std::string& file, Progress& progress) {
  Found found;
  const auto refuse = [&](const std::string& where, const std::string& got, const std::string& requirement) {
    throw InputError(plain_text(file) + where, got, requirement);
  };
  read_csv(
      file,
      [&](const Heading& heading) {
        for (const std::string& line : heading.comments) found.comments += line + "\n";
        if (found.comments.size() > kLongestComments)
          refuse(": the lines before the names", std::to_string(found.comments.size()) + " bytes",
                 "at most " + std::to_string(kLongestComments));
        if (heading.columns.size() > kMostColumns)
          refuse("", std::to_string(heading.columns.size()) + " columns",
                 "at most " + std::to_string(kMostColumns));
        for (const std::string& name : heading.columns) {
          if (name.size() > kLongestName)
            refuse(": column " + name.substr(0, 20) + "...",
                   "a name of " + std::to_string(name.size()) + " bytes",
                   "at most " + std::to_string(kLongestName));
          found.columns.emplace_back().kind.name = name;
        }
      },
      [&](const std::vector<std::string_view>& cells, std::uint64_t line, double share) {
        ++found.rows;
        for (std::size_t k = 0; k < cells.size(); ++k) found.columns[k].look(cells[k]);
        if (line % kBlock == 0) progress.show("reading", share);
      });
  for (Column& column : found.columns) column.settle(found.rows);
  return found;
}

void csv_to_hdf5(const std::string& file, const Found& found, const fs::path& to, Progress& progress) {
  std::vector<ColumnKind> kinds;
  for (const Column& column : found.columns) kinds.push_back(column.kind);
  if (const std::size_t bytes = bytes_of(kinds); bytes > kLongestRow) {
    const auto widest =
        std::max_element(kinds.begin(), kinds.end(), [](const ColumnKind& a, const ColumnKind& b) {
          return (a.cell == Cell::text ? a.width : 0) < (b.cell == Cell::text ? b.width : 0);
        });
    throw InputError(plain_text(file) + ": column " + widest->name,
                     "rows of " + std::to_string(bytes) + " bytes",
                     "at most " + std::to_string(kLongestRow) + " (8 a number, of texts the longest)");
  }
  Hdf5Writer out(to.string(), found.comments, kinds);
  std::vector<Cells> block(kinds.size());
  std::size_t held = 0;
  std::uint64_t rows = 0;
  const auto changed = [&](std::uint64_t line) {
    throw InputError(plain_text(file) + ": line " + std::to_string(line), "another text than a moment ago",
                     "a table that nothing writes to");
  };
  const auto flush = [&] {
    if (held > 0) out.append(block, held);
    held = 0;
    for (Cells& cells : block) {
      cells.numbers.clear();
      cells.words.clear();
      cells.text.clear();
    }
  };
  read_csv(
      file,
      [&](const Heading& heading) {
        for (std::size_t k = 0; k < std::max(kinds.size(), heading.columns.size()); ++k)
          if (heading.columns.size() != kinds.size() || heading.columns[k] != kinds[k].name) changed(1);
      },
      [&](const std::vector<std::string_view>& cells, std::uint64_t line, double share) {
        for (std::size_t k = 0; k < cells.size(); ++k) {
          const ColumnKind& kind = kinds[k];
          if (kind.cell == Cell::word) {
            const auto word = found.columns[k].words.find(cells[k]);
            if (word == found.columns[k].words.end()) changed(line);
            block[k].words.push_back(word->second);
          } else if (kind.cell == Cell::text) {
            if (cells[k].size() > kind.width) changed(line);
            block[k].text.append(cells[k]).append(kind.width - cells[k].size(), '\0');
          } else {
            const auto x = kind.cell == Cell::whole ? whole_in(cells[k]) : number_in(cells[k]);
            if (!x && (kind.cell == Cell::whole || !cells[k].empty())) changed(line);
            block[k].numbers.push_back(x.value_or(std::numeric_limits<double>::quiet_NaN()));
          }
        }
        ++rows;
        if (++held < kBlock) return;
        flush();
        progress.show("packing", share);
      });
  if (rows != found.rows) changed(rows);
  flush();
  out.close();
}

/// A row's cell as the table has it.
void add_cell(const ColumnKind& kind, const Cells& cells, std::size_t row, std::string& text) {
  if (kind.cell == Cell::word) {
    text += kind.words[cells.words[row]];
  } else if (kind.cell == Cell::text) {
    const std::string_view all(cells.text.data() + row * kind.width, kind.width);
    text += all.substr(0, std::min(all.find('\0'), all.size()));
  } else if (const double x = cells.numbers[row]; !std::isnan(x)) {
    text += kind.cell == Cell::whole ? std::to_string(std::int64_t(x)) : to_text(x);
  }
}

Found look_hdf5(const std::string& file, OutputFile* out, Progress& progress) {
  const Hdf5Reader in(file);
  const std::vector<ColumnKind>& kinds = in.columns();
  Found found{in.comments(), {}, in.rows()};
  std::string text = in.comments();
  for (const ColumnKind& kind : kinds) {
    text += (found.columns.empty() ? "" : ",") + kind.name;
    found.columns.emplace_back().kind = kind;
  }
  text += '\n';
  for (std::uint64_t first = 0; first < in.rows(); first += kBlock) {
    checkpoint();
    const std::vector<Cells> block = in.read(first);
    const auto rows = std::size_t(std::min<std::uint64_t>(kBlock, in.rows() - first));
    for (std::size_t k = 0; k < block.size(); ++k)
      for (const double x : block[k].numbers) found.columns[k].add(x);
    for (std::size_t i = 0; out && i < rows; ++i)
      for (std::size_t k = 0; k < block.size(); ++k) {
        const std::size_t begin = text.size();
        add_cell(kinds[k], block[k], i, text);
        if (kinds[k].cell == Cell::text && !is_cell(std::string_view(text).substr(begin)))
          throw InputError(
              plain_text(file) + ": column " + kinds[k].name + ", row " + std::to_string(first + i + 1),
              "bytes that are no cell of a table", "as vericone-rows wrote them");
        text += k + 1 < block.size() ? ',' : '\n';
      }
    if (out) out->write(text);
    text.clear();
    if (in.rows() > kBlock) progress.show("unpacking", double(first + rows) / double(in.rows()));
  }
  if (out) out->write(text);
  return found;
}

Json to_json(const Found& found) {
  Json columns = Json::array();
  for (const Column& column : found.columns) {
    Json one{{"name", column.kind.name}};
    if (column.kind.cell == Cell::text) {
      one["longest"] = column.kind.width;
    } else if (column.kind.cell == Cell::word) {
      one["words"] = column.kind.words;
    } else {
      one["numbers"] = column.filled;
      one["least"] = column.filled ? Json(column.least) : Json(nullptr);
      one["most"] = column.filled ? Json(column.most) : Json(nullptr);
      one["sum"] = column.sum;
    }
    columns.push_back(std::move(one));
  }
  return {{"rows", found.rows}, {"columns", columns}};
}

void print(const Found& found) {
  std::cout << found.rows << " rows\n";
  for (const Column& column : found.columns) {
    std::cout << "  " << plain_text(column.kind.name) << ": ";
    if (column.kind.cell == Cell::text) {
      std::cout << "texts of at most " << column.kind.width << " bytes";
    } else if (column.kind.cell != Cell::word) {
      std::cout << column.filled << " numbers";
      if (column.filled > 0)
        std::cout << " from " << to_text(column.least) << " to " << to_text(column.most) << ", mean "
                  << to_text(column.sum / double(column.filled));
    } else {
      for (std::size_t i = 0; i < column.kind.words.size() && i < 8; ++i)
        std::cout << (i ? ", " : "")
                  << (column.kind.words[i].empty() ? "(empty)" : plain_text(column.kind.words[i]));
      if (column.kind.words.size() > 8) std::cout << ", ... (" << column.kind.words.size() << " words)";
    }
    std::cout << '\n';
  }
}

int rows_command(CommandLine& line) {
  std::string file, out;
  bool json = false, quiet = false;
  line.option("table", file, "A table, CSV as commands write it, or HDF5").required();
  line.option("--out", out, "Write it here: NAME.h5 or NAME.csv; each gives back the other byte for byte");
  line.flag("--json", json, "Print JSON");
  line.flag("--quiet", quiet, "No progress");
  line.read();
  const bool from_hdf5 = is_hdf5(file);
  const std::string extension = fs::path(out).extension().string();
  if (!out.empty() && extension != ".h5" && extension != ".csv")
    throw InputError("--out", out, "NAME.h5 or NAME.csv");
  if (!out.empty() && (extension == ".h5") == from_hdf5)
    throw InputError("--out", out, from_hdf5 ? "NAME.csv: the table is HDF5" : "NAME.h5: the table is text");
  std::optional<work::StagedFolder> folder;
  fs::path staged;
  if (!out.empty()) {
    folder.emplace(fs::path(out).has_parent_path() ? fs::path(out).parent_path() : fs::path("."), "--out");
    staged = folder->path() / fs::path(out).filename();
  }
  Found found;
  {
    Progress progress(quiet);
    if (from_hdf5) {
      std::optional<OutputFile> text;
      if (folder) text.emplace(staged);
      found = look_hdf5(file, text ? &*text : nullptr, progress);
      if (text) text->close();
    } else {
      found = look_csv(file, progress);
      if (folder) csv_to_hdf5(file, found, staged, progress);
    }
  }
  if (folder) folder->publish();
  if (json)
    std::cout << to_json(found).dump(1) << '\n';
  else
    print(found);
  return 0;
}

}  // namespace
}  // namespace vericone::rows

int main(int argc, char** argv) {
  return vericone::run_program(argc, argv, "rows", vericone::rows::rows_command);
}
