"""Meshes, and oracles that share no code with the package: f64, each triangle of each point; and
exact signs."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

FIXTURES = Path(__file__).parents[3] / "fixtures"


CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], np.float64)
"""Those of the unit cube."""

FACES = [[0, 2, 1], [1, 2, 3], [0, 1, 4], [1, 5, 4], [1, 3, 5], [3, 7, 5]]
FACES += [[3, 2, 7], [2, 6, 7], [2, 0, 6], [0, 4, 6], [4, 5, 6], [5, 7, 6]]
"""Triangles of the cube. The last two are its lid, at z = 1."""


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


def winding_numbers(points, vertices, triangles):
    """How often a mesh encloses each point (n, 3), by solid angles in f64: shape (n,)."""
    corners = vertices.astype(np.float64)[np.asarray(triangles)]
    a, b, c = (corners[:, k] - np.asarray(points, np.float64)[:, None] for k in range(3))
    dot = lambda u, v: np.einsum("ntk,ntk->nt", u, v)
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    over = dot(a, np.cross(b, c))
    under = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    return np.arctan2(over, under).sum(axis=1) / (2 * np.pi)


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
