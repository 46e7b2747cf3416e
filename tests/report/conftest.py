"""A page in a real browser without any network; skipped where there is none."""

from __future__ import annotations

import os
import shutil

import pytest

import bikestab as bs

SMALL = ["grid.lam.num=7", "grid.sigma.num=6", "grid.V.num=9", "slices=[]", "fields=[stable]"]


@pytest.fixture(scope="session")
def volumes(tmp_path_factory):
    """The folders of small volumes: the benchmark, the paper's bicycle, sweeps of damping and of a gain."""
    folder = tmp_path_factory.mktemp("volumes")
    made = []
    for config, more in (
        ("meijaard2007", []),
        ("dikarev1981", []),
        ("meijaard2007", ["sweep={delta: [0, 2]}"]),
        ("meijaard2007", ["sweep={k_phidot: [-20, 0]}"]),
    ):
        output = folder / str(len(made))
        bs.scan(f"configs/{config}.yaml", [*SMALL, *more, f"output={output}"])
        made.append(output)
    return made


@pytest.fixture(scope="session")
def pages(volumes, tmp_path_factory):
    """A page of one volume, and one of all."""
    pytest.importorskip("plotly", reason="the extra report is not installed")
    from bikestab.report.page import save_page

    folder = tmp_path_factory.mktemp("pages")
    for name, chosen in (("one", volumes[:1]), ("all", volumes)):
        opened = [bs.open_volume(each) for each in chosen]
        save_page(opened, folder / f"{name}.html")
        for each in opened:
            each.close()
    return folder


@pytest.fixture(scope="session")
def chromium():
    sync = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    program = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("google-chrome")
    if not program:
        pytest.skip("there is no Chromium: apt-get install chromium, or name it in CHROMIUM")
    flags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    with sync.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=program, args=flags)
        yield browser
        browser.close()


@pytest.fixture
def opened(chromium, pages):
    """Opens a page; what it asks of a network and what goes wrong in it fails the test."""
    contexts, wrong = [], []

    def open_page(name="one", **options):
        context = chromium.new_context(
            offline=True, **{"viewport": {"width": 1400, "height": 900}, **options}
        )
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("request", lambda one: wrong.append(one.url) if one.url.startswith("http") else None)
        page.goto(f"file://{pages}/{name}.html")
        page.evaluate("async () => { await window.bikestab.ready; }")
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert not wrong
