# SPDX-License-Identifier: BSD-3-Clause
"""The report of a paper, report.html: each figure beside the claims that belong to it. One file, nothing is loaded; it
fits a phone, and it prints. Reads report.json, needs Python alone."""
import base64
import html
import json
import os
import sys

FOLDER = sys.argv[1]
CLASSES = {"given": "weak", "consistent": "weak", "reproduced": "reproduced", "by the authors' code": "weak", "fitted": "weak",
           "not engaged": "weak", "differs": "differs", "not decided by what is printed": "not", "source wrong": "source"}
STYLE = """
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
"""
LEGEND = """Every value under <i>Ours</i> was measured when this report was made, on what <i>measured on</i> names beside it; where
that names nothing, it is arithmetic on what the source prints. <b>Reproduced</b>: ours agrees within the tolerance, and nothing that
was chosen is known to matter. <b>By the authors' code</b>: it agrees, by values that are not printed but stand in their program.
<b>Fitted</b>: it agrees because values that the source does not print were chosen so; how many, and what else rests on them, is in the
note. <b>Consistent</b>: the source's own numbers agree with one another; nothing of ours is in it. <b>Not engaged</b>: what the
statement is about did not take place, so the law was not tried. <b>Not decided by what is printed</b>: ours does not agree, and rests
on values that are not printed, named in the note. <b>Differs</b>: it does not agree, and what is printed decides. <b>Source wrong</b>:
what is printed is shown wrong. <b>Given</b>: goes into a run, or is ordered by it, and was read back as printed."""


def escaped(text):
    return html.escape(str(text))


def scrolling(head, rows):
    cells = "".join("<th>%s</th>" % h for h in head)
    return '<div class="scroll"><table><thead><tr>%s</tr></thead><tbody>\n%s</tbody></table></div>\n' % (cells, "".join(rows))


def row(claim):
    tolerance = "" if claim["tolerance"] is None else "%s %.3g: " % (
        "+" if claim["tolerance_one_sided"] else "&plusmn;", claim["tolerance"])
    note = escaped(claim["note"])
    for fit in claim["fits"]:
        numbers, missing = fit["free_numbers"], fit["not_measured"]
        note += "; <i>fit</i>: %s: %d free number%s, %d of %d statements that rest on it come out%s" % (
            escaped(", ".join(fit["free"])), numbers, "" if numbers == 1 else "s", fit["explains"], fit["of"],
            ", %d not measured here" % missing if missing else "")
    if claim["measured_on"]:
        note += "; <i>measured on</i>: <code>%s</code>" % escaped(", ".join(claim["measured_on"]))
    return '<tr><td>%s</td><td>%s</td><td>%s</td><td>%s%s</td><td><span class="v %s">%s</span></td><td class="n">%s</td></tr>\n' % (
        escaped(claim["what"]), escaped(claim["printed"]), escaped(claim["ours"]), tolerance, escaped(claim["tolerance_reason"]),
        CLASSES[claim["verdict"]], claim["verdict"], note)


def table(claims):
    return scrolling(("Claim", "Printed", "Ours", "Tolerance", "Verdict", "Note"), [row(c) for c in claims])


def shown(figure, claims):
    name, origin = escaped(figure["name"]), figure["origin"]
    page = '<h2 id="%s">Figure %s%s</h2>\n<figure>' % (
        name, escaped(figure["id"]), " (changed inputs)" if origin and "changed" in origin else "")
    picture = os.path.join(FOLDER, figure["picture"])
    if os.path.exists(picture):
        with open(picture, "rb") as f:
            page += '<img alt="%s" src="data:image/png;base64,%s">' % (
                escaped(figure["caption"]), base64.b64encode(f.read()).decode())
    else:
        page += "<p>Not made: <code>vericone figures %s</code></p>" % escaped(figure["id"])
    page += "<figcaption>%s</figcaption></figure>\n" % escaped(figure["caption"])
    own = [c for c in claims if figure["id"] in c["figures"]]
    results, given = [c for c in own if c["kind"] != "given"], [c for c in own if c["kind"] == "given"]
    if results:
        page += table(results)
    if given:
        page += "<details><summary>%d given values</summary>\n%s</details>\n" % (len(given), table(given))
    if origin:
        page += "<details><summary>Provenance</summary><pre>%s</pre></details>\n" % escaped(json.dumps(origin, indent=1))
    return page


with open(os.path.join(FOLDER, "report.json"), encoding="utf-8") as f:
    data = json.load(f)
claims, verdicts, changed = data["claims"], data["verdicts"], data["provenance"].get("changed")
page = ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>%s: figures and claims</title>\n'
        "<style>%s</style></head><body>\n<h1>%s</h1>\n<p>%s</p>\n" % (escaped(data["paper"]), STYLE, escaped(data["title"]), LEGEND))
if changed:
    page += ("<p><b>Changed inputs</b>, not those of the paper: <code>%s</code>. Verdicts are of these; notes speak of the "
             "paper's.</p>\n" % escaped(json.dumps(changed)))
page += scrolling([""] + list(verdicts["result"]), [
    "<tr><td>%s</td>%s</tr>\n" % (kind, "".join("<td>%d</td>" % n for n in counts.values())) for kind, counts in verdicts.items()])
page += "<nav>%s</nav>\n" % "".join('<a href="#%s">%s</a>' % (escaped(f["name"]), escaped(f["id"])) for f in data["figures"])
page += "".join(shown(figure, claims) for figure in data["figures"])
if data["references"]:
    page += "<h2>Source</h2>\n<pre>%s</pre>\n" % escaped(data["references"])
page += "<h2>Provenance of the claims</h2>\n<pre>%s</pre>\n</body></html>\n" % escaped(json.dumps(data["provenance"], indent=1))
with open(os.path.join(FOLDER, "report.html"), "w", encoding="utf-8") as f:
    f.write(page)
