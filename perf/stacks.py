#!/usr/bin/env python3
"""Folds the output of `perf script -F ip,sym` and says what takes the time.

    perf script -i run.data -F ip,sym | perf/stacks.py OUT.folded [SAMPLES_PER_SECOND]

Writes stacks for flame graphs: outermost first, joined by ';', template arguments left out, and loop bodies called after
the function they stand in. Prints seconds by stage, divided into what runs inside parallel loops, what runs side by
side for patches only, and the serial rest (take the data with one thread: `run -t 1`), and the dearest functions.
"""
import collections
import functools
import re
import sys

STAGES = [
    ("read", "read_mesh"), ("surface", "mesh_to_surface|surface_to_sharp"), ("scale", "surface_to_scale"),
    ("curvature", "scale_to_curvature|curvature_to_lines"), ("ridges", "curvature_to_ridges"),
    ("curves", "ridges_to_curves"), ("network", "curves_to_network|curvature_to_directions"),
    ("patches", "network_to_patches"), ("layout", "patches_to_smoothing|smoothing_to_layout"),
    ("write", "write_result"), ("hash", "hash_of"),
]
PLUMBING = {"for_each_block", "for_each", "reduce", "sum", "in_parallel", "tbb", "detail", "execute", "operator",
            "start_for", "work_balance", "dynamic_grainsize_mode", "adaptive_mode", "blocked_range", "vector", "span", "allocator",
            "function", "Cost", "Work"}
LOOP = re.compile(r"start_for|work_balance|parallel_for|quick_sort|parallel_reduce")
BY_PATCH = re.compile(r"split_patches|cut_to_discs|seed_by_error")
NAME = re.compile(r"::([A-Za-z_]\w*)[<(]")


@functools.lru_cache(None)
def short(symbol):
    """A name to read: of a loop's body the function around it, of the rest all before the first '<' or '('."""
    symbol = re.sub(r"\+0x[0-9a-f]+$", "", symbol).replace("(anonymous namespace)::", "")
    if "for_each" in symbol or LOOP.search(symbol):
        for name in NAME.findall(symbol):
            if name not in PLUMBING:
                return name
        return "loop"
    return re.split(r"[<(]", symbol.replace("intarsia::", "").replace("kernels::", ""))[0] or symbol


@functools.lru_cache(None)
def stage_of_frame(frame):
    for name, pattern in STAGES:
        if re.search(r"intarsia::.*(%s)" % pattern, frame):
            return name
    return None


def stage_of(stack):
    return next(filter(None, map(stage_of_frame, reversed(stack))), "other")


@functools.lru_cache(None)
def loop_of(frame):
    if not LOOP.search(frame) or "flow" in frame or "invoke_node" in frame:
        return None
    return "by patch" if BY_PATCH.search(frame) else "parallel"


def kind_of(stack):
    loops = set(map(loop_of, stack)) - {None}
    return "serial" if not loops else "parallel" if "parallel" in loops else "by patch"


def stacks(lines):
    stack = []
    for line in lines:
        if line.strip():
            parts = line.split(None, 1)
            stack.append(parts[1].strip() if len(parts) > 1 else "?")
        elif stack:
            yield stack
            stack = []
    if stack:
        yield stack


def main():
    per_second = float(sys.argv[2]) if len(sys.argv) > 2 else 999.0
    folded, stages, functions = (collections.Counter() for _ in range(3))
    for stack in stacks(sys.stdin):
        names = [n for i, n in enumerate(map(short, stack)) if i == 0 or n != short(stack[i - 1])]
        folded[";".join(n.replace(";", ",") for n in reversed(names))] += 1
        stage = stage_of(stack)
        stages[stage, kind_of(stack)] += 1
        functions[stage, " < ".join(names[:2])] += 1
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        for stack, count in folded.items():
            print(stack, count, file=out)
    kinds = ["parallel", "by patch", "serial"]
    print("seconds    " + "".join("%10s" % k for k in kinds))
    for name in [n for n, _ in STAGES] + ["other"]:
        if any(stages[name, k] for k in kinds):
            print("%-10s " % name + "".join("%10.2f" % (stages[name, k] / per_second) for k in kinds))
    total = {k: sum(c for (_, kind), c in stages.items() if kind == k) / per_second for k in kinds}
    print("%-10s " % "all" + "".join("%10.2f" % total[k] for k in kinds))
    print()
    for (stage, name), count in functions.most_common(40):
        print("%7.2f s  %-10s %s" % (count / per_second, stage, name))


if __name__ == "__main__":
    main()
