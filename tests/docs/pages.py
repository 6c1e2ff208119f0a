# SPDX-License-Identifier: BSD-3-Clause
"""The pages that people read, cut into what can be checked: fenced blocks, links, headings.

A block of shell is called `console`. Each of its lines that begins with `$ ` is a command; what follows, up to the next,
is what it prints. What varies is written so:

- `...` within a line stands for anything within that line, `...` alone in a line for any lines;
- numbers in a line that begins with `time` or `map time` may be others;
- a command with nothing under it has output that nobody compares; `$ echo $?` under a command tells its exit status,
  which is 0 otherwise.

`<!-- not run: WHY -->` before a block keeps it from being run, `<!-- file: NAME -->` writes the block to that file first.
"""

import os
import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
LANGUAGES = {"console", "c", "cpp", "python", "yaml", "cmake", "json", "text", "bibtex"}
NOTE = re.compile(r"^<!-- (not run|file|not compiled): (.+) -->$")


@dataclass
class Block:
    page: Path
    line: int  # of the opening fence
    language: str
    text: str
    note: tuple  # ("not run", WHY), ("file", NAME), or ()

    def __str__(self):
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def pages():
    """README first, then all others in the order of their names."""
    found = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md"]
    for folder in ("docs", "examples", "papers", "tests"):
        found += sorted((ROOT / folder).rglob("*.md"))
    return [page for page in found if page.exists()]


def text_of(path):
    return path.read_text(encoding="utf-8")


def blocks(page):
    found, opened, note = [], None, ()
    for number, line in enumerate(text_of(page).split("\n"), 1):
        fence = re.match(r"^```(.*)$", line)
        if opened and fence:
            opened.text = "\n".join(opened.text)
            found.append(opened)
            opened, note = None, ()
        elif opened:
            opened.text.append(line)
        elif fence:
            opened = Block(page, number, fence.group(1).strip(), [], note)
        elif line.strip():
            note = tuple(NOTE.match(line).groups()) if NOTE.match(line) else ()
    return found


def prose(page):
    """The page with blanks for its blocks: what is left stays in its line."""
    inside, kept = False, []
    for line in text_of(page).split("\n"):
        fence = line.startswith("```")
        kept.append("" if fence or inside else line)
        inside ^= fence
    return "\n".join(kept)


def anchors(page):
    """The sections of a page as GitHub names them in addresses."""
    found = set()
    for heading in re.findall(r"^#+ (.+)$", prose(page), re.MULTILINE):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        found.add(name if name not in found else next(f"{name}-{n}" for n in range(1, 99) if f"{name}-{n}" not in found))
    return found


def commands(block):
    """(command, what the page says that it prints) of a console block."""
    found = []
    for line in block.text.split("\n"):
        if line.startswith("$ "):
            found.append([line[2:], []])
        elif found and found[-1][0].endswith("\\") and not found[-1][1]:
            found[-1][0] += "\n" + line
        elif found:
            found[-1][1].append(line)
        else:
            raise ValueError(f"{block}: a line before the first command: {line}")
    return [(command, "\n".join(output).strip("\n")) for command, output in found]


def shortened(output):
    """What a page shows of an output: six digits of numbers that have more than nine, but in JSON all."""
    def short(number):
        whole, exponent = re.fullmatch(r"(-?[\d.]+)(e[-+]?\d+)?", number.group(0)).groups()
        digits = re.sub(r"[-.]", "", whole).lstrip("0")
        if len(digits) <= 9 or "." not in whole:
            return number.group(0)
        return whole[:len(whole) - len(digits) + 6].rstrip(".") + "..." + (exponent or "")

    return "\n".join(line if line.startswith("{") else re.sub(r"(?<![\w.])-?\d+\.\d+(e[-+]?\d+)?(?![\w.])", short, line)
                     for line in output.split("\n"))


def pattern(output):
    """A regular expression for what a page says that a command prints."""
    lines = []
    for line in output.split("\n"):
        if line.strip() == "...":
            lines.append(r"(?:[^\n]*\n)*?")
            continue
        line = re.escape(line.rstrip()).replace(r"\.\.\.", r"[^\n]*?")
        if re.match(r"(map\\ )?time\\ ", line):
            line = re.sub(r"\d+(\\\.\d+)?(e(\\-|\\\+)?\d+)?", r"[\\d.e+-]+", line)
        lines.append(line + r"[ ]*\n")
    return re.compile("".join(lines))
