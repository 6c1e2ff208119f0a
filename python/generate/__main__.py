# SPDX-License-Identifier: BSD-3-Clause
"""generate ROOT OUT PARTS MODULES INCLUDE... (MODULES: those of CMake, separated by commas): the C++ sources of all modules, the stubs and the list of names, from the headers
of the library below ROOT. Files that stay the same are not touched."""
from __future__ import annotations

import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import emit  # noqa: E402
import headers  # noqa: E402
import model as models  # noqa: E402
import requirements  # noqa: E402
import rules  # noqa: E402
import stubs  # noqa: E402


def write(path: str, text: str) -> None:
    os.makedirs(os.path.dirname(path), exist_ok=True)
    try:
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    except FileNotFoundError:
        pass
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main() -> None:
    root, out, parts, wanted, *includes = sys.argv[1:]
    modules = wanted.split(",")
    folders = [os.path.join(prefix, "include") for prefix in (*rules.FOLDERS, *(["verify"] if "_verify" in modules else []))]
    found = sorted(headers.public_headers(root, folders))
    interface = headers.Reader(root).read(found, [*(os.path.join(root, f) for f in folders), *includes])
    model = models.Model(interface)
    if model.problems:
        sys.exit("the Python binding does not know what to do with\n  " + "\n  ".join(model.problems) +
                 "\nsay so in python/generate/rules.py")
    required = requirements.read(root, rules.FOLDERS)
    for module in dict.fromkeys(m for _, m in rules.MODULES):
        count = int(parts) if module == "_core" else 1
        for name, text in emit.Emitter(model, module, required).sources(count).items():
            write(os.path.join(out, "src", name), text)
    package = stubs.package(model)
    for name, text in package.items():
        write(os.path.join(out, name), text)
    for old in os.listdir(os.path.join(out, "package")):  # of namespaces that are gone, as written and as copied
        if f"package/{old}" not in package:
            for folder in ("package", "vericone"):
                if os.path.exists(os.path.join(out, folder, old)):
                    os.remove(os.path.join(out, folder, old))
    own = [vars(n) for n in model.names if not n.cpp.startswith("verify::")]
    write(os.path.join(out, "names.json"), json.dumps(own, indent=1))
    write(os.path.join(out, "overloads.json"), json.dumps(model.overloads(), indent=1))
    apart = [vars(n) for n in model.names if n.cpp.startswith("verify::")]
    write(os.path.join(out, "names_verify.json"), json.dumps(apart, indent=1))


main()
