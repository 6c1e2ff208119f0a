// SPDX-License-Identifier: BSD-3-Clause
#include "paper/report.h"

#include <algorithm>
#include <cstdint>
#include <sstream>

namespace vericone::paper {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, sans-serif; color: #1d1d1f; background: #fff; margin: 2rem auto; max-width: 64rem;
  padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.5rem; border-top: 1px solid #ddd; padding-top: 1rem; }
figure { margin: 0; } img { max-width: 100%; height: auto; }
figcaption { color: #444; margin: .3rem 0 1rem; max-width: 52rem; }
table { border-collapse: collapse; width: 100%; font-size: .86rem; margin: .5rem 0; }
th, td { text-align: left; vertical-align: top; padding: .25rem .6rem .25rem 0; border-bottom: 1px solid #eee; }
th { font-weight: 600; } td.n { color: #555; }
.v { white-space: nowrap; padding: .05rem .4rem; border-radius: .3rem; }
.reproduced { background: #dff1e2; } .differs { background: #fbe0d4; } .not { background: #f0ecda; }
.source { background: #eadff3; } .weak { background: #e3ebf3; }
details { margin: .4rem 0; } summary { cursor: pointer; color: #333; } pre { font-size: .75rem; overflow-x: auto;
  background: #f7f7f7; padding: .6rem; }
nav { font-size: .9rem; display: flex; flex-wrap: wrap; gap: .4rem .8rem; }
.scroll { overflow-x: auto; max-width: 100%; } .scroll table { min-width: 44rem; }
code { overflow-wrap: anywhere; }
@media print { body { max-width: none; margin: 0; font-size: 10pt; } nav { display: none; } figure { break-inside: avoid; }
  img { max-height: 20cm; } .scroll { overflow: visible; } .scroll table { min-width: 0; } tr { break-inside: avoid; }
  pre { white-space: pre-wrap; } }
@media (max-width: 40rem) { body { margin: 1rem auto; padding: 0 .6rem; } nav { font-size: 1rem; gap: .6rem 1rem; } }
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j > bytes.size() ? '=' : kDigits[group >> (18 - 6 * j) & 63];
  }
  return text;
}

const char* css_class(Verdict verdict) {
  switch (verdict) {
    case Verdict::given:
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::fitted:
    case Verdict::not_engaged:
      return "weak";
    case Verdict::differs:
      return "differs";
    case Verdict::not_decided:
      return "not";
    case Verdict::source_wrong:
      return "source";
  }
  return "";
}

void table(std::ostream& out, const std::vector<const Claim*>& claims) {
  out << "<div "
         "class=\"scroll\"><table><thead><tr><th>Claim</th><th>Printed</th><th>Ours</th><th>Tolerance</th>"
         "<th>Verdict</th><th>Note</th></tr></thead><tbody>\n";
  for (const Claim* c : claims) {
    out << "<tr><td>" << escaped(c->what) << "</td><td>" << escaped(c->printed) << "</td><td>"
        << escaped(c->ours) << "</td><td>";
    if (c->tolerance) out << (c->later ? "+ " : "&plusmn; ") << short_text(*c->tolerance, 3) << ": ";
    out << escaped(c->tolerance_reason) << "</td><td><span class=\"v " << css_class(c->verdict) << "\">"
        << to_string(c->verdict) << "</span></td><td class=\"n\">" << escaped(c->note);
    if (c->fit)
      out << "; <i>fit</i>: " << escaped(c->fit->text()) << ", " << c->fit->explains << " of "
          << c->fit->claims << " printed statements come out";
    out << "</td></tr>\n";
  }
  out << "</tbody></table></div>\n";
}

void summary(std::ostream& out, const Json& counts) {
  out << "<div class=\"scroll\"><table><thead><tr><th></th>";
  for (const auto& [verdict, unused] : counts["results"].items())
    out << "<th>" << escaped(verdict) << "</th>";
  out << "</tr></thead><tbody>\n";
  for (const auto& [kind, row] : counts.items()) {
    out << "<tr><td>" << escaped(kind) << "</td>";
    for (const auto& [unused, count] : row.items()) out << "<td>" << count.get<int>() << "</td>";
    out << "</tr>\n";
  }
  out << "</tbody></table></div>\n";
}

bool belongs(const Claim& claim, const std::string& figure) {
  return std::find(claim.figures.begin(), claim.figures.end(), figure) != claim.figures.end();
}

}  // namespace

std::string report_html(const Paper& paper, const std::vector<ReportFigure>& figures,
                        const std::vector<Claim>& claims, const Json& provenance) {
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<title>"
      << escaped(paper.name()) << ": figures and claims</title>\n<style>" << kStyle
      << "</style></head><body>\n<h1>" << escaped(paper.title)
      << "</h1>\n<p>Every value under <i>Ours</i> was measured from the run that the figures show. "
         "<b>Reproduced</b>: ours agrees within the tolerance. <b>Fitted</b>: it agrees because values that "
         "the "
         "source does not print were chosen so; how many, and what else they explain, is in the note. <b>Not "
         "engaged</b>: nothing was commanded against that obstacle, so the law was not tried. <b>Not decided "
         "by "
         "what is printed</b>: ours does not agree, and rests on values that are not printed, named in the "
         "note. "
         "<b>Differs</b>: it does not agree, and what is printed decides. <b>Source wrong</b>: what is "
         "printed is "
         "shown wrong. <b>Given</b>: goes into a run, and was read back from it as printed.</p>\n";
  if (provenance.contains("changed"))
    out << "<p><b>Changed inputs</b>, not those of the paper: <code>" << escaped(provenance["changed"].dump())
        << "</code>. Verdicts are of these; notes speak of the paper's.</p>\n";
  summary(out, count_verdicts(claims));
  out << "<nav>";
  for (const ReportFigure& f : figures)
    out << "<a href=\"#" << escaped(f.figure.name()) << "\">" << escaped(f.figure.id) << "</a>";
  out << "</nav>\n";
  for (const ReportFigure& f : figures) {
    out << "<h2 id=\"" << escaped(f.figure.name()) << "\">Figure " << escaped(f.figure.id)
        << (f.provenance.contains("changed") ? " (changed inputs)" : "") << "</h2>\n<figure>";
    if (f.png.empty())
      out << "<p>Not made: <code>vericone figures " << escaped(f.figure.id) << "</code></p>";
    else
      out << "<img alt=\"" << escaped(f.figure.caption) << "\" src=\"data:image/png;base64," << base64(f.png)
          << "\">";
    out << "<figcaption>" << escaped(f.figure.caption) << "</figcaption></figure>\n";
    std::vector<const Claim*> results, given;
    for (const Claim& c : claims)
      if (belongs(c, f.figure.id)) (c.given ? given : results).push_back(&c);
    if (!results.empty()) table(out, results);
    if (!given.empty()) {
      out << "<details><summary>" << given.size() << " given values</summary>\n";
      table(out, given);
      out << "</details>\n";
    }
    if (!f.provenance.is_null())
      out << "<details><summary>Provenance</summary><pre>" << escaped(f.provenance.dump(1))
          << "</pre></details>\n";
  }
  if (!paper.references.empty()) out << "<h2>Source</h2>\n<pre>" << escaped(paper.references) << "</pre>\n";
  out << "<h2>Provenance of the claims</h2>\n<pre>" << escaped(provenance.dump(1))
      << "</pre>\n</body></html>\n";
  return out.str();
}

}  // namespace vericone::paper
