"""Meshes, and oracles that share no code with the package: f64, each triangle of each point; and
exact signs."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

FIXTURES = Path(__file__).parents[3] / "fixtures"


@pytest.fixture
def fixtures() -> Path:
    return FIXTURES


def sphere(rings: int = 8, sectors: int = 12, scale: float = 1.0):
    """A closed mesh of slivers at its poles: vertices, triangles."""
    angle = np.linspace(0, np.pi, rings + 1)[1:-1]
    turn = np.linspace(0, 2 * np.pi, sectors, endpoint=False)
    ring = np.stack(
        [
            np.outer(np.sin(angle), np.cos(turn)),
            np.outer(np.sin(angle), np.sin(turn)),
            np.outer(np.cos(angle), np.ones(sectors)),
        ],
        axis=-1,
    ).reshape(-1, 3)
    vertices = np.vstack([[0, 0, 1], ring, [0, 0, -1]]).astype(np.float32)
    last = len(vertices) - 1
    triangles = []
    for s in range(sectors):
        t = (s + 1) % sectors
        triangles.append([0, 1 + s, 1 + t])
        for r in range(rings - 2):
            a, b = 1 + r * sectors, 1 + (r + 1) * sectors
            triangles += [[a + s, b + s, b + t], [a + s, b + t, a + t]]
        a = 1 + (rings - 2) * sectors
        triangles.append([a + s, last, a + t])
    return vertices * np.float32(scale), np.array(triangles, np.uint32)


def distances(points, vertices, triangles):
    """The distance of each point (n, 3) from each triangle, in f64: shape (n, t)."""
    corners = vertices.astype(np.float64)[triangles]
    p = np.asarray(points, np.float64)[:, None, :]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    unit = normal / area[:, None]
    height = np.einsum("ntk,tk->nt", p - a, unit)
    is_over = np.ones(height.shape, bool)
    nearest = np.full(height.shape, np.inf)
    for start, end in [(a, b), (b, c), (c, a)]:
        edge = end - start
        outwards = np.cross(edge, unit)
        is_over &= np.einsum("ntk,tk->nt", p - start, outwards) <= 0
        t = np.einsum("ntk,tk->nt", p - start, edge) / np.einsum("tk,tk->t", edge, edge)
        foot = start + np.clip(t, 0, 1)[..., None] * edge
        nearest = np.minimum(nearest, np.linalg.norm(p - foot, axis=2))
    return np.where(is_over, np.abs(height), nearest)


def orientation(a, b, c, d):
    """The sign of the volume of a tetrahedron, exact. Coordinates are fractions or floats."""
    a, b, c, d = (
        [x if isinstance(x, Fraction) else Fraction(float(x)) for x in p] for p in (a, b, c, d)
    )
    u, v, w = ([x - y for x, y in zip(p, d, strict=True)] for p in (a, b, c))
    volume = (
        u[0] * (v[1] * w[2] - v[2] * w[1])
        - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
    )
    return (volume > 0) - (volume < 0)


def passes(p, q, triangle):
    """Whether a segment passes properly through a triangle: exact."""
    if orientation(*triangle, p) * orientation(*triangle, q) >= 0:
        return False
    around = {orientation(p, q, triangle[i], triangle[(i + 1) % 3]) for i in range(3)}
    return len(around) == 1 and 0 not in around


def crosses(first, second):
    """Whether an edge of one triangle passes properly through the other: exact."""
    both = [(first, second), (second, first)]
    return any(passes(a[k], a[(k + 1) % 3], b) for a, b in both for k in range(3))
