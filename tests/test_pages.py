"""The pages in Markdown: their links lead somewhere, and the reference has every public name."""

import re
from pathlib import Path

import pytest

import bikestab

ROOT = Path(__file__).parents[1]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("*/*.md")])
OUTSIDE = ("http://", "https://", "mailto:")


def anchors(page):
    """What ``#…`` may name in a page: its headings, as GitHub and the site write them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text("utf-8"), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def links(page):
    text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.M | re.S)
    return [link for link in re.findall(r"\]\(([^)\s]+)\)", text) if not link.startswith(OUTSIDE)]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links(page):
    for link in links(page):
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


def test_every_page_of_the_site_can_be_reached():
    index = (ROOT / "docs" / "index.md").read_text("utf-8")
    toctree = re.search(r"^```{toctree}\n(.*?)^```", index, re.M | re.S)[1].split()
    pages = {page.stem for page in ROOT.glob("docs/*.md")} - {"index"}
    assert set(toctree) - {":hidden:"} == pages


def test_the_reference_has_every_public_name():
    text = (ROOT / "docs" / "reference.md").read_text("utf-8")
    listed = re.findall(r"^\.\. \S+:: bikestab\.(\w+)$", text, re.M)
    assert sorted(listed) == sorted(bikestab.__all__)


def test_the_house_has_every_room():
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    house = text.partition("## The house")[2].partition("\n## ")[0]
    library = house.partition("    bikestab/\n")[2].partition("    cli/bikestab_cli/")[0]
    rooms = {path.stem for path in (ROOT / "bikestab").iterdir() if path.suffix == ".py" or path.is_dir()}
    assert rooms - {"__pycache__"} <= set(re.findall(r"\w+", library))
    for path in (path for path in ROOT.iterdir() if path.is_dir() and not path.name.startswith(".")):
        if path.name not in ("build", "dist", "out", "bikestab", "__pycache__"):
            assert f"    {path.name}/" in house


def test_places_that_are_told_exist():
    """Every path of the project between backticks in CONTRIBUTING.md, but for the names to be given."""
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    for path in re.findall(r"`((?:bikestab|cli|docs|tests|configs|examples)/[^`*]*)`", text):
        if "NAME" not in path:
            assert (ROOT / path).exists(), path
