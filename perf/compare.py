#!/usr/bin/env python3
"""Says what got slower: ratios of medians, benchmark by benchmark.

    perf/compare.py BASE.json HEAD.json                  two outputs of intarsia_bench --benchmark_format=json
    perf/compare.py BASE_BENCH HEAD_BENCH [-r 5] [-- ..]  two programs, run in turn; what follows -- goes to both
    ... [--limit 1.05]                                   exit status 1 if a ratio is above the limit

The two programs take turns, so that a busy machine slows both; CPU time is compared, not the clock.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys


def add_times(report, times):
    for b in report["benchmarks"]:
        if b.get("run_type") == "aggregate" or b.get("error_occurred"):
            continue
        unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}[b["time_unit"]]
        times.setdefault(b.get("run_name", b["name"]), []).append(b["cpu_time"] * unit)


def run(program, extra):
    done = subprocess.run([program, "--benchmark_format=json", *extra], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{program} failed: {done.stderr.strip()}")
    return json.loads(done.stdout)


def measure(arguments):
    times = ({}, {})
    sides = (arguments.base, arguments.head)
    if all(os.access(s, os.X_OK) and not s.endswith(".json") for s in sides):
        for turn in range(arguments.rounds):
            for side in ((0, 1), (1, 0))[turn % 2]:
                add_times(run(sides[side], arguments.extra), times[side])
    else:
        for side, path in enumerate(sides):
            with open(path, encoding="utf-8") as f:
                add_times(json.load(f), times[side])
    return times


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base")
    parser.add_argument("head")
    parser.add_argument("-r", "--rounds", type=int, default=5)
    parser.add_argument("--limit", type=float, default=1.05)
    own, extra = sys.argv[1:], []
    if "--" in own:
        at = own.index("--")
        own, extra = own[:at], own[at + 1:]
    arguments = parser.parse_args(own)
    arguments.extra = extra
    base, head = measure(arguments)
    slower = []
    print(f"{'benchmark':32} {'base ms':>10} {'head ms':>10} {'head/base':>10}")
    for name in sorted(base.keys() & head.keys()):
        b, h = statistics.median(base[name]), statistics.median(head[name])
        ratio = h / b if b > 0 else float("inf")
        print(f"{name:32} {1e3 * b:10.3f} {1e3 * h:10.3f} {ratio:10.3f}{'  slower' if ratio > arguments.limit else ''}")
        if ratio > arguments.limit:
            slower.append(name)
    for name in sorted(base.keys() ^ head.keys()):
        print(f"{name:32} only in {'base' if name in base else 'head'}")
    if not base.keys() & head.keys():
        sys.exit("no benchmark in both")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
