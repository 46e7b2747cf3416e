"""The bicycles that come with the package: one commented YAML file each."""

from __future__ import annotations

from pathlib import Path

_FOLDER = Path(__file__).parent  # importlib.resources costs vrange a tenth of its start


def preset_names() -> list[str]:
    """Their names."""
    return sorted(path.stem for path in _FOLDER.glob("*.yaml"))


def preset_text(name: str) -> str:
    """The text of one."""
    return (_FOLDER / f"{name}.yaml").read_text("utf-8")
