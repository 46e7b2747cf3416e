"""The page as a person meets it, and its numbers beside Python's."""

from __future__ import annotations

import io
import json
import shlex
import subprocess
import sys
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import bikestab as bs
from bikestab.kinds import KINDS

BENCHMARK = bs.Bicycle.preset("meijaard2007")
PAPER = bs.Bicycle.preset("dikarev1981")
ASSISTED = BENCHMARK.replaced({"k_phidot": -20})


def apart(one, other):
    """Largest distance between two sets of four eigenvalues (4, n), in units of the largest."""
    size = np.abs(other).max(axis=0)
    orders = [np.abs(one[list(order)] - other).max(axis=0) for order in permutations(range(4))]
    return np.min(orders, axis=0) / size


def eigenvalues_in(page, lam, sigma, V):
    found = page.evaluate(
        "many => many.map(([lam, sigma, V]) => bikestab.eigenvalues(lam, sigma, V))",
        np.column_stack([lam, sigma, V]).tolist(),
    )
    return (np.array(found) @ [1, 1j]).T


def set_slider(page, name, value):
    page.evaluate(
        "([name, value]) => { const e = document.getElementById(name); e.value = value;"
        " e.dispatchEvent(new Event('input', { bubbles: true })); }",
        [name, str(value)],
    )
    drawn(page)


def drawn(page):
    """Wait until what was chosen is shown."""
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def test_eigenvalues_are_those_of_python(opened):
    rng = np.random.default_rng(18)
    n = 10_000
    lam, sigma, V = rng.uniform(-0.4, 1.2, n), rng.uniform(-0.3, 0.5, n), rng.uniform(0, 30, n)
    mine = eigenvalues_in(opened(), lam, sigma, V)
    assert apart(mine, bs.eigenvalues(BENCHMARK, V, lam=lam, sigma=sigma)).max() < 1e-9


def test_eigenvalues_with_feedback_are_those_of_python(opened):
    page = opened("all")
    page.locator("#tabs button").nth(3).click()
    assert "k_phidot = -20" in page.inner_text("#subtitle")
    rng = np.random.default_rng(15)
    lam, sigma, V = rng.uniform(-0.4, 1.2, 3000), rng.uniform(-0.3, 0.5, 3000), rng.uniform(0, 30, 3000)
    mine = eigenvalues_in(page, lam, sigma, V)
    assert apart(mine, bs.eigenvalues(ASSISTED, V, lam=lam, sigma=sigma)).max() < 1e-9


def test_eigenvalues_that_meet_are_those_of_python(opened, volumes):
    with bs.open_volume(volumes[0]) as volume:
        bicycle = volume.bicycle  # its two parts are doubles, which a double root tells from the 25 numbers
    designs = [(lam, sigma) for lam in (0.1, 0.2, 0.35) for sigma in (0.02, 0.08, 0.15)]
    lam, sigma, V = np.array(
        [
            (*design, speed)
            for design in designs
            for speed in bs.modes(bicycle, [1.0], lam=design[0], sigma=design[1]).coalescences
        ]
    ).T
    assert len(V) > 9
    mine = eigenvalues_in(opened(), lam, sigma, V)
    assert apart(mine, bs.eigenvalues(bicycle, V, lam=lam, sigma=sigma)).max() < 1e-9


@pytest.mark.parametrize("which", [0, 1, 2, 3])
def test_intervals_are_those_of_python(opened, which):
    page = opened("all")
    page.locator("#tabs button").nth(which).click()
    bicycle = [BENCHMARK, PAPER, BENCHMARK.with_delta(2), ASSISTED][which]
    if which == 2:
        set_slider(page, "sweep-delta", 1)
    rng = np.random.default_rng(which)
    lam, sigma = rng.uniform(-0.1, 0.6, 700), rng.uniform(-0.05, 0.4, 700)
    found = page.evaluate(
        "many => many.map(([lam, sigma]) => bikestab.intervals(lam, sigma))",
        np.column_stack([lam, sigma]).tolist(),
    )
    right = bs.stable_intervals(bicycle, lam=lam, sigma=sigma)
    assert [len(each) for each in found] == right.number.tolist()
    for i, each in enumerate(found):
        for k, one in enumerate(each):
            assert one["V1"] == pytest.approx(right.V1[i, k], rel=1e-12)
            assert (one["V2"] or np.inf) == pytest.approx(right.V2[i, k], rel=1e-12)
            assert [one["lower"], one["upper"]] == [KINDS[right.lower[i, k]], KINDS[right.upper[i, k]]]


def test_modes_have_the_names_of_python(opened):
    page = opened()
    V = np.linspace(0.05, 12, 240)
    wrong = total = 0
    for lam, sigma in [(BENCHMARK.lam, BENCHMARK.sigma), (0.2, 0.05), (0.4, 0.15), (0.1, 0.02), (0.5, 0.2)]:
        found = page.evaluate("([lam, sigma, V]) => bikestab.modes(lam, sigma, V)", [lam, sigma, V.tolist()])
        mine = np.array(found["s"]) @ [1, 1j]
        right = bs.modes(BENCHMARK, V, lam=lam, sigma=sigma)
        for i in range(len(V)):
            order = min(
                permutations(range(4)), key=lambda o: np.abs(mine[list(o), i] - right.eigenvalues[:, i]).max()
            )
            total += 4
            wrong += sum(found["names"][b][i] != right.names[k, i] for k, b in enumerate(order))
    assert total == 4800
    assert wrong <= 20, wrong  # within a step of where two meet


def test_sliders_numbers_and_words_agree(opened):
    page = opened()
    text = page.inner_text("#intervals")
    assert "4.292 m/s (weave) to 6.024 m/s (capsize)" in text
    set_slider(page, "lam", 0.05)
    assert page.inner_text("#intervals") == "no stable speed"
    assert page.input_value("#head-angle") == f"{90 - np.degrees(0.05):.2f}"
    page.fill("#head-angle", "71")
    page.press("#head-angle", "Tab")
    assert float(page.input_value("#lam")) == pytest.approx(np.radians(19))
    page.fill("#offset", "45")
    page.press("#offset", "Tab")
    lam = np.radians(19)
    trail = (0.35 * np.sin(lam) - 0.045) / np.cos(lam)
    assert float(page.input_value("#sigma")) == pytest.approx(trail / 1.02, abs=1e-12)
    drawn(page)
    assert "stable" in page.get_attribute("#modes", "aria-label")
    command = shlex.split(page.inner_text("#command code"))
    (tilt,) = (word.removeprefix("--lam=") for word in command if word.startswith("--lam="))
    assert float(tilt) == pytest.approx(lam, abs=1e-12)


def test_sentences_say_what_happens_below_above_and_with_a_longer_trail(opened):
    below, above, longer = opened().locator("#ends li").all_inner_texts()
    own = bs.stable_intervals(BENCHMARK)
    V1, V2 = own.V1[0], own.V2[0]
    for text, V in ((below, 0.9 * V1), (above, 1.1 * V2)):
        s = max(bs.eigenvalues(BENCHMARK, V), key=lambda s: s.real)
        assert f"at {V:.2f} m/s" in text
        assert f"{np.log(2) / s.real:.1f} s" in text
        assert ("swings" in text) == (s.imag != 0)
        assert f"{abs(s.imag) / 2 / np.pi:.2f} times a second" in text or s.imag == 0
    then = bs.stable_intervals(BENCHMARK, sigma=BENCHMARK.sigma + 0.01 / BENCHMARK.c)
    assert f"from {then.V1[0]:.3f} m/s (weave) to {then.V2[0]:.3f} m/s (capsize)" in longer
    wider = then.V2[0] - then.V1[0] - (V2 - V1)
    assert f"{wider:.3f} m/s wider" in longer


def test_the_answer_and_pictures_are_there_before_the_drawing_library(chromium, pages):
    context = chromium.new_context(offline=True)
    page = context.new_page()
    page.add_init_script(
        "Object.defineProperty(window, 'Plotly', { configurable: true, set(library) {"
        " const picture = document.getElementById('region-picture');"
        " window.seen = { told: document.getElementById('intervals').innerText, wide: picture.naturalWidth,"
        " dot: document.querySelectorAll('#region-chosen circle').length,"
        " wheels: document.querySelectorAll('#side circle').length };"
        " delete window.Plotly; window.Plotly = library; } })"
    )
    page.goto(f"file://{pages}/one.html")
    page.evaluate("async () => { await window.bikestab.ready; }")
    seen = page.evaluate("window.seen")
    context.close()
    assert "4.292 m/s (weave) to 6.024 m/s (capsize)" in seen["told"]
    assert seen["wide"] > 300
    assert seen["dot"] == 1
    assert seen["wheels"] >= 2


def test_what_is_typed_beyond_the_box_is_cut_and_said(opened):
    page = opened()
    page.fill("#head-angle", "20")
    page.press("#head-angle", "Enter")
    drawn(page)
    most = float(page.get_attribute("#lam", "max"))
    assert float(page.input_value("#head-angle")) == pytest.approx(90 - np.degrees(most), abs=0.01)
    assert "outside" in page.inner_text("#limit")
    set_slider(page, "lam", 0.3)
    assert page.inner_text("#limit") == ""


def test_a_click_on_the_plane_chooses_a_design(opened):
    page = opened()
    box = page.locator("#plane .nsewdrag").first.bounding_box()
    page.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + 0.25 * box["height"])
    low, high = 0.0, float(page.get_attribute("#lam", "max"))
    assert float(page.input_value("#lam")) == pytest.approx(low + 0.75 * (high - low), abs=0.01)


def test_a_click_on_the_surface_chooses_what_is_there(opened):
    page = opened()
    before = [page.input_value(f"#{name}") for name in ("lam", "sigma", "V")]
    page.locator("#region").scroll_into_view_if_needed()
    box = page.locator("#region canvas").first.bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.45 * box["height"]
    page.evaluate(
        "() => { const at = document.getElementById('region');"
        " at.on('plotly_hover', () => { window.found = true; }); }"
    )
    page.mouse.move(x - 5, y - 5)
    page.mouse.move(x, y)
    page.wait_for_function("() => window.found")
    page.mouse.click(x, y)
    drawn(page)
    after = [page.input_value(f"#{name}") for name in ("lam", "sigma", "V")]
    assert after != before
    lam, sigma, V = map(float, after)
    own = bs.stable_intervals(BENCHMARK, lam=lam, sigma=sigma)
    assert min(abs(np.concatenate([own.V1, own.V2]) - V)) < 0.02  # of a surface of 36 cells


def test_the_copied_command_says_the_same_as_the_page(opened):
    page = opened("all")
    for which in (0, 1, 2, 3):
        page.locator("#tabs button").nth(which).click()
        command = shlex.split(page.inner_text("#command code"))
        done = subprocess.run(
            [sys.executable, "-m", *command, "--json"], capture_output=True, text=True, check=True
        )
        right = json.loads(done.stdout)["results"][0]
        found = page.evaluate(
            "([lam, sigma]) => bikestab.intervals(lam, sigma)", [right["lam"], right["sigma"]]
        )
        assert len(found) == len(right["intervals"])
        for one, other in zip(found, right["intervals"], strict=True):
            assert one["V1"] == pytest.approx(other["V1"], rel=1e-12)


def test_one_table_compares_all_machines(opened):
    page = opened("all")
    rows = page.locator("#compare tbody tr").all_inner_texts()
    assert len(rows) == 6
    assert "delta = 2" in rows[3]
    assert "from 4.292 m/s" in rows[0]


def test_a_page_where_nothing_draws_three_dimensions_shows_a_picture(opened, pages, chromium):
    context = chromium.new_context(offline=True)
    page = context.new_page()
    page.add_init_script(
        "HTMLCanvasElement.prototype.getContext = new Proxy("
        "HTMLCanvasElement.prototype.getContext, { apply: (f, self, [kind, ...rest]) =>"
        " /webgl/.test(kind) ? null : Reflect.apply(f, self, [kind, ...rest]) })"
    )
    page.goto(f"file://{pages}/one.html")
    page.evaluate("async () => { await window.bikestab.ready; }")
    assert page.locator("#region-picture").evaluate("e => e.complete && e.naturalWidth") > 300
    set_slider(page, "lam", 0.2)
    context.close()


def test_the_file_is_small_enough_to_be_mailed(pages):
    for path in pages.glob("*.html"):
        assert path.stat().st_size <= 3_000_000  # 24 machines: 5 MB


AXE = Path(__file__).parent / "node_modules" / "axe-core" / "axe.min.js"


@pytest.mark.skipif(not AXE.is_file(), reason="axe-core is not there: npm install in tests/report")
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1400, 360])
def test_axe_finds_no_violation(opened, scheme, width):
    page = opened("all", color_scheme=scheme, viewport={"width": width, "height": 800})
    page.add_script_tag(path=AXE)
    found = page.evaluate("axe.run(document)")["violations"]
    assert [(each["id"], [node["html"][:120] for node in each["nodes"]]) for each in found] == []


def test_a_phone_scrolls_in_one_direction_only(opened):
    page = opened("all", viewport={"width": 360, "height": 780})
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    assert page.evaluate("matchMedia('(prefers-reduced-motion: no-preference)').matches")


def test_it_prints_on_two_sheets_of_a4(opened, tmp_path):
    page = opened()
    pdf = page.pdf(prefer_css_page_size=True)
    assert 1 <= pdf.count(b"/Type /Page\n") + pdf.count(b"/Type /Page ") + pdf.count(b"/Type/Page") <= 4
    page.emulate_media(media="print")
    assert not page.locator("#play").is_visible()
    assert page.evaluate("getComputedStyle(document.body).color") == "rgb(0, 0, 0)"


def test_letters_on_paper_are_large_enough(opened):
    page = opened()
    before = page.evaluate("document.getElementById('modes').clientWidth")
    page.emulate_media(media="print")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    sizes = page.evaluate(
        "() => [...document.querySelectorAll('.plot svg text, p, td, li, figcaption')]"
        ".filter(e => e.checkVisibility() && e.textContent.trim())"
        ".map(e => parseFloat(getComputedStyle(e).fontSize))"
    )
    assert len(sizes) > 60
    assert min(sizes) >= 10  # CSS pixels, 7.5 points
    wide = "[...document.querySelectorAll('.plot')].map(e => e.querySelector('svg')?.clientWidth ?? 0)"
    assert max(page.evaluate(wide)) <= 336  # 89 mm
    page.emulate_media(media="screen")
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    page.wait_for_timeout(300)
    assert page.evaluate("document.getElementById('modes').querySelector('svg').clientWidth") == before


def test_a_machine_without_a_stable_design_of_its_own_opens_on_another(opened):
    page = opened("all")
    assert page.inner_text("#limit") == ""
    page.locator("#tabs button").nth(1).click()
    drawn(page)
    assert "no design of its own" in page.inner_text("#limit")
    assert "stable from" in page.inner_text("#answer")


@pytest.mark.parametrize(
    ("own", "plane", "words", "design"),
    [
        ([0.31, 0.078], 1, "", [0.31, 0.078]),
        ([0.02, 0.01], 1, "no stable speed: this is one near it", [0.25, 0.1]),
        ([-0.1, 0.1], 1, "not within these tilts", [0.25, 0.1]),
        (None, 1, "no design of its own", [0.25, 0.1]),
        (None, 0, "No design on this page", [0.25, 0.1]),
    ],
)
def test_the_design_that_a_page_opens_on(opened, own, plane, words, design):
    """A plane of nine designs, of which the one at (0, 0) has next to none and that at (0.5, 0.2) most."""
    page = opened()
    found = page.evaluate(
        "async ([own, plane]) => { const { opening } = await import('bikestab/opening');"
        " const { machines, box } = JSON.parse(document.getElementById('data').textContent).volumes[0];"
        " const shown = { box: { ...box, lam: [0, 0.5], sigma: [0, 0.2] },"
        " plane: { lam: [0, 0.25, 0.5], sigma: [0, 0.1, 0.2],"
        " width: [0.1, 0, 0, 0, 2, 0, 0, 0, 3].map(x => x * plane) } };"
        " return opening({ ...machines[0], own }, shown); }",
        [own, plane],
    )
    assert words in found["words"]
    assert bool(found["words"]) == bool(words)
    assert [found["lam"], found["sigma"]] == pytest.approx(design)


def test_play_moves_the_machine_and_pauses(opened):
    page = opened()
    first = page.locator("#rear").inner_html()
    page.get_by_role("button", name="Play").click()
    page.wait_for_timeout(400)
    page.get_by_role("button", name="Pause").click()
    stopped = page.locator("#rear").inner_html()
    assert stopped != first
    page.wait_for_timeout(200)
    assert page.locator("#rear").inner_html() == stopped


def test_the_keyboard_reaches_and_moves_the_sliders(opened):
    page = opened()
    before = float(page.input_value("#V"))
    page.locator("#V").focus()
    page.keyboard.press("ArrowRight")
    assert float(page.input_value("#V")) > before


@pytest.mark.parametrize("what", ["modes", "side"])
def test_a_picture_is_saved(opened, what):
    page = opened()
    page.select_option("#which", what)
    for name in ("PNG", "SVG"):
        with page.expect_download() as download:
            page.get_by_role("button", name=f"Save {name}").click()
        assert download.value.suggested_filename == f"bikestab-{what}.{name.lower()}"
        content = Path(download.value.path()).read_bytes()
        assert content.startswith(b"\x89PNG" if name == "PNG" else b"<svg")
        if name == "PNG":
            assert Image.open(io.BytesIO(content)).convert("RGBA").getpixel((1, 1)) == (255, 255, 255, 255)
