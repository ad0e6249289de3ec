"""Solids at rest and on their way, beside samples of the solid and all triangles in f64."""

import functools

import meshsweep
import numpy as np
import pytest
from conftest import distances, sphere
from meshsweep import Verdict

RNG = np.random.default_rng(11)
BALL = sphere(6, 8)


@functools.cache
def model():
    return meshsweep.build(BALL, "closest,segment,sdf", sdf_bytes=4096)


SHAPES = {
    "ball": np.zeros((1, 3)),
    "capsule": np.array([[0, 0, -0.4], [0.1, 0.2, 0.5]]),
    "box": np.array([[x, y, z] for x in (0, 0.6) for y in (0, 0.3) for z in (0, 0.2)]),
}


def placed(shape, count=40):
    """Corners of a shape that is turned and moved: shape (n, k, 3)."""
    turns = np.linalg.qr(RNG.normal(size=(count, 3, 3)))[0]
    places = RNG.uniform(-2.2, 2.2, (count, 1, 3))
    return SHAPES[shape] @ turns + places


def to_surface(corners, samples=150):
    """Of each hull of corners the least distance of a sample of it from the surface."""
    weights = RNG.dirichlet(np.full(corners.shape[1], 0.5), samples * (corners.shape[1] > 1))
    weights = np.vstack([np.eye(corners.shape[1]), weights])
    points = np.einsum("sk,nkc->nsc", weights, corners)
    near = distances(points.reshape(-1, 3), *BALL).min(axis=1)
    return near.reshape(len(corners), -1).min(axis=1)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("radius", [0.0, 0.2 + 1e-12])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_distances_and_verdicts_of_solids_hold(shape, radius, dtype):
    part = model()
    corners = placed(shape).astype(dtype)
    found = part.solid_distance(corners, radius=radius)
    truth = np.maximum(to_surface(corners.astype(np.float64)) - radius, 0)
    # A sample is no nearer than the hull, and of a ball it is the hull.
    assert (found.lower <= truth + 1e-12).all() and (found.lower <= found.upper).all()
    gap = {"ball": 1e-4, "capsule": 0.02, "box": 0.2}[shape]
    assert (truth <= found.upper + gap).all()
    apart = np.linalg.norm(found.points[:, 0] - found.points[:, 1], axis=1) - radius
    is_apart = found.lower > 1e-3
    assert is_apart.any() and (np.abs(apart - found.upper)[is_apart] < 1e-4).all()
    of = distances(found.points[:, 1], *BALL)
    assert (of[np.arange(len(of)), found.triangle] < 1e-4).all()
    for distance in [0.0, 0.3, 0.3 + 1e-12]:
        for field_first in [False, True]:
            verdict = part.solid_within(
                corners, distance, radius=radius, field_first=field_first
            ).verdict
            assert (truth[verdict == Verdict.NO] > distance - 1e-12).all()
            assert (found.upper[verdict == Verdict.NO] > distance).all()
            assert (found.lower[verdict == Verdict.YES] <= distance).all()
            # What is clearly nearer or farther is decided, but for flat solids that cross.
            far, near = found.lower > distance + 1e-3, found.upper < distance - 1e-3
            assert (verdict[far] == Verdict.NO).all() and (verdict[near] == Verdict.YES).all()
            assert far.any() and (near.any() or distance == 0)


def test_the_field_spares_searches_and_changes_no_verdict():
    part = model()
    corners = placed("capsule", 300).astype(np.float32)
    by_tree = part.solid_within(corners, 0.2, radius=0.1)
    by_field = part.solid_within(corners, 0.2, radius=0.1, field_first=True)
    alone = by_field.work == 0
    assert 0.3 < alone.mean() < 1
    # Where both decide they agree.
    both = (by_tree.verdict != Verdict.UNDECIDED) & (by_field.verdict != Verdict.UNDECIDED)
    assert (by_tree.verdict == by_field.verdict)[both].all() and both.mean() > 0.9
    assert (by_field.triangle[alone] == -1).all()


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("field_first", [False, True])
def test_solids_are_clear_before_they_touch_on_their_way(shape, field_first):
    part = model()
    begins = placed(shape, 30)
    ends = begins + RNG.uniform(-2, 2, (30, 1, 3)) + RNG.normal(size=begins.shape) * 0.02
    radius = 0.1
    found = part.solid_first_contact(begins, ends, radius=radius, field_first=field_first)
    met = np.zeros(30, bool)
    for t in np.linspace(0, 1, 21):
        truth = to_surface(begins * (1 - t) + ends * t, 30)
        assert (truth[t < found.t_lower] > radius - 1e-12).all()
        met |= truth <= radius
    assert (found.verdict[met] != Verdict.NO).all()
    clear, sure = (found.verdict == verdict for verdict in [Verdict.NO, Verdict.YES])
    assert clear.any() and sure.any() and np.isinf(found.t_lower[clear]).all()
    assert (found.t_upper[sure] - found.t_lower[sure]).max() < 1e-2


def test_a_carried_tool_is_a_solid_on_its_way():
    part = meshsweep.build(BALL, "segment")
    tool = np.array([[0, 0, 0.25], [0.125, 0.75, 0.25]], np.float32)
    starts, ends = np.round(RNG.uniform(-2.5, 2.5, (2, 100, 3)) * 64).astype(np.float32) / 64
    carried = part.first_contact(starts, ends, tool=tool, radius=0.125)
    by_corners = part.solid_first_contact(
        starts[:, None] + tool, ends[:, None] + tool, radius=0.125
    )
    # No sum is rounded: the same question.
    assert carried.tobytes() == by_corners.tobytes()


def test_solids_that_are_none_are_refused_by_name():
    part = meshsweep.build(BALL, "closest,segment")
    ball = np.zeros((1, 1, 3))
    for ask, words in [
        (lambda: part.solid_distance(np.zeros((2, 33, 3))), "corners: 1 to 32 corners"),
        (lambda: part.solid_distance(np.zeros((2, 0, 3))), "corners: 1 to 32 corners"),
        (lambda: part.solid_distance([1, 2, 3]), r"\(n, k, 3\)"),
        (lambda: part.solid_distance(ball * np.nan), "row 0"),
        (lambda: part.solid_distance(ball, radius=-1), "radius: -1 is negative"),
        (lambda: part.solid_distance(ball, rel=-1), "rel: -1 is negative"),
        (lambda: part.solid_distance(ball, steps=-1), "steps: -1 is none from 0"),
        (lambda: part.solid_distance(ball, steps=1.5), "steps: a whole number"),
        (lambda: part.solid_within(ball, [1, 2]), "distance: one number"),
        (lambda: part.solid_within(ball, 1, field_first=True), 'for_="sdf"'),
        (lambda: part.solid_first_contact(ball, np.zeros((1, 2, 3))), "at the end"),
        (lambda: part.solid_first_contact(ball, np.zeros((2, 1, 3))), "at the end"),
    ]:
        with pytest.raises(meshsweep.MeshsweepError, match=words):
            ask()
    assert part.solid_distance(np.zeros((0, 2, 3))).shape == (0,)
