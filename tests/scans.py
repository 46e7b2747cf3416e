"""Small scans of many tiles."""

from pathlib import Path

from bikestab import yamltext
from bikestab.config.file import parse_config


def load(text):
    """The config of a YAML text."""
    return parse_config(yamltext.parse(text, "scan.yaml"))


def config_of(shape=(4, 5, 6), output="out", more=""):
    """The config of so many tilts, trails and speeds."""
    n, m, k = shape
    first = "" if "bicycle:" in more else "bicycle: dikarev1981\n"
    return load(
        f"{first}grid:\n  lam: {{start: 0, stop: 0.3, num: {n}}}\n"
        f"  sigma: {{start: 0, stop: 0.15, num: {m}}}\n  V: {{start: 0, stop: 15, num: {k}}}\n"
        f"output: {output}\n{more}"
    )


def files():
    """All that is below the current folder."""
    return sorted(str(path) for path in Path().rglob("*") if path.is_file())
