"""The Python module: known layouts, the program's own labels, threads, signals, errors."""

import os
import pickle
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import intarsia


def cube(n=8, size=1.0):
    """Unit cube, n squares along an edge, closed and oriented outward."""
    u, v = (x.ravel() for x in np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij"))
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    b, c, d = a + 1, a + n + 1, a + n + 2
    V, F = [], []
    for axis in range(3):
        for w in (0, n):
            first = len(V) * u.size
            V.append(np.roll(np.column_stack([u, v, np.full(u.size, w)]), axis, axis=1))
            for t in ((a, c, d), (a, d, b)) if w else ((a, d, c), (a, b, d)):
                F.append(first + np.column_stack(t))
    V, number = np.unique(np.vstack(V), axis=0, return_inverse=True)
    return V * (size / n), number[np.vstack(F)].reshape(-1, 3)


def sphere(n=24, radius=1.0):
    """A cube blown up to a sphere."""
    V, F = cube(n)
    V = V - 0.5
    return radius * V / np.linalg.norm(V, axis=1)[:, None], F


def test_a_cube_has_six_patches():
    V, F = cube()
    r = intarsia.layout(V, F)
    assert len(r.patches) == 6 and len(r.nodes) == 8 and len(r.arcs) == 12
    assert np.allclose(r.patches["area"], 1) and np.allclose(r.patches["perimeter"], 4)
    assert r.patches["is_disc"].all() and r.valid and not r.shortened
    assert r.labels.shape == (len(F),) and set(r.labels) == set(range(6))
    centre = V[F].mean(axis=1)
    side = np.where(np.isclose(centre, 0), -1, 0) + np.where(np.isclose(centre, 1), 1, 0)
    assert len({(label, *s) for label, s in zip(r.labels, side)}) == 6
    assert [intarsia.ARC_KINDS[k] for k in np.unique(r.curve_kind)] == ["sharp"]
    assert np.allclose(r.arcs["length"], 1)
    assert r.report["counts"]["patches"] == 6 and r.report["hash"] == r.hash
    assert np.array_equal(r.vertices[:len(V)], V)


def test_curves_are_what_polyscope_takes():
    r = intarsia.layout(*cube())
    nodes, edges, arc, kind = r.curves
    length = np.linalg.norm(nodes[edges[:, 1]] - nodes[edges[:, 0]], axis=1)
    assert length.sum() == pytest.approx(12)
    assert np.allclose(np.bincount(arc, weights=length), r.arcs["length"])
    assert len(kind) == len(edges)
    for a in range(len(r.arcs)):
        points = r.arc_points(a)
        assert np.allclose(points[0], r.nodes[r.edges[a, 0]]) and np.allclose(points[-1], r.nodes[r.edges[a, 1]])
    for patch in range(6):
        (loop,) = r.loops(patch)
        assert len(loop) == 4
        for arc, forward in loop:
            assert r.arcs["left" if forward else "right"][arc] == patch


def test_labels_are_those_of_the_program(tmp_path):
    program = os.environ.get("INTARSIA_PROGRAM")
    if not program:
        pytest.skip("INTARSIA_PROGRAM is not set")
    mesh, out = tmp_path / "part.ply", tmp_path / "out"
    V, F = sphere(16)
    V[:, 2] = np.where(V[:, 2] > 0.5, 0.5, V[:, 2])  # cut flat: a sharp circle
    with open(mesh, "w") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(V)}\n")
        file.writelines(f"property double {axis}\n" for axis in "xyz")
        file.write(f"element face {len(F)}\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines(f"{float(x)!r} {float(y)!r} {float(z)!r}\n" for x, y, z in V)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in F)
    subprocess.run([program, "run", mesh, "-o", out, "--patches", "5", "--write", "npy", "-q"], check=True)
    r = intarsia.layout(V, F, patches=5)
    assert np.array_equal(np.load(out / "labels.npy"), r.labels)
    assert len(np.unique(r.labels)) == len(r.patches) > 1


def test_threads_and_integer_types_change_no_bit():
    V, F = cube(10)
    runs = [intarsia.layout(V, F.astype(kind), patches=9, threads=threads)
            for kind, threads in ((np.int32, 1), (np.int32, 2), (np.int64, 2), (np.uint32, 3))]
    for r in runs[1:]:
        assert r.hash == runs[0].hash
        assert np.array_equal(r.labels, runs[0].labels) and np.array_equal(r.vertices, runs[0].vertices)


def test_lists_float32_and_other_memory_orders_are_taken():
    V, F = cube(4)
    first = intarsia.layout(V, F)
    assert intarsia.layout(V.tolist(), F.tolist()).hash == first.hash
    assert intarsia.layout(np.asfortranarray(V), np.asfortranarray(F)).hash == first.hash
    assert intarsia.layout(V.astype(np.float32), F).hash == first.hash


def test_features_of_a_sphere():
    V, F = sphere(24, radius=2)
    f = intarsia.features(V, F)
    assert np.allclose(f.kmax, 0.5, rtol=0.05) and np.allclose(f.kmin, 0.5, rtol=0.05)
    assert np.allclose(f.normals, V / 2, atol=0.02)
    assert f.variation.shape == (len(V), 6) and f.tmax.shape == (len(V), 3)
    assert f.scale.min() >= 1 and (f.status < 3).all()


def test_distance_of_two_spheres():
    (VA, F), (VB, _) = sphere(40, 1.0), sphere(40, 1.25)
    d = intarsia.distance(VA, F, VB, F, samples=20000, keep_samples=True)
    assert d.hausdorff == pytest.approx(0.25, rel=0.02) and d.mean == pytest.approx(0.25, rel=0.02)
    assert d.vertex_distance.shape == (len(VA),)
    assert d.sample_point.shape == (d.forward["samples"], 3)
    assert np.allclose(np.linalg.norm(d.sample_point, axis=1), 1, atol=0.01)


def test_evaluation_of_a_cube():
    V, F = cube(6, size=10)
    r = intarsia.layout(V, F)
    e = intarsia.evaluate(V, F, r, samples=20000)
    for rebuilt in (e.triangulated, e.transfinite, e.filled):
        assert rebuilt.hausdorff < 1e-6
    assert e.patches == 6 and e.report["patches"] == 6
    assert np.allclose(e.compactness, 4 / np.pi)
    labelled = intarsia.evaluate(V, F, r.labels, samples=20000, filled=False)
    assert labelled.filled is None and labelled.triangulated.hausdorff < 1e-6
    again = pickle.loads(pickle.dumps(r))
    assert intarsia.evaluate(V, F, again, samples=20000).report == e.report


def test_progress_comes_in_the_calling_thread_and_grows():
    seen = []
    intarsia.layout(*sphere(40), progress=lambda stage, fraction: seen.append((threading.get_ident(), stage, fraction)))
    assert {ident for ident, _, _ in seen} == {threading.get_ident()}
    fractions = [fraction for _, _, fraction in seen]
    assert fractions == sorted(fractions) and fractions[-1] == 1


def test_progress_can_cancel():
    with pytest.raises(intarsia.Cancelled):
        intarsia.layout(*sphere(40), progress=lambda stage, fraction: False)


def test_exceptions_of_the_progress_function_come_through():
    def angry(stage, fraction):
        raise LookupError(stage)
    with pytest.raises(LookupError):
        intarsia.layout(*sphere(40), progress=angry)


def test_ctrl_c_ends_a_long_call_soon():
    V, F = sphere(150)
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(100):
            intarsia.layout(V, F)
    assert time.monotonic() - start < 5  # one call alone takes seconds, a hundred minutes


def test_other_threads_go_on_during_a_call():
    count, stop = [0], threading.Event()

    def work():
        while not stop.is_set():
            count[0] += 1
            time.sleep(0.001)
    thread = threading.Thread(target=work)
    thread.start()
    before = count[0]
    intarsia.layout(*sphere(40))
    advanced = count[0] - before
    stop.set()
    thread.join()
    assert advanced > 10


def test_two_calls_at_once():
    V, F = cube(6)
    alone, found = intarsia.layout(V, F).hash, []
    threads = [threading.Thread(target=lambda: found.append(intarsia.layout(V, F).hash)) for _ in range(2)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert found == [alone, alone]


@pytest.mark.parametrize("V, F", [
    (np.zeros((4, 2)), np.zeros((1, 3), int)),
    (np.zeros((4, 3)), np.zeros((1, 4), int)),
    (np.zeros((4, 3)), np.zeros((1, 3))),
    (np.zeros((4, 3), dtype="U1"), np.zeros((1, 3), int)),
    (np.zeros(12), np.zeros((1, 3), int)),
])
def test_arrays_of_wrong_shape_or_type(V, F):
    with pytest.raises(ValueError):
        intarsia.layout(V, F)


def test_meshes_that_are_refused():
    V, F = cube(4)
    F[9, 1] = len(V)
    with pytest.raises(intarsia.RejectedMesh) as caught:
        intarsia.layout(V, F)
    assert caught.value.element == 9
    with pytest.raises(ValueError):
        intarsia.layout(np.empty((0, 3)), np.empty((0, 3), int))
    V, F = cube(4)
    V[5, 2] = np.nan
    with pytest.raises(intarsia.RejectedMesh):
        intarsia.layout(V, F)


def test_options():
    V, F = cube(4)
    with pytest.raises(ValueError, match="smooth.iterations"):
        intarsia.layout(V, F, options={"smooth.iteration": 3})
    with pytest.raises(ValueError):
        intarsia.layout(V, F, options={"smooth.iterations": -1})
    with pytest.raises(ValueError):
        intarsia.layout(V, F, mode="quick")
    with pytest.raises(ValueError):
        intarsia.layout(V, F, patches=-1)
    with pytest.raises(MemoryError):
        intarsia.layout(V, F, max_memory=1000)
    with pytest.raises(TimeoutError):
        intarsia.layout(V, F, time_limit=1e-9)
    with pytest.raises(TimeoutError):
        intarsia.features(V, F, time_limit=1e-9)
    r = intarsia.layout(V, F, options={"smooth.iterations": 2}, min_feature=0.001)
    assert r.report["options"]["smooth.iterations"] == {"given": True, "value": 2}
    known = intarsia.method_options()
    assert known["smooth.iterations"]["whole"] and all(o["help"] for o in known.values())


def test_mending_is_told():
    V, F = cube(6)
    F[3] = F[3, ::-1]
    r = intarsia.layout(V, F)
    assert len(r.patches) == 6 and r.remarks
    with pytest.raises(intarsia.RejectedMesh):
        intarsia.layout(V, F, strict=True)


def test_curves_and_pins_are_kept():
    V, F = cube(8)
    x = np.linspace(0, 1, 9)
    across = np.column_stack([x, np.full(9, 0.5), np.ones(9)])  # halves the top
    r = intarsia.layout(V, F, curves=[across])
    assert len(r.patches) == 7
    assert r.arcs["length"][r.curve_kind == intarsia.ARC_KINDS.index("given")].sum() == pytest.approx(1)
    pins = np.where((V[F].mean(axis=1)[:, 2] > 1 - 1e-9) & (V[F].mean(axis=1)[:, 0] < 0.5), 3, -1)
    pinned = intarsia.layout(V, F, pins=pins)
    assert len(set(pinned.labels[pins == 3])) == 1
    assert set(pinned.labels[pins == 3]).isdisjoint(pinned.labels[pins != 3])
    with pytest.raises(ValueError):
        intarsia.layout(V, F, pins=pins[1:])
    with pytest.raises(ValueError):
        intarsia.layout(V, F, curves=[across[:1]])


def test_a_tolerance_instead_of_a_number():
    V, F = cube(8)
    r = intarsia.layout(V, F, tolerance="1%")
    assert r.report["tolerance"]["rms_relative"] <= 0.01
    with pytest.raises(ValueError):
        intarsia.layout(V, F, patches=6, tolerance="1%")
