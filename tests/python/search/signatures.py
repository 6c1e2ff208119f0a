# SPDX-License-Identifier: BSD-3-Clause
"""The signatures of the package, read from its stubs: what each callable takes, as written there."""

import ast
import importlib
import inspect
import pkgutil
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any


@dataclass
class Signature:
    """One overload. Parameters in their order: (name, annotation, whether it may be left out, by name only)."""

    parameters: list[tuple[str, str, bool, bool]] = field(default_factory=list)
    returns: str = ""


@dataclass
class Callable:
    name: str  # "guidance.Navigator.step"
    owner: str  # the class of a method, else ""
    kind: str  # "function", "class", "method", "static", "property"
    target: Any  # a function or class; of methods and properties the name of the attribute
    signatures: list[Signature]


def modules(package: ModuleType) -> list[ModuleType]:
    """The package and its modules, private ones, parts of modules and what cannot be imported here left out."""
    found = [package]
    for info in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        if info.name.count(".") > package.__name__.count(".") + 1 or any(part.startswith("_") for part in info.name.split(".")):
            continue
        try:
            found.append(importlib.import_module(info.name))
        except ImportError:
            pass  # built without what it needs
    return found


def _signature(node: ast.FunctionDef, method: bool) -> Signature:
    names = node.args
    positional = [*names.posonlyargs, *names.args]
    required = len(positional) - len(names.defaults)
    parameters = [(a.arg, ast.unparse(a.annotation) if a.annotation else "", i >= required, False)
                  for i, a in enumerate(positional)]
    parameters += [(a.arg, ast.unparse(a.annotation) if a.annotation else "", default is not None, True)
                   for a, default in zip(names.kwonlyargs, names.kw_defaults)]
    return Signature(parameters[1:] if method else parameters, ast.unparse(node.returns) if node.returns else "")


def _decorators(node: ast.FunctionDef) -> set[str]:
    return {ast.unparse(decorator).split(".")[-1] for decorator in node.decorator_list}


def _described(body: list[ast.stmt], method: bool) -> dict[str, tuple[str, list[Signature]]]:
    """Name: its kind and signatures."""
    found: dict[str, tuple[str, list[Signature]]] = {}
    for node in body:
        if not isinstance(node, ast.FunctionDef):
            continue
        marks = _decorators(node)
        kind = "property" if "property" in marks else "static" if "staticmethod" in marks or "classmethod" in marks else "method"
        receiver = method and "staticmethod" not in marks
        found.setdefault(node.name, (kind, []))[1].append(_signature(node, receiver))
    return found


def _file_of(module: str, package: ModuleType) -> Path | None:
    """What describes a module: its stub, or its own source."""
    base = Path(package.__path__[0], *module.split(".")[1:])
    for candidate in (base.with_suffix(".pyi"), base / "__init__.pyi", base.with_suffix(".py"), base / "__init__.py"):
        if candidate.exists():
            return candidate
    return None


def _stub_of(module: ModuleType, package: ModuleType) -> list[ast.stmt]:
    """What is said of its names, those that it takes from private modules of the package included."""
    path = _file_of(module.__name__, package)
    if path is None:
        return []
    body = ast.parse(path.read_text(encoding="utf-8")).body
    said = list(body)
    for node in body:
        if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith(package.__name__ + "._"):
            private = _file_of(node.module, package)
            if private:
                said += ast.parse(private.read_text(encoding="utf-8")).body
    return said


def callables(package: ModuleType) -> list[Callable]:
    """Every public function, class, method and property, each once, in the order of their names."""
    found: dict[str, Callable] = {}
    seen: set[int] = set()
    for module in modules(package):
        stub = _stub_of(module, package)
        space = module.__name__.removeprefix(package.__name__).removeprefix(".")
        functions = _described(stub, False)
        classes = {node.name: node for node in stub if isinstance(node, ast.ClassDef)}
        for name, value in sorted(vars(module).items()):
            full = f"{space}.{name}" if space else name
            if name.startswith("_") or inspect.ismodule(value) or id(value) in seen:
                continue
            if inspect.isclass(value) and name in classes:
                seen.add(id(value))
                inner = _described(classes[name].body, True)
                made = inner.get("__init__", inner.get("__new__", ("", [Signature()])))[1]
                found[full] = Callable(full, "", "class", value, made)
                for attribute, (kind, signatures) in inner.items():
                    if attribute.startswith("__"):
                        continue
                    target = getattr(value, attribute, None) if kind == "static" else attribute
                    found[f"{full}.{attribute}"] = Callable(f"{full}.{attribute}", full, kind, target, signatures)
            elif callable(value) and name in functions:
                seen.add(id(value))
                found[full] = Callable(full, "", "function", value, functions[name][1])
    return [found[name] for name in sorted(found)]
