"""What the calls of intarsia return. Numbers are in the units of the mesh; arrays own their memory."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Optional, Tuple

import numpy as np

#: Names of the kinds of curves, by number.
ARC_KINDS = ("ridge", "valley", "sharp", "border", "extension", "subdivision", "given")


class Curves(NamedTuple):
    """The curves as segments, the way polyscope.register_curve_network takes them."""

    nodes: np.ndarray  #: (k, 3) points
    edges: np.ndarray  #: (s, 2) segments between points
    arc: np.ndarray    #: (s,) arc of each segment
    kind: np.ndarray   #: (s,) its kind


class Layout:
    """A patch layout.

    labels           (m,) patch of every input triangle: the one with most of it; -1 if it was left out
    vertices         (k, 3) of the layout mesh: a refinement of the input whose edges carry all curves; the input's
                     vertices come first
    triangles        (j, 3) of the layout mesh
    triangle_patch   (j,) and triangle_parent (j,): patch and input triangle of each
    nodes            (q, 3) where arcs meet or end; node_vertex (q,): vertices of the layout mesh
    arcs             structured array: kind start end left right length strength; left and right are patches, -1 outside
    edges            (a, 2) start and end node of every arc
    curve_kind       (a,) kind of every arc, see ARC_KINDS
    patches          structured array: triangles area perimeter compactness flatness loops filled_holes is_disc
    interior         features that separate nothing: (kind, (p, 3) points) each
    remarks          (code, stage, message, count) of everything that was mended or is worth knowing
    diagonal, hash   of the bounding box; of the layout's bits
    report           dict, as report.json of the program (docs/formats.md)
    """

    def __init__(self, value: dict) -> None:
        self.labels: np.ndarray = value["labels"]
        self.vertices: np.ndarray = value["vertices"]
        self.triangles: np.ndarray = value["triangles"]
        self.triangle_patch: np.ndarray = value["triangle_patch"]
        self.triangle_parent: np.ndarray = value["triangle_parent"]
        self._network: Dict[str, np.ndarray] = value["network"]
        self.nodes: np.ndarray = self._network["nodes"]
        self.node_vertex: np.ndarray = self._network["node_vertex"]
        names = ("kind", "start", "end", "left", "right", "length", "strength")
        self.arcs: np.ndarray = _records({name: self._network[name] for name in names})
        self.patches: np.ndarray = _records(
            {k: v.astype(bool) if k == "is_disc" else v for k, v in value["patches"].items()})
        self.interior: List[Tuple[int, np.ndarray]] = value["interior"]
        self.remarks: List[Tuple[str, str, str, int]] = value["remarks"]
        self.diagonal: float = value["diagonal"]
        self.hash: str = value["hash"]
        self.report: dict = json.loads(value["report"])

    @property
    def curve_kind(self) -> np.ndarray:
        return self.arcs["kind"]

    @property
    def edges(self) -> np.ndarray:
        return np.column_stack([self.arcs["start"], self.arcs["end"]])

    @property
    def valid(self) -> bool:
        """Whether every guarantee of the layout holds."""
        return bool(self.report["valid"])

    @property
    def shortened(self) -> bool:
        """Whether the time limit stopped the improvement."""
        return bool(self.report.get("time_limit", {}).get("shortened", False))

    def arc_vertices(self, arc: int) -> np.ndarray:
        """Vertices of the layout mesh along an arc, both ends included; a closed arc repeats its first."""
        offset = self._network["arc_offset"]
        return self._network["arc_vertex"][offset[arc]:offset[arc + 1]]

    def arc_points(self, arc: int) -> np.ndarray:
        """(p, 3) points along an arc."""
        return self.vertices[self.arc_vertices(arc)]

    def loops(self, patch: int) -> List[List[Tuple[int, bool]]]:
        """The border loops of a patch: (arc, whether it is walked from start to end) with the patch on the left."""
        n, found = self._network, []
        for loop in np.flatnonzero(n["loop_patch"] == patch):
            steps = slice(n["loop_offset"][loop], n["loop_offset"][loop + 1])
            found.append([(int(a), bool(f)) for a, f in zip(n["loop_arc"][steps], n["loop_is_forward"][steps])])
        return found

    @property
    def curves(self) -> Curves:
        """All arcs as segments between points."""
        vertex, offset = self._network["arc_vertex"], self._network["arc_offset"]
        inner = np.ones(len(vertex), dtype=bool)
        inner[offset[1:] - 1] = False  # the last vertex of an arc starts no segment
        begin = np.flatnonzero(inner)
        used, number = np.unique(vertex, return_inverse=True)
        arc = np.repeat(np.arange(len(self.arcs)), np.diff(offset) - 1)
        edges = np.column_stack([number[begin], number[begin + 1]]).reshape(-1, 2)
        return Curves(self.vertices[used], edges, arc, self.arcs["kind"][arc])

    def to_polyscope(self, name: str = "intarsia") -> None:
        """Registers the layout mesh with its patches, and the curves, with the package polyscope."""
        import polyscope as ps

        mesh = ps.register_surface_mesh(name, self.vertices, self.triangles)
        mesh.add_scalar_quantity("patch", self.triangle_patch, defined_on="faces", datatype="categorical")
        nodes, edges, arc, kind = self.curves
        lines = ps.register_curve_network(name + " curves", nodes, edges)
        lines.add_scalar_quantity("arc", arc, defined_on="edges")
        lines.add_scalar_quantity("kind", kind, defined_on="edges")

    def __repr__(self) -> str:
        return (f"<intarsia.Layout: {len(self.patches)} patches, {len(self.arcs)} arcs, {len(self.nodes)} nodes, "
                f"{len(self.labels)} triangles>")


def _records(columns: Dict[str, np.ndarray]) -> np.ndarray:
    count = len(next(iter(columns.values())))
    out = np.zeros(count, dtype=[(name, column.dtype) for name, column in columns.items()])
    for name, column in columns.items():
        out[name] = column
    return out


@dataclass(repr=False)
class Features:
    """Per-vertex fields in the input's order. Curvature is positive where the surface is convex."""

    normals: np.ndarray    #: (n, 3) unit
    variation: np.ndarray  #: (n, 6) surface variation of rings 1 to 6
    kmax: np.ndarray       #: (n,) principal curvatures, 1 / unit
    kmin: np.ndarray
    tmax: np.ndarray       #: (n, 3) their directions, unit, up to sign
    tmin: np.ndarray
    emax: np.ndarray       #: (n,) derivative of kmax along tmax, 1 / unit^2
    emin: np.ndarray
    scale: np.ndarray      #: (n,) ring chosen by the rule, 1 to 6
    fit_ring: np.ndarray   #: (n,) ring that was fitted; above 6 a disc on coarse samples
    status: np.ndarray     #: (n,) 0 full cubic, 1 ring grown, 2 quadratic only, 3 invalid (all zero)


@dataclass(repr=False)
class Distance:
    """Distances in the units of A; divide by `diagonal` for relative ones. forward: from A to B."""

    hausdorff: float  #: the larger of the two directions, as mean and rms
    mean: float
    rms: float
    diagonal: float
    forward: dict   #: max bound mean rms area samples worst worst_triangle
    backward: dict
    vertex_distance: np.ndarray  #: per vertex of A
    triangle_rms: np.ndarray     #: per triangle of A
    triangle_max: np.ndarray
    sample_point: np.ndarray     #: (s, 3); empty unless asked for
    sample_distance: np.ndarray
    sample_triangle: np.ndarray

    def __repr__(self) -> str:
        return f"<intarsia.Distance: hausdorff {self.hausdorff:.6g}, mean {self.mean:.6g}, rms {self.rms:.6g}>"


@dataclass(repr=False)
class Rebuilt:
    """A surface rebuilt from curves, and the distance between it and the input. forward: from the input to it."""

    vertices: np.ndarray        #: (k, 3)
    triangles: np.ndarray       #: (j, 3)
    triangle_patch: np.ndarray  #: (j,)
    hausdorff: float
    mean: float
    rms: float
    forward: dict
    backward: dict
    patch_rms: np.ndarray  #: per patch
    patch_max: np.ndarray
    failed: int            #: patches left out, or fallen back to the triangulation


@dataclass(repr=False)
class Evaluation:
    """How well curves alone describe the surface. None: not asked for."""

    triangulated: Optional[Rebuilt]  #: optimal triangulations of the borders
    transfinite: Optional[Rebuilt]   #: patches from the curves alone
    filled: Optional[Rebuilt]        #: smooth fills that also use the input's normals along the curves
    compactness: np.ndarray          #: per patch: perimeter^2 / (4 pi area)
    patches: int
    not_discs: int
    diagonal: float
    report: dict  #: as eval.json of the program (docs/formats.md)
