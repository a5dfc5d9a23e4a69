#!/usr/bin/env python3
"""Forty good and bad meshes in two shards; one shard is killed on its way; resumed, everything is there and right.

usage: forty_meshes_test.py PROGRAM
"""
import csv
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

GOOD, BAD = 32, 8
DAMAGE = ["", "ply\nformat ascii 1.0\n", "solid x\nfacet\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"]


def check(what, condition):
    print("ok  " if condition else "FAIL", what)
    if not condition:
        sys.exit(1)


def make_meshes(program, folder):
    os.makedirs(folder)
    shapes = ["cube", "sphere", "rounded-box", "cylinder"]
    for i in range(GOOD):
        subprocess.run([program, "make", shapes[i % len(shapes)], "--triangles", str(600 + 40 * i), "--seed",
                        str(i + 1), "-o", f"{folder}/scan-{i:02}.ply", "-q"], check=True)
    endings = ["ply", "ply", "stl", "off"]
    for i in range(BAD):
        with open(f"{folder}/bad-{i}.{endings[i % 4]}", "w", encoding="ascii") as file:
            file.write(DAMAGE[i % 4])


def batch(program, scans, results, *options):
    return [program, "batch", scans, "-o", results, "-q", *options, "--", "--write", "none"]


def records(results):
    folder = os.path.join(results, ".batch")
    return [n for n in os.listdir(folder) if n.endswith(".json")] if os.path.isdir(folder) else []


def summary_of(results):
    with open(os.path.join(results, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        scans, results, fresh = (os.path.join(folder, n) for n in ("scans", "results", "fresh"))
        make_meshes(program, scans)
        first = subprocess.Popen(batch(program, scans, results, "--shard", "1/2"), start_new_session=True)
        while len(records(results)) < 5 and first.poll() is None:
            time.sleep(0.01)
        os.killpg(first.pid, signal.SIGKILL)
        first.wait()
        done_before = len(records(results))
        check("the first shard was killed on its way", 5 <= done_before < 20)
        second = subprocess.run(batch(program, scans, results, "--shard", "2/2"), check=False)
        check("the second shard says that some failed", second.returncode == 8)
        counts = summary_of(results)["counts"]
        check("the summary knows what was not run yet", counts["missing"] > 0)
        again = subprocess.run(batch(program, scans, results, "--shard", "1/2", "--resume"), check=False)
        check("the first shard, resumed, says so too", again.returncode == 8)
        summary = summary_of(results)
        counts = summary["counts"]
        check("forty meshes: none missing", counts["missing"] == 0 and len(summary["meshes"]) == GOOD + BAD)
        check("the good ones are done", counts["done"] + counts["degraded"] == GOOD)
        check("the bad ones failed", counts["failed"] == BAD)
        check("failed.txt lists them",
              sorted(os.path.basename(p) for p in open(f"{results}/failed.txt", encoding="utf-8").read().split()) ==
              sorted(n for n in os.listdir(scans) if n.startswith("bad-")))
        with open(f"{results}/summary.csv", newline="", encoding="utf-8") as file:
            check("summary.csv has a row for each", len(list(csv.DictReader(file))) == GOOD + BAD)
        page = open(f"{results}/summary.html", encoding="utf-8").read()
        check("summary.html names each", all(m["name"] in page for m in summary["meshes"]))
        subprocess.run(batch(program, scans, fresh), check=False)
        hashes = {m["name"]: m["hash"] for m in summary["meshes"]}
        check("the same results as in one go", hashes == {m["name"]: m["hash"] for m in summary_of(fresh)["meshes"]})


if __name__ == "__main__":
    main()
