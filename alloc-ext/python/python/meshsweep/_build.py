"""Builds models."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence

from . import _meshsweep
from ._mesh import Bar, Mesh, Progress, given
from ._meshsweep import BuildError
from ._model import Model


def build(
    mesh: Mesh,
    for_: str | Iterable[str] = (),
    *,
    progress: Progress = None,
    unit: str | None = None,
    vertex_bits: int | None = None,
    base_faces: int | None = None,
    triboxes: int | None = None,
    tribox_error: float | None = None,
    orient: str | None = None,
    extrema: bool = False,
    tight_faces: Sequence[int] | None = None,
    slack: float | None = None,
    void_percent: float | None = None,
    margin: float | None = None,
    effort: float | None = None,
    tight_for: str | Iterable[str] = (),
    sdf_bytes: int | None = None,
    sdf_error: float | None = None,
    sdf_rel: float | None = None,
    sdf_kind: str | None = None,
    sdf_layout: str | None = None,
    sdf_margin: float | None = None,
    frames: Iterable[str | os.PathLike[str]] = (),
    closed: bool = False,
) -> Model:
    """Builds the model of a mesh: the bytes of `meshsweep build`, in memory.

    `mesh` is a file (STL, PLY, OBJ, OFF, glTF, 3MF, COLLADA; or CSV of a curve), a pair of vertices
    (v, 3) and triangles (t, 3), or an object with `vertices` and `faces`, as `trimesh.Trimesh`.
    `for_` names the questions, as "closest,segment", which is the default. The other options are
    those of `meshsweep build`, which its help explains; `None` is the default. So `sdf_error` is
    the largest width of an interval of a distance field, in the mesh's unit.

    `progress` is called with the name of the stage and the part of the work that is done; `True`
    shows a bar, if tqdm is installed. An exception of it, or Ctrl-C, ends the build.

    Raises `BuildError`, which names the defect and its place, if the mesh or an option is refused.
    What was repaired is in `Model.report`.
    """
    if isinstance(frames, (str, os.PathLike)):
        raise BuildError(f"frames: a list of files is wanted, as [{os.fspath(frames)!r}]")
    if isinstance(tight_faces, str) or not isinstance(tight_faces, Iterable | None):
        raise BuildError(f"tight_faces: a list of numbers is wanted, as [{tight_faces}]")
    options = {
        "for_": _words(for_),
        "unit": unit,
        "vertex_bits": vertex_bits,
        "base_faces": base_faces,
        "triboxes": triboxes,
        "tribox_error": tribox_error,
        "orient": orient,
        "extrema": extrema,
        "tight_faces": None if tight_faces is None else list(tight_faces),
        "slack": slack,
        "void_percent": void_percent,
        "margin": margin,
        "effort": effort,
        "tight_for": _words(tight_for),
        "sdf_bytes": sdf_bytes,
        "sdf_error": sdf_error,
        "sdf_rel": sdf_rel,
        "sdf_kind": sdf_kind,
        "sdf_layout": sdf_layout,
        "sdf_margin": sdf_margin,
        "frames": [os.fspath(frame) for frame in frames],
        "closed": closed,
    }
    with Bar(progress) as tell:
        return Model(_meshsweep.build(given(mesh), options, tell))


def _words(words: str | Iterable[str]) -> list[str]:
    """Words that commas separate."""
    parts = words.split(",") if isinstance(words, str) else words
    return [word.strip() for word in parts if word.strip()]
