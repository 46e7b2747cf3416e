"""Where axes stand in the paper's pictures: their texts are the same in every run, and so are these places.

matplotlib's constrained layout finds them; to measure all texts takes it longer than to draw a picture.
"""

from __future__ import annotations

from matplotlib.figure import Figure

TITLE = 0.992  # of the height, where the title of a picture with two axes begins
PLACES = {  # left, bottom, width and height of axes, in parts of the picture
    "machine": ((0.1068, 0.1372, 0.8865, 0.7255),),
    "sections": ((0.0439, 0.1439, 0.3927, 0.7356), (0.5451, 0.1439, 0.3927, 0.7356)),
    "space": ((0.1226, 0.0911, 0.7549, 0.8728),),
    "refinement": ((0.0381, 0.2028, 0.4394, 0.6717), (0.5393, 0.2028, 0.4394, 0.6717)),
    "kinds": ((0.0772, 0.1852, 0.8455, 0.7197),),
    "widths": ((0.0498, 0.0984, 0.3849, 0.761), (0.5512, 0.0984, 0.3849, 0.761)),
    "damping": ((0.0459, 0.0964, 0.4355, 0.8084), (0.5529, 0.0964, 0.4355, 0.8084)),
}


def place(figure: Figure, picture: str) -> None:
    """Put a picture's axes in their places."""
    for ax, place in zip(figure.axes, PLACES[picture], strict=True):
        ax.set_position(place)
