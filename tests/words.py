"""The words of a picture: which cover each other, and which are not all in it."""

from itertools import combinations

from matplotlib.text import Text
from matplotlib.transforms import Bbox

DESCENDING = set("gjpqyσλ,;()[]|")  # below others there is nothing
ROOM = 0.5  # points by which boxes may overlap, which have some room around their letters


def faults(figure):
    """What a reader would stumble over, as words."""
    figure.draw_without_rendering()
    boxes = [(text.get_text(), box) for text, box in _boxes(figure)]
    found = []
    for (one, a), (other, b) in combinations(boxes, 2):
        wide, high = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
        if min(wide, high) > ROOM * figure.dpi / 72:
            found.append(f"{one!r} and {other!r} overlap")
    width, height = figure.get_size_inches() * figure.dpi
    for words, box in boxes:
        if box.x0 < 0 or box.y0 < 0 or box.x1 > width or box.y1 > height:
            found.append(f"{words!r} leaves the picture")
    return found


def _boxes(figure):
    """Each text that is drawn, and its box in pixels."""
    for text in _texts(figure):
        if text.get_visible() and text.get_text().strip():
            box = Text.get_window_extent(text)  # of an annotation without its arrow
            low = 0.2 * text.get_fontsize() * figure.dpi / 72
            if text.get_rotation() == 0 and not DESCENDING & set(text.get_text().rpartition("\n")[2]):
                box = Bbox.from_extents(box.x0, box.y0 + low, box.x1, box.y1)
            yield text, box


def _texts(figure):
    yield from figure.texts
    for legend in figure.legends:
        yield from legend.get_texts()
    axes = list(figure.axes)
    while axes:
        ax = axes.pop()
        axes += ax.child_axes
        yield from (ax.title, *ax.texts)
        if legend := ax.get_legend():
            yield from legend.get_texts()
        for axis in ax._axis_map.values():
            yield from (axis.label, axis.offsetText)
            for tick in axis._update_ticks():  # those within the limits
                yield from (tick.label1, tick.label2)
