"""Precise closest points beside all triangles in f64."""

import meshsweep
import numpy as np
import pytest
from conftest import distances, sphere


def test_intervals_are_as_narrow_as_single_precision_and_hold():
    vertices, triangles = sphere(9, 14)
    vertices = (vertices * [3, 1, 0.5] + [40, 0, -20]).astype(np.float32)
    part = meshsweep.build((vertices, triangles), vertex_bits=32)
    assert part.surface_error == 0
    rng = np.random.default_rng(9)
    low, high = part.bounds
    points = rng.uniform(low - 2, high + 2, (400, 3)).astype(np.float32)
    # Next to the surface, where rounding hides the nearest triangle.
    near = vertices[triangles].mean(axis=1) + rng.normal(scale=1e-6, size=(len(triangles), 3))
    points = np.vstack([points, near.astype(np.float32)])
    all_of = distances(points, vertices, triangles)
    truth = all_of.min(axis=1)
    plain, found = part.closest_point(points), part.closest_point(points, precise=True)
    assert (found.lower <= truth + 1e-13).all() and (truth - 1e-13 <= found.upper).all()
    # A rounding at each end, and that of a sum in double precision.
    width = found.upper.astype(np.float64) - found.lower
    rounding = np.spacing(found.upper).astype(np.float64)
    assert (width <= 3 * rounding + 1e-11).all()
    assert (width <= plain.upper.astype(np.float64) - plain.lower).all()
    assert width.sum() < 0.2 * (plain.upper.astype(np.float64) - plain.lower).sum()
    named = np.take_along_axis(all_of, found.triangle[:, None], axis=1)[:, 0]
    assert (named <= truth + 1e-11).all()
    on = distances(found.point, vertices, triangles).min(axis=1)
    apart = np.linalg.norm(found.point.astype(np.float64) - points, axis=1)
    assert on.max() < 1e-5 and np.abs(apart - truth).max() < 1e-5
    assert (found.ended == meshsweep.Ended.EXACT).all()


def test_points_in_double_precision_and_few_steps_leave_wider_intervals_that_hold():
    vertices, triangles = sphere()
    part = meshsweep.build((vertices, triangles), vertex_bits=32)
    points = np.random.default_rng(10).uniform(-2, 2, (300, 3))
    truth = distances(points, vertices, triangles).min(axis=1)
    for steps in [None, 40, 1]:
        found = part.closest_point(points, steps=steps, precise=True)
        assert (found.lower <= truth + 1e-12).all() and (truth - 1e-12 <= found.upper).all()
        is_ended = found.ended == meshsweep.Ended.STEPS
        assert is_ended.all() if steps == 1 else steps is not None or not is_ended.any()


def test_what_cannot_be_precise_is_refused(fixtures):
    part, hull = meshsweep.build(sphere()), meshsweep.build(sphere(), "hull")
    for options in [{"rel": 0.1}, {"abs": 1}]:
        with pytest.raises(meshsweep.QueryError, match="precise: it takes no rel"):
            part.closest_point([0, 0, 3], precise=True, **options)
    for model in [hull, meshsweep.load(fixtures / "fence.msw")]:
        with pytest.raises(meshsweep.NotServedError, match="box tree"):
            model.closest_point([0, 0], precise=True) if model is not hull else (
                model.closest_point([0, 0, 3], precise=True)
            )
    with pytest.raises(meshsweep.QueryError, match="row 1"):
        part.closest_point([[0, 0, 3], [np.nan, 0, 0]], precise=True)
