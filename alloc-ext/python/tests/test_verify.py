"""All is proved of the mesh that a model was built from, and of no other."""

import meshsweep
import numpy as np
import pytest
from conftest import sphere

ALL = "closest,segment,cull,winding,hull,tight,triboxes,sdf"


def test_every_structure_is_proved_of_its_mesh_and_fails_of_another():
    vertices, triangles = sphere(5, 6)
    options = {"tight_faces": [20], "triboxes": 4, "sdf_bytes": 2048}
    part = meshsweep.build((vertices, triangles), ALL, **options)
    proof = meshsweep.verify(part, (vertices, triangles))
    assert proof and not proof.unproved
    structures = {finding.structure for finding in proof.proved}
    wanted = {"box tree", "hull hierarchy", "tight hulls", "triboxes", "distance field"}
    assert wanted <= structures
    (tree,) = [found for found in proof.proved if found.counts.get("moment")]
    assert tree.structure == "box tree" and tree.counts["triangle"] == len(triangles)
    larger = vertices.copy()
    larger[0, 2] += 0.25
    proof = meshsweep.verify(part, (larger, triangles))
    assert not proof and wanted <= {found.structure for found in proof.unproved}
    assert all(found.outcome != "proved" and found.text for found in proof.unproved)


def test_files_in_units_on_grids_with_key_frames_and_of_curves_are_proved(tmp_path, fixtures):
    file = fixtures / "bracket.stl"
    for options in [{"for_": "hull", "vertex_bits": 16}, {"unit": "mm"}]:
        part = meshsweep.build(file, **options)
        assert meshsweep.verify(part, str(file), unit=options.get("unit"))
    trimesh = pytest.importorskip("trimesh")
    frames = []
    for size in [1.0, 1.5]:
        frames.append(tmp_path / f"{size}.ply")
        trimesh.Trimesh(sphere()[0] * size, sphere()[1], process=False).export(frames[-1])
    part = meshsweep.build(frames[0], "hull,deform", frames=frames[1:])
    assert meshsweep.verify(part, frames[0], frames=frames[1:])
    assert not meshsweep.verify(part, frames[0], frames=frames[:1])
    fence = meshsweep.load(fixtures / "fence.msw")
    assert meshsweep.verify(fence, fixtures / "fence.csv")
    text = (fixtures / "fence.csv").read_text().replace("100,48,0", "100,47,0")
    (tmp_path / "other.csv").write_text(text)
    assert not meshsweep.verify(fence, tmp_path / "other.csv")


def test_what_is_no_mesh_of_the_model_is_refused(fixtures):
    fence, part = meshsweep.load(fixtures / "fence.msw"), meshsweep.build(sphere())
    for model, mesh, words in [
        (fence, sphere(), "csv"),
        (part, fixtures / "fence.csv", "holds curves"),
        (part, "/nowhere.stl", "nowhere"),
        (part, (np.zeros((3, 2)), [[0, 1, 2]]), r"shape \(v, 3\)"),
    ]:
        with pytest.raises(meshsweep.BuildError, match=words):
            meshsweep.verify(model, mesh)
    with pytest.raises(meshsweep.QueryError, match="a Model is wanted"):
        meshsweep.verify(bytes(part), sphere())
    for frames in ["k1.ply", 5]:
        with pytest.raises(meshsweep.BuildError, match="frames: a list of files is wanted"):
            meshsweep.verify(part, sphere(), frames=frames)
    with pytest.raises(meshsweep.BuildError, match="no key frames"):
        meshsweep.verify(part, sphere(), frames=["a.ply"])
