# SPDX-License-Identifier: BSD-3-Clause
"""The typed stubs of the package, and the Python modules of the namespaces, from the model."""
from __future__ import annotations

import re
import textwrap

from cxxtypes import Type
from docs import docstring
from model import Argument, Callable_, Group, Model, Record, python_name

HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

from vericone._enums import NamedInt as _NamedInt
from fractions import Fraction
from os import PathLike
from pathlib import Path
from typing import Any, Callable, Literal, Optional, Sequence, SupportsIndex, Union, final, overload

import numpy as np
import numpy.typing as npt

_Number = Union[float, np.floating[Any], np.integer[Any]]
_Floats = npt.NDArray[np.float64]
_Exact = Union[Fraction, int, float]
'''


def quoted(text: str, indent: str) -> str:
    if not text:
        return ""
    body = text.replace("\\", "\\\\").replace('"""', "'''")
    lines = textwrap.indent(body, indent).strip()
    return f'{indent}"""{lines}{" " if lines.endswith(chr(34)) else ""}"""\n'


class Stubs:
    def __init__(self, model: Model, space: tuple[str, ...]) -> None:
        self.model = model
        self.space = space
        self.imports: set[tuple[str, ...]] = set()

    # Types ------------------------------------------------------------------------------------------------

    def _name(self, path: tuple[str, ...], space: tuple[str, ...]) -> str:
        inner = ".".join(python_name(p) for p in path[len(space):])
        if space == self.space:
            return inner
        self.imports.add(space)
        return f"_{'_'.join(space) or 'root'}.{inner}"

    def taken(self, kind: Type, alone: bool = True) -> str:
        """What a parameter takes."""
        what = self.model.kind(kind)
        if kind.reference == "*" and what != "text":
            return f"Optional[{self.taken(kind.plain())}]"
        if what == "number":
            return "_Number"
        if what == "integer":
            return "SupportsIndex"
        if what == "boolean":
            return "bool"
        if what == "text":
            return "str"
        if what == "path":
            return "Union[str, PathLike[str]]"
        if what in ("fixed", "matrix", "motion"):
            return "npt.ArrayLike"
        if what == "rational":
            return "_Exact"
        if what == "whole":
            return "int"
        if what == "enum":
            enum = self.model.enum(kind)
            assert enum
            return self._name(enum.path, enum.space)
        if what == "class":
            record = self.model.record(kind)
            assert record
            own = self._name(record.path, record.space)
            if record.stand_ins and alone:
                others = []
                for t in record.stand_ins:
                    text = self.taken(t, True)
                    others.append(text)
                return f"Union[{', '.join(dict.fromkeys([own, *others]))}]"
            return own
        if what == "optional":
            return f"Optional[{self.taken(kind.arguments[0])}]"
        if what in ("shared_ptr", "unique_ptr"):
            return f"Optional[{self.taken(kind.arguments[0].plain())}]"
        if what in ("vector", "span"):
            inner = kind.arguments[0]
            if self.model.kind(inner) in ("number", "integer", "fixed") or (
                    self.model.kind(inner) == "array" and self.model.kind(inner.arguments[0]) == "integer"):
                return "npt.ArrayLike"
            return f"Sequence[{self.taken(inner)}]"
        if what == "array":
            return f"Sequence[{self.taken(kind.arguments[0])}]"
        if what == "variant":
            return f"Union[{', '.join(self.taken(a) for a in kind.arguments)}]"
        if what == "pair":
            return f"tuple[{', '.join(self.taken(a) for a in kind.arguments)}]"
        if what == "function":
            result, *parameters = kind.arguments[0].arguments
            answer = "Optional[bool]" if result.name == "bool" else self.taken(result) if result.name != "void" else "object"
            return f"Optional[Callable[[{', '.join(self.given(p) for p in parameters)}], {answer}]]"
        raise SystemExit(f"no annotation of {kind.text()}")

    def given(self, kind: Type) -> str:
        """What is returned."""
        what = self.model.kind(kind)
        if kind.reference == "*" and what != "text":
            return f"Optional[{self.given(kind.plain())}]"
        if what == "none":
            return "None"
        if what == "number":
            return "float"
        if what == "integer":
            return "int"
        if what == "path":
            return "Path"
        if what in ("fixed", "matrix", "motion"):
            return "_Floats"
        if what == "rational":
            return "Fraction"
        if what == "class":
            record = self.model.record(kind)
            assert record
            return self._name(record.path, record.space)
        if what == "optional":
            return f"Optional[{self.given(kind.arguments[0])}]"
        if what in ("shared_ptr", "unique_ptr"):
            return f"Optional[{self.given(kind.arguments[0].plain())}]" if what == "shared_ptr" else self.given(kind.arguments[0].plain())
        if what in ("vector", "span"):
            inner = kind.arguments[0]
            if self.model.kind(inner) in ("number", "fixed") and (self.model.kind(inner) == "number" or inner.arguments[2].name == "1"):
                return "_Floats"
            if self.model.kind(inner) in ("integer", "boolean") or (
                    self.model.kind(inner) == "array" and self.model.kind(inner.arguments[0]) == "integer"):
                return "npt.NDArray[Any]"
            return f"list[{self.given(inner)}]"
        if what == "array":
            if self.model.kind(kind.arguments[0]) in ("number", "integer"):
                return "npt.NDArray[Any]"
            return f"tuple[{self.given(kind.arguments[0])}, ...]"
        if what == "variant":
            return f"Union[{', '.join(dict.fromkeys(self.given(a) for a in kind.arguments))}]"
        if what == "pair":
            return f"tuple[{', '.join(self.given(a) for a in kind.arguments)}]"
        if what == "function":
            return self.taken(kind)
        return self.taken(kind, False)

    # Calls ------------------------------------------------------------------------------------------------

    def _parameters(self, call: Callable_, style: str, asked: str, group: Group | None = None) -> list[str]:
        """style: "one", "many"; asked: the annotation of rung."""
        parts, star = [], False
        for i, a in enumerate(call.arguments):
            kind = self.model.kind(a.type)
            text = self.taken(a.type)
            if kind == "class" and group:
                # What stands for a kind may have an overload of its own.
                own = self.taken(a.type, False)
                others = {self.taken(c.arguments[i].type, False) for c in group.overloads
                          if len(c.arguments) > i and self.model.kind(c.arguments[i].type) == "class"} - {own}
                if text.startswith("Union["):
                    kept = [t for t in re.findall(r"[\w.]+", text[6:-1]) if t not in others and t != "Union"]
                    text = f"Union[{', '.join(dict.fromkeys(kept))}]" if len(set(kept)) > 1 else own
            if a.role == "many":
                if style == "one":
                    text = "Sequence[_Number]" if kind == "fixed" else text
                else:
                    text = "npt.ArrayLike" if kind in ("fixed", "number") else \
                        "Union[Sequence[Any], npt.NDArray[Any]]" if kind == "array" else f"Union[{text}, Sequence[{text}], npt.NDArray[Any]]"
            if a.role == "asked":
                if not star:
                    parts.append("*")
                    star = True
                parts.append(f"{a.name}: {asked}" if asked == "Literal[True]" else f"{a.name}: {asked} = ...")
                continue
            optional = a.default is not None or (a.type.reference == "*" and kind != "text") or self.model.options(call, a) is not None
            parts.append(f"{a.name}: {text}" + (" = ..." if optional else ""))
        if call.many:
            if not star:
                parts.append("*")
                star = True
            parts.append("threads: SupportsIndex = ...")
        names = {a.name for a in call.arguments} | {"threads"} if call.many else {a.name for a in call.arguments}
        for options in filter(None, (self.model.options(call, a) for a in call.arguments)):
            for field, of, _, _, _ in options.fields:
                if python_name(field) not in names:
                    parts += [] if star else ["*"]
                    star = True
                    parts.append(f"{python_name(field)}: {self.taken(of)} = ...")
        return parts

    def _result(self, call: Callable_) -> str:
        result = self.given(call.result)
        changed = [a for a in call.arguments if a.role in ("changed", "memory")]
        if changed:
            memory = [a for a in changed if a.role == "memory"]
            parts = ([] if result == "None" else [result]) + [self.given(a.type.plain()) for a in changed]
            if memory:
                return "Any"
            return parts[0] if len(parts) == 1 else f"tuple[{', '.join(parts)}]"
        return result

    def definitions(self, group: Group, method: bool, indent: str, doc: str, constructor: bool = False) -> str:
        versions: list[tuple[list[str], str]] = []
        for call in group.overloads:
            result = "None" if constructor else self._result(call)
            asks = any(a.role == "asked" for a in call.arguments)
            if call.many:
                versions.append((self._parameters(call, "one", "Literal[False]", group), result))
                if asks:
                    enum = next(a for a in call.arguments if a.role == "asked")
                    versions.append((self._parameters(call, "one", "Literal[True]", group), f"tuple[{result}, {self.given(enum.type.plain())}]"))
                versions.append((self._parameters(call, "many", "bool", group), "Any"))
            elif asks:
                enum = next(a for a in call.arguments if a.role == "asked")
                versions.append((self._parameters(call, "one", "Literal[False]", group), result))
                versions.append((self._parameters(call, "one", "Literal[True]", group), f"tuple[{result}, {self.given(enum.type.plain())}]"))
            else:
                versions.append((self._parameters(call, "one", "bool", group), result))
        # Overloads that only shapes tell apart are one to a type checker.
        by_types: dict[tuple[str, ...], tuple[list[str], list[str]]] = {}
        for parameters, result in versions:
            types = tuple(p.split(":", 1)[-1].strip().removesuffix(" = ...") for p in parameters)
            by_types.setdefault(types, (parameters, []))[1].append(result)
        unique = []
        for parameters, results in by_types.values():
            results = list(dict.fromkeys(results))
            unique.append((tuple(parameters), results[0] if len(results) == 1 else "Any" if "Any" in results else f"Union[{', '.join(results)}]"))
        name = "__init__" if constructor else group.name
        text = ""
        # What is broader comes last.
        unique.sort(key=lambda v: v[1] == "Any")
        for i, (parameters, result) in enumerate(unique):
            if len(unique) > 1:
                text += f"{indent}@overload\n"
            if group.static:
                text += f"{indent}@staticmethod\n"
            own = ["self"] if method or constructor else []
            text += f"{indent}def {name}({', '.join(own + list(parameters))}) -> {result}:"
            if i == 0 and doc:
                text += "\n" + quoted(doc, indent + "    ") + f"{indent}    ...\n"
            else:
                text += " ...\n"
        return text

    def record(self, record: Record, indent: str) -> str:
        base = ""
        if record.base:
            parent = self.model.records[record.base]
            base = f"({self._name(parent.path, parent.space)})"
        inner = indent + "    "
        text = f"{indent}class {record.path[-1]}{base}:\n"
        text += quoted(without_head(docstring(self.model, Group(record.path[-1], record.constructors), record, of_class=True)), inner)
        for nested in self.model.records.values():
            if nested.path[:-1] == record.path:
                text += self.record(nested, inner)
        for enum in self.model.enums.values():
            if enum.path[:-1] == record.path:
                text += self.enum(enum, inner)
        if record.constructors and not record.source.abstract and any(c.arguments for c in record.constructors):
            text += self.definitions(Group("__init__", record.constructors), True, inner, "", constructor=True)
        elif record.is_record and record.source.default_constructible:
            needs = [n for _, _, n, _, _ in record.fields]
            ordered = all(not b or a for a, b in zip(needs, needs[1:]))
            parameters = ", ".join(f"{python_name(n)}: {self.taken(t)}" + ("" if required else " = ...")
                                   for n, t, required, _, _ in record.fields)
            text += f"{inner}def __init__(self, {'' if ordered else '*, '}{parameters}) -> None: ...\n"
        for name, kind, _, doc, _ in record.fields:
            text += f"{inner}@property\n{inner}def {python_name(name)}(self) -> {self.given(kind)}:"
            text += "\n" + quoted(doc, inner + "    ") + f"{inner}    ...\n" if doc else " ...\n"
        if record.is_record and record.fields:
            text += f"{inner}def replace(self, **fields: Any) -> {self._name(record.path, record.space)}: ...\n"
        for group in record.methods:
            text += self.definitions(group, not group.static, inner, without_head(docstring(self.model, group, record)))
        if text.endswith(":\n"):
            text += f"{inner}...\n"
        return text

    def enum(self, enum, indent: str) -> str:  # type: ignore[no-untyped-def]
        text = f"{indent}class {enum.path[-1]}(_NamedInt):\n" + quoted(enum.source.doc, indent + "    ")
        for name, value, doc in enum.source.members:
            text += f"{indent}    {python_name(name)} = {value}" + (f"  # {doc.splitlines()[0]}" if doc else "") + "\n"
        return text

    def text(self) -> str:
        body = ""
        for enum in self.model.enums.values():
            if enum.space == self.space and enum.path[:-1] == self.space:
                body += "\n" + self.enum(enum, "")
        for record in self.model.records.values():
            if record.space == self.space and record.path[:-1] == self.space:
                body += "\n" + self.record(record, "")
        for (space, _, _), group in merged(self.model):
            if space == self.space:
                body += "\n" + self.definitions(group, False, "", without_head(docstring(self.model, group, None)))
        for path, kind, doc, _ in self.model.constants:
            if path[:-1] == self.space:
                body += f"\n{path[-1]}: {self.given(kind)}" + (f"  # {doc.splitlines()[0]}" if doc else "") + "\n"
        imports = "".join(
            f"from vericone import _root as _root\n" if not space else
            f"import vericone.{'.'.join(space)} as _{'_'.join(space)}\n" for space in sorted(self.imports))
        return HEAD + imports + body


def without_head(doc: str) -> str:
    return doc.split("\n--\n\n", 1)[-1]


def merged(model: Model) -> list[tuple[tuple[tuple[str, ...], str, str], Group]]:
    return list(model.functions.items())


def package(model: Model) -> dict[str, str]:
    spaces: dict[tuple[str, ...], set[str]] = {}
    for record in model.records.values():
        spaces.setdefault(record.space, set()).add(record.module)
    for enum in model.enums.values():
        spaces.setdefault(enum.space, set()).add(enum.module)
    for path, _, _, module in model.constants:
        spaces.setdefault(path[:-1], set()).add(module)
    for space, _, module in model.functions:
        spaces.setdefault(space, set()).add(module)
    needed = model.needed()
    files: dict[str, str] = {}
    for module in {m for modules in spaces.values() for m in modules}:
        folder = "package_verify" if module == "_verify" else "package"
        files[f"{folder}/{module}.pyi"] = (
            "# SPDX-License-Identifier: BSD-3-Clause\n# Compiled; its names are those of the modules of the namespaces.\n"
            "from typing import Any\n\n_names: dict[str, dict[str, Any]]\n")
    for space, modules in spaces.items():
        name = "/".join(space) or "_root"
        if len(space) > 1:
            raise SystemExit("a namespace within a namespace: " + "::".join(space))
        if space == ("verify",):  # a package of its own, under another licence
            files["package_verify/__init__.pyi"] = Stubs(model, space).text()
            files["package_verify/__init__.py"] = (
                '# SPDX-License-Identifier: GPL-3.0-or-later\n"""The exact cross-checks with CGAL: the names of the C++ namespace '
                'vericone::verify."""\nfrom vericone import _core as _core\nfrom vericone_verify import _verify as _module\n\n'
                'globals().update(_module._names["verify"])\n')
            files["package_verify/py.typed"] = ""
            continue
        files[f"package/{name}.pyi"] = Stubs(model, space).text()
        title = f"vericone::{'::'.join(space)}" if space else "vericone"
        others = {other for module in modules for other in needed[module]} - modules
        files[f"package/{name}.py"] = (
            f'# SPDX-License-Identifier: BSD-3-Clause\n"""The names of the C++ namespace {title}."""\n'
            "from vericone._load import fill as _fill\n\n"
            f'_fill(globals(), "{".".join(space)}", {sorted(others) + sorted(modules)!r})\n')
    return files
