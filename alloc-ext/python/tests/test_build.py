"""What builds, what is refused, and with which words."""

import inspect
import os
import pickle
import re
import subprocess
import sys
import threading

import meshsweep
import numpy as np
import pytest
from conftest import sphere
from meshsweep._meshsweep import words_of_for


def test_a_file_and_its_arrays_give_the_same_answers(fixtures):
    trimesh = pytest.importorskip("trimesh")
    file = fixtures / "bracket.stl"
    of_file = meshsweep.build(file)
    loaded = trimesh.load(file, process=False)
    points = np.random.default_rng(1).uniform(0, 50, (100, 3)).astype(np.float32)
    wanted = of_file.closest_point(points)
    for mesh in [loaded, (loaded.vertices, loaded.faces)]:
        found = meshsweep.build(mesh).closest_point(points)
        assert (found.lower == wanted.lower).all() and (found.upper == wanted.upper).all()


def test_the_bytes_are_those_that_are_saved_loaded_and_pickled(tmp_path, fixtures):
    part = meshsweep.build(fixtures / "bracket.stl", ["closest", "tight"])
    assert part.serves == ["closest", "tight"] and part.is_closed and part.has_sides
    part.save(tmp_path / "part.msw")
    again = meshsweep.load(tmp_path / "part.msw")
    copied = pickle.loads(pickle.dumps(part))
    assert bytes(again) == bytes(part) == bytes(copied) and copied.report == part.report
    assert again == part == copied and len({again, part, copied}) == 1 and part != bytes(part)
    assert part != meshsweep.build(fixtures / "bracket.stl")
    assert again.report == [] and any("read" in note.text for note in part.report)
    assert "closest,tight" in repr(part)


def test_repairs_are_reported():
    vertices, triangles = sphere()
    doubled = np.vstack([triangles, triangles[:1]])
    notes = [note.text for note in meshsweep.build((vertices, doubled)).report]
    assert any("triangle" in note for note in notes)


@pytest.mark.parametrize(
    "mesh, words",
    [
        ("/nowhere.stl", "/nowhere.stl"),
        ((np.zeros((3, 3)), [[0, 1, 5]]), "vertex 5"),
        ((np.zeros((3, 2)), [[0, 1, 2]]), r"shape \(v, 3\)"),
        ((np.zeros((3, 3)), [[0.5, 1, 2]]), "integers"),
        ((np.zeros((3, 3)), [[-1, 1, 2]]), "negative"),
        (([[0, 0, 0], [np.nan, 0, 0], [0, 1, 0]], [[0, 1, 2]]), "NaN|finite"),
        (7, "vertices"),
    ],
)
def test_a_mesh_that_is_refused_is_told_why(mesh, words):
    with pytest.raises(meshsweep.BuildError, match=words):
        meshsweep.build(mesh)


def test_options_are_refused_by_name():
    for options, words in [
        ({"for_": "closests"}, "closest, segment"),
        ({"vertex_bits": 7}, "16, 24 and 32"),
        ({"tight_faces": [20]}, "tight"),
        ({"for_": "sdf", "sdf_bytes": 1}, "sdf"),
        ({"unit": "mile"}, "um, mm"),
        ({"unit": 3}, "unit: a string is wanted, not 3"),
        ({"for_": None}, "for_: words are wanted"),
        ({"for_": 5}, "for_: words are wanted"),
        ({"for_": [1]}, "for_: words are wanted"),
        ({"for_": b"closest"}, "for_: words are wanted"),
        ({"tight_for": 5}, "tight_for: words are wanted"),
        ({"vertex_bits": -1}, "vertex_bits: -1 is none from 0"),
        ({"base_faces": 2**32}, "base_faces: 4294967296 is none from 0"),
        ({"triboxes": 1.5}, "triboxes: a whole number is wanted"),
        ({"sdf_bytes": "4096"}, "sdf_bytes: a whole number is wanted"),
        ({"tight_faces": [20.5]}, "tight_faces: a whole number is wanted"),
        ({"tight_faces": [None]}, "tight_faces: whole numbers are wanted"),
        ({"tight_faces": []}, "tight_faces: at least one number is wanted"),
        ({"slack": "1"}, "slack: one number is wanted"),
        ({"sdf_error": 10**400}, "sdf_error: a number is beyond double"),
        ({"extrema": "no"}, "extrema: True or False is wanted"),
        ({"closed": 1}, "closed: True or False is wanted"),
        ({"frames": 5}, "frames: a list of files is wanted, not 5"),
        ({"frames": [5]}, "frames: a list of files is wanted"),
    ]:
        with pytest.raises(meshsweep.BuildError, match=words):
            meshsweep.build(sphere(), **options)


def test_no_refusal_speaks_of_the_programs_options_or_of_rust(fixtures):
    part, fence = meshsweep.build(sphere()), fixtures / "fence.csv"
    ajar = sphere()[0], sphere()[1][1:]
    half = np.diag([0.5, 1, 1, 1])
    for ask, words in [
        (lambda: meshsweep.build(sphere(), "tight", tight_faces=[0]), "tight_faces 0: a number"),
        (lambda: meshsweep.build(sphere(), "sdf", sdf_error=-1), "sdf_error -1: a finite"),
        (lambda: meshsweep.build(sphere(), closed=True), 'closed=True is .*; add for_="curve"'),
        (lambda: meshsweep.build(sphere(), frames=["a.ply"]), 'add for_="deform"'),
        (lambda: meshsweep.build(sphere(), base_faces=9), "add hull to for_"),
        (lambda: meshsweep.build(sphere(), "tight", slack=1, void_percent=2), "and void_percent"),
        (lambda: meshsweep.build(fence, "closest"), 'serves for_="curve" only'),
        (lambda: meshsweep.build(ajar, "hull"), 'the mesh: .*\n.*\n.* for_="sweep,deform"$'),
        (lambda: meshsweep.build(ajar, "sdf", sdf_kind="signed"), 'ask for sdf_kind="surface"'),
        (lambda: meshsweep.build("a --b--c.stl"), "b--c.stl: cannot be read"),
        (lambda: part.cut(level=0), 'build it with for_="hull"'),
        (lambda: part.distance_to(part, half), "row 0: the pose's matrix is no rotation, or it is"),
        (lambda: part.tribox_overlap(part), 'with for_="triboxes"'),
        (
            lambda: part.first_hit([1e30, 0, 0], [1e30, 1, 0]),
            "row 0: a point.* too far away: clip segm",
        ),
        (lambda: meshsweep.choose(sphere(6, 8), flash=10), "needs flash .* instead of 10"),
        (lambda: meshsweep.hausdorff(sphere(), (np.zeros((0, 3)), np.zeros((0, 3), int))), "b: "),
    ]:
        with pytest.raises(meshsweep.MeshsweepError, match=words) as refused:
            ask()
        said = str(refused.value).replace("b--c.stl", "")
        assert not [word for word in ["--", "::", "(memory)", "joint"] if word in said], said
    notes = meshsweep.build(sphere(), unit="mm").report
    assert not any("--" in note.text for note in notes)


def test_questions_are_refused_with_the_row_and_the_word_to_build_with():
    part = meshsweep.build(sphere(), "closest")
    points = np.zeros((5, 3), np.float32)
    points[3, 1] = np.inf
    with pytest.raises(meshsweep.QueryError, match="row 3"):
        part.closest_point(points)
    with pytest.raises(meshsweep.NotServedError, match='for_="segment"'):
        part.first_hit(points[:1], points[:1])
    with pytest.raises(meshsweep.QueryError, match=r"shape \(n, 3\)"):
        part.closest_point(np.zeros((4, 2)))
    with pytest.raises(meshsweep.QueryError, match="negative"):
        part.within(points[:1], -1)
    assert issubclass(meshsweep.NotServedError, ValueError)
    assert len(part.closest_point(np.zeros((0, 3)))) == 0


@pytest.mark.parametrize(
    "ask, words",
    [
        (lambda part: part.closest_point(np.ma.zeros((2, 3))), "masked"),
        (lambda part: part.closest_point([["1", "2", "3"]]), "real numbers"),
        (lambda part: part.closest_point(np.zeros((2, 3), object)), "real numbers"),
        (lambda part: part.closest_point(np.zeros((2, 3), complex)), "real numbers"),
        (lambda part: part.closest_point(np.zeros((2, 3), bool)), "real numbers"),
        (lambda part: part.closest_point([[1, 2, 3], [1]]), "points"),
        (lambda part: part.within([[0, 0, 0], [np.nan, 0, 0]], 0.1), "row 1: .*(finite|NaN)"),
        (lambda part: part.within([[0, 0, 0]], "far"), "one number"),
        (lambda part: part.within([[0, 0, 0]], [1, 2]), "one number"),
        (lambda part: part.within([[0, 0, 0]], 1e39), "single precision"),
        (lambda part: part.within([[0, 0, 0]], "1"), "one number is wanted, not '1'"),
        (lambda part: part.within([[0, 0, 0]], 10**400), "beyond double precision"),
        (lambda part: part.within([[1e-9, 0, 0]], 3.4028234e38), "rounding it is beyond"),
        (lambda part: part.within(np.zeros((2, 3)), [1, -1]), "row 1: distance: -1.0 is negative"),
        (lambda part: part.within(np.zeros((2, 3)), [1]), r"shape \(2,\) is wanted, not \(1,\)"),
        (lambda part: part.within([[0, 0, 0]], 1, field_first=1), "True or False"),
        (lambda part: part.closest_point([[0, 0, 0]], precise="no"), "precise: True or False"),
        (lambda part: part.triboxes(1.5), "count: a whole number"),
        (lambda part: part.first_contact_of(part, np.eye(4), np.eye(4), straight=0), "straight"),
        (lambda part: part.first_hit(np.zeros((2, 3)), np.zeros((3, 3))), "2 starts for 3 ends"),
        (lambda part: part.first_hit([[0, 0, 0]], [[1, 0, 0]], facing=7), "Facing"),
        (lambda part: part.distance_to(np.zeros((2, 3))), "another Model is wanted"),
        (lambda part: part.overlap(part, np.eye(4)[:, :3]), "shape"),
        (lambda part: part.overlap(part, (np.eye(4) + np.eye(4, k=3)).T), "transposed"),
    ],
)
def test_a_question_that_is_refused_is_told_why(ask, words):
    with pytest.raises(meshsweep.QueryError, match=words):
        ask(meshsweep.build(sphere()))


def test_arguments_of_other_kinds_are_told_what_is_wanted():
    for options, words in [
        ({"frames": "a.ply"}, r"list of files is wanted, as \['a.ply'\]"),
        ({"for_": "tight", "tight_faces": 200}, r"list of numbers is wanted, as \[200\]"),
    ]:
        with pytest.raises(meshsweep.BuildError, match=words):
            meshsweep.build(sphere(), **options)
    with pytest.raises(meshsweep.BlobError, match=r"use meshsweep\.load"):
        meshsweep.Model("part.msw")
    with pytest.raises(meshsweep.BlobError, match="bytes are wanted"):
        meshsweep.Model(7)
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.Scene([trimesh.Trimesh(*sphere())])
    with pytest.raises(meshsweep.BuildError, match=r"to_geometry"):
        meshsweep.build(scene)
    with pytest.raises(meshsweep.BuildError, match="masked"):
        meshsweep.build((np.ma.array(sphere()[0]), sphere()[1]))


def test_fields_of_records_are_aligned():
    dtypes = [of for of in vars(meshsweep._records).values() if isinstance(of, np.dtype)]
    assert len(dtypes) > 20 and all(of.isalignedstruct for of in dtypes)
    part = meshsweep.build(sphere(), "closest,segment,winding")
    points = np.random.default_rng(5).uniform(-2, 2, (7, 3)).astype(np.float32)
    for found in [
        part.closest_point(points),
        part.nearest(points, 3),
        part.first_hit(points, -points),
    ]:
        assert all(found[name].flags.aligned for name in found.dtype.names)
        assert (found.triangle >= -1).all() and (found.triangle < len(sphere()[1])).all()


def test_rows_of_every_layout_give_the_same_answers():
    part = meshsweep.build(sphere())
    points = np.random.default_rng(3).uniform(-2, 2, (20, 3)).astype(np.float32)
    wanted = part.closest_point(points)
    frozen = points.copy()
    frozen.flags.writeable = False
    unaligned = np.frombuffer(b"x" + points.tobytes(), np.float32, offset=1).reshape(20, 3)
    doubled = np.repeat(points, 2, axis=0)[::2]
    for rows in [frozen, unaligned, doubled, np.asfortranarray(points), points.astype(">f4")]:
        assert part.closest_point(rows).tobytes() == wanted.tobytes()
    again = part.closest_point(wanted.point)
    for row in range(20):
        (found,) = part.closest_point(wanted[row].point)
        assert found.lower == again[row].lower
    for rows in [np.array([[1, 2, 3]]), np.array([[1, 2, 3]], np.uint8), [[1, 2, 3]]]:
        assert part.closest_point(rows).lower == part.closest_point(np.float32([[1, 2, 3]])).lower
    (found,) = part.closest_point(np.array([[2**62 + 1, 0, 0]]))
    assert found.lower <= 2**62 <= found.upper


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_the_child_of_a_fork_answers_builds_and_is_interrupted():
    script = """
import os, signal, sys
import meshsweep, numpy as np
sys.path.insert(0, "tests")
from conftest import sphere

part = meshsweep.build(sphere(), "closest,tight")
points = np.random.default_rng(1).uniform(-2, 2, (100_000, 3)).astype(np.float32)
wanted = part.closest_point(points).tobytes(), part.within(points, 0.5).tobytes()

def check():
    assert (part.closest_point(points).tobytes(), part.within(points, 0.5).tobytes()) == wanted
    assert bytes(meshsweep.build(sphere(), "closest,tight")) == bytes(part)

def in_child(work):
    child = os.fork()
    if child == 0:
        code = 1
        try:
            work()
            code = 0
        finally:
            os._exit(code)
    assert os.waitpid(child, 0)[1] == 0

def ended(*_):
    raise TimeoutError

def stopped():
    signal.signal(signal.SIGALRM, ended)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        meshsweep.build(sphere(300, 400), "tight,hull", effort=4)
    except TimeoutError:
        return
    raise AssertionError

in_child(check)
in_child(lambda: (check(), in_child(check), check()))
in_child(stopped)
check()
"""
    run = [sys.executable, "-W", "ignore", "-c", script]
    subprocess.run(run, check=True, timeout=100)


def test_the_numbers_of_faces_may_be_a_generator():
    given = (most for most in [20, 60])
    part = meshsweep.build(sphere(), "tight", tight_faces=given)
    assert bytes(part) == bytes(meshsweep.build(sphere(), "tight", tight_faces=[20, 60]))


def test_answers_that_memory_does_not_hold_are_refused():
    script = """
import resource, sys
import meshsweep, numpy as np
sys.path.insert(0, "tests")
from conftest import sphere

part = meshsweep.build(sphere(40, 60))
points = np.zeros((20_000, 3), np.float32)
part.all_within(points[:100], 2.0)  # starts the threads
with open("/proc/self/statm") as told:
    taken = int(told.read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (taken + (1 << 29),) * 2)
for ask in [part.nearest, part.all_within]:
    try:
        ask(points, 4000 if ask == part.nearest else 2.0)
    except MemoryError as error:
        assert "take more memory" in str(error)
        continue
    raise AssertionError
assert len(part.nearest(points[:10], 2**32 - 1)) == 10
"""
    if not os.path.exists("/proc/self/statm"):
        pytest.skip("the memory of a process is not told")
    subprocess.run([sys.executable, "-c", script], check=True, timeout=100)


def test_damaged_bytes_are_refused():
    part = bytearray(bytes(meshsweep.build(sphere())))
    part[100] ^= 1
    for bad in [b"", b"not a blob", bytes(part)]:
        with pytest.raises(meshsweep.BlobError):
            meshsweep.Model(bad)


def test_progress_rises_to_one_and_its_exception_ends_the_build():
    told = []
    meshsweep.build(sphere(20, 30), "tight", progress=lambda *told_: told.append(told_))
    parts = [part for _, part in told]
    assert parts == sorted(parts) and told[-1] == ("done", 1.0)

    def stop(_stage, part):
        if part > 0.1:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        meshsweep.build(sphere(20, 30), "tight", progress=stop)


def test_other_threads_run_while_a_question_is_asked():
    part = meshsweep.build(sphere(40, 60))
    points = np.random.default_rng(2).uniform(-2, 2, (400_000, 3)).astype(np.float32)
    found, counted = [], 0
    asking = threading.Thread(target=lambda: found.append(part.closest_point(points)))
    asking.start()
    while asking.is_alive():
        counted += 1
    assert counted > 1000 and len(found[0]) == len(points)


def test_curves_answer_with_segments(tmp_path):
    (tmp_path / "path.csv").write_text("x,y,z\n0,0,0\n1,0,0\n1,1,0\n")
    path = meshsweep.build(tmp_path / "path.csv")
    (near,) = path.closest_point(np.array([[2, 0.5, 0]], np.float32))
    assert near.segment == 1 and near.polyline == 0
    assert near.lower <= 1 <= near.upper
    moved = np.array([[2, 0.5 + 1e-9, 0], [0.5, 1e-40, 0]])
    given, rounded = path.closest_point(moved), path.closest_point(moved.astype(np.float32))
    off = np.linalg.norm(moved - moved.astype(np.float32), axis=1)
    assert (rounded.safe_motion > 0).any() and (given.safe_motion >= 0).all()
    assert (given.safe_motion <= np.maximum(rounded.safe_motion - off, 0)).all()
    assert (given.safe_motion >= rounded.safe_motion - 1e-6).all()


def test_the_tour_shows_a_part(fixtures):
    file = str(fixtures / "bracket.stl")
    run = [sys.executable, "-m", "meshsweep", file]
    shown = subprocess.run(run, capture_output=True, text=True, check=True).stdout
    assert "clear, proved" in shown and "100,000 closest points" in shown
    bad = subprocess.run([*run[:-1], "nowhere.stl"], capture_output=True, text=True, check=False)
    assert bad.returncode == 1 and "nowhere.stl" in bad.stderr
    for other in sorted(map(str, [*fixtures.glob("*.msw"), fixtures / "fence.csv"])):
        run = [sys.executable, "-m", "meshsweep", other]
        shown = subprocess.run(run, capture_output=True, text=True, check=True).stdout
        assert " bytes for " in shown and ("box " in shown or "knows no bounds" in shown)
    told = subprocess.run([*run[:-1], "--help"], capture_output=True, text=True, check=True)
    assert "usage" in told.stdout and not told.stderr


def test_the_lines_of_the_readme_run(tmp_path, monkeypatch, fixtures):
    text = (fixtures.parent / "alloc-ext/python/README.md").read_text()
    lines = text.split("```python\n")[1].split("```")[0]
    (tmp_path / "link.stl").write_bytes((fixtures / "bracket.stl").read_bytes())
    monkeypatch.chdir(tmp_path)
    exec(compile(lines.replace("1_000_000", "10_000"), "README.md", "exec"), {})  # noqa: S102
    assert (tmp_path / "link.msw").stat().st_size > 1000


def test_the_lines_of_the_first_readme_run(monkeypatch, fixtures, capsys):
    text = (fixtures.parent / "README.md").read_text()
    lines = text.split("```python\n")[1].split("```")[0]
    monkeypatch.chdir(fixtures.parent)
    exec(compile(lines.replace("1_000_000", "10_000"), "README.md", "exec"), {})  # noqa: S102
    assert 10 < float(capsys.readouterr().out) < 100


def test_the_docstring_of_build_names_every_word_and_every_option():
    text = inspect.getdoc(meshsweep.build)
    words = re.findall(r"^`(\w+)`  ", text, re.MULTILINE)
    assert sorted(words) == sorted(words_of_for())
    options = re.findall(r"^- `(\w+)`: ", text, re.MULTILINE)
    parameters = [*inspect.signature(meshsweep.build).parameters]
    assert options == [name for name in parameters if name not in ("mesh", "for_", "progress")]
