# SPDX-License-Identifier: BSD-3-Clause
"""What C++ requires of its callers, read from the definitions: VERICONE_REQUIRES(condition, "input", "what it got",
"what it must be") stands in the function that requires it, where assertions look at it."""
from __future__ import annotations

import ast
import dataclasses
import os
import re

MARK = re.compile(r"\bVERICONE_REQUIRES\(")


@dataclasses.dataclass
class Requirement:
    condition: str          # in C++, by the names of the definition
    field: str
    got: str
    need: str
    parameters: list[str]   # these names


def _blanked(text: str) -> str:
    """Blanks for comments, strings and directives: what is left stays where it was."""
    def blank(match: re.Match[str]) -> str:
        return re.sub(r"[^\n]", " ", match.group(0))

    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|^#[^\n]*(?:\\\n[^\n]*)*', blank, text,
                  flags=re.DOTALL | re.MULTILINE)


def _arguments(text: str, code: str, at: int) -> list[str]:
    """Of a call whose parenthesis opens before `at`. < and > are not brackets."""
    parts, depth, start = [], 0, at
    while True:
        sign = code[at]
        if depth == 0 and sign in ",)":
            parts.append(text[start:at].strip())
            start = at + 1
            if sign == ")":
                return parts
        depth += (sign in "([{") - (sign in ")]}")
        at += 1


def _parameters(declaration: str, at: int) -> list[str]:
    names, depth, last = [], 0, at
    for i in range(at, len(declaration)):
        sign = declaration[i]
        if depth == 0 and sign in ",)":
            name = re.search(r"(\w+)\s*(?:=.*)?$", declaration[last:i].strip(), re.DOTALL)
            names += [name.group(1)] if name else []
            last = i + 1
            if sign == ")":
                break
        depth += (sign in "([{<") - (sign in ")]}>")
    return names


def _functions(code: str) -> list[tuple[int, int, str, list[str]]]:
    """Begin and end of each function's body, its name within vericone, the names of its parameters."""
    found, scopes, start, parentheses = [], [], 0, 0
    for mark in re.finditer(r"[;{}()]", code):
        at, sign = mark.start(), mark.group(0)
        parentheses += {"(": 1, ")": -1}.get(sign, 0)
        if parentheses or sign in "()":
            continue
        declaration = code[start:at]
        if sign == "{":
            inside = any(kind == "body" for kind, *_ in scopes)
            named = re.search(r"\b(namespace|class|struct|union|enum)\b(?: class)?\s*([\w:]*)[^()]*$", declaration)
            if inside or not (named or "(" in declaration):
                scopes.append(("block", "", at, []))
            elif named:
                scopes.append(("scope", named.group(2), at, []))
            else:
                name = re.search(r"([\w:~]+)\s*\(", declaration)
                scopes.append(("body", name.group(1), at, _parameters(declaration, name.end())) if name else
                              ("body", "", at, []))
        elif sign == "}" and scopes:
            kind, name, begin, parameters = scopes.pop()
            if kind == "body":
                path = "::".join([n for k, n, *_ in scopes if k == "scope" and n] + [name])
                found.append((begin, at, path.removeprefix("vericone::"), parameters))
        start = at + 1
    return found


def read(root: str, folders: list[str]) -> dict[tuple[str, int], Requirement]:
    """By the function's name and the number of its parameters."""
    requirements: dict[tuple[str, int], Requirement] = {}
    for folder in folders:
        for part in ("include", "src"):
            for path, _, files in os.walk(os.path.join(root, folder, part)):
                for name in files:
                    with open(os.path.join(path, name), encoding="utf-8") as file:
                        text = file.read()
                    if not MARK.search(text):
                        continue
                    code = _blanked(text)
                    functions = _functions(code)
                    for mark in MARK.finditer(code):
                        condition, *words = _arguments(text, code, mark.end())
                        if len(words) != 3:
                            continue
                        _, _, full, parameters = next(f for f in functions if f[0] < mark.start() < f[1])
                        field, got, need = (ast.literal_eval("(" + word + ")") for word in words)
                        requirements[full, len(parameters)] = Requirement(
                            re.sub(r"\s+", " ", condition), field, got, need, parameters)
    return requirements
