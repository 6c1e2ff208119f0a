# SPDX-License-Identifier: BSD-3-Clause
"""The public interface of the C++ library, read from its headers by libclang: what there is, its types as written, its
comments."""
from __future__ import annotations

import dataclasses
import os
import re
from typing import Iterator

import clang.cindex as clang
from clang.cindex import CursorKind as Kind

HIDDEN = {"detail", "pairs", "courses"}  # namespaces that no user is to use


@dataclasses.dataclass
class Parameter:
    name: str
    type: str
    default: str | None = None


@dataclasses.dataclass
class Function:
    name: str
    scope: tuple[str, ...]  # namespaces below vericone and types
    result: str
    parameters: list[Parameter]
    doc: str
    header: str
    static: bool = False
    const: bool = False
    constructor: bool = False
    explicit: bool = False
    template: list[str] = dataclasses.field(default_factory=list)  # of a function template


@dataclasses.dataclass
class Field:
    name: str
    type: str
    default: str | None
    doc: str


@dataclasses.dataclass
class Class:
    name: str
    scope: tuple[str, ...]
    doc: str
    header: str
    struct: bool = False
    abstract: bool = False
    template: list[str] = dataclasses.field(default_factory=list)
    bases: list[str] = dataclasses.field(default_factory=list)
    fields: list[Field] = dataclasses.field(default_factory=list)
    methods: list[Function] = dataclasses.field(default_factory=list)
    aliases: dict[str, str] = dataclasses.field(default_factory=dict)
    constants: list[str] = dataclasses.field(default_factory=list)
    private_data: bool = False
    copyable: bool = True
    default_constructible: bool = True

    @property
    def path(self) -> tuple[str, ...]:
        return (*self.scope, self.name)


@dataclasses.dataclass
class Enum:
    name: str
    scope: tuple[str, ...]
    doc: str
    header: str
    members: list[tuple[str, int, str]]

    @property
    def path(self) -> tuple[str, ...]:
        return (*self.scope, self.name)


@dataclasses.dataclass
class Interface:
    classes: list[Class] = dataclasses.field(default_factory=list)
    enums: list[Enum] = dataclasses.field(default_factory=list)
    functions: list[Function] = dataclasses.field(default_factory=list)
    aliases: dict[tuple[str, ...], tuple[str, str]] = dataclasses.field(default_factory=dict)  # type, header
    constants: list[tuple[tuple[str, ...], str, str, str]] = dataclasses.field(default_factory=list)  # path, type, doc, header


class Comments:
    """Comments as people put them: above a declaration, or behind it and going on below at the same column."""

    def __init__(self) -> None:
        self._files: dict[str, list[str]] = {}

    def _lines(self, name: str) -> list[str]:
        if name not in self._files:
            with open(name, encoding="utf-8") as file:
                self._files[name] = file.read().split("\n")
        return self._files[name]

    def of(self, cursor: clang.Cursor) -> str:
        start, end = cursor.extent.start, cursor.extent.end
        lines = self._lines(start.file.name)
        above: list[str] = []
        first = start.line - 1
        for line in range(start.line - 1, 0, -1):  # a template's or a declaration's first line
            text = lines[line - 1].strip()
            if text.startswith("template") or text.startswith("[[nodiscard]]") and not text.endswith((";", "}")):
                first = line - 1
                continue
            break
        i = first - 1 if first < start.line else start.line - 2
        while i >= 0 and lines[i].strip().startswith("//"):
            above.insert(0, lines[i].strip().lstrip("/").strip())
            i -= 1
        behind: list[str] = []
        at = end.line - 1
        match = re.match(r'^((?:[^"/]|"(?:[^"\\]|\\.)*"|/(?!/))*?)//(.*)$', lines[at])
        if match:
            column = len(match.group(1))
            behind.append(match.group(2).strip().lstrip("/<").strip())
            for following in lines[at + 1 : at + 12]:
                if following[:column].strip() == "" and following[column:].startswith("//") and column > 4:
                    behind.append(following[column:].lstrip("/").strip())
                else:
                    break
        text = " ".join(behind) if behind else ""
        over = "\n".join(above)
        if text.startswith("NOLINT"):
            text = ""
        if over.startswith("SPDX"):
            over = ""
        return "\n".join(part for part in (over, text) if part).strip()


def _tokens(cursor: clang.Cursor) -> list[str]:
    return [token.spelling for token in cursor.get_tokens()]


def _join(tokens: list[str]) -> str:
    return re.sub(r"\s*(::|<|>|\(|\)|,|\.|\{|\})\s*", r"\1", " ".join(tokens)).replace(",", ", ")


def _default(cursor: clang.Cursor) -> str | None:
    tokens = _tokens(cursor)
    depth = 0
    for i, token in enumerate(tokens):
        if token in ("(", "[", "{", "<"):
            depth += 1
        elif token in (")", "]", "}", ">", ">>"):
            depth -= len(token)
        if token == "=" and depth == 0:
            return _join([t for t in tokens[i + 1 :] if not t.startswith("//")])
        if token == "{" and depth == 1 and i > 0 and cursor.kind == Kind.FIELD_DECL and i == tokens.index(cursor.spelling) + 1:
            return _join(tokens[i:])
    return None


class Reader:
    def __init__(self, root: str) -> None:
        self.root = os.path.join(os.path.realpath(root), "")
        self.comments = Comments()
        self.interface = Interface()

    def read(self, headers: list[str], includes: list[str]) -> Interface:
        text = "".join(f'#include "{header}"\n' for header in headers)
        arguments = ["-std=c++20", "-xc++", *(f"-I{folder}" for folder in includes)]
        unit = clang.Index.create().parse(
            "interface.cpp", args=arguments, unsaved_files=[("interface.cpp", text)],
            options=clang.TranslationUnit.PARSE_SKIP_FUNCTION_BODIES)
        errors = [str(d) for d in unit.diagnostics if d.severity >= clang.Diagnostic.Error]
        if errors:
            raise SystemExit("the headers cannot be read: " + "; ".join(errors[:5]))
        self._namespace(unit.cursor, None)
        return self.interface

    def _own(self, cursor: clang.Cursor) -> bool:
        file = cursor.location.file
        return file is not None and os.path.realpath(file.name).startswith(self.root)

    def _header(self, cursor: clang.Cursor) -> str:
        return os.path.relpath(os.path.realpath(cursor.location.file.name), self.root)

    def _namespace(self, cursor: clang.Cursor, scope: tuple[str, ...] | None) -> None:
        for child in cursor.get_children():
            if not self._own(child):
                continue
            if child.kind == Kind.NAMESPACE:
                if scope is None:
                    if child.spelling == "vericone":
                        self._namespace(child, ())
                elif child.spelling not in HIDDEN:
                    self._namespace(child, (*scope, child.spelling))
            elif scope is not None:
                self._declaration(child, scope)

    def _declaration(self, cursor: clang.Cursor, scope: tuple[str, ...]) -> None:
        if cursor.kind in (Kind.STRUCT_DECL, Kind.CLASS_DECL, Kind.CLASS_TEMPLATE):
            if cursor.is_definition():
                self._class(cursor, scope)
        elif cursor.kind == Kind.ENUM_DECL:
            self._enum(cursor, scope)
        elif cursor.kind in (Kind.FUNCTION_DECL, Kind.FUNCTION_TEMPLATE):
            if cursor.semantic_parent == cursor.lexical_parent:
                function = self._function(cursor, scope)
                if not any(f.name == function.name and f.scope == function.scope and
                           [p.type for p in f.parameters] == [p.type for p in function.parameters]
                           for f in self.interface.functions):
                    self.interface.functions.append(function)
        elif cursor.kind in (Kind.TYPE_ALIAS_DECL, Kind.TYPE_ALIAS_TEMPLATE_DECL):
            tokens = _tokens(cursor)
            if "=" in tokens:
                self.interface.aliases[(*scope, cursor.spelling)] = (
                    _join(tokens[tokens.index("=") + 1 :]), self._header(cursor))
        elif cursor.kind == Kind.VAR_DECL:
            self.interface.constants.append(
                ((*scope, cursor.spelling), cursor.type.spelling, self.comments.of(cursor), self._header(cursor)))

    def _template(self, cursor: clang.Cursor) -> list[str]:
        return [c.spelling for c in cursor.get_children()
                if c.kind in (Kind.TEMPLATE_NON_TYPE_PARAMETER, Kind.TEMPLATE_TYPE_PARAMETER)]

    def _function(self, cursor: clang.Cursor, scope: tuple[str, ...]) -> Function:
        parameters = []
        for i, c in enumerate(c for c in cursor.get_children() if c.kind == Kind.PARM_DECL):
            parameters.append(Parameter(c.spelling or f"argument{i}", c.type.spelling, _default(c)))
        tokens = _tokens(cursor)
        return Function(
            cursor.spelling, scope, cursor.result_type.spelling, parameters, self.comments.of(cursor),
            self._header(cursor), static=cursor.is_static_method(), const=cursor.is_const_method(),
            constructor=cursor.kind == Kind.CONSTRUCTOR, explicit="explicit" in tokens[:4],
            template=self._template(cursor) if cursor.kind == Kind.FUNCTION_TEMPLATE else [])

    def _enum(self, cursor: clang.Cursor, scope: tuple[str, ...]) -> None:
        members = [(c.spelling, c.enum_value, self.comments.of(c))
                   for c in cursor.get_children() if c.kind == Kind.ENUM_CONSTANT_DECL]
        self.interface.enums.append(Enum(cursor.spelling, scope, self.comments.of(cursor), self._header(cursor), members))

    def _class(self, cursor: clang.Cursor, scope: tuple[str, ...]) -> None:
        made = Class(cursor.spelling, scope, self.comments.of(cursor), self._header(cursor))
        made.struct = cursor.kind == Kind.STRUCT_DECL or (
            cursor.kind == Kind.CLASS_TEMPLATE and "struct" in _tokens(cursor)[:12] and
            "class" not in _tokens(cursor)[:12])
        made.template = self._template(cursor) if cursor.kind == Kind.CLASS_TEMPLATE else []
        made.abstract = cursor.is_abstract_record() if not made.template else False
        self.interface.classes.append(made)  # before the types within it
        path = (*scope, cursor.spelling)
        group = ""
        last_line = 0
        constructors = []
        for c in cursor.get_children():
            if c.kind == Kind.CXX_BASE_SPECIFIER:
                made.bases.append(c.type.spelling)
                continue
            public = c.access_specifier == clang.AccessSpecifier.PUBLIC
            if c.kind == Kind.FIELD_DECL and not public:
                made.private_data = True
            if c.kind == Kind.CONSTRUCTOR:
                constructors.append((c, public))
                if c.is_copy_constructor() and ("delete" in _tokens(c) or not public):
                    made.copyable = False
            if not public:
                continue
            if c.kind in (Kind.STRUCT_DECL, Kind.CLASS_DECL, Kind.CLASS_TEMPLATE):
                if c.is_definition():
                    self._class(c, path)
            elif c.kind == Kind.ENUM_DECL:
                self._enum(c, path)
            elif c.kind == Kind.FIELD_DECL:
                made.fields.append(Field(c.spelling, c.type.spelling, _default(c), self.comments.of(c)))
            elif c.kind in (Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.FUNCTION_TEMPLATE):
                if "delete" in _tokens(c)[-3:]:
                    continue
                function = self._function(c, path)
                # A comment goes for those that follow without a gap; that of a constructor for itself.
                if c.kind == Kind.CONSTRUCTOR:
                    group = ""
                elif function.doc:
                    group = function.doc
                elif c.extent.start.line == last_line + 1:
                    function.doc = group
                else:
                    group = ""
                last_line = c.extent.end.line
                if c.kind == Kind.CONSTRUCTOR and (c.is_copy_constructor() or c.is_move_constructor()):
                    continue
                made.methods.append(function)
            elif c.kind in (Kind.TYPE_ALIAS_DECL, Kind.TYPEDEF_DECL):
                tokens = _tokens(c)
                if "=" in tokens:
                    made.aliases[c.spelling] = _join(tokens[tokens.index("=") + 1 :])
            elif c.kind == Kind.VAR_DECL:
                made.constants.append(c.spelling)
        own = [c for c, _ in constructors if not (c.is_copy_constructor() or c.is_move_constructor())]
        made.default_constructible = not own or any(
            public and not [p for p in self._function(c, path).parameters if p.default is None]
            for c, public in constructors if c in own)


def public_headers(root: str, folders: list[str]) -> Iterator[str]:
    for folder in folders:
        for path, below, files in os.walk(os.path.join(root, folder)):
            below[:] = sorted(name for name in below if name != "internal")
            for name in sorted(files):
                if name.endswith(".h"):
                    yield os.path.join(path, name)
