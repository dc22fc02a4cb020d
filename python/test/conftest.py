# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests share: seeds as in the C++ tests, poses, an arm, a scene."""
import os
import pathlib

import numpy as np
import pytest

DATA = pathlib.Path(os.environ.get("VISP_DIRECT_DATA_DIR", pathlib.Path(__file__).parents[2] / "data"))


def longer(count):
    """Cases of a random test: more with VISP_DIRECT_LONG_TESTS, as in test/support/vpCatch.h."""
    return count * int(os.environ.get("VISP_DIRECT_LONG_TESTS", "1"))


def pytest_generate_tests(metafunc):
    if "seed" in metafunc.fixturenames:
        metafunc.parametrize("seed", [1, *map(int, os.environ.get("VISP_DIRECT_SEED", "").split())])


@pytest.fixture
def random(seed):
    return np.random.default_rng(seed)


def value_of(text):
    """The number that a report shows."""
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
    mantissa, _, power = text.partition("·10")
    return float(mantissa.translate(digits)) * 10.0 ** int(power.translate(digits) or 0)


def rotation(vector):
    """exp([vector]x), by its own formula."""
    angle = np.linalg.norm(vector)
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = np.asarray(vector) / angle
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def pose(translation, vector=(0, 0, 0)):
    M = np.eye(4)
    M[:3, :3], M[:3, 3] = rotation(vector), translation
    return M


@pytest.fixture(scope="session")
def arm():
    import visp_direct as vd

    return vd.loadArmJson(str(DATA / "robot/amor.json"))
