"""The words of a picture: which cover each other, or axes, and which are not all in it."""

from itertools import combinations

from matplotlib.text import Text
from matplotlib.transforms import Bbox

DESCENDING = set("gjpqyσλ,;()[]|")  # below others there is nothing
ROOM = 0.5  # points by which boxes may overlap, which have some room around their letters


def faults(figure):
    """What a reader would stumble over, as words."""
    figure.draw_without_rendering()
    texts = list(_boxes(figure))
    boxes = [(text.get_text(), box) for text, box in texts]
    room = ROOM * figure.dpi / 72
    found = [
        f"{one!r} and {other!r} overlap"
        for (one, a), (other, b) in combinations(boxes, 2)
        if _common(a, b) > room
    ]
    frames = {tuple(ax.bbox.extents.round(3)) for ax in _axes(figure)}  # a second axis has that of the first
    for text, box in texts:
        own = text.axes and tuple(text.axes.bbox.extents.round(3))
        if any(_common(box, Bbox.from_extents(frame)) > room for frame in frames - {own}):
            found.append(f"{text.get_text()!r} is where other axes are")
    width, height = figure.get_size_inches() * figure.dpi
    for words, box in boxes:
        if box.x0 < 0 or box.y0 < 0 or box.x1 > width or box.y1 > height:
            found.append(f"{words!r} leaves the picture")
    return found


def offsets(figure):
    """What is taken from the numbers beside axes without a word in their labels."""
    return [
        text for ax in _axes(figure) for axis in ax._axis_map.values() if (text := axis.offsetText.get_text())
    ]


def smallest(figure):
    """Points of the smallest letters of a picture that is printed 16 cm wide, unless it is narrower."""
    scale = min(1.0, 16 / 2.54 / figure.get_figwidth())
    sizes = (text.get_fontsize() for text in _texts(figure) if text.get_visible() and text.get_text().strip())
    return scale * min(sizes)


def _common(a, b):
    """The smaller side of what two boxes have in common; below zero where they are apart."""
    return min(min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0))


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
    for ax in _axes(figure):
        yield from (ax.title, *ax.texts)
        if legend := ax.get_legend():
            yield from legend.get_texts()
        for axis in ax._axis_map.values():
            yield from (axis.label, axis.offsetText)
            for tick in axis._update_ticks():  # those within the limits
                yield from (tick.label1, tick.label2)


def _axes(figure):
    axes = list(figure.axes)
    while axes:
        ax = axes.pop()
        axes += ax.child_axes
        yield ax
