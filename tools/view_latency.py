#!/usr/bin/env python3
"""Latency of edits in the viewer with several ranks: milliseconds from an edit to its first frame.

    tools/view_latency.py [--etendue PROGRAM] [--ranks 1,2,4] [--edits N] [--size WxH] [SCENE...]

For each scene and number of ranks, `mpirun -n RANKS etendue view --offscreen --script` edits the document at intervals
that vary from 0.2 to 1.7 s: the camera, a material, and the camera again. The state that the script writes has the
percentiles. The table also has the share of the samples that other ranks have rendered at the end. The exit code is 1
if the 95th percentile of a run exceeds 100 ms.
"""
import argparse
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

BOUND = 100  # milliseconds, of the 95th percentile


def script(edits, state):
    """Steps: the image of the first document settles, then edits follow, at times that do not match any cycle."""
    chance = random.Random(1)
    steps = [{"do": "wait", "spp": 4}, {"do": "state", "file": str(state.parent / "before.json")}]
    for i in range(edits):
        steps.append({"do": "wait", "seconds": round(chance.uniform(0.2, 1.7), 3)})
        name, value = (("material.0.roughness", 0.2 + 0.6 * (i % 7) / 7) if i % 3 == 1
                       else ("camera.yfov", 0.6 + 0.01 * (i % 13)))
        steps.append({"do": "set", "name": name, "value": round(value, 4)})
    return steps + [{"do": "wait", "seconds": 1}, {"do": "state", "file": str(state)}]


def measure(etendue, scene, ranks, edits, size):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none")
    with tempfile.TemporaryDirectory() as folder:
        state = pathlib.Path(folder) / "state.json"
        steps = pathlib.Path(folder) / "script.json"
        steps.write_text(json.dumps(script(edits, state)))
        command = [etendue, "view", scene, "--offscreen", "--size", size, "--script", str(steps)]
        if ranks > 1:
            command = ["mpirun", "-n", str(ranks)] + command
        subprocess.run(command, env=environment, check=True, timeout=600)
        return json.loads(state.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="*", default=["cornell"])
    parser.add_argument("--etendue", default="build/release/app/cli/etendue")
    parser.add_argument("--ranks", default="1,2,4")
    parser.add_argument("--edits", type=int, default=60)
    parser.add_argument("--size", default="1280x720", help="of the window, in pixels")
    a = parser.parse_args()
    print(f"{'scene':<24} {'ranks':>5} {'edits':>5} {'p50':>6} {'p95':>6} {'max':>6}  ms; from other ranks")
    missed = False
    for scene in a.scenes:
        for ranks in [int(n) for n in a.ranks.split(",")]:
            state = measure(a.etendue, scene, ranks, a.edits, a.size)
            latency, shared = state["latency_ms"], state["ranks"]
            total = shared["own_samples"] + shared["other_samples"] if shared else 0
            share = f"{100 * shared['other_samples'] / total:.0f} %" if total else "-"
            late = latency["p95"] > BOUND
            missed = missed or late
            print(f"{pathlib.Path(scene).name:<24} {ranks:>5} {latency['count']:>5} {latency['p50']:>6.1f} "
                  f"{latency['p95']:>6.1f} {latency['max']:>6.1f}  {share}{'  MISSED' if late else ''}", flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
