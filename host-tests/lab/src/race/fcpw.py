# FCPW as a child process of the race: it reads a mesh, then lists of queries, and answers each list
# with the time that it took. The bytes to and fro are those of embree.cpp; FCPW does not tell what
# it holds, so that number is 0.
#
# FCPW gives a list to as many threads as there are processors. The child may use one processor, and
# its time is that of the process: the sum over all threads. What FCPW does once a list is part of
# it: threads, and a place for every answer.
#
# FCPW takes a ray for parallel to a triangle if a determinant is below 1e-7, which is an area: on a
# mesh of fine triangles it loses a quarter of the hits. So FCPW gets the mesh, and all queries,
# multiplied by a power of two.

import os

os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})

import sys
import time

import fcpw
import numpy as np

FARTHEST = np.finfo(np.float32).max
# The largest coordinate in FCPW is near this number.
SIZE = 4096


def read(kind, columns):
    """A list: its length, then its rows."""
    (count,) = numbers(np.uint32, 1)
    return numbers(kind, count * columns).reshape(count, columns)


def numbers(kind, count):
    """Ends the child where the input ends."""
    size = int(count) * np.dtype(kind).itemsize
    data = sys.stdin.buffer.read(size)
    if len(data) < size:
        sys.exit()
    return np.frombuffer(data, kind)


def write(*arrays):
    for array in arrays:
        sys.stdout.buffer.write(array.tobytes())
    sys.stdout.buffer.flush()


def timed(run):
    begun = time.process_time()
    run()
    return np.float64(time.process_time() - begun)


def columns(rows):
    """As FCPW wants them."""
    return np.asfortranarray(rows)


def closest_points():
    points = columns(scale * read(np.float32, 3))
    radii = np.full(len(points), FARTHEST, np.float32)
    found = fcpw.interaction_3D_list()
    seconds = timed(lambda: scene.find_closest_points(points, radii, found))
    return seconds, np.array([at.p for at in found], np.float32) / scale


def segments():
    rows = scale * read(np.float32, 6)
    return rows[:, :3], rows[:, 3:]


def first_hits():
    origins, ends = segments()
    lengths = np.linalg.norm(ends - origins, axis=1)
    directions = (ends - origins) / lengths[:, None]
    rays = columns(origins), columns(directions), lengths
    found = fcpw.interaction_3D_list()
    seconds = timed(lambda: scene.intersect(*rays, found))
    distances = np.array([at.d if at.primitive_index >= 0 else -1 for at in found], np.float32)
    return seconds, np.where(distances < 0, -1, distances / lengths).astype(np.float32)


def any_hits():
    # With arrays, version 1.1.4 returns no answers.
    ends = [fcpw.float_3D_list(list(np.ascontiguousarray(ends))) for ends in segments()]
    is_clear = fcpw.uint32_list()
    seconds = timed(lambda: scene.has_line_of_sight(*ends, is_clear))
    return seconds, np.where(np.array(is_clear) != 0, -1, 0).astype(np.float32)


scene = fcpw.scene_3D()
scene.set_object_count(1)
vertices = read(np.float32, 3)
scale = np.exp2(np.round(np.log2(SIZE / np.abs(vertices).max()))).astype(np.float32)
scene.set_object_vertices(columns(scale * vertices), 0)
scene.set_object_triangles(columns(read(np.int32, 3)), 0)
seconds = timed(lambda: scene.build(fcpw.aggregate_type.bvh_surface_area, True))
write(np.uint64(0), seconds)
while True:
    (question,) = numbers(np.uint32, 1)
    write(*[closest_points, first_hits, any_hits][question]())
