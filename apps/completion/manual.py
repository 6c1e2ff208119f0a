#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""manual.py PROGRAM: prints the manual page of `vericone` from the helps of all commands that PROGRAM has. The
installation writes it."""

import re
import subprocess
import sys


def commands(program):
    """(name, summary) in the order of the help."""
    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^  ([a-z][a-z-]*) +(\S.*)$", text, re.MULTILINE)


def help_of(program, name):
    """Without the summary, which is the section's, and called as users call it; nothing of a command that is not there."""
    text = subprocess.run([program, name, "--help"], capture_output=True, text=True, check=False).stdout
    return "\n".join(line.rstrip() for line in text.replace(program, "vericone").strip().splitlines()[1:])


def roff(text):
    """As it stands: no line is a request, no character a command."""
    lines = text.replace("\\", "\\e").replace("-", "\\-").splitlines()
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in lines)


def manual(program):
    yield '.TH VERICONE 1 "" "vericone" "User Commands"\n.SH NAME\nvericone \\- collision, rendezvous and orifice cones'
    yield ".SH SYNOPSIS\n.B vericone\n.I COMMAND\n[options]"
    yield ".SH DESCRIPTION\n" + roff("Computes the set of relative velocities that bring two moving bodies into contact, or"
                                    " through an opening. Below are all commands as their helps have them; words, units and"
                                    " file formats are in the pages of docs/reference.")
    yield ".SH COMMANDS"
    for name, summary in commands(program):
        yield f".SS {roff(name)}\n{roff(summary)}.\n.PP\n.nf\n{roff(help_of(program, name))}\n.fi"


if __name__ == "__main__":
    for part in manual(sys.argv[1]):
        print(part)
