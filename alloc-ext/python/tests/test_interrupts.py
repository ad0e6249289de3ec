"""Ctrl-C ends what runs, soon, and the interpreter can end after it."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time

import meshsweep
import numpy as np
import pytest
from conftest import sphere

LATEST = 5
"""Seconds after Ctrl-C: a busy machine takes some, and each question tens."""


@contextlib.contextmanager
def ctrl_c(after):
    """Sends Ctrl-C after so many seconds. What runs must end by it, soon."""
    sent = []

    def send():
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(after, send).start()
    with pytest.raises(KeyboardInterrupt):
        yield
    assert time.perf_counter() - sent[0] < LATEST


def test_ctrl_c_ends_costly_rows_behind_cheap_ones_soon():
    part = meshsweep.build(sphere(150, 200), "winding")
    # Far points are cheap, so blocks grow before the others.
    points = np.full((3_000_000, 3), 1e3, np.float32)
    points[70_000:] = np.random.default_rng(4).normal(size=(len(points) - 70_000, 3))
    points[70_000:] /= np.linalg.norm(points[70_000:], axis=1, keepdims=True)
    with ctrl_c(1.0):
        part.winding_number(points)
    assert len(part.winding_number(points[:1000])) == 1000


@pytest.mark.parametrize("progress", ["None", "report"])
def test_an_interpreter_ends_after_ctrl_c_while_threads_work_on(progress):
    script = f"""
import os, signal, sys, threading
import meshsweep
sys.path.insert(0, "tests")
from conftest import sphere

def report(_stage, _part):
    sum(range(1000))

threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    meshsweep.trade(sphere(60, 90), count=20_000, progress={progress})
except KeyboardInterrupt:
    sys.exit(3)
"""
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", script], check=False, timeout=60)
        assert ended.returncode == 3


def test_ctrl_c_ends_a_question_soon():
    part = meshsweep.build(sphere(60, 90), "winding")
    points = np.random.default_rng(4).uniform(-2, 2, (8_000_000, 3)).astype(np.float32)
    with ctrl_c(0.3):
        part.winding_number(points)


def test_ctrl_c_ends_a_slow_question_soon():
    part = meshsweep.build(sphere(20, 30), "closest,segment,winding")
    poses = np.tile(np.eye(4), (2000, 1, 1))
    poses[:, :3, 3] = np.random.default_rng(4).uniform(-0.6, 0.6, (2000, 3))
    with ctrl_c(0.3):
        part.penetration(part, poses)


@pytest.mark.parametrize("what", ["verify", "trade"])
def test_ctrl_c_ends_a_proof_and_a_trade_soon(what):
    mesh = sphere(6, 8)
    part = meshsweep.build(mesh, "closest,sdf", sdf_bytes=4096, sdf_layout="lattice")
    with ctrl_c(0.3):
        meshsweep.verify(part, mesh) if what == "verify" else meshsweep.trade(sphere(20, 30))
    # Threads that work on are not those of questions.
    before = time.perf_counter()
    assert part.closest_point([0, 0, 3]).lower <= 2 and time.perf_counter() - before < 5
