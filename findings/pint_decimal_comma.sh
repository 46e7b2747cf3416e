#!/usr/bin/env bash
# pint drops commas from what it parses: a length typed with a decimal comma, 5,5 cm, becomes 55 cm without a word.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check pint==0.25.3
"$folder/venv/bin/python" - <<'PY'
import pint
ureg = pint.UnitRegistry()
found = {text: str(ureg.Quantity(text)) for text in ("5.5 cm", "5,5 cm", "1,05 m")}
print("pint", pint.__version__, found)
assert found == {"5.5 cm": "5.5 centimeter", "5,5 cm": "55 centimeter", "1,05 m": "105 meter"}, "behaviour changed"
PY
