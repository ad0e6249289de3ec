"""Builds models."""

from __future__ import annotations

import os
from collections.abc import Iterable
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
    tight_faces: Iterable[int] | None = None,
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
    `for_` has the words of the questions that the model must answer, as "closest,segment", which is
    the default:

    ==========  ==================================================================================
    word        what the model answers, and from which structure
    ==========  ==================================================================================
    `closest`   distances and sides of points: a box tree of any mesh
    `segment`   segments, rays, solids and other models: a box tree of any mesh
    `cull`      `front_facing`: normal cones in the box tree
    `winding`   `winding_number`, sides of open meshes, `penetration`: in the box tree
    `hull`      `hull_levels` and `refine`; distances, segments, `overlap`: a progressive hull of a
                closed manifold mesh
    `sweep`     as `hull`, of any mesh; no level encloses the mesh
    `triboxes`  `tribox_distance` and its kin: a union of chamfered boxes that holds the mesh
    `tight`     `tight_hulls`; wider intervals of distances: hulls of few faces
    `sdf`       `field_distance` and `field_within`: a distance field
    `deform`    `frame=` of questions: the hierarchy of `hull`, or with "sweep,deform" that of any
                mesh, with key frames
    `curve`     questions about points to a curve or a fence: the only word for a CSV file
    ==========  ==================================================================================

    Options are those of `meshsweep build`. Lengths are in the mesh's unit. `None` is the default.

    - `unit`: the unit that the file is scaled to, as "mm"; without it nothing is scaled.
    - `vertex_bits`: bits of a stored coordinate, 16, 24 or 32 (single precision). By default 16, or
      32 where 16 would move vertices too far; of hulls the fewest that store the mesh exactly.
    - `base_faces`: faces of the coarsest hull of "hull", "sweep" and "deform". Default: 200.
    - `triboxes`: the most triboxes of the finest level. Default: 64.
    - `tribox_error`: a length. Triboxes are split until each is within it of the convex hull of the
      triangles that it holds.
    - `orient`: "volume" or "area": turns the triboxes to where one about the mesh has the least.
    - `extrema`: whether triboxes are split just beyond local extrema of the mesh too.
    - `tight_faces`: the number of faces of each tight hull. Default: [200].
    - `slack`: a length, in place of `tight_faces`: one hull of the fewest faces found, no point of
      which is farther from the mesh.
    - `void_percent`: in place of `tight_faces`: one hull of the fewest faces found, whose volume
      beside the mesh is at most so many percent of the mesh's volume.
    - `margin`: a length: tight hulls hold all points that are so near to the mesh. Default: 0.
    - `effort`: a factor of the time to polish tight hulls. 0 is not at all. Default: 1.
    - `tight_for`: the questions of tight hulls. Default: "closest,segment".
    - `sdf_bytes`: bytes of the distance field. Default: 16384; with `sdf_error` at most 262144.
    - `sdf_error`: a length: the largest width of the field's intervals. The field has the fewest
      bytes found.
    - `sdf_rel`: a fraction of the distance that is added to `sdf_error`. Default: 0.
    - `sdf_kind`: "signed", "solid" (0 inside) or "surface" (without sign). Default: "signed" of a
      closed mesh with sides, else "surface".
    - `sdf_layout`: "lattice" or "tree". Default: the one of narrower intervals, or nearly so.
    - `sdf_margin`: a length: how far the field extends beyond the mesh's box. Default: a tenth of
      the box's diagonal.
    - `frames`: files of the same mesh at further key frames, with "deform".
    - `closed`: whether the last point of each polyline is joined with its first.

    `progress` is called with the name of the stage and the fraction of the work that is done;
    `True` shows a bar, if tqdm is installed. An exception of `progress`, or Ctrl-C, ends the build.

    Raises `BuildError`, which names the defect and its place, if the mesh or an option is refused.
    Repairs are in `Model.report`.
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
        # A generator gives its numbers once.
        faces = list(tight_faces)
        if not faces:
            raise BuildError("tight_faces: at least one number is wanted")
        if None in faces:
            raise BuildError("tight_faces: whole numbers are wanted, not None")
        options["tight_faces"] = [whole(most, "tight_faces", BuildError) for most in faces]
    with Bar(progress) as on_progress:
        return Model(_meshsweep.build(given(mesh), options, on_progress))


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
