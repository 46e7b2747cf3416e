"""All benchmarks, one after the other.

    python benchmarks/run.py [--quick] [--json FILE]

About six minutes; with --quick a quarter of one.
"""

from __future__ import annotations

import columns
import common
import memory
import peers
import points
import proofs
import scaling
import scans
import startup

if __name__ == "__main__":
    common.main(
        __doc__,
        {
            "points": points.run,
            "scaling": scaling.run,
            "columns": columns.run,
            "scans": scans.run,
            "memory": memory.run,
            "startup": startup.run,
            "peers": peers.run,
            "proofs": proofs.run,
        },
    )
