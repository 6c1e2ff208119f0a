# SPDX-License-Identifier: BSD-3-Clause
"""What all pictures share: one style, tables of runs, bodies, solids, directions."""
