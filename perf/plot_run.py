#!/usr/bin/env python3
"""Pictures of what runs cost, from their reports.

    perf/plot_run.py PICTURE.png REPORT.json...

Left: CPU seconds of each stage per million vertices, one bar for each report. Right: seconds over vertices where the
reports differ in size, else speed-up over threads.
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLOURS = ["#4e79a7", "#f28e2b", "#e15759", "#76b7b2", "#59a14f", "#edc948", "#b07aa1", "#ff9da7", "#9c755f", "#bab0ac"]


def read(path):
    r = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    return {"name": pathlib.Path(r["input"]["path"]).stem, "vertices": r["input"]["vertices"], "threads": r["threads"],
            "seconds": r["seconds"], "memory": r["peak_memory_bytes"],
            "stages": {s["name"]: s["cpu_seconds"] for s in r["stages"]}}


def draw_stages(axis, runs):
    names = list(dict.fromkeys(stage for run in runs for stage in run["stages"]))
    labels = [f"{run['name']}\n{run['vertices'] / 1e3:.0f} k\n{run['threads']} thr." for run in runs]
    bottom = [0.0] * len(runs)
    for i, name in enumerate(names):
        height = [run["stages"].get(name, 0) * 1e6 / run["vertices"] for run in runs]
        axis.bar(range(len(runs)), height, bottom=bottom, label=name, color=COLOURS[i % len(COLOURS)], width=0.7)
        bottom = [b + h for b, h in zip(bottom, height)]
    axis.set_xticks(range(len(runs)), labels)
    axis.set_ylabel("CPU seconds per million vertices")
    handles, texts = axis.get_legend_handles_labels()
    axis.legend(handles[::-1], texts[::-1], frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))


def draw_scaling(axis, runs):
    if len({run["vertices"] for run in runs}) > 1:
        for threads in sorted({run["threads"] for run in runs}):
            line = sorted((r["vertices"], r["seconds"]) for r in runs if r["threads"] == threads)
            axis.loglog(*zip(*line), "o-", label=f"{threads} threads")
        least, most = min(r["vertices"] for r in runs), max(r["vertices"] for r in runs)
        rate = min(r["seconds"] / r["vertices"] for r in runs)
        axis.loglog([least, most], [rate * least, rate * most], "--", color="0.6", label="linear")
        axis.set_xlabel("vertices")
        axis.set_ylabel("seconds of the whole run")
    else:
        line = sorted((r["threads"], r["seconds"]) for r in runs)
        first = line[0][0] * line[0][1]
        axis.plot([t for t, _ in line], [first / s for _, s in line], "o-", label="measured")
        axis.plot([t for t, _ in line], [t for t, _ in line], "--", color="0.6", label="ideal")
        axis.set_xlabel("threads")
        axis.set_ylabel("speed-up")
    axis.grid(True, which="both", color="0.92")
    axis.legend(frameon=False)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    runs = sorted((read(path) for path in sys.argv[2:]), key=lambda r: (r["vertices"], r["threads"]))
    figure, axes = plt.subplots(1, 2, figsize=(6 + 0.9 * len(runs) + 5, 4.6), width_ratios=[2 + 0.9 * len(runs), 4.5])
    draw_stages(axes[0], runs)
    draw_scaling(axes[1], runs)
    for axis in axes:
        axis.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=110)


if __name__ == "__main__":
    main()
