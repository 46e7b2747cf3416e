"""Write docs/json.md from the JSON Schemas of the command line: python docs/json_page.py."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from bikestab_cli.schemas import SCHEMAS

PAGE = Path(__file__).with_name("json.md")
HEAD = """\
# What `--json` prints

Every command with `--json` prints one object. `results` has an entry for each thing that was asked about: a
design, a machine, a config. What is common to all of them stands beside it, and `files` names what was
written. Numbers have all their digits, in SI units; angles are in radians but for `head_angle_deg`. The
tables say which keys can be `null`. `certify` alone prints one object without `results`.

Of one bicycle as it is, `bicycle`, `model` and `delta` beside `results` tell all. Where there are several, or
`--set` changes one, each of `results` has its own `bicycle`, and in `set` what was changed; the `bicycle` and
`delta` beside them are then lists if they differ.

`bikestab schema COMMAND` prints the same as JSON Schema; the tests validate every command's output by it.

```sh
bikestab schema vrange > vrange.schema.json
bikestab vrange --bicycle meijaard2007 --json
```
"""


def page() -> str:
    """The page as text."""
    parts = [HEAD]
    for name, schema in sorted(SCHEMAS.items()):
        rows = "".join(f"| `{key}` | {kind} | {text} |\n" for key, kind, text in rows_of(schema, ""))
        parts.append(f"## {name}\n\n| key | type | |\n|---|---|---|\n{rows}")
    return "\n".join(parts)


def rows_of(schema: dict[str, Any], path: str) -> Iterator[tuple[str, str, str]]:
    """The keys below a schema, with what may stand there."""
    for kind in [each for each in schema.get("anyOf", []) if each.get("type") in ("object", "array")]:
        yield from rows_of(kind, path)
    if schema.get("type") == "array":
        yield from rows_of(schema["items"], f"{path}[]")
    required = schema.get("required", [])
    for key, inner in schema.get("properties", {}).items():
        whole = f"{path}.{key}".lstrip(".")
        text = inner.get("description", "")
        left_out = "" if key in required else "; may be left out"
        yield whole, _kind(inner), f"{text}{left_out}".lstrip("; ")
        yield from rows_of(inner, whole)


def _kind(schema: dict[str, Any]) -> str:
    if "enum" in schema:
        return ", ".join("null" if value is None else f"`{value}`" for value in schema["enum"])
    if "const" in schema:
        return f"`{schema['const']}`"
    if "anyOf" in schema:
        return " or ".join(dict.fromkeys(map(_kind, schema["anyOf"])))
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    return " or ".join(kinds)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
