"""Builds models."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any

from . import _meshsweep
from ._arrays import real, whole, word, yes_or_no
from ._mesh import Bar, Mesh, Progress, files, given
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
    if isinstance(tight_faces, str) or not isinstance(tight_faces, Iterable | None):
        raise BuildError(f"tight_faces: a list of numbers is wanted, as [{tight_faces}]")
    options: dict[str, Any] = {
        "for_": _words(for_, "for_"),
        "unit": unit,
        "vertex_bits": vertex_bits,
        "base_faces": base_faces,
        "triboxes": triboxes,
        "tribox_error": tribox_error,
        "orient": orient,
        "extrema": extrema,
        "tight_faces": None,
        "slack": slack,
        "void_percent": void_percent,
        "margin": margin,
        "effort": effort,
        "tight_for": _words(tight_for, "tight_for"),
        "sdf_bytes": sdf_bytes,
        "sdf_error": sdf_error,
        "sdf_rel": sdf_rel,
        "sdf_kind": sdf_kind,
        "sdf_layout": sdf_layout,
        "sdf_margin": sdf_margin,
        "frames": files(frames, "frames"),
        "closed": closed,
    }
    for check, names in _CHECKS:
        options |= {name: check(options[name], name, BuildError) for name in names}
    if tight_faces is not None:
        if None in tight_faces:
            raise BuildError("tight_faces: whole numbers are wanted, not None")
        options["tight_faces"] = [whole(most, "tight_faces", BuildError) for most in tight_faces]
    with Bar(progress) as tell:
        return Model(_meshsweep.build(given(mesh), options, tell))


def _number(given: Any, what: str, refused: Any) -> float | None:
    return None if given is None else real(given, what, refused)


# Options by what they are.
_CHECKS: list[tuple[Any, list[str]]] = [
    (whole, ["vertex_bits", "base_faces", "triboxes", "sdf_bytes"]),
    (_number, ["tribox_error", "slack", "void_percent", "margin", "effort"]),
    (_number, ["sdf_error", "sdf_rel", "sdf_margin"]),
    (word, ["unit", "orient", "sdf_kind", "sdf_layout"]),
    (yes_or_no, ["extrema", "closed"]),
]


def _words(words: str | Iterable[str], what: str) -> list[str]:
    """Words that commas separate."""
    parts: Any = words.split(",") if isinstance(words, str) else words
    try:
        return [word for word in map(str.strip, parts) if word]
    except TypeError:
        text = f"{what}: words are wanted, as {'closest,segment'!r}, not {words!r}"
        raise BuildError(text) from None
