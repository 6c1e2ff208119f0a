# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts share: their folder, the runs and tables in it. What they draw with is the package plot."""
