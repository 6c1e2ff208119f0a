# SPDX-License-Identifier: BSD-3-Clause
"""What ./check runs of many cases of one kind that take long: a part, which the date draws, so that in as many days as
there are parts all of them run. VERICONE_DAY is another day's number, VERICONE_CAMPAIGN=long stands for all."""
import datetime
import os


def drawn(cases, parts):
    cases = list(cases)
    if os.environ.get("VERICONE_CAMPAIGN") == "long":
        return cases
    day = int(os.environ.get("VERICONE_DAY", datetime.date.today().toordinal()))
    today = cases[day % parts::parts]
    if parts > 1:
        print(f"VERICONE_DAY={day}: {len(today)} of {len(cases)}: {', '.join(map(str, today))}", flush=True)
    return today
