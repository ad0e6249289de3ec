"""Triboxes hold the mesh, and what they prove to be clear is clear."""

import meshsweep
import numpy as np
import pytest
from conftest import distances, sphere
from meshsweep import Verdict


def turned_sphere():
    """A long closed mesh along a diagonal, so that turned triboxes are smaller."""
    vertices, triangles = sphere(6, 8)
    axis = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
    stretched = vertices + 3 * (vertices @ axis)[:, None] * axis
    return stretched.astype(np.float32), triangles


@pytest.fixture(params=[None, "volume"])
def model(request):
    mesh = turned_sphere()
    return meshsweep.build(mesh, "triboxes", triboxes=16, orient=request.param), *mesh


def gaps(union, points):
    """How far each point lies beyond the planes of each tribox, in f64: shape (n, boxes)."""
    directions = union.directions.astype(np.float64)
    values = points @ union.frame.astype(np.float64).T @ directions.T
    below, above = union.low - values[:, None], values[:, None] - union.high
    return (np.maximum(below, above) / np.linalg.norm(directions, axis=1)).max(axis=2)


def test_unions_of_triboxes_hold_the_solid(model):
    part, vertices, _ = model
    rng = np.random.default_rng(1)
    weights = rng.dirichlet(np.ones(len(vertices)) / 8, 500)
    inside = np.vstack([vertices, weights @ vertices.astype(np.float64)])
    anywhere, shares = rng.uniform(-6, 6, (4000, 3)), []
    for count in [1, 4, None]:
        union = part.triboxes(count)
        assert len(union.node) <= (count or 16) and union.is_solid
        assert (gaps(union, inside).min(axis=1) <= 1e-6).all()
        shares.append((gaps(union, anywhere).min(axis=1) <= 0).mean())
    assert shares[0] > shares[2] > 0
    assert part.triboxes().distance < part.triboxes(1).distance
    values = union.corners.astype(np.float64) @ union.directions.T.astype(np.float64)
    unit = 2.0**-19 * np.abs([union.low, union.high]).max()
    assert (values.max(axis=1) >= union.high).all() and (values.min(axis=1) <= union.low).all()
    assert (values.max(axis=1) <= union.high + unit).all()
    with pytest.raises(meshsweep.QueryError, match="count"):
        part.triboxes(0)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_lower_bounds_are_those_of_the_nearest_tribox(model, dtype):
    part, vertices, triangles = model
    points = np.random.default_rng(2).uniform(-6, 6, (400, 3)).astype(dtype)
    found = part.tribox_distance(points)
    truth = distances(points, vertices, triangles).min(axis=1)
    by_planes = np.maximum(gaps(part.triboxes(), points.astype(np.float64)), 0)
    assert (found.lower <= truth + 1e-12).all()
    assert (found.lower >= by_planes.min(axis=1) * (1 - 1e-5) - 1e-4).all()
    assert np.isin(found.tribox, part.triboxes().node).all() and (found.lower > 0).any()


def test_segments_are_clear_before_they_enter_a_tribox(model):
    part, _, _ = model
    rng = np.random.default_rng(3)
    starts, ends = rng.uniform(-6, 6, (2, 100, 3)).astype(np.float32)
    found = part.tribox_first_hit(starts, ends)
    t = np.linspace(0, 1, 200)
    way = starts[:, None].astype(np.float64) * (1 - t)[:, None] + ends[:, None] * t[:, None]
    depth = gaps(part.triboxes(), way.reshape(-1, 3)).min(axis=1).reshape(100, 200)
    before = t < found.t_lower[:, None]
    assert (depth[before] > -1e-6).all()
    clear = found.verdict == Verdict.NO
    assert 0 < clear.mean() < 1 and (depth[clear] > -1e-6).all()
    assert (clear == np.isinf(found.t_lower)).all() and ((found.tribox < 0) == clear).all()
    enters = (depth <= -1e-6).any(axis=1)
    first = np.argmax(depth <= -1e-6, axis=1)
    assert (found.t_lower[enters] <= t[first[enters]]).all() and enters.any()


def test_pairs_that_are_proved_apart_are_apart(model):
    part, vertices, triangles = model
    rng = np.random.default_rng(4)
    poses = np.tile(np.eye(4), (30, 1, 1))
    poses[:, :3, :3] = [np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in poses]
    poses[:, :3, :3] *= np.linalg.det(poses[:, :3, :3])[:, None, None]
    poses[:, :3, 3] = rng.normal(size=(30, 3)) * 5
    apart = []
    for distance in [0.0, 0.5, 1 + 1e-12]:
        found = part.tribox_within_of(part, distance, poses)
        clear = found.verdict == Verdict.NO
        for pose in poses[clear]:
            moved = vertices @ pose[:3, :3].T + pose[:3, 3]
            assert distances(moved, vertices, triangles).min() > distance
        assert (found.verdict != Verdict.YES).all() and (found.triboxes[clear] == -1).all()
        apart.append(clear.sum())
    assert apart[0] > apart[2] > 0 and apart[0] < 30
    assert (part.tribox_overlap(part, poses).verdict == Verdict.NO).sum() == apart[0]


def test_a_blob_without_triboxes_says_so():
    part = meshsweep.build(sphere())
    for ask in [part.triboxes, lambda: part.tribox_distance([0, 0, 0])]:
        with pytest.raises(meshsweep.NotServedError, match='for_="triboxes"'):
            ask()
