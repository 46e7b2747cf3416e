"""What tests share."""

from importlib import import_module

import pytest
from hypothesis import settings

from bikestab.scan.run import run_scan
from bikestab.scan.tile import compute
from tests import volumes

settings.register_profile("bikestab", settings(), deadline=None)  # no test is about time on a busy machine
settings.load_profile("bikestab")


@pytest.fixture
def in_an_empty_folder(tmp_path, monkeypatch):
    """Make an empty folder the current one."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def small_tiles(monkeypatch):
    """Let tiles be as small as can be: 64 tilts, 128 trails, 32 speeds."""
    monkeypatch.setattr(import_module("bikestab.scan.plan"), "_TILE_BYTES", 1)


@pytest.fixture
def computed(monkeypatch):
    """Give the speeds at which the tiles begin that are computed, as they are."""
    begins = []

    def count(tile):
        begins.append(round(float(tile.V[0]), 6))
        return compute(tile)

    monkeypatch.setattr(import_module("bikestab.scan.processes"), "compute", count)
    return begins


@pytest.fixture(scope="session")
def equal(tmp_path_factory):
    """A volume with equal steps and all fields, and its config."""
    config = volumes.config_of(volumes.EQUAL, tmp_path_factory.mktemp("equal"))
    return run_scan(config).path, config


@pytest.fixture(scope="session")
def own(tmp_path_factory):
    """A volume with axes of one's own values and a cell with two intervals, and its config."""
    config = volumes.config_of(volumes.OWN, tmp_path_factory.mktemp("own"))
    return run_scan(config).path, config
