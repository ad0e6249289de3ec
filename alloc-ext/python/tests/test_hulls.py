"""Refined hulls and coarser models."""

import meshsweep
import numpy as np
import pytest
from conftest import distances, sphere, winding_numbers

MESH = sphere()


@pytest.fixture(scope="module")
def part():
    words = "closest,hull,tight,triboxes"
    options = {"tight_faces": [8, 20], "triboxes": 16, "base_faces": 40}
    return meshsweep.build(MESH, words, vertex_bits=32, **options)


def encloses(hull, points):
    """Whether a closed hull has all points inside or on it: winding numbers in f64."""
    corners, faces = hull[0].astype(np.float64), hull[1].astype(np.int64)
    edges = [(int(f[k]), int(f[(k + 1) % 3])) for f in faces for k in range(3)]
    assert len(set(edges)) == len(edges) and {e[::-1] for e in edges} == set(edges)
    winding = winding_numbers(points, corners, faces)
    return (winding > 0.5) | (distances(points, *hull[:2]).min(axis=1) < 1e-6)


def test_a_refined_hull_encloses_and_is_fine_in_its_place_alone():
    vertices, triangles = sphere(24, 32)
    part = meshsweep.build((vertices, triangles), "hull", vertex_bits=32)
    finest = len(part.hull_levels()[-1][1])
    coarsest = len(part.hull_levels()[0][1])
    assert len(part.refine(0).triangles) == finest == len(triangles)
    centre, radius = vertices[30], 0.3
    for place, is_there in [
        ({"near": centre, "within": radius}, lambda p: np.linalg.norm(p - centre, axis=1) < radius),
        ({"box": [[0, 0, 0], [2, 2, 2]]}, lambda p: (p > 0).all(axis=1)),
        (
            {"segment": [[-2, 0, 0.1], [2, 0, 0.1]], "within": 0.2},
            lambda p: np.linalg.norm(p[:, 1:] - [0, 0.1], axis=1) < 0.2,
        ),
    ]:
        counts = []
        for error in [0.0, 0.1, 0.5]:
            hull = part.refine(error, **place)
            counts.append(len(hull.triangles))
            assert hull.error_left == 0 and encloses(hull, vertices).all()
            # Vertices of the mesh that are there are as near as was asked for.
            there = vertices[is_there(vertices.astype(np.float64))]
            assert len(there) > 3
            off = distances(there, *hull[:2]).min(axis=1)
            assert off.max() <= error + 1e-6
        assert coarsest == counts[2] < counts[1] < counts[0] < finest


def test_a_cut_model_keeps_its_coarse_hulls(part):
    levels, hulls = part.hull_levels(), part.tight_hulls()
    cut = part.cut(level=1)
    assert isinstance(cut, meshsweep.Model) and cut.report == []
    assert len(bytes(cut)) < len(bytes(part)) and "closest" not in cut.serves
    assert len(cut.hull_levels()) == 2 < len(levels)
    for coarse, whole in zip(cut.hull_levels(), levels, strict=False):
        assert [len(x) for x in coarse] == [len(x) for x in whole]
        assert encloses(coarse, MESH[0]).all()
    # The distance to the mesh is still in the interval, which is wider.
    points = np.random.default_rng(1).uniform(-2, 2, (100, 3)).astype(np.float32)
    truth = distances(points, *MESH).min(axis=1)
    near = cut.closest_point(points)
    assert (near.lower <= truth + 1e-12).all() and (truth - 1e-12 <= near.upper).all()
    fewer = part.cut(tight=len(hulls[0].triangles), triboxes=4)
    assert len(fewer.tight_hulls()) == 1 < len(hulls)
    assert np.array_equal(fewer.tight_hulls()[0].vertices, hulls[0].vertices)
    assert len(fewer.triboxes().node) <= 4 < len(part.triboxes().node)
    assert fewer.serves == part.serves and len(fewer.hull_levels()) == len(levels)
    assert bytes(part.cut()) == bytes(part)


def test_what_cannot_be_refined_or_cut_is_refused(part):
    plain = meshsweep.build(sphere())
    for options, words in [
        ({"error": -1}, "error: -1 is negative"),
        ({"error": 0, "near": [0, 0]}, r"near: shape \(3,\)"),
        ({"error": 0, "near": [0, 0, np.nan]}, "finite"),
        ({"error": 0, "near": [0, 0, 0], "box": np.zeros((2, 3))}, "near and box: one place"),
        ({"error": 0, "within": 1}, "within: it takes"),
        ({"error": 0, "segment": np.zeros(6)}, r"segment: shape \(2, 3\)"),
    ]:
        with pytest.raises(meshsweep.QueryError, match=words):
            part.refine(**options)
    for ask in [lambda: plain.refine(0), plain.hull_levels]:
        with pytest.raises(meshsweep.NotServedError, match="hull"):
            ask()
    for options, words in [
        ({"level": 99}, "level 99 does not exist"),
        ({"level": -1}, "level: -1 is none"),
        ({"tight": 1.5}, "tight: a whole number"),
    ]:
        with pytest.raises(meshsweep.BuildError, match=words):
            part.cut(**options)
    for options in [{"level": 0}, {"triboxes": 1}, {"tight": 8}]:
        with pytest.raises(meshsweep.BuildError, match="to cut"):
            plain.cut(**options)
