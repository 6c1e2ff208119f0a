# SPDX-License-Identifier: BSD-3-Clause
"""C++ types as written in the headers, taken apart and with every name in full."""
from __future__ import annotations

import dataclasses
import re


@dataclasses.dataclass(frozen=True)
class Type:
    name: str                            # "double", "std::vector", "vericone::Pair"
    arguments: tuple["Type", ...] = ()
    const: bool = False
    reference: str = ""                  # "", "&", "&&", "*"

    def plain(self) -> "Type":
        return dataclasses.replace(self, const=False, reference="")

    def text(self) -> str:
        """As C++ writes it."""
        if self.name == "function()":
            return f"{self.arguments[0].text()}({', '.join(a.text() for a in self.arguments[1:])})"
        inner = f"<{', '.join(a.text() for a in self.arguments)}>" if self.arguments else ""
        return ("const " if self.const else "") + self.name + inner + (f" {self.reference}" if self.reference else "")


_TOKEN = re.compile(r"\s*(::|[A-Za-z_][\w]*|-?\d+|&&|[<>(),&*+\[\]])")


def parse(text: str) -> Type:
    tokens = _TOKEN.findall(text.replace("struct ", "").replace("enum ", "").replace("class ", ""))
    kind, rest = _type(tokens)
    if rest:
        raise ValueError(f"cannot read the type '{text}': {rest}")
    return kind


def _type(tokens: list[str]) -> tuple[Type, list[str]]:
    const = False
    name = ""
    while tokens and tokens[0] in ("const", "typename"):
        const = const or tokens[0] == "const"
        tokens = tokens[1:]
    words = []
    while tokens and (re.match(r"[A-Za-z_]|-?\d", tokens[0]) or tokens[0] in ("::", "+")):
        if tokens[0] == "const":
            const = True
        elif tokens[0] in ("unsigned", "signed", "long", "short") and words and words[-1] != "::":
            words.append(" " + tokens[0])
        elif tokens[0] in ("int", "char", "double", "long") and words and words[-1].strip() in ("unsigned", "signed", "long", "short"):
            words.append(" " + tokens[0])
        else:
            words.append(tokens[0])
        tokens = tokens[1:]
    name = "".join(words)
    arguments: list[Type] = []
    if tokens and tokens[0] == "<":
        tokens = tokens[1:]
        while tokens[0] != ">":
            if tokens[0] == "(":  # of a function without a name for its result: "R (A)"
                raise ValueError("unexpected parenthesis")
            argument, tokens = _type(tokens)
            if tokens[0] == "(":  # a function type
                tokens = tokens[1:]
                parts = [argument]
                while tokens[0] != ")":
                    part, tokens = _type(tokens)
                    if tokens[0] not in (",", ")"):
                        tokens = tokens[1:]  # the parameter's name
                    parts.append(part)
                    if tokens[0] == ",":
                        tokens = tokens[1:]
                tokens = tokens[1:]
                argument = Type("function()", tuple(parts))
            arguments.append(argument)
            if tokens[0] == ",":
                tokens = tokens[1:]
        tokens = tokens[1:]
    while tokens and tokens[0] == "::":  # a type in a template
        name += "<" + ", ".join(a.text() for a in arguments) + ">::" + tokens[1]
        arguments = []
        tokens = tokens[2:]
    reference = ""
    while tokens and (tokens[0] in ("&", "&&", "*", "const") or re.match(r"[A-Za-z_]", tokens[0]) and reference):
        if tokens[0] in ("&", "&&", "*"):
            reference += tokens[0]
        elif tokens[0] == "const" and not reference:
            const = True
        elif tokens[0] != "const":
            break
        tokens = tokens[1:]
    return Type(name, tuple(arguments), const, reference), tokens
