# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the Python package share: where things are, and small scenes."""
import os
import pathlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]

ROPE = """\
capstan: 1
title: a rope on a floor
obstacles:
  floor: {plane: {}, friction: 0.5}
lines:
  rope:
    length: 2
    elements: 20
    mass: 1
    stiffness: 1e4
    start: {straight: {from: [0, 0, 0], to: [2, 0, 0]}}
    ends: {A: free, B: {held: [2, 0, 0]}}
history:
  - {name: pull, rope.B: {move: [0.5, 0.3, 0]}, steps: 5}
  - {name: back, rope.B: {move: [-0.2, 0, 0]}, steps: 3}
"""


@pytest.fixture
def rope():
    """The text of a scene of 8 steps: a rope that slides on a floor, there and back."""
    return ROPE


@pytest.fixture
def root():
    return ROOT


@pytest.fixture
def command():
    return os.environ["CAPSTAN_COMMAND"]


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """Each test works in a folder of its own."""
    monkeypatch.chdir(tmp_path)
