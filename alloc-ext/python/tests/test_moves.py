"""Moves that are proved clear are clear at every instant, beside samples in time."""

import meshsweep
import numpy as np
import pytest
from conftest import distances, sphere
from meshsweep import Verdict

TIMES = np.linspace(0, 1, 51)


def distances_on_the_way(starts, ends, tool):
    """Of samples of the tool's hull, at samples in time, the least distance: shape (n, times)."""
    s = np.linspace(0, 1, 17)[:, None]
    hull = tool[0] if len(tool) == 1 else tool[0] * (1 - s) + tool[1] * s
    t = TIMES[:, None]
    places = starts[:, None] * (1 - t) + ends[:, None] * t
    points = places[:, :, None] + hull.reshape(-1, 3)
    near = [distances(row.reshape(-1, 3), *sphere()).min(axis=1) for row in points]
    return np.array(near).reshape(len(starts), len(TIMES), -1).min(axis=2)


@pytest.mark.parametrize("tool", [[[0, 0, 0]], [[0, 0, 0.3], [0.1, 0.7, 0.3]]])
@pytest.mark.parametrize("radius", [0.0, 0.25 + 1e-12])
def test_tools_are_clear_before_they_touch(tool, radius):
    part = meshsweep.build(sphere(), "segment")
    starts, ends = np.random.default_rng(1).uniform(-2.5, 2.5, (2, 50, 3)).astype(np.float32)
    found = part.first_contact(starts, ends, radius=radius, tool=tool)
    truth = distances_on_the_way(starts, ends, np.array(tool, np.float32).astype(np.float64))
    assert (truth[TIMES < found.t_lower[:, None]] > radius).all()
    clear, met = (found.verdict == verdict for verdict in [Verdict.NO, Verdict.YES])
    assert (truth[clear] > radius).all() and np.isinf(found.t_lower[clear]).all()
    assert clear.any() and (met.any() or radius == 0)
    step = np.linalg.norm(ends - starts, axis=1) / 50 + 0.7 / 16
    assert (truth.min(axis=1)[met] <= radius + step[met]).all()
    after = TIMES <= found.t_upper[:, None] + 0.02
    reached = np.where(after, truth, np.inf).min(axis=1)
    assert (reached[met] <= radius + step[met]).all()
    assert (found.t_upper[met] - found.t_lower[met]).max(initial=0) < 1e-3


def test_a_ball_meets_the_pole_when_it_is_there():
    part = meshsweep.build(sphere(), "segment")
    for radius in [0.25, 0.5]:
        (found,) = part.first_contact([0, 0, 5], [0, 0, 1], radius=radius)
        assert found.verdict == Verdict.YES
        assert found.t_lower <= 1 - radius / 4 <= found.t_upper < found.t_lower + 1e-4
        assert np.linalg.norm(found.point - [0, 0, 1]) < 1e-3
    exact = meshsweep.build(sphere(), "segment", vertex_bits=32)
    for radius, wrong in [(0.25 - 1e-12, Verdict.YES), (0.25 + 1e-12, Verdict.NO)]:
        (found,) = exact.first_contact([0, 0, 5], [0, 0, 1.25], radius=radius)
        assert found.verdict != wrong
    for tool, words in [(np.zeros((33, 3)), "1 to 32"), (np.zeros((2, 2)), r"\(n, 3\)")]:
        with pytest.raises(meshsweep.QueryError, match=words):
            part.first_contact([0, 0, 5], [0, 0, 1], tool=tool)
    with pytest.raises(meshsweep.QueryError, match="radius"):
        part.first_contact([0, 0, 5], [0, 0, 1], radius=-1)


def screw(angles, places):
    """Poses that turn about z."""
    poses = np.tile(np.eye(4), (len(angles), 1, 1))
    poses[:, 0, 0] = poses[:, 1, 1] = np.cos(angles)
    poses[:, 1, 0] = np.sin(angles)
    poses[:, 0, 1] = -poses[:, 1, 0]
    poses[:, :3, 3] = places
    return poses


def test_models_keep_their_distance_before_they_are_stopped():
    vertices, triangles = sphere(6, 7)
    part = meshsweep.build((vertices, triangles), "segment")
    rng = np.random.default_rng(2)
    angle = rng.uniform(0, 3, 30)
    # A turn about the z axis and a way along it: a screw about this axis.
    reach = np.stack([rng.uniform(0, 4, 30), np.zeros(30)], axis=1)
    low, high = rng.uniform(-4, 4, (2, 30))

    def pose(t):
        turn = angle * t
        x = reach[:, 0] * np.cos(turn)
        y = reach[:, 0] * np.sin(turn)
        return screw(turn, np.stack([x, y, low + (high - low) * t], axis=1))

    for clearance in [0.0, 0.4 + 1e-12]:
        found = part.first_contact_of(part, pose(0.0), pose(1.0), clearance=clearance)
        for t in TIMES[::3]:
            poses = pose(t)
            for row in np.flatnonzero(t < found.clear_until):
                moved = vertices @ poses[row, :3, :3].T + poses[row, :3, 3]
                assert distances(moved, vertices, triangles).min() > clearance
        assert ((found.verdict == Verdict.NO) == np.isinf(found.clear_until)).all()
        assert 0 < (found.verdict == Verdict.NO).sum() < 30


def test_models_that_move_along_a_line_are_stopped_where_their_poles_meet():
    part = meshsweep.build(sphere(), "segment")
    begins, ends = (screw(np.zeros(2), [[0, 0, z], [9, 0, z]]) for z in (4, 0))
    for straight in [False, True]:
        found = part.first_contact_of(part, begins, ends, clearance=0.5, straight=straight)
        assert found.verdict.tolist() == [Verdict.UNDECIDED, Verdict.NO]
        assert 0.374 < found.clear_until[0] <= 0.375
        assert np.abs(found.points[0] - [[0, 0, 1], [0, 0, 1.5]]).max() < 0.01
    with pytest.raises(meshsweep.QueryError, match="2 poses to begin at, 1 to end at"):
        part.first_contact_of(part, begins, ends[:1])
