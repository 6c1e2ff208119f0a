# SPDX-License-Identifier: BSD-3-Clause
"""What Python sees: every public C++ name resolved, templates instantiated, the kind of each type known. A name that
cannot be bound must be in rules.py with its reason, else generating fails."""
from __future__ import annotations

import dataclasses
import keyword
import re

import rules
from cxxtypes import Type, parse
from headers import Class, Enum, Function, Interface

EIGEN = {
    "Eigen::Vector2d": ("2", "1"), "Eigen::Vector3d": ("3", "1"), "Eigen::Vector4d": ("4", "1"),
    "Eigen::Matrix2d": ("2", "2"), "Eigen::Matrix3d": ("3", "3"), "Eigen::Matrix4d": ("4", "4"),
    "Eigen::VectorXd": ("-1", "1"), "Eigen::MatrixXd": ("-1", "-1"), "Eigen::Matrix2Xd": ("2", "-1"),
    "Eigen::Matrix3Xd": ("3", "-1"),
}
INTEGERS = {"int", "unsigned int", "unsigned", "long", "unsigned long", "std::size_t", "std::uint64_t", "std::uint32_t",
            "std::uint16_t", "std::uint8_t", "std::int64_t", "std::int32_t", "std::int8_t", "std::int16_t", "size_t", "Eigen::Index",
            "std::ptrdiff_t", "std::uint_fast32_t"}
STANDARD = {"std::optional", "std::vector", "std::array", "std::span", "std::variant", "std::pair", "std::function",
            "std::shared_ptr", "std::unique_ptr", "std::string", "std::string_view", "std::filesystem::path", "std::monostate",
            "Eigen::Matrix", "Eigen::Ref", "Eigen::Isometry3d", "void", "char", "double", "float", "bool", "function()"}
RATIONAL = "vericone::exact::Rational"
WHOLE = "vericone::exact::Integer"


class Unbound(Exception):
    """A type that Python has no form of."""


class Internal(Unbound):
    """A type of the library's own mechanism."""


def python_name(name: str) -> str:
    return name + "_" if keyword.iskeyword(name) else name


@dataclasses.dataclass
class Argument:
    name: str
    type: Type              # as C++ declares it, resolved
    default: str | None     # C++
    role: str               # "value", "many", "asked" (rung=True), "changed", "memory"


@dataclasses.dataclass
class Callable_:
    name: str               # in Python
    cpp: Function
    call: str               # C++ expression to call: "vericone::clearance", "{self}.verdict", "vericone::Body::pieces"
    arguments: list[Argument]
    result: Type
    doc: str
    many: bool = False      # takes one or many
    whole: str = ""         # a C++ call of its own for many vectors
    work: str = "quick"     # Work of call.h
    module: str = ""


@dataclasses.dataclass
class Group:
    """Overloads of one name."""
    name: str
    overloads: list[Callable_]
    static: bool = False


@dataclasses.dataclass
class Record:
    """A class or a struct."""
    cpp: str                # "vericone::BasicEllipsoid<3>"
    path: tuple[str, ...]   # in Python: ("guidance", "GuideMemory", "Past")
    space: tuple[str, ...]  # its namespaces
    source: Class
    module: str
    doc: str
    fields: list[tuple[str, Type, bool, str, str | None]] = dataclasses.field(default_factory=list)  # name, type, required, doc, default
    constructors: list[Callable_] = dataclasses.field(default_factory=list)
    methods: list[Group] = dataclasses.field(default_factory=list)
    base: str | None = None
    stand_ins: list[Type] = dataclasses.field(default_factory=list)
    machine: bool = False

    @property
    def is_record(self) -> bool:
        return bool(self.fields) and not self.source.private_data

    @property
    def name(self) -> str:
        return ".".join(self.path)


@dataclasses.dataclass
class PyEnum:
    cpp: str
    path: tuple[str, ...]
    space: tuple[str, ...]
    source: Enum
    module: str

    @property
    def name(self) -> str:
        return ".".join(self.path)


@dataclasses.dataclass
class Name:
    cpp: str
    kind: str
    header: str
    python: str = ""
    reason: str = ""
    doc: str = ""


def module_of(header: str) -> str:
    for prefix, module in rules.MODULES:
        if header.startswith(prefix):
            return module
    raise SystemExit(f"no module for {header}")


def is_public(header: str) -> bool:
    return "/vericone/internal/" not in header


def skipped(full: str) -> str:
    """Why Python has no such name; empty where it has one."""
    return rules.SKIPPED.get(full) or next((reason for kind, reason in rules.SKIPPED_KINDS if kind.search(full)), "")


class Model:
    def __init__(self, interface: Interface) -> None:
        self.interface = interface
        self.mechanism = {entry.path for entry in (*interface.classes, *interface.enums) if not is_public(entry.header)}
        interface.classes = [c for c in interface.classes if is_public(c.header)]
        interface.enums = [e for e in interface.enums if is_public(e.header)]
        interface.functions = [f for f in interface.functions if is_public(f.header)]
        interface.constants = [c for c in interface.constants if is_public(c[3])]
        self.namespaces: set[tuple[str, ...]] = {()}
        self.class_sources = {c.path: c for c in interface.classes}
        self.enum_sources = {e.path: e for e in interface.enums}
        for entry in (*interface.classes, *interface.enums, *interface.functions):
            scope = entry.scope
            while scope and (scope in self.class_sources):
                scope = scope[:-1]
            self.namespaces.add(scope)
        self.records: dict[str, Record] = {}
        self.enums: dict[str, PyEnum] = {}
        self.functions: dict[tuple[tuple[str, ...], str, str], Group] = {}
        self.constants: list[tuple[tuple[str, ...], Type, str, str]] = []  # path, type, comment, module
        self.names: list[Name] = []
        self.problems: list[str] = []
        self._declare()
        self._define()

    # Names ------------------------------------------------------------------------------------------------

    def _space(self, scope: tuple[str, ...]) -> tuple[str, ...]:
        while scope not in self.namespaces:
            scope = scope[:-1]
        return scope

    def resolve(self, text: str, scope: tuple[str, ...], values: dict[str, str] | None = None) -> Type:
        return self._resolve(parse(text), scope, values or {})

    def _resolve(self, kind: Type, scope: tuple[str, ...], values: dict[str, str]) -> Type:
        arguments = tuple(self._resolve(a, scope, values) for a in kind.arguments)
        name = kind.name
        if name in values or re.fullmatch(r"[\w]+\+\d+", name):
            for key, value in values.items():
                name = re.sub(rf"\b{key}\b", value, name)
            if re.fullmatch(r"\d+\+\d+", name):
                name = str(eval(name))  # noqa: S307: two numbers
            return Type(name)
        if re.fullmatch(r"-?\d+", name):
            return Type(name)
        if name == "Eigen::Dynamic":
            return Type("-1")
        if name in EIGEN:
            rows, columns = EIGEN[name]
            return Type("Eigen::Matrix", (Type("double"), Type(rows), Type(columns)), kind.const, kind.reference)
        if name == "Eigen::Matrix":
            arguments = arguments[:3]
        if name in INTEGERS or name in STANDARD or name == "unsigned":
            return Type(name, arguments, kind.const, kind.reference)
        if name.startswith("vericone::"):
            name = name[len("vericone::"):]
            scopes: list[tuple[str, ...]] = [()]
        else:
            scopes = [scope[:n] for n in range(len(scope), -1, -1)]
        parts = tuple(re.sub(r"<[^>]*>", "", name).split("::"))
        for outer in scopes:
            path = (*outer, *parts)
            if path in (("exact", "Rational"), ("exact", "Integer")):
                return Type("vericone::" + "::".join(path), (), kind.const, kind.reference)
            if path in self.mechanism:
                raise Internal("::".join(path))
            if path in self.class_sources or path in self.enum_sources:
                if path in self.class_sources and self.class_sources[path].template and not arguments and values:
                    # The name of a template within itself.
                    arguments = tuple(Type(values[p]) for p in self.class_sources[path].template if p in values)
                return Type("vericone::" + "::".join(path), arguments, kind.const, kind.reference)
            if path in self.interface.aliases:
                target, _ = self.interface.aliases[path]
                inner = self._resolve(parse(target), path[:-1], self._alias_values(path, arguments))
                return dataclasses.replace(inner, const=kind.const or inner.const, reference=kind.reference or inner.reference)
            if path[:-1] in self.class_sources and path[-1] in self.class_sources[path[:-1]].aliases:
                inner = self._resolve(parse(self.class_sources[path[:-1]].aliases[path[-1]]), path[:-1], values)
                return dataclasses.replace(inner, const=kind.const or inner.const, reference=kind.reference or inner.reference)
        raise Unbound(f"unknown type {kind.text()}")

    def _alias_values(self, path: tuple[str, ...], arguments: tuple[Type, ...]) -> dict[str, str]:
        return dict(zip(("D",), (a.text() for a in arguments)))

    def key(self, kind: Type) -> str:
        return kind.plain().text()

    def record(self, kind: Type) -> Record | None:
        return self.records.get(self.key(kind))

    def options(self, call: Callable_, a: Argument) -> Record | None:
        """The record of options whose fields a call takes by name in place of `a`, behind which all may be left out."""
        record = self.record(a.type) if a.role == "value" and a.type.reference in ("", "&") else None
        behind = call.arguments[call.arguments.index(a) + 1:]
        if not record or not record.is_record or any(b.default is None and b.type.reference != "*" for b in behind):
            return None
        return record if record.path[-1].endswith("Options") else None

    def enum(self, kind: Type) -> PyEnum | None:
        return self.enums.get(self.key(kind))

    def needed(self) -> dict[str, set[str]]:
        """Module: the other modules whose types are in its own, or in what its functions take and return."""
        met: dict[str, set[str]] = {module: set() for _, module in rules.MODULES}

        def meet(module: str, kind: Type) -> None:
            for found in (self.record(kind), self.enum(kind)):
                if found and found.module != module:
                    met[module].add(found.module)
            for inner in kind.arguments:
                meet(module, inner)

        calls = [(g, module) for (_, _, module), g in self.functions.items()]
        for record in self.records.values():
            for _, kind, *_ in record.fields:
                meet(record.module, kind)
            calls += [(g, record.module) for g in (*record.methods, Group("", record.constructors))]
        for group, module in calls:
            for call in group.overloads:
                for kind in (call.result, *(a.type for a in call.arguments)):
                    meet(module, kind)
        for _ in met:  # and those that these need
            for others in met.values():
                others.update(*(met[other] for other in set(others)))
        return {module: others - {module, "_core"} for module, others in met.items()}

    # Declarations -----------------------------------------------------------------------------------------

    def overloads(self) -> dict[str, list[str]]:
        """Name in Python: the parameters of each of its overloads, as C++ has them."""
        groups = {".".join((*space, group.name)): group for (space, _, _), group in self.functions.items()}
        for record in self.records.values():
            groups |= {f"{record.name}.{group.name}": group for group in record.methods}
            if record.constructors and not record.source.abstract:
                groups[record.name] = Group("", record.constructors)
        return {name: [", ".join(f"{a.type.text()} {a.name}" for a in call.arguments) for call in group.overloads]
                for name, group in groups.items()}

    def _declare(self) -> None:
        for source in self.interface.enums:
            path = source.path
            if "::".join(path) in rules.SKIPPED:
                continue
            cpp = "vericone::" + "::".join(path)
            self.enums[cpp] = PyEnum(cpp, path, self._space(source.scope), source, module_of(source.header))
        for cls in self.interface.classes:
            full = "::".join(cls.path)
            if full in rules.SKIPPED or any(full.startswith(s + "::") for s in rules.SKIPPED if s in map("::".join, self.class_sources)):
                continue
            space = self._space(cls.scope)
            if cls.template:
                if full not in rules.INSTANCES:
                    self.problems.append(f"{full}: a template without instances in rules.py")
                    continue
                for name, values in rules.INSTANCES[full]:
                    arguments = ", ".join(values)
                    cpp = f"vericone::{full}<{arguments}>"
                    self.records[cpp] = Record(cpp, (*cls.scope, name), space, cls, module_of(cls.header), cls.doc)
            else:
                cpp = f"vericone::{full}"
                self.records[cpp] = Record(cpp, cls.path, space, cls, module_of(cls.header), cls.doc)

    def _define(self) -> None:
        for source in self.interface.enums:
            full = "::".join(source.path)
            self.names.append(Name(full, "enum", source.header, "" if full in rules.SKIPPED else full.replace("::", "."),
                                   rules.SKIPPED.get(full, ""), source.doc))
        for cls in self.interface.classes:
            full = "::".join(cls.path)
            if full in rules.SKIPPED:
                self.names.append(Name(full, "class", cls.header, "", rules.SKIPPED[full], cls.doc))
        for record in self.records.values():
            self._define_record(record)
        for function in self.interface.functions:
            self._define_function(function)
        for path, kind, doc, header in self.interface.constants:
            full = "::".join(path)
            reason = rules.SKIPPED.get(full, "")
            self.names.append(Name(full, "constant", header, "" if reason else full.replace("::", "."), reason, doc))
            if reason:
                continue
            try:
                resolved = self.resolve(kind, path[:-1])
                self.check(resolved)
                self.constants.append((path, resolved, doc, module_of(header)))
            except (Unbound, ValueError) as error:
                self.problems.append(f"{full}: {error}")
        for path, (_, header) in self.interface.aliases.items():
            if not is_public(header):
                continue
            full = "::".join(path)
            self.names.append(Name(full, "alias", header, full.replace("::", ".") if any(
                r.path == path for r in self.records.values()) else "", rules.SKIPPED.get(full, "the type it stands for is bound")))
        known = {n.cpp for n in self.names}
        parsed = any(n.cpp.startswith("verify::") for n in self.names)
        for full in (*rules.SKIPPED, *rules.LONG, *rules.INSTANCES, *rules.REQUIRES):
            if full not in known and (parsed or not full.startswith("verify::")):
                self.problems.append(f"{full}: in rules.py, and not in the headers")

    def _values(self, record: Record) -> dict[str, str]:
        if not record.source.template:
            return {}
        return dict(zip(record.source.template, re.search(r"<(.*)>", record.cpp).group(1).split(", ")))  # type: ignore[union-attr]

    def _define_record(self, record: Record) -> None:
        source = record.source
        values = self._values(record)
        path = source.path
        full = "::".join(path)
        self.names.append(Name(full, "struct" if source.struct else "class", source.header, record.name, "", source.doc))
        for base in source.bases:
            try:
                resolved = self.record(self.resolve(base, source.scope, values))
            except Unbound:
                resolved = None
            record.base = resolved.cpp if resolved else None
        for field in source.fields:
            name = f"{full}::{field.name}"
            if name in rules.SKIPPED:
                self.names.append(Name(name, "field", source.header, "", rules.SKIPPED[name], field.doc))
                continue
            try:
                kind = self.resolve(field.type, path, values)
                self.check(kind, field=True)
            except (Unbound, ValueError) as error:
                self.problems.append(f"{name}: {error}")
                continue
            needs = field.default is None and self.kind(kind) in ("number", "integer", "boolean", "fixed", "enum")
            record.fields.append((field.name, kind, needs, field.doc, field.default))
            self.names.append(Name(name, "field", source.header, f"{record.name}.{python_name(field.name)}", "", field.doc))
        groups: dict[str, Group] = {}
        for method in source.methods:
            name = f"{full}::{method.name}" if not method.constructor else f"{full}::{full.split('::')[-1]}"
            reason = skipped(name) or ("an operator" if method.name.startswith(("operator", "~")) else "")
            if reason:
                self.names.append(Name(name, "method", source.header, "", reason, method.doc))
                continue
            made = self._callable(method, path, values, record)
            if made is None:
                continue
            if method.constructor:
                if not source.abstract:
                    record.constructors.append(made)
                    if len(method.parameters) >= 1 and not method.explicit and all(
                            p.default is not None for p in method.parameters[1:]):
                        first = made.arguments[0].type
                        if first.plain().text() != record.cpp:
                            record.stand_ins.append(first)
                self.names.append(Name(name, "constructor", source.header, record.name, "", method.doc))
                continue
            group = groups.setdefault(made.name, Group(made.name, [], method.static))
            group.overloads.append(made)
            if not method.const and not method.static:
                record.machine = True
            self.names.append(Name(name, "method", source.header, f"{record.name}.{made.name}", "", method.doc))
        record.methods = list(groups.values())
        if record.name in rules.MACHINES:
            record.machine = True

    def _define_function(self, function: Function) -> None:
        full = "::".join((*function.scope, function.name))
        reason = skipped(full) or ("an operator" if function.name.startswith("operator") else "")
        if reason:
            if not any(n.cpp == full for n in self.names):
                self.names.append(Name(full, "function", function.header, "", reason, function.doc))
            return
        versions: list[dict[str, str]] = [{}]
        if function.template:
            if not all(p in rules.DIMENSIONS for p in function.template):
                self.problems.append(f"{full}: a template of {', '.join(function.template)}")
                return
            versions = [dict(zip(function.template, v)) for v in (("2",), ("3",))]
        module = module_of(function.header)
        space = self._space(function.scope)
        python = ".".join((*space, python_name(function.name)))
        for values in versions:
            made = self._callable(function, function.scope, values, None)
            if made is None:
                return
            group = self.functions.setdefault((space, function.name, module), Group(python_name(function.name), []))
            group.overloads.append(made)
        self.names.append(Name(full, "function", function.header, python, "", function.doc))

    # Callables --------------------------------------------------------------------------------------------

    def _callable(self, f: Function, scope: tuple[str, ...], values: dict[str, str], record: Record | None) -> Callable_ | None:
        full = "::".join((*scope, f.name)) if record else "::".join((*f.scope, f.name))
        # libclang qualifies a name or not, as its version has it.
        types = ", ".join(p.type for p in f.parameters).replace("vericone::", "")
        reason = rules.SKIPPED_OVERLOADS.get((full, types))
        if reason:
            self.names.append(Name(full, "overload", f.header, "", reason, f.doc))
            return None
        try:
            arguments = []
            for p in f.parameters:
                kind = self.resolve(p.type, scope, values)
                self.check(kind)
                arguments.append(Argument(python_name(p.name), kind, p.default, self._role(full, p.name, kind)))
            if f.constructor:  # an object keeps no pointer to what Python has no hold of
                arguments = [a for a in arguments if a.role != "memory"]
            result = self.resolve("void" if f.constructor else f.result, scope, values)
            if not f.constructor:
                self.check(result, result=True)
        except Internal as error:
            self.names.append(Name(full, "overload", f.header, "", f"speaks of {error}, a type of the library's own", f.doc))
            return None
        except (Unbound, ValueError) as error:
            self.problems.append(f"{full}({', '.join(p.type for p in f.parameters)}) -> {f.result}: {error}")
            return None
        if record and not f.static and not f.constructor:
            call = "self." + f.name
        elif record:
            call = record.cpp if f.constructor else f"{record.cpp}::{f.name}"
        else:
            instance = f"<{', '.join(values[p] for p in f.template)}>" if f.template else ""
            call = f"vericone::{full}{instance}"
        made = Callable_(python_name(f.name), f, call, arguments, result, f.doc, module=module_of(f.header))
        if full in rules.LONG or f.header.startswith("verify/"):
            made.work = "lasts"
        elif any(self.kind(a.type) in ("vector", "span", "matrix", "text") for a in arguments):
            made.work = "grows"
        made.whole = rules.WHOLE.get((full, len([a for a in arguments if a.role != "asked"])), "")
        question = record is None or f.const
        made.many = (question and not f.constructor and not f.static and f.header.startswith(rules.MANY_FOLDERS) and self.answers(result)
                     and not any(a.role in ("changed", "memory") for a in arguments)
                     and any(self.is_question(a) for a in arguments))
        if made.many:
            for a in arguments:
                if a.role == "value" and self.is_question(a):
                    a.role = "many"
        return made

    def _role(self, full: str, name: str, kind: Type) -> str:
        if kind.reference == "*" and not kind.const:
            return "asked" if kind.name in rules.ASKED else "memory"
        if kind.reference == "&" and not kind.const:
            record = self.record(kind) if self.kind(kind) == "class" else None
            return "value" if record and record.machine else "changed"  # machines are not copied
        if kind.name == "Eigen::Ref" and not kind.arguments[0].const and not kind.const:
            return "changed"
        if kind.name == "std::span" and not kind.arguments[0].const and not full.startswith("vericone::never"):
            return "changed"
        return "value"

    def is_question(self, a: Argument) -> bool:
        kind = self.kind(a.type)
        if a.type.reference == "*" or a.role not in ("value", "many"):
            return False
        if kind == "number" or (kind == "fixed" and a.type.arguments[2].name == "1" and int(a.type.arguments[1].name) <= 4):
            return True
        if kind == "array":  # an exact vector
            return self.kind(a.type.arguments[0]) == "rational"
        if kind == "class":
            record = self.record(a.type)
            assert record
            return not record.path[-1].endswith(rules.NOT_QUESTIONS) and not record.machine
        return False

    def answers(self, result: Type) -> bool:
        """Whether many of these make an array."""
        kind = self.kind(result)
        if kind in ("number", "integer", "boolean", "enum", "fixed"):
            return result.reference != "*"
        if kind == "class":
            return True
        if kind == "optional":
            return self.answers(result.arguments[0])
        return False

    def is_column(self, kind: Type) -> bool:
        """As Convert<T>::kColumn, of records with all their fields."""
        what = self.kind(kind)
        if what in ("number", "integer", "boolean", "enum", "fixed"):
            return True
        if what == "array":
            return self.kind(kind.arguments[0]) in ("number", "integer", "boolean")
        if what == "optional":
            return self.is_column(kind.arguments[0])
        if what == "class":
            if kind.name == "vericone::Interval":
                return True
            record = self.record(kind)
            return bool(record and record.is_record and record.fields and all(self.is_column(t) for _, t, _, _, _ in record.fields))
        return False

    # Kinds of types ---------------------------------------------------------------------------------------

    def kind(self, kind: Type) -> str:
        name = kind.name
        if name in ("double", "float"):
            return "number"
        if name == "bool":
            return "boolean"
        if name == "void":
            return "none"
        if name in INTEGERS:
            return "integer"
        if name in ("std::string", "std::string_view") or (name == "char" and kind.reference == "*"):
            return "text"
        if name == "std::filesystem::path":
            return "path"
        if name in ("Eigen::Matrix", "Eigen::Ref"):
            matrix = kind.arguments[0] if name == "Eigen::Ref" else kind
            return "fixed" if int(matrix.arguments[1].name) > 0 and int(matrix.arguments[2].name) > 0 else "matrix"
        if name == "Eigen::Isometry3d":
            return "motion"
        if name == RATIONAL:
            return "rational"
        if name == WHOLE:
            return "whole"
        if name.startswith("std::"):
            return name[5:]
        if self.enum(kind):
            return "enum"
        if self.record(kind):
            return "class"
        raise Unbound(f"{kind.text()} has no form in Python")

    def check(self, kind: Type, result: bool = False, field: bool = False) -> None:
        what = self.kind(kind)
        if what == "function":
            for part in kind.arguments[0].arguments:
                self.check(part)
            return
        if what in ("variant", "optional", "vector", "array", "span", "pair", "shared_ptr", "unique_ptr"):
            for part in kind.arguments:
                if not re.fullmatch(r"\d+", part.name):
                    self.check(part)
        if kind.reference == "*" and field and what != "text":
            raise Unbound("a pointer")
        if kind.reference == "**" or (what == "vector" and kind.arguments[0].reference):
            raise Unbound("a list of pointers")
