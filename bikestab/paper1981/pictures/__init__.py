"""The pictures of the reproduction, one file for each."""

from bikestab.paper1981.pictures.damping import draw_damping
from bikestab.paper1981.pictures.figure3 import draw_sections, draw_space
from bikestab.paper1981.pictures.kinds import draw_kinds
from bikestab.paper1981.pictures.machine import draw_machine
from bikestab.paper1981.pictures.refinement import draw_refinement
from bikestab.paper1981.pictures.widths import draw_widths

__all__ = [
    "draw_damping", "draw_kinds", "draw_machine", "draw_refinement", "draw_sections", "draw_space",
    "draw_widths",
]  # fmt: skip
