#!/usr/bin/env bash
# isal's levels 1 and 2 compress the same bytes to different bytes in different processes: about one process in ten gets
# another stream for one of 300 short inputs. All streams decompress to the input; levels 0 and 3 are the same everywhere.
# Who compares files by their checksum, or caches by it, must not compress with levels 1 and 2 (2 is the default).
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check isal==1.9.1
cat > "$folder/one.py" <<'PY'
import hashlib
import random
import zlib
from isal import isal_zlib
random_bytes = random.Random(1).randbytes
inputs = [random_bytes(400) * 4 for _ in range(300)]
for level in (0, 1, 2, 3):
    streams = [isal_zlib.compress(each, level=level) for each in inputs]
    assert [zlib.decompress(stream) for stream in streams] == inputs
    print(hashlib.sha256(b"".join(streams)).hexdigest()[:8], end=" ")
print()
PY
for _ in $(seq 300); do "$folder/venv/bin/python" "$folder/one.py"; done > "$folder/all"
"$folder/venv/bin/python" - "$folder/all" <<'PY'
import sys
from collections import Counter
from importlib.metadata import version
print("isal", version("isal"))
columns = list(zip(*(line.split() for line in open(sys.argv[1])), strict=True))
for level, column in enumerate(columns):
    kinds = Counter(column)
    usual = kinds.most_common(1)[0][1]
    print(f"level {level}: {len(kinds)} different result(s) in {len(column)} processes, the usual one in {usual}")
assert [len(set(column)) > 1 for column in columns] == [False, True, True, False], "behaviour changed"
PY
