# SPDX-License-Identifier: BSD-3-Clause
"""What the pages show of Python is what it prints."""

import doctest
from pathlib import Path

import pytest

PAGES = ["python/README.md", "docs/howto/python.md", "docs/explanation/python.md"]


@pytest.mark.parametrize("page", PAGES)
def test_examples_print_what_is_shown(source: Path, page: str) -> None:
    failures, _ = doctest.testfile(str(source / page), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert failures == 0


def test_there_are_examples(source: Path) -> None:
    parser = doctest.DocTestParser()
    assert len(parser.get_examples((source / PAGES[0]).read_text(encoding="utf-8"))) > 5
