#!/usr/bin/env python3
"""Compares integrators after equal time on built-in scenes, by one interleaved run of `etendue bench` per scene.

    method_table.py [--scenes A,B,...] [--methods path,bdpt,...] [--budget 4] [--repeats 2] [--size 128x96]
                    [--reference-time 60] [--keep FOLDER]

The table has relMSE relative to that of the first method: the median over the repeats, after BUDGET seconds with the time
for choices and photon passes. Values below 1 are better; the best is bold. A dash is a method that does not support the
scene, or whose error is below the noise of the reference. `!` follows the name of a scene whose reference is too noisy for its smallest errors. With --keep, FOLDER/SCENE has
the report of each scene with its chart.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

SCENES = "cornell,cornell-spheres,glossy-plates,glass-caustic,caustic-pool,spot-indirect,door-ajar,many-lights,fog"
METHODS = "path,path-guided,path-manifold,bdpt,vcm,sppm,pssmlt,mlt,auto"


def measure(scene, options, folder):
    out = folder / scene
    command = [options.etendue, "bench", scene, "--methods", options.methods, "--budget", str(options.budget),
               "--repeats", str(options.repeats), "--size", options.size, "--reference-time", str(options.reference_time),
               "--out", out]
    subprocess.run(command, check=True, capture_output=True)
    return json.loads((out / "summary.json").read_text())


def row(scene, summary):
    errors = {m["name"]: m["relmse"] for m in summary["methods"]}
    first = next(iter(errors.values()))
    ratios = [e / first if e and e > 0 else None for e in errors.values()]
    best = min(r for r in ratios if r is not None)
    cells = ["—" if r is None else f"**{r:.2g}**" if r == best else f"{r:.2g}" for r in ratios]
    noisy = " !" if summary["reference"]["too_noisy"] else ""
    chosen = {choice.split()[0] for m in summary["methods"] for choice in m["choices"]}
    return f"| `{scene}`{noisy} | " + " | ".join(cells) + f" | {', '.join(sorted(chosen))} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", default=SCENES)
    parser.add_argument("--methods", default=METHODS)
    parser.add_argument("--budget", type=float, default=4)
    parser.add_argument("--repeats", type=int, default=2)
    parser.add_argument("--size", default="128x96")
    parser.add_argument("--reference-time", type=float, default=60)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--etendue", default="build/release/app/cli/etendue")
    options = parser.parse_args()
    methods = [f"`{name}`" for name in options.methods.split(",")]
    print("| scene | " + " | ".join(methods) + " | chosen by `auto` |\n|" + "---|" * (len(methods) + 2))
    with tempfile.TemporaryDirectory() as temporary:
        for scene in options.scenes.split(","):
            print(row(scene, measure(scene, options, options.keep or pathlib.Path(temporary))), flush=True)


if __name__ == "__main__":
    main()
