# SPDX-License-Identifier: BSD-3-Clause
"""Docstrings, from the comments of the headers, and signatures."""
from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from model import Argument, Callable_, Group, Model, Record


def literal(default: str | None) -> str:
    """A C++ default as Python would write it, where it is a number, a truth value or nothing."""
    if default is None:
        return "..."
    if re.fullmatch(r"-?\d+(\.\d*)?(e-?\d+)?", default):
        return default
    return {"true": "True", "false": "False", "nullptr": "None", "std::nullopt": "None"}.get(default, "...")


def signature(model: Model, call: Callable_, method: bool) -> str:
    parts = ["$self"] if method else []
    star = False
    for a in call.arguments:
        if a.role == "asked":
            if not star:
                parts.append("*")
                star = True
            parts.append(f"{a.name}=False")
        elif a.type.reference == "*" and model.kind(a.type) != "text":
            parts.append(f"{a.name}=None")
        elif a.default is not None or model.options(call, a):
            parts.append(f"{a.name}={literal(a.default)}")
        else:
            parts.append(a.name)
    if call.many:
        if not star:
            parts.append("*")
        parts.append("threads=1")
    if any(model.options(call, a) for a in call.arguments):
        parts.append("**fields")
    return f"({', '.join(parts)})"


def _plain(comment: str) -> str:
    return comment.replace("std::", "").replace("nullptr", "None").replace("true_cone", "true_cone")


def notes(model: Model, call: Callable_) -> str:
    lines = []
    questions = [a.name for a in call.arguments if a.role == "many"]
    if questions:
        lines.append(f"One or many: {', '.join(questions)} broadcast (docs/explanation/python.md); `threads` divides them.")
    for a in call.arguments:
        options = model.options(call, a)
        if options:
            lines.append(f"In place of `{a.name}` its fields, by name: {', '.join(f[0] for f in options.fields)}.")
        if a.role == "asked":
            lines.append(f"`{a.name}=True`: the answer is a tuple whose second part is the {a.name}.")
        elif a.role in ("changed", "memory"):
            lines.append(f"`{a.name}` is not changed: what becomes of it is returned"
                         + (" after the answer" if model.kind(call.result) != "none" else "") + ".")
    return "\n".join(lines)


def docstring(model: Model, group: Group, record: Record | None, of_class: bool = False) -> str:
    method = record is not None and not group.static and not of_class
    head = ""
    if of_class:
        assert record
        if record.constructors:
            if len(record.constructors) == 1:
                head = record.path[-1] + signature(model, record.constructors[0], False) + "\n--\n\n"
        elif record.fields:
            from model import python_name
            fields = ", ".join(f"{python_name(n)}" if needs else f"{python_name(n)}=..." for n, _, needs, _, _ in record.fields)
            # A required field may follow one that is not: by name they all go.
            ordered = all(not b or a for a, b in zip([f[2] for f in record.fields], [f[2] for f in record.fields][1:]))
            head = f"{record.path[-1]}({'' if ordered else '*, '}{fields})\n--\n\n"
        text = record.doc
        for call in record.constructors:
            if call.doc:
                text += f"\n\n{record.path[-1]}{signature(model, call, False)}: {call.doc}"
        if record.fields:
            text += "\n\n" + "\n".join(f"{n}: {d}" for n, _, _, d, _ in record.fields if d)
        return head + _plain(text).strip()
    if len(group.overloads) == 1:
        head = group.name + signature(model, group.overloads[0], method) + "\n--\n\n"
        call = group.overloads[0]
        return head + _plain("\n\n".join(part for part in (call.doc, notes(model, call)) if part))
    parts = []
    for call in group.overloads:
        shown = group.name + signature(model, call, method).replace("$self, ", "").replace("$self", "")
        parts.append("\n".join(part for part in (shown, call.doc, notes(model, call)) if part))
    return _plain("\n\n".join(dict.fromkeys(parts)))
