import pytest

from bikestab.bicycle import Bicycle


@pytest.fixture(scope="session")
def bicycle():
    return Bicycle.preset("dikarev1981")
