# SPDX-License-Identifier: BSD-3-Clause
"""The documentation as a site (scripts/site): Sphinx with MyST and Furo, as Debian has them."""
project = "vericone"
author = "the vericone authors"
copyright = "the vericone authors, BSD 3-clause"  # noqa: A001
extensions = ["myst_parser"]
myst_heading_anchors = 5
myst_enable_extensions = ["html_image"]
# Outputs have `...` for what varies, which no lexer knows; pages of the source tree begin where their readers do.
suppress_warnings = ["misc.highlighting_failure", "myst.header"]
root_doc = "index"
html_theme = "furo"
html_title = "vericone"
html_copy_source = False
html_show_sourcelink = False
html_show_search_summary = False  # they are fetched, and no page of a folder may fetch another
html_last_updated_fmt = None
pygments_style = "default"
pygments_dark_style = "github-dark"
