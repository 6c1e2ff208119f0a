# SPDX-License-Identifier: BSD-3-Clause
"""The C++ sources of the modules, from the model: tables for python/src, one small function for each call."""
from __future__ import annotations

import re

import rules
from cxxtypes import Type
from docs import docstring
from model import Argument, Callable_, Group, Model, PyEnum, Record, python_name
from requirements import Requirement


def quoted(text: str) -> str:
    """A C++ string literal; long ones in parts, since compilers have limits."""
    parts = [text[i : i + 8000] for i in range(0, len(text), 8000)] or [""]
    return " ".join('"' + part.replace("\\", "\\\\").replace('"', '\\"').replace("\n", '\\n"\n"') + '"' for part in parts)


class Emitter:
    def __init__(self, model: Model, module: str, requirements: dict[tuple[str, int], Requirement]) -> None:
        self.model = model
        self.requirements = requirements
        self.module = module
        self.counter = 0
        self.defaults: list[str] = []

    # Types --------------------------------------------------------------------------------------------------

    def storage(self, kind: Type) -> str:
        """The type of what is made of a Python object for a parameter."""
        what = self.model.kind(kind)
        if what == "span":
            inner = kind.arguments[0]
            return "Flags" if inner.name == "bool" else f"std::vector<{inner.plain().text()}>"
        if what == "text":
            return "std::string"
        if kind.name == "Eigen::Ref":
            return kind.arguments[0].plain().text()
        return kind.plain().text()

    def element(self, kind: Type) -> str:
        return f"ObjectOf<{kind.plain().text()}>" if self.model.kind(kind) in ("class", "array") else kind.plain().text()

    # Calls --------------------------------------------------------------------------------------------------

    def default(self, call: Callable_, argument: Argument, record: Record | None) -> str:
        """The name of a function that makes the default value, in the scope of the declaration."""
        self.counter += 1
        name = f"default_{self.counter}"
        text = argument.default or "{}"
        source = record.source if record else None
        values = self.model._values(record) if record else {}
        if source:
            for alias, target in source.aliases.items():
                try:
                    resolved = self.model.resolve(target, source.path, values).text()
                except Exception:  # noqa: BLE001: an alias that no default uses
                    continue
                text = re.sub(rf"\b{alias}\b", resolved, text)
        for key, value in values.items():
            text = re.sub(rf"\b{key}\b", value, text)
        space = "::".join(("vericone", *self.model._space(call.cpp.scope)))
        kind = self.storage(argument.type)
        if text in ("nullptr",) and kind.startswith("std::function"):
            text = "{}"
        self.defaults.append(f"namespace {space} {{ static {kind} {name}() {{ return {text}; }} }}")
        return f"{space}::{name}()"

    @staticmethod
    def full(call: Callable_, record: Record | None) -> str:
        return "::".join((*(record.source.path if record else call.cpp.scope), call.cpp.name))

    def requires(self, call: Callable_, record: Record | None, passed: list[str]) -> str:
        """What C++ asks of its callers, as expressions that throw."""
        found = []
        full = self.full(call, record)
        own = self.requirements.get((full, len(call.cpp.parameters)))
        if full in rules.REQUIRES:
            own = Requirement(*rules.REQUIRES[full], [p.name for p in call.cpp.parameters])
        if own:
            condition = own.condition
            members = {m.name for m in record.source.methods} | {f.name for f in record.source.fields} if record else ()
            for name in re.findall(r"(?<![\w.>:])[A-Za-z_]\w*", condition):
                if name in members and name not in own.parameters:
                    condition = re.sub(rf"(?<![\w.>:]){name}\b", f"self.{name}", condition)
                    members -= {name}
            for name, value in zip(own.parameters, passed):
                condition = re.sub(rf"(?<![\w.>:]){name}\b", value, condition)
            found.append(f'require({condition}, "{own.field}", "{own.got}", "{own.need}")')
        for i, a in enumerate(call.arguments):
            if self.model.kind(a.type) == "function" and a.default is None:
                found.append(f'require({passed[i]} != nullptr, "{a.name}", "None", "a callable")')
            of = a.type.arguments[0] if self.model.kind(a.type) in ("span", "vector") else a.type
            if of.plain().text() in rules.CHECKED:
                check = f"[](const auto& one) {{ {rules.CHECKED[of.plain().text()]}(one); }}"
                found.append(f'require_sound({passed[i]}, "{a.name}", {check})' if of is a.type else
                             f'require_all_sound({passed[i]}, "{a.name}", {check})')
        return ", ".join(found)

    def overload(self, call: Callable_, record: Record | None) -> tuple[str, str, str]:
        """The function of one overload, its table of parameters, and their names."""
        self.counter += 1
        number = self.counter
        lines: list[str] = []
        passed: list[str] = []
        table: list[str] = []
        changed: list[str] = []
        asked: tuple[int, Argument] | None = None
        many: list[tuple[str, str]] = []  # variable, element
        lambda_parameters: list[str] = []
        method = record is not None and not call.cpp.static and not call.cpp.constructor
        object_type = record.cpp if record else ""
        if method and call.many:
            lines.append(f"const Many m_self(g, -1, type_of<{object_type}>());")
            many.append(("m_self", f"ObjectOf<{object_type}>"))
            lambda_parameters.append("const auto& self")
        elif method:
            lines.append(f"{'const ' if call.cpp.const else ''}{object_type}& self = g.object<{object_type}>(-1);")
        for i, a in enumerate(call.arguments):
            text = a.type.plain().text()
            what = self.model.kind(a.type)
            variable = f"v{i}"
            optional = a.default is not None or a.role == "asked" or (a.type.reference == "*" and what != "text")
            could = f"&Convert<{self.storage(a.type)}>::could"
            if a.role == "many":
                could = "&could_many"
                if what == "class":
                    could = f"&could_be_many<{text}>"
                    make = f"Many(g, {i}, type_of<{text}>())"
                elif what == "array":
                    could = f"&Convert<{text}>::could"
                    make = f"Many(g, {i}, static_cast<const {text}*>(nullptr))"
                else:
                    make = f"Many(g, {i}, {0 if what == 'number' else a.type.arguments[1].name})"
                if a.default is None:
                    lines.append(f"const Many {variable}m{make[4:]};")
                elif what == "number":
                    lines.append(f'const Many {variable}m = g.has({i}) ? {make} : Many("{a.name}", {self.default(call, a, record)});')
                else:
                    lines.append(f"const {text} {variable}d = {self.default(call, a, record)};")
                    lines.append(f'const Many {variable}m = g.has({i}) ? {make} : Many("{a.name}", &{variable}d);')
                many.append((f"{variable}m", self.element(a.type)))
                lambda_parameters.append(f"const auto& {variable}")
                passed.append(variable)
            elif a.role == "asked":
                could = f"&Convert<bool>::could"
                asked = (i, a)
                passed.append("@asked")
            elif a.type.reference == "*" and what == "class" and a.role != "memory":
                could = f"&could_be_or_none<{text}>"
                lines.append(f"const {text}* {variable} = g.pointer<{text}>({i});")
                passed.append(variable)
            elif a.type.reference == "*" and what != "text":
                could = f"&Convert<std::optional<{text}>>::could"
                lines.append(f"std::optional<{text}> {variable} = g.has({i}) ? g.get<std::optional<{text}>>({i}) : std::nullopt;")
                passed.append(f"({variable} ? &*{variable} : nullptr)")
                if a.role == "memory":
                    changed.append(variable)
            elif a.role == "changed":
                storage = self.storage(a.type)
                otherwise = f"g.has({i}) ? g.get<{storage}>({i}) : {storage}{{}}" if optional else f"g.get<{storage}>({i})"
                lines.append(f"{storage} {variable} = {otherwise};")
                changed.append(variable)
                passed.append(variable)
            elif what == "class" and a.type.reference in ("", "&"):
                if a.default is None:
                    constant = "" if a.type.reference == "&" and not a.type.const else "const "
                    lines.append(f"{constant}{text}& {variable} = g.object<{text}>({i});")
                else:
                    lines.append(f"std::optional<{text}> {variable}d;")
                    lines.append(f"const {text}& {variable} = g.has({i}) ? g.object<{text}>({i}) : {variable}d.emplace({self.default(call, a, record)});")
                passed.append(variable)
            else:
                storage = self.storage(a.type)
                value = f"g.{'present' if 'shared_ptr' in storage and a.default is None else 'get'}<{storage}>({i})"
                if a.default is not None:
                    value = f"g.has({i}) ? {value} : {self.default(call, a, record)}"
                lines.append(f"{storage} {variable} = {value};")
                passed.append(f"std::move({variable})" if a.type.reference == "&&" or (what == "unique_ptr") else variable)
            options = f", &options_of<{text}>" if self.model.options(call, a) else ""
            table.append(f'{{"{a.name}", {could}, {str(optional).lower()}, {str(a.role == "asked").lower()}{options}}}')
        threads = len(call.arguments)
        if call.many:
            table.append('{"threads", nullptr, true, true}')
            lines.append(f"const int threads = g.threads({threads});")
        target = call.call
        if call.cpp.constructor:
            target = object_type
        braces = f"{target}({', '.join(passed)})"
        requires = self.requires(call, record, passed)
        if requires:
            braces = f"({requires}, {braces})"
        if call.many:
            elements = ", ".join(e for _, e in many)
            variables = ", ".join(v for v, _ in many)
            plain = braces.replace(", @asked", "").replace("@asked", "")
            answer = "answer" if self.model.is_column(call.result) else "answer_objects"
            if call.result.reference == "*":
                raise SystemExit(f"{call.call}: returns a pointer to many")
            parameters = ", ".join(lambda_parameters)
            if asked:
                i, a = asked
                kind = a.type.plain().text()
                lines.append(
                    f"if (g.wants({i})) return answer_with<{kind}, {elements}>(g, threads, [&]({parameters}, {kind}& asked) "
                    f"{{ return {braces.replace('@asked', '&asked')}; }}, {variables});")
                plain = braces.replace("@asked", "nullptr")
            if call.whole and len(many) == 2:
                vector = many[1][1]
                lines.append("if (m_self.single()) {")
                lines.append(f"  const auto& self = *static_cast<const {object_type}*>(m_self.one());")
                lines.append(f"  return answer_whole<{vector}>(g, threads, [&](const auto& {lambda_parameters[1].split()[-1]}) {{ return {plain}; }}, "
                             f"[&](const double* in, Py_ssize_t step, const auto& out) {{ self.{call.whole}(in, step, out); }}, {many[1][0]});")
                lines.append("}")
            lines.append(f"return {answer}<{elements}>(g, threads, [&]({parameters}) {{ return {plain}; }}, {variables});")
        else:
            if asked:
                i, a = asked
                kind = a.type.plain().text()
                lines.append(f"{kind} asked{{}};")
                braces = braces.replace("@asked", "&asked")
            what = self.model.kind(call.result)
            accessor = (method and call.cpp.const and not call.arguments and record and not record.machine and call.work == "quick" and
                        (call.result.reference or what in ("number", "boolean", "enum", "integer", "text")))
            if call.cpp.constructor:
                body = f"{requires}{';' if requires else ''} return own(new {object_type}({', '.join(passed)}));".replace("@asked", "&asked")
            elif call.result.reference == "*" and what != "text":
                body = f"return copied({braces});"
            elif what == "none":
                body = f"{braces};"
            else:
                body = f"return {braces};"
            if accessor and not (call.result.reference == "*" and what != "text"):
                lines.append(f"return to_python({braces});")
            elif what == "none" and not call.cpp.constructor:
                lines.append(f"run(g, [&] {{ {body} }});")
                if changed:
                    lines.append(f"return {'to_python(' + changed[0] + ')' if len(changed) == 1 else 'tuple_of({' + ', '.join(f'to_python({c})' for c in changed) + '})'};")
                else:
                    lines.append("Py_RETURN_NONE;")
            else:
                lines.append(f"auto result = run(g, [&] {{ {body} }});")
                if call.cpp.constructor:
                    lines.append(f"return new_instance(type_of<{object_type}>(), std::move(result));")
                elif asked:
                    lines.append(f"if (g.wants({asked[0]})) return tuple_of({{to_python(std::move(result)), to_python(asked)}});")
                    lines.append("return to_python(std::move(result));")
                elif changed:
                    memory = [a for a in call.arguments if a.role == "memory"]
                    if memory and len(changed) == 1:
                        lines.append(f"if (!{changed[0]}) return to_python(std::move(result));")
                    parts = ", ".join(["to_python(std::move(result))", *(f"to_python({c})" for c in changed)])
                    lines.append(f"return tuple_of({{{parts}}});")
                elif self.full(call, record) in rules.KEEPS_SELF:
                    lines.append("return keeping(to_python(std::move(result)), g.self);")
                else:
                    lines.append("return to_python(std::move(result));")
        body = "\n  ".join(lines)
        function = f"PyObject* call_{number}([[maybe_unused]] Given& g) {{\n  {body}\n}}\n"
        parameters_table = (f"constexpr Parameter parameters_{number}[] = {{{', '.join(table)}}};\n" if table else
                            f"constexpr std::span<const Parameter> parameters_{number}{{}};\n")
        work = "" if call.work == "quick" else f", Work::{call.work}"
        return function + parameters_table, f"{{parameters_{number}, call_{number}{work}}}", ""

    def group(self, group: Group, record: Record | None, many_names: list[str]) -> tuple[str, str]:
        """C++ of a group of overloads, and its entry in a table of methods."""
        texts, entries = [], []
        for call in group.overloads:
            text, entry, _ = self.overload(call, record)
            texts.append(text)
            entries.append(entry)
        self.counter += 1
        number = self.counter
        name = f"{record.path[-1]}.{group.name}" if record else group.name
        texts.append(f"constexpr Overload overloads_{number}[] = {{{', '.join(entries)}}};\n"
                     f"PyObject* function_{number}(PyObject* self, PyObject* const* arguments, Py_ssize_t n, PyObject* names) {{\n"
                     f'  return call("{name}", overloads_{number}, self, arguments, n, names);\n}}\n')
        flags = "METH_FASTCALL | METH_KEYWORDS" + (" | METH_STATIC" if group.static else "")
        doc = quoted(docstring(self.model, group, record))
        if record and any(c.many for c in group.overloads):
            many_entries = [e for e, c in zip(entries, group.overloads) if c.many]
            texts.append(f"constexpr Overload many_overloads_{number}[] = {{{', '.join(many_entries)}}};\n"
                         f"PyObject* many_{number}(PyObject*, PyObject* const* arguments, Py_ssize_t n, PyObject* names) {{\n"
                         f'  return call_many("{name}", many_overloads_{number}, arguments, n, names);\n}}\n')
            many_names.append(f'  {{"{record.name}.{group.name}", method(many_{number}), METH_FASTCALL | METH_KEYWORDS, nullptr}},')
        return "".join(texts), f'{{"{group.name}", method(function_{number}), {flags}, {doc}}}'

    # Entities -----------------------------------------------------------------------------------------------

    def enum(self, enum: PyEnum) -> str:
        members = " ".join(f"{python_name(n)} {v}" for n, v, _ in enum.source.members)
        doc = enum.source.doc + "\n\n" + "\n".join(
            f"{python_name(n)}: {d}" if d else python_name(n) for n, _, d in enum.source.members)
        return f'  add_enum(typeid({enum.cpp}), "{enum.name}", {quoted(members)}, {quoted(doc.strip())});\n'

    def record(self, record: Record, many_names: list[str], results: set[str]) -> tuple[str, str]:
        self.counter += 1
        number = self.counter
        before: list[str] = []
        methods: list[str] = []
        for group in record.methods:
            text, entry = self.group(group, record, many_names)
            before.append(text)
            methods.append(entry)
        construct = "nullptr"
        if record.constructors and not record.source.abstract:
            entries = []
            for call in record.constructors:
                text, entry, _ = self.overload(call, record)
                before.append(text)
                entries.append(entry)
            before.append(f"constexpr Overload constructors_{number}[] = {{{', '.join(entries)}}};\n"
                          f"PyObject* new_{number}(PyTypeObject* type, PyObject* arguments, PyObject* named) {{\n"
                          f'  return construct("{record.path[-1]}", constructors_{number}, type, arguments, named);\n}}\n')
            construct = f"new_{number}"
        elif (record.is_record or (record.source.default_constructible and not record.source.abstract)) and \
                record.source.default_constructible:
            before.append(f"PyObject* new_{number}(PyTypeObject* type, PyObject* arguments, PyObject* named) {{\n"
                          f"  return construct_record(type_of<{record.cpp}>(), type, arguments, named);\n}}\n")
            construct = f"new_{number}"
        lines = ["  {", f"    using T = {record.cpp};", f"    TypeInfo& info = type_of<{record.cpp}>();", f'    info.name = "{record.name}";',
                 f"    describe<{record.cpp}>(info);"]
        if record.machine:
            lines.append("    info.machine = true;")
        if record.base:
            lines.append(f"    inherit<{record.cpp}, {record.base}>(info);")
        if record.fields:
            lines.append("    info.fields = {")
            for name, _, needs, doc, _ in record.fields:
                lines.append(f'      {{"{python_name(name)}", offsetof(T, {name}), &kConverter<std::remove_cv_t<decltype(T::{name})>>, '
                             f"{str(needs).lower()}, {quoted(doc)}}},")
            lines.append("    };")
        if record.cpp in results:
            for group in record.methods:
                call = group.overloads[0]
                if len(group.overloads) == 1 and not call.arguments and call.cpp.const and self.model.is_column(call.result):
                    lines.append(f'    derive<{record.cpp}>(info, "{group.name}", [](const {record.cpp}& r) {{ return r.{call.cpp.name}(); }});')
        if record.stand_ins:
            tests = " || ".join(f"Convert<{self.storage(t)}>::could(given)" for t in record.stand_ins)
            lines.append(f"    info.has_stand_in = [](PyObject* given) {{ return {tests}; }};")
            tries = "".join(
                f" if (Convert<{self.storage(t)}>::could(given)) return own(new {record.cpp}(Convert<{self.storage(t)}>::from(given, place)));"
                for t in record.stand_ins)
            lines.append(f"    info.stand_in = []([[maybe_unused]] PyObject* given, [[maybe_unused]] const Place& place) -> std::shared_ptr<void> {{{tries} return nullptr; }};")
        if methods:
            lines.append(f"    static PyMethodDef methods[] = {{\n      {(',' + chr(10) + '      ').join(methods)},\n      {{}}}};")
        doc = docstring(self.model, Group(record.path[-1], record.constructors), record, of_class=True)
        lines.append(f"    add_type(info, {quoted(doc)}, {'methods' if methods else 'nullptr'}, {construct});")
        lines.append("  }")
        return "".join(before), "\n".join(lines) + "\n"

    def sources(self, parts: int) -> dict[str, str]:
        """File name: text."""
        model = self.model
        records = [r for r in model.records.values() if r.module == self.module]
        enums = [e for e in model.enums.values() if e.module == self.module]
        functions = [(space, g) for (space, _, module), g in model.functions.items() if module == self.module]
        if not (records or enums or functions):
            return {}
        results: set[str] = set()
        for (_, _, _), g in model.functions.items():
            results.update(self._result(c) for c in g.overloads if c.many)
        for r in model.records.values():
            for g in r.methods:
                results.update(self._result(c) for c in g.overloads if c.many)
        headers = sorted({"/".join(h.split("include/", 1)[1:]) for h in self._headers(records, enums, functions)})
        files: dict[str, str] = {}
        own = "".join(f"#include <{h}>\n" for h in headers)
        flags = "".join(f"template <> struct IsRecord<{r.cpp}> : std::true_type {{}};\n"
                        for r in model.records.values()
                        if r.is_record and model.is_column(Type(r.cpp)) and self._included(r, headers))
        if self.module == "_core":  # what all modules are compiled with
            files["library.h"] = "#pragma once\n" + own
            own = '#include "library.h"\n'
        files[f"{self.module}.h"] = ("#pragma once\n" + own + '#include "bind.h"\n\nnamespace vericone::python {\n' + flags + "}\n")
        # Of about equal length; a type that others are in comes before them.
        weights = [len(r.methods) * 3 + len(r.fields) + len(r.constructors) * 3 + 2 for r in records]
        total = sum(weights) + 4 * len(functions)
        chunks: list[tuple[list[Record], list[tuple[tuple[str, ...], Group]]]] = [([], [])]
        reached, done = 0, 0
        items: list[tuple[int, Record | tuple[tuple[str, ...], Group]]] = [*zip(weights, records), *((4 * len(f[1].overloads), f) for f in functions)]
        for weight, item in items:
            if reached >= total / parts and len(chunks) < parts:
                chunks.append(([], []))
                reached = 0
            reached += weight
            if isinstance(item, Record):
                chunks[-1][0].append(item)
            else:
                chunks[-1][1].append(item)
        main = ["\nnamespace vericone::python {\n"]
        calls: list[str] = []
        for k, (some, some_functions) in enumerate(chunks):
            self.defaults = []
            many_names: list[str] = []
            before, types, tables = [], [], []
            for r in some:
                a, b = self.record(r, many_names, results)
                before.append(a)
                types.append(b)
            spaces: dict[str, list[str]] = {}
            for space, g in some_functions:
                text, entry = self.group(g, None, many_names)
                before.append(text)
                spaces.setdefault(".".join(space), []).append(entry)
            for space, entries in spaces.items():
                tables.append(f"  static PyMethodDef functions_{len(tables)}[] = {{\n    {(',' + chr(10) + '    ').join(entries)},\n    {{}}}};\n"
                              f'  for (PyMethodDef* f = functions_{len(tables)}; f->ml_name; ++f) add_function("{space}", f);\n')
            if k == 0:
                for path, kind, _, module in self.model.constants:
                    if module == self.module:
                        tables.append(f'  add_constant("{".".join(path[:-1])}", "{path[-1]}", to_python({kind.plain().text()}(vericone::{"::".join(path)})));\n')
            if many_names:
                tables.append("  static PyMethodDef many[] = {\n" + "\n".join(many_names) + "\n    {}};\n"
                              '  for (PyMethodDef* f = many; f->ml_name; ++f) add_function("_many", f);\n')
            head = f'#include "{self.module}.h"\n\n' + "\n".join(self.defaults) + "\n"
            nested = {r.path for r in model.records.values()}
            enum_text = "".join(self.enum(e) for e in enums if e.path[:-1] not in nested) if k == 0 else ""
            # Those within a type follow it.
            types += [self.enum(e) for e in enums if any(e.path[:-1] == r.path for r in some)]
            files[f"{self.module}_{k}.cpp"] = (
                head + "namespace vericone::python {\nnamespace {\n" + "".join(before) + "}  // namespace\n\n" +
                f"void add_enums_{k}() {{\n{enum_text}}}\n\nvoid add_types_{k}() {{\n{''.join(types)}}}\n\nvoid add_functions_{k}() {{\n{''.join(tables)}}}\n}}\n")
            main.append(f"void add_enums_{k}();\nvoid add_types_{k}();\nvoid add_functions_{k}();\n")
        for what in ("enums", "types", "functions"):
            calls += [f"  vericone::python::add_{what}_{k}();" for k in range(len(chunks))]
        extra = "void describe_values();\n" if self.module == "_core" else ""
        after = "  vericone::python::describe_values();\n" if self.module == "_core" else ""
        main.append(extra + f'}}\n\nPyMODINIT_FUNC PyInit_{self.module}() {{\n'
                    f'  return vericone::python::make_module("{self.module}", [] {{\n' + "\n".join(calls) + "\n" + after + "  });\n}\n")
        last = f"{self.module}_{parts - 1}.cpp"
        files[last] = files.get(last, f'#include "{self.module}.h"\n') + "".join(main)
        return files

    def _result(self, call: Callable_) -> str:
        kind = call.result
        if kind.name == "std::optional":
            kind = kind.arguments[0]
        return kind.plain().text()

    def _headers(self, records: list[Record], enums: list[PyEnum], functions: list[tuple[tuple[str, ...], Group]]) -> set[str]:
        return ({r.source.header for r in records} | {e.source.header for e in enums} |
                {c.cpp.header for _, g in functions for c in g.overloads})

    def _included(self, record: Record, headers: list[str]) -> bool:
        header = record.source.header.split("include/", 1)[1]
        return header in headers or record.module == "_core" and self.module != "_core" and False
