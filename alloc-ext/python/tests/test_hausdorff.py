"""Bounds of Hausdorff distances: known ones, and those of samples in f64."""

import os
import signal
import threading
import time
import zipfile

import meshsweep
import numpy as np
import pytest
from conftest import CORNERS, FACES, distances, sphere


def box(size, at=(0, 0, 0)):
    """An axis-aligned box of so large sides with its lowest corner there."""
    return CORNERS * np.array(size, np.float64) + at, np.array(FACES, np.uint32)


def sampled(mesh, other, parts):
    """The farthest of a grid of points on `mesh` from `other`, and how far the next point of the
    grid is at most: the distance is between the first and the sum."""
    vertices, triangles = mesh
    a, b, c = vertices.astype(np.float64)[triangles].transpose(1, 0, 2)
    u, v = np.meshgrid(*[np.arange(parts + 1) / parts] * 2)
    u, v = (x[u + v <= 1 + 1e-9][:, None, None] for x in (u, v))
    points = (a + u * (b - a) + v * (c - a)).reshape(-1, 3)
    far = max(distances(some, *other).min(axis=1).max() for some in np.array_split(points, 20))
    longest = max(np.linalg.norm(x - y, axis=1).max() for x, y in [(a, b), (b, c), (c, a)])
    return far, longest / parts


@pytest.mark.parametrize(
    ("a", "b", "forward", "backward"),
    [
        # The lid of the lower box is inside the higher one: half of its side away from walls.
        (box((1, 1, 1)), box((1, 1, 2)), 0.5, 1.0),
        # A cube in a cube: faces of the inner one, corners of the outer one.
        (box((1, 1, 1), (1, 1, 1)), box((3, 3, 3)), 1.0, 3**0.5),
        (box((1, 2, 3)), box((1, 2, 3), (10, 0, 0)), 10.0, 10.0),
    ],
)
def test_boxes_are_as_far_apart_as_is_known(a, b, forward, backward):
    # Single precision does not hold corners scaled by 0.1. `rounding` says how far they move.
    for scale in [1.0, 0.1]:
        scaled = [(vertices * scale, triangles) for vertices, triangles in (a, b)]
        for meshes, distance in [(scaled, forward), (scaled[::-1], backward)]:
            found = meshsweep.hausdorff(*meshes, one_sided=True, rel=1e-6)
            distance *= scale
            assert found.lower <= distance <= found.upper <= found.lower * (1 + 1e-6) + 1e-6
            assert found.is_backward is False and found.lower > 0
        both = meshsweep.hausdorff(*scaled)
        assert both.lower <= max(forward, backward) * scale <= both.upper
        assert both.stopped_by == "precision" and both.upper <= both.lower * (1 + 1e-4)
        assert (max(both.rounding) > 0) == (scale == 0.1)
        apart = np.linalg.norm(both.point_a - both.point_b)
        assert apart == pytest.approx(both.lower, rel=1e-6)
        for point, triangle, mesh in zip(
            both[2:4], (both.triangle_a, both.triangle_b), scaled, strict=True
        ):
            assert distances([point], *mesh)[0, triangle] < 1e-6
        if backward > forward:
            assert both.is_backward


def test_bounds_agree_with_samples_of_both_sides():
    rng = np.random.default_rng(6)
    vertices, triangles = sphere(5, 7)
    for spread in [0.02, 0.3]:
        moved = vertices + rng.normal(scale=spread, size=vertices.shape)
        a, b = (vertices, triangles), (moved, triangles)
        grids = [sampled(a, b, 40), sampled(b, a, 40)]
        for number, (far, step) in enumerate(grids):
            found = meshsweep.hausdorff(*[(a, b), (b, a)][number], one_sided=True)
            assert far <= found.upper * (1 + 1e-12) and found.lower <= far + step
            assert found.upper <= far + 2 * step
        both = meshsweep.hausdorff(a, b)
        assert max(far for far, _ in grids) <= both.upper * (1 + 1e-12)
        assert both.lower <= max(far + step for far, step in grids)
        assert both.lower == pytest.approx(meshsweep.hausdorff(b, a).lower, rel=1e-3)


def test_a_limit_is_decided_or_left_open():
    a, b = box((1, 1, 1)), box((1, 1, 2))
    for limit, holds in [(0.999, False), (1.001, True), (1.0, None), (0.0, False)]:
        assert meshsweep.hausdorff(a, b, at_most=limit).holds is holds
    assert meshsweep.hausdorff(a, b).holds is None
    alike = meshsweep.hausdorff(a, a)
    assert alike.lower == 0 and 0 < alike.upper < 1e-9
    assert alike.stopped_by == "rounding" and alike.point_a is None and alike.triangle_b is None


def in_3mf(file, unit, mesh):
    """Writes a mesh in that unit."""
    vertices, triangles = mesh
    points = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in vertices)
    faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles)
    space = "http://schemas.microsoft.com/3dmanufacturing"
    package = "http://schemas.openxmlformats.org/package/2006"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr(
            "[Content_Types].xml",
            f'<Types xmlns="{package}/content-types"><Default Extension="rels" ContentType="'
            'application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" '
            'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>',
        )
        archive.writestr(
            "_rels/.rels",
            f'<Relationships xmlns="{package}/relationships"><Relationship Id="r" '
            f'Target="/3D/3dmodel.model" Type="{space}/2013/01/3dmodel"/></Relationships>',
        )
        archive.writestr(
            "3D/3dmodel.model",
            f'<model unit="{unit}" xmlns="{space}/core/2015/02"><resources><object id="1" '
            f'type="model"><mesh><vertices>{points}</vertices><triangles>{faces}</triangles>'
            '</mesh></object></resources><build><item objectid="1"/></build></model>',
        )


def test_files_have_units_and_other_meshes_take_theirs(tmp_path, fixtures):
    a, b = tmp_path / "a.3mf", tmp_path / "b.3mf"
    in_3mf(a, "millimeter", box((1, 1, 1)))
    in_3mf(b, "inch", box((1, 1, 2)))
    found = meshsweep.hausdorff(a, box((1, 1, 2)))
    assert found.unit == "mm" and found.lower <= 1 <= found.upper and found.warnings == []
    with pytest.raises(meshsweep.BuildError, match=r"mm.*in"):
        meshsweep.hausdorff(a, b)
    in_mm = meshsweep.hausdorff(a, b, unit="mm")
    far = np.linalg.norm([24.4, 24.4, 49.8])
    assert in_mm.unit == "mm" and in_mm.lower <= far <= in_mm.upper <= far * 1.001


def test_a_mesh_of_trimesh_that_is_moved_far_is_so_far(fixtures):
    trimesh = pytest.importorskip("trimesh")
    moved = trimesh.load_mesh(fixtures / "bracket.stl")
    moved.apply_translation([1000, 0, 0])
    found = meshsweep.hausdorff(str(fixtures / "bracket.stl"), moved)
    # A point where the part begins moves by all of it, and no point by more.
    assert found.lower <= 1000 <= found.upper <= found.lower * 1.001 and found.unit is None


def test_what_is_no_mesh_is_refused_by_its_name(fixtures):
    good, flat = box((1, 1, 1)), (np.zeros((3, 2)), [[0, 1, 2]])
    none = (np.zeros((3, 3)), np.zeros((0, 3), np.uint32))
    for a, b, words in [
        (flat, good, r"a: vertices: shape \(v, 3\)"),
        (good, flat, r"b: vertices: shape \(v, 3\)"),
        (good, none, "b: .*no triangle"),
        ("/nowhere.stl", good, "a: .*nowhere"),
        (good, fixtures / "fence.csv", "b: .*csv"),
    ]:
        with pytest.raises(meshsweep.BuildError, match=words):
            meshsweep.hausdorff(a, b)
    for options, words in [
        ({"rel": -1}, "rel: -1 is negative"),
        ({"abs": np.nan}, "abs: nan is"),
        ({"at_most": [1, 2]}, "at_most: one number"),
        ({"unit": "furlong"}, "unit: no"),
    ]:
        with pytest.raises(meshsweep.MeshsweepError, match=words):
            meshsweep.hausdorff(good, good, **options)


def test_ctrl_c_ends_a_distance_soon_and_the_lock_is_free():
    # Almost equally far apart everywhere: millions of pieces.
    a, b = sphere(200, 300), sphere(190, 290)
    sent, ran = [], []

    def send():
        begin = time.perf_counter()
        while time.perf_counter() - begin < 2:
            ran.append(None)
            time.sleep(0.01)
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=send).start()
    with pytest.raises(KeyboardInterrupt):
        meshsweep.hausdorff(a, b, rel=0)
    assert time.perf_counter() - sent[0] < 1 and len(ran) > 20
    # The search ends too, well before it would be complete: the processors are free.
    for _ in range(16):
        before = time.process_time()
        time.sleep(0.5)
        if time.process_time() - before < 0.1:
            return
    raise AssertionError
