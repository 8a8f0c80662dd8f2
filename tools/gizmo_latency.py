#!/usr/bin/env python3
"""Latency while objects are dragged with handles: milliseconds from a movement of the pointer to its first frame.

    tools/gizmo_latency.py [--etendue PROGRAM] [--drags N] [--size WxH] SCENE...

For each scene, the off-screen viewer selects the object in the middle of the image, shows the handles, and drags them back
and forth: along an axis, about it, and along it again as a scale. The state that the script writes has the percentiles of
all frames. The exit code is 1 if the 95th percentile of a scene exceeds 50 ms.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

BOUND = 50  # milliseconds, of the 95th percentile
MOVEMENTS = {"move": ("g", "gizmo.x", (40, 10)), "rotate": ("t", "gizmo.y", (25, 25)), "scale": ("s", "gizmo.x", (-20, 0))}


def script(drags, point, key, item, movement, state):
    x, y = movement
    steps = [{"do": "wait", "spp": 2}, {"do": "click", "image": point}, {"do": "key", "key": key},
             {"do": "wait", "spp": 2}, {"do": "state", "file": str(state.parent / "before.json")}]
    for i in range(drags):
        sign = 1 if i % 2 == 0 else -1
        steps.append({"do": "drag", "item": item, "by": [sign * x, sign * y]})
    return steps + [{"do": "wait", "seconds": 0.5}, {"do": "state", "file": str(state)}]


def measure(etendue, scene, drags, size, point, movement):
    with tempfile.TemporaryDirectory() as folder:
        state = pathlib.Path(folder) / "state.json"
        steps = pathlib.Path(folder) / "script.json"
        steps.write_text(json.dumps(script(drags, point, *movement, state)))
        subprocess.run([etendue, "view", scene, "--offscreen", "--size", size, "--script", str(steps)], check=True,
                       timeout=600)
        return json.loads(state.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--etendue", default="build/release/app/cli/etendue")
    parser.add_argument("--drags", type=int, default=12)
    parser.add_argument("--size", default="1280x720", help="of the window, in pixels")
    parser.add_argument("--point", default="0.5,0.5", help="of the image, at which the object is selected")
    a = parser.parse_args()
    point = [float(x) for x in a.point.split(",")]
    print(f"{'scene':<24} {'handles':<8} {'edits':>5} {'frames':>6} {'p50':>6} {'p95':>6} {'max':>6}  ms")
    missed = False
    for scene in a.scenes:
        for name, movement in MOVEMENTS.items():
            state = measure(a.etendue, scene, a.drags, a.size, point, movement)
            latency = state["latency_ms"]
            if state["undo_depth"] == 0:
                print(f"{pathlib.Path(scene).name:<24} {name:<8}  nothing was dragged; is there an object at {a.point}?")
                missed = True
                continue
            late = latency["p95"] > BOUND
            missed = missed or late
            print(f"{pathlib.Path(scene).name:<24} {name:<8} {state['undo_depth']:>5} {latency['count']:>6} "
                  f"{latency['p50']:>6.1f} {latency['p95']:>6.1f} {latency['max']:>6.1f}{'  MISSED' if late else ''}",
                  flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
