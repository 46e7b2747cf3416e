"""What happens to texts on their way: bytes replaced, doubled, dropped and put in."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

TOKENS = [
    b"&a ", b"*a", b"<<: *a", b"!!int ", b"!!bool x", b"!<a> ", b"{", b"}", b"[", b"]", b"? ", b": ", b"- ",
    b"\t", b"\0", b"\xff", b"\xc3", b"'", b'"', b"#", b"|\n", b">-\n", b"%YAML 9.9\n", b"---\n", b"...\n",
    b"1e999", b"-", b"9" * 5000, b" " * 3000, b".nan", b".inf", b"0o7", b"\r", b"\x1b[2J", b"\xef\xbb\xbf",
    b"+/-", b"=", b",", b"pi/0",
]  # fmt: skip


@st.composite
def damaged(draw: Any, text: bytes) -> bytes:
    """A text with some places replaced, doubled, dropped, or with something put in."""
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(text)))
        end = min(len(text), at + draw(st.integers(0, 12)))
        kind = draw(st.sampled_from(["token", "byte", "drop", "double", "cut"]))
        middle = {
            "token": draw(st.sampled_from(TOKENS)), "byte": draw(st.binary(min_size=1, max_size=2)),
            "drop": b"", "double": 2 * text[at:end], "cut": b"",
        }[kind]  # fmt: skip
        text = text[:at] + middle + (b"" if kind == "cut" and draw(st.booleans()) else text[end:])
    return text
