#!/usr/bin/env python3
"""A result in every form of --write, read by other programs: NumPy, VTK, Assimp, CGAL, each where it is installed.

usage: readers_test.py PROGRAM      with a Python that has NumPy and VTK, if any has
All have to see the same triangles, patches, arcs and lengths as network.json and labels.seg say.
"""
import collections
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
CGAL_HEADER = "/usr/include/CGAL/Surface_mesh/IO/PLY.h"


class Result:
    """What the program itself says of its result."""

    def __init__(self, folder):
        self.folder = folder
        with open(self.path("network.json"), encoding="utf-8") as file:
            self.network = json.load(file)
        with open(self.path("labels.seg"), encoding="ascii") as file:
            self.labels = [int(line) for line in file]
        with open(self.path("report.json"), encoding="utf-8") as file:
            self.report = json.load(file)
        self.patches = len(self.network["patches"])
        self.arcs = self.network["arcs"]
        self.lengths = sorted(a["length"] for a in self.arcs)
        self.points = sum(len(a["vertices"]) for a in self.arcs)

    def path(self, name):
        return os.path.join(self.folder, name)


def near(a, b, relative=1e-5):
    return len(a) == len(b) and all(math.isclose(x, y, rel_tol=relative) for x, y in zip(a, b))


def read_with_numpy(r):
    import numpy as np
    assert np.load(r.path("labels.npy")).tolist() == r.labels
    assert np.loadtxt(r.path("labels.seg"), dtype=int).tolist() == r.labels
    table = np.genfromtxt(r.path("patches.csv"), delimiter=",", names=True, usecols=range(3))
    counts = collections.Counter(r.labels)
    assert len(table) == r.patches and sum(abs(table["triangles"] - [counts[p] for p in range(r.patches)])) == 0


def read_with_vtk(r):
    from vtkmodules.vtkIOGeometry import vtkOBJReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    def read(reader, name):
        reader = reader()
        reader.SetFileName(r.path(name))
        reader.Update()
        return reader.GetOutput()

    def length_of(cell):
        points = [cell.GetPoints().GetPoint(i) for i in range(cell.GetNumberOfPoints())]
        return sum(math.dist(a, b) for a, b in zip(points, points[1:]))

    patches = read(vtkXMLPolyDataReader, "patches.vtp")
    ids = patches.GetCellData().GetArray("patch_id")
    assert [ids.GetValue(i) for i in range(patches.GetNumberOfPolys())] == r.labels
    network = read(vtkXMLPolyDataReader, "network.vtp")
    assert network.GetNumberOfLines() == len(r.arcs)
    for name in ("kind", "left", "right", "length"):
        column = network.GetCellData().GetArray(name)
        said = [-1 if a[name] is None else a[name] for a in r.arcs]
        assert near([column.GetTuple1(i) for i in range(len(r.arcs))], said), name
    assert near(sorted(length_of(network.GetCell(i)) for i in range(len(r.arcs))), r.lengths)
    features = read(vtkXMLPolyDataReader, "features.vtp")
    chosen = features.GetCellData().GetArray("chosen")
    assert 0 < sum(chosen.GetValue(i) for i in range(features.GetNumberOfLines())) < features.GetNumberOfLines()
    assert near(features.GetBounds(), network.GetBounds(), 0.2)
    coloured = read(vtkPLYReader, "patches.ply")  # knows no integers of faces, but their colours
    rgb = coloured.GetCellData().GetArray("RGB")
    by_patch = collections.defaultdict(set)
    for i, p in enumerate(r.labels):
        by_patch[p].add(rgb.GetTuple3(i))
    assert len(by_patch) == r.patches and all(len(colours) == 1 for colours in by_patch.values())
    lines = read(vtkOBJReader, "network.obj")
    assert lines.GetNumberOfLines() == len(r.arcs)
    assert near(sorted(length_of(lines.GetCell(i)) for i in range(len(r.arcs))), r.lengths)
    assert read(vtkOBJReader, "quadwild/layout.obj").GetNumberOfPolys() == read(vtkPLYReader, "layout.ply").GetNumberOfPolys()


def read_with_assimp(r):
    kinds = len({a["kind"] for a in r.arcs})
    refined = sum(1 for _ in open(r.path("quadwild/layout.patch"), encoding="ascii")) - 1
    segments = r.points - len(r.arcs)
    for name, meshes, faces in (("layout.glb", r.patches + kinds, refined + segments),
                                ("patches.obj", r.patches, len(r.labels))):
        out = subprocess.run(["assimp", "info", r.path(name)], capture_output=True, text=True, check=True).stdout
        seen = {key: int(re.search(rf"^{key}: +(\d+)", out, re.MULTILINE).group(1)) for key in ("Meshes", "Faces")}
        assert seen == {"Meshes": meshes, "Faces": faces}, (name, seen, meshes, faces)


def read_with_cgal(r):
    program = r.path("cgal_reads")
    subprocess.run(["g++", "-std=c++17", "-w", "-o", program, os.path.join(HERE, "cgal_reads.cpp"), "-lgmp"], check=True)
    seen = subprocess.run([program, r.path("patches.ply"), r.path("network.polylines.txt")], capture_output=True, text=True,
                          check=True).stdout.split()
    assert [int(x) for x in seen[1:3]] == [len(r.labels), len(r.arcs)], seen[:3]
    assert [int(x) for x in seen[3:]] == r.labels


def has_module(name):
    try:
        __import__(name)
        return True
    except ImportError:
        return False


def main():
    program = os.path.abspath(sys.argv[1])
    readers = [("NumPy (python3-numpy)", read_with_numpy, has_module("numpy")),
               ("VTK (python3-vtk9)", read_with_vtk, has_module("vtkmodules.vtkIOXML")),
               ("Assimp (assimp-utils)", read_with_assimp, bool(shutil.which("assimp"))),
               ("CGAL (libcgal-dev)", read_with_cgal, os.path.exists(CGAL_HEADER) and bool(shutil.which("g++")))]
    with tempfile.TemporaryDirectory(prefix="intarsia-readers-") as folder:
        mesh, out = os.path.join(folder, "part.ply"), os.path.join(folder, "out")
        for command in (["make", "part", "--triangles", "6000", "-o", mesh, "-q"],
                        ["run", mesh, "-o", out, "-n", "20", "-q", "--write", "all"]):
            subprocess.run([program, *command], check=True)
        result = Result(out)
        assert sorted(set(result.labels)) == list(range(result.patches)) and result.patches == 20
        for name, read, there in readers:
            if there:
                read(result)
            print(f"{name}: {'reads the same' if there else 'skipped, not installed'}")
    return 0 if any(there for _, _, there in readers) else 77


if __name__ == "__main__":
    sys.exit(main())
