"""A mesh that deforms, at key frames and between: beside all triangles in f64, and exact signs."""

import functools
import pickle
import tempfile
from fractions import Fraction
from pathlib import Path

import meshsweep
import numpy as np
import pytest
from conftest import crosses, distances, passes, sphere
from meshsweep import Facing, Verdict

REST, TRIANGLES = sphere(5, 7)
BENT = (REST * [1.5, 0.75, 1] + np.outer(REST[:, 0] ** 2, [0, 0, 0.5])).astype(np.float32)
TURNED = (BENT[:, [1, 2, 0]] + np.float32([0.25, 0, 0])).astype(np.float32)


@functools.cache
def model():
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for name, vertices in [("bent", BENT), ("turned", TURNED)]:
            files.append(Path(folder) / f"{name}.obj")
            lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
            lines += [f"f {a} {b} {c}" for a, b, c in (TRIANGLES + 1).tolist()]
            files[-1].write_text("\n".join(lines))
        return meshsweep.build((REST, TRIANGLES), "deform", vertex_bits=32, frames=files)


def at(frame):
    """The vertices at a frame, in f64."""
    keys = [vertices.astype(np.float64) for vertices in (REST, BENT, TURNED, TURNED)]
    key = int(frame)
    return keys[key] + (keys[key + 1] - keys[key]) * (float(frame) - key)


def corners(frame):
    """The same of triangles, as fractions."""
    return [[[Fraction(x) for x in p] for p in t] for t in at(frame)[TRIANGLES].tolist()]


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_distances_are_those_of_each_points_frame(dtype):
    part, rng = model(), np.random.default_rng(41)
    points = rng.uniform(-2.5, 2.5, (200, 3)).astype(dtype)
    frames = rng.uniform(0, 2, 200).astype(np.float32)
    frames[:3] = [0, 1, 2]
    found, near = part.closest_point(points, frame=frames), part.nearest(points, 4, frame=frames)
    assert part.frames == 3 and near.shape == (200, 4)
    for point, frame, one, few in zip(points, frames, found, near, strict=True):
        each = distances(point[None], at(frame), TRIANGLES)[0]
        truth = each.min()
        assert one.lower <= truth + 1e-12 and truth - 1e-12 <= one.upper
        assert one.upper - one.lower < 3e-5
        assert each[one.triangle] <= one.upper + 1e-12
        own = each[few.triangle]
        assert (few.lower <= own + 1e-12).all() and (own - 1e-12 <= few.upper).all()
        assert len(set(few.triangle)) == 4 and (few.lower <= np.sort(each)[:4] + 1e-12).all()
    wide = part.closest_point(points, frame=frames, rel=0.5)
    assert (wide.lower <= found.upper).all() and wide.work.sum() < found.work.sum()


def test_one_frame_is_that_of_all_rows_and_one_row_is_asked_at_all_frames():
    part, points = model(), np.float32([[2, 0, 0], [0, 2, 1], [0, 0, 0]])
    one, each = (part.closest_point(points, frame=frame) for frame in (1.25, [1.25] * 3))
    assert one.tobytes() == each.tobytes()
    frames = np.linspace(0, 2, 9)
    path = part.closest_point(points[0], frame=frames)
    assert len(path) == 9 and path[0].tobytes() == part.closest_point(points[0]).tobytes()
    assert path[5].tobytes() == one[0].tobytes()
    again = pickle.loads(pickle.dumps(part))
    assert again.closest_point(points, frame=1.25).tobytes() == one.tobytes()
    assert part.closest_point(np.zeros((0, 3)), frame=1).shape == (0,)
    assert part.nearest(points, 10_000, frame=1).shape == (3, len(TRIANGLES))


@pytest.mark.parametrize("frame", [0, 1, 2, 1.5])
def test_hits_are_those_of_the_frame(frame):
    part = model()
    starts, ends = np.random.default_rng(42).uniform(-2, 2, (2, 80, 3)).astype(np.float32)
    ends = starts + (ends - starts) / 2  # Some are clear.
    first = part.first_hit(starts, ends, frame=frame)
    lists, is_complete = part.all_hits(starts, ends, frame=frame)
    assert is_complete.all()
    mesh, seen = corners(frame), []
    for a, b, hit, hits in zip(starts.tolist(), ends.tolist(), first, lists, strict=True):
        truly = {number for number, corner in enumerate(mesh) if passes(a, b, corner)}
        assert truly <= set(hits.triangle.tolist())
        assert (hit.verdict == Verdict.NO) == (len(hits) == 0)
        assert not truly or hit.verdict != Verdict.NO
        if frame == 1.5:
            assert hit.verdict != Verdict.YES and (hits.verdict == Verdict.UNDECIDED).all()
        else:
            assert truly == set(hits.triangle.tolist()) and bool(truly) == (hit.verdict == 1)
        seen.append(len(truly))
        for number in truly:
            p, q, r = at(frame)[TRIANGLES[number]]
            normal, way = np.cross(q - p, r - p), np.subtract(b, a)
            assert hit.t_lower <= np.dot(normal, p - a) / np.dot(normal, way) + 1e-6
    assert 5 < np.count_nonzero(seen) < 70


def test_overlaps_are_those_of_each_poses_frame():
    part = model()
    small = (REST * np.float32(0.25), TRIANGLES)
    other = meshsweep.build(small, "hull", vertex_bits=32)
    rng = np.random.default_rng(43)
    places, frames = rng.integers(-9, 10, (40, 3)) / 8, rng.integers(0, 5, 40) / 2
    poses = np.tile(np.eye(4), (40, 1, 1))
    poses[:, :3, 3] = places
    found = part.overlap(other, poses, frame=frames)
    tool = small[0].astype(np.float64)[TRIANGLES]
    for place, frame, meets in zip(places, frames, found, strict=True):
        mesh = at(frame)[TRIANGLES]
        moved = tool + place
        apart = (mesh.min(axis=1)[:, None] > moved.max(axis=1)) | (
            moved.min(axis=1) > mesh.max(axis=1)[:, None]
        )
        exact = [[[Fraction(x) for x in p] for p in t] for t in moved.tolist()]
        may, of = np.argwhere(~apart.any(axis=2)).tolist(), corners(frame)
        truly = any(crosses(of[a], exact[b]) for a, b in may)
        assert meets.verdict == truly
        if meets.verdict == Verdict.YES:
            a, b = meets.triangles
            assert crosses(of[a], exact[b])
    assert 5 < (found.verdict == Verdict.YES).sum() < 35


def test_frames_that_are_none_are_refused():
    part, point, plain = model(), np.zeros((2, 3), np.float32), meshsweep.build(sphere())
    assert plain.frames is None
    for frame, words in [
        (-1, "row 0: no such frame: frames go from 0 to 2"),
        ([1, 2.5], "row 1: no such frame"),
        (np.nan, "no such frame"),
        ([0, 1, 2], "2 points for 3 frames"),
        (np.zeros((2, 1)), r"frame: one number or shape \(n,\)"),
        ("1", "frame: real numbers"),
    ]:
        with pytest.raises(meshsweep.QueryError, match=words):
            part.closest_point(point, frame=frame)
    with pytest.raises(meshsweep.QueryError, match="facing: it takes no frame"):
        part.first_hit(point, point + 1, frame=1, facing=Facing.FRONT)
    with pytest.raises(meshsweep.QueryError, match="precise: it takes no frame"):
        part.closest_point(point, frame=1, precise=True)
    for ask in [
        lambda: plain.closest_point(point, frame=0),
        lambda: plain.nearest(point, 1, frame=0),
        lambda: plain.first_hit(point, point + 1, frame=0),
        lambda: plain.all_hits(point, point + 1, frame=0),
        lambda: plain.overlap(plain, frame=0),
    ]:
        with pytest.raises(meshsweep.NotServedError, match='for_="deform"'):
            ask()
    with pytest.raises(meshsweep.NotServedError, match='for_="hull"'):
        part.overlap(plain, frame=0)
