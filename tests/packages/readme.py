#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs what the README shows with the installed command, without the sources, in the folder it is called in
(scripts/try-packages). tests/docs/pages.py has the notation."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

DOC = Path("/usr/share/doc/vericone")
os.environ["VERICONE_SOURCE"] = str(DOC)
from pages import blocks, commands, pattern  # noqa: E402

shutil.copytree(DOC / "docs/examples", "docs/examples")
Path("run").symlink_to("/usr/bin/vericone")
wrong, run = 0, 0
for block in blocks(DOC / "README.md"):
    if block.language != "console" or block.note:
        continue
    for command, output in commands(block):
        if command == "echo $?":
            continue
        printed = subprocess.run(["bash", "-c", command], text=True, check=False, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT).stdout
        run += 1
        if output and not pattern(output).fullmatch(re.sub(r"[ ]+$", "", printed.rstrip("\n"), flags=re.M) + "\n"):
            wrong += 1
            print(f"{block}: $ {command}\n--- the page\n{output}\n--- printed\n{printed}")
print(f"README: {run} commands, {wrong} print something else")
sys.exit(wrong > 0 or run < 5)
