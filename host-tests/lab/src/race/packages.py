"""`cargo xtask python race MESH...`: what other Python packages take and answer, in one run, each on
one thread.

Prints a table for each mesh. A ratio is the time of a package beside that of meshsweep for the same
rows, measured one after the other. Wrong answers are counted by brute force in f64, on the first
rows: a distance that is off by more than 1e-6 of the mesh's diagonal, a sign that is another one
where the surface is farther than that. Of pairs there is no brute force: those are counted whose
distance is outside of meshsweep's interval by more than that.

Each time is the best of three. trimesh is timed on few rows. The Rust batch is the one that answers
meshsweep's closest points, called once for all points, in a process of its own and by a program
that is built as published ones are: `cargo xtask race --batch`.
"""

import importlib.metadata
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import coal
import fcl
import igl
import meshsweep
import numpy as np
import trimesh

ROWS, CHECKED, SLOW, PAIRS, BATCH = 200_000, 400, 2_000, 300, 1_000_000


PACKAGES = ("meshsweep", "libigl", "trimesh", "rtree", "python-fcl", "coal", "numpy", "scipy")


def timed(ask):
    """The best of three times, in seconds, and the answer."""
    times = []
    for _ in range(3):
        begun = time.perf_counter()
        answer = ask()
        times.append(time.perf_counter() - begun)
    return min(times), answer


def brute(points, corners):
    """The distance of each point from the mesh and its winding number, in f64."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    unit = normal / np.where(area > 0, area, 1)[:, None]
    nearest, winding = [], []
    for p in points.astype(np.float64):
        inside, least = area > 0, np.full(len(a), np.inf)
        for start, end in ((a, b), (b, c), (c, a)):
            edge = end - start
            inside &= np.einsum("tk,tk->t", p - start, np.cross(edge, unit)) <= 0
            length = np.einsum("tk,tk->t", edge, edge)
            t = np.einsum("tk,tk->t", p - start, edge) / np.where(length > 0, length, 1)
            foot = start + np.clip(t, 0, 1)[:, None] * edge
            least = np.minimum(least, np.linalg.norm(p - foot, axis=1))
        height = np.abs(np.einsum("tk,tk->t", p - a, unit))
        nearest.append(np.where(inside, height, least).min())
        u, v, w = a - p, b - p, c - p
        lu, lv, lw = (np.linalg.norm(x, axis=1) for x in (u, v, w))
        above = np.einsum("tk,tk->t", u, np.cross(v, w))
        beside = lu * lv * lw + lw * np.einsum("tk,tk->t", u, v)
        beside += lu * np.einsum("tk,tk->t", v, w) + lv * np.einsum("tk,tk->t", w, u)
        winding.append(np.arctan2(above, beside).sum() / (2 * np.pi))
    return np.array(nearest), np.array(winding)


def race(file):
    """One mesh."""
    mesh = trimesh.load(file, process=True, force="mesh")
    vertices = np.ascontiguousarray(mesh.vertices, np.float64)
    faces = np.ascontiguousarray(mesh.faces, np.int64)
    part = meshsweep.build(file, "closest,segment,winding")
    low, high = part.bounds.astype(np.float64)
    diagonal = np.linalg.norm(high - low)
    rng = np.random.default_rng(1)
    points = rng.uniform(low - 0.25 * (high - low), high + 0.25 * (high - low), (ROWS, 3))
    points = points.astype(np.float32)
    wide = points.astype(np.float64)
    truth, winding = brute(points[:CHECKED], vertices[faces])
    limit = 1e-6 * diagonal
    signs = np.where(winding > 0.5, -1, 1)

    def wrong(distance):
        return int((np.abs(distance[:CHECKED] - truth) > limit).sum())

    def wrong_sign(signed):
        is_off = np.sign(signed[:CHECKED]) != signs
        return int((is_off & (truth > limit)).sum())

    print(f"\n`{file.split('/')[-1]}`, {len(faces):,} triangles, {ROWS:,} points\n")
    print("| question | package | time / meshsweep | wrong of checked |")
    print("| --- | --- | --- | --- |")

    def row(question, package, ratio, bad, of=None):
        found = f"{bad} of {of}" if of else bad
        print(f"| {question} | {package} | {ratio:.2f} | {found} |", flush=True)

    ours, near = timed(lambda: part.closest_point(points))
    outside = (near.lower[:CHECKED] > truth + 1e-12) | (near.upper[:CHECKED] < truth - 1e-12)
    row("closest point", "meshsweep", 1, int(outside.sum()), CHECKED)
    took, found = timed(lambda: igl.point_mesh_squared_distance(wide, vertices, faces))
    row("closest point", "libigl", took / ours, wrong(np.sqrt(found[0])), CHECKED)
    took, found = timed(lambda: trimesh.proximity.closest_point(mesh, wide[:SLOW]))
    row("closest point", "trimesh", took * ROWS / SLOW / ours, wrong(found[1]), CHECKED)

    sides = low - 0.25 * (high - low), high + 0.25 * (high - low)
    many = np.random.default_rng(2).uniform(*sides, (BATCH, 3)).astype(np.float32)
    ours, _ = timed(lambda: part.closest_point(many))
    row(f"closest point, {BATCH:,}", "the Rust batch", by_rust(part, many) / ours, "–")

    ours, near = timed(lambda: part.signed_distance(points))
    decided = near.side[:CHECKED] != 0
    bad = ((near.side[:CHECKED] != signs) & decided & (truth > limit)).sum()
    row("signed distance", "meshsweep", 1, int(bad), CHECKED)
    kinds = igl.SIGNED_DISTANCE_TYPE_FAST_WINDING_NUMBER
    took, found = timed(lambda: igl.signed_distance(wide, vertices, faces, sign_type=kinds))
    row("signed distance", "libigl", took / ours, wrong_sign(found[0]), CHECKED)
    took, found = timed(lambda: -trimesh.proximity.signed_distance(mesh, wide[:SLOW]))
    row("signed distance", "trimesh", took * ROWS / SLOW / ours, wrong_sign(found), CHECKED)

    turns = np.linalg.qr(rng.normal(size=(PAIRS, 3, 3)))[0].astype(np.float32)
    turns[np.linalg.det(turns) < 0, :, 0] *= -1
    poses = np.zeros((PAIRS, 3, 4), np.float32)
    poses[:, :, :3] = turns
    middle = (low + high) / 2
    way = rng.normal(size=(PAIRS, 3))
    way *= (diagonal * rng.uniform(0.2, 1.2, PAIRS) / np.linalg.norm(way, axis=1))[:, None]
    poses[:, :, 3] = middle + way - np.einsum("nij,j->ni", turns, middle)
    ours, near = timed(lambda: part.distance_to(part, poses))
    row("distance of two", "meshsweep", 1, "–")

    def off(distance):
        beyond = (distance < near.lower - limit) | (distance > near.upper + limit)
        return int((beyond & ~((near.upper == 0) & (distance <= limit))).sum())

    took, found = timed(lambda: by_fcl(vertices, faces, poses))
    row("distance of two", "python-fcl", took / ours, off(found), PAIRS)
    took, found = timed(lambda: by_coal(vertices, faces, poses))
    row("distance of two", "coal", took / ours, off(found), PAIRS)


def by_rust(part, points):
    """Seconds of exact closest points by the Rust batch."""
    with tempfile.TemporaryDirectory() as folder:
        blob, raw = (pathlib.Path(folder, name) for name in ("part.msw", "points.f32"))
        part.save(blob)
        points.tofile(raw)
        words = [os.environ["MESHSWEEP_LAB"], "race", "--batch", blob, raw]
        return float(subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout)


def by_fcl(vertices, faces, poses):
    """Distances by python-fcl; 0 where the meshes meet."""
    model = fcl.BVHModel()
    model.beginModel(len(vertices), len(faces))
    model.addSubModel(vertices, faces)
    model.endModel()
    first, found = fcl.CollisionObject(model), []
    for pose in poses.astype(np.float64):
        second = fcl.CollisionObject(model, fcl.Transform(pose[:, :3], pose[:, 3]))
        found.append(max(0.0, fcl.distance(first, second)))
    return np.array(found)


def by_coal(vertices, faces, poses):
    """Distances by coal; 0 where the meshes meet."""
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(faces), len(vertices))
    corners = coal.StdVec_Vec3s()
    corners.extend(list(vertices))
    numbers = coal.StdVec_Triangle()
    numbers.extend([coal.Triangle(*map(int, face)) for face in faces])
    model.addSubModel(corners, numbers)
    model.endModel()
    found = []
    for pose in poses.astype(np.float64):
        at = coal.Transform3s(pose[:, :3], pose[:, 3])
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        found.append(max(0.0, coal.distance(model, coal.Transform3s(), model, at, request, result)))
    return np.array(found)


print(", ".join(f"{name} {importlib.metadata.version(name)}" for name in PACKAGES))
for mesh_file in sys.argv[1:]:
    race(mesh_file)
