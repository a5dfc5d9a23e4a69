#!/usr/bin/env python3
# %% [markdown]
# # Patches of a part, from NumPy
# Run it as it is, or cell by cell in an editor that knows `# %%`. It needs matplotlib.
# Usage: example.py [PICTURE.png] [PATCHES]

# %% A part, made here so that no file is needed.
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

import intarsia


def part(n=56):
    """A box with rounded vertical edges and a round boss: a cube of n x n squares a side, moved onto the shape."""
    t = np.linspace(-1, 1, n + 1)
    u, v = np.meshgrid(t, t, indexing="ij")
    points, triangles = [], []
    for axis in range(3):
        for w in (-1.0, 1.0):
            side = np.roll(np.column_stack([u.ravel(), v.ravel(), np.full(u.size, w)]), axis, axis=1)
            a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel() + len(points) * u.size
            b, c, d = a + 1, a + n + 1, a + n + 2
            quads = (a, c, d, b) if w > 0 else (a, b, d, c)
            triangles += [np.column_stack([quads[0], quads[1], quads[2]]),
                          np.column_stack([quads[0], quads[2], quads[3]])]
            points.append(side)
    V, F = np.vstack(points), np.vstack(triangles)
    square = np.maximum(np.abs(V[:, 0]), np.abs(V[:, 1]))
    power = (np.abs(V[:, 0]) ** 5 + np.abs(V[:, 1]) ** 5) ** 0.2
    V[:, :2] *= np.where(power > 0, square / np.maximum(power, 1e-12), 1)[:, None]
    top = V[:, 2] > 1 - 1e-9
    V[:, 2] = np.where(top, 1 + 0.5 * np.clip((0.62 - np.hypot(V[:, 0], V[:, 1])) / 0.18, 0, 1), V[:, 2])
    return V * [1.3, 0.9, 0.5], F


V, F = part()

# %% Patches, with a line of progress; Ctrl-C works.
patches = int(sys.argv[2]) if len(sys.argv) > 2 else None


def show(stage, fraction):
    print(f"\r{stage:<12}{100 * fraction:4.0f} %", end="", file=sys.stderr)


r = intarsia.layout(V, F, patches=patches, progress=show)
print(file=sys.stderr)
print(r)
for code, stage, message, count in r.remarks:
    print(f"  {message}")

# %% Curvature, and how well the curves alone describe the part.
f = intarsia.features(V, F)
e = intarsia.evaluate(V, F, r, samples=100_000, transfinite=False)
d = intarsia.distance(V, F, e.filled.vertices, e.filled.triangles, samples=100_000)
print(f"rebuilt from {len(r.arcs)} arcs: RMS {100 * e.filled.rms / e.diagonal:.3f} % of the diagonal, "
      f"largest {100 * e.filled.hausdorff / e.diagonal:.3f} %")


# %% The picture.
def draw(axes, V, F, colour, title):
    normal = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    light = 0.55 + 0.45 * np.clip(normal @ (np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])), 0, 1)
    colour = np.column_stack([colour[:, :3] * light[:, None], np.ones(len(F))])
    axes.add_collection3d(Poly3DCollection(V[F], facecolors=colour, edgecolors=colour, linewidths=0.2))
    axes.set_xlim(-1.3, 1.3), axes.set_ylim(-1.3, 1.3), axes.set_zlim(-0.7, 0.9)
    axes.set_box_aspect((2.6, 2.6, 1.6), zoom=1.35)
    axes.view_init(32, -58), axes.set_axis_off(), axes.set_title(title)


def colours(values, name, low, high):
    return matplotlib.colormaps[name](np.clip((values - low) / (high - low), 0, 1))


figure = plt.figure(figsize=(12, 3.4))
axes = [figure.add_subplot(1, 3, i + 1, projection="3d") for i in range(3)]
draw(axes[0], r.vertices, r.triangles, matplotlib.colormaps["tab20"](r.triangle_patch % 20),
     f"{len(r.patches)} patches")
# Lines that face the viewer, lifted towards it: matplotlib does not know what hides what.
toward = np.array([0.45, -0.72, 0.53])
normals = np.zeros_like(r.vertices)
for corner in range(3):
    a, b, c = (r.vertices[r.triangles[:, (corner + i) % 3]] for i in range(3))
    np.add.at(normals, r.triangles[:, corner], np.cross(b - a, c - a))
segments = []
for arc in range(len(r.arcs)):
    v = r.arc_vertices(arc)
    seen = (normals[v[:-1]] + normals[v[1:]]) @ toward > 0
    points = r.vertices[v] + 0.02 * toward
    segments.append(np.stack([points[:-1], points[1:]], axis=1)[seen])
axes[0].computed_zorder = False
axes[0].add_collection3d(Line3DCollection(np.vstack(segments), colors="black", linewidths=1.2, zorder=2))
k = np.abs(np.where(np.abs(f.kmax) > np.abs(f.kmin), f.kmax, f.kmin))[F].mean(axis=1)
draw(axes[1], V, F, colours(k, "magma", 0, np.quantile(k, 0.98)), "largest curvature")
draw(axes[2], V, F, colours(d.triangle_rms, "viridis", 0, d.triangle_rms.max()), "distance of the rebuilt surface")
figure.subplots_adjust(0, 0, 1, 0.92, 0, 0)
picture = sys.argv[1] if len(sys.argv) > 1 else "intarsia.png"
figure.savefig(picture, dpi=110)
print("drawn:", picture)
