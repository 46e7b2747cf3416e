"""What tests share."""

import pytest


@pytest.fixture
def in_an_empty_folder(tmp_path, monkeypatch):
    """Make an empty folder the current one."""
    monkeypatch.chdir(tmp_path)
