#!/usr/bin/env python3
"""Efficiency of `path` and `auto` relative to Cycles, on five scenes, interleaved in one run of `etendue bench` per scene.

    compare_with_cycles.py --data DATA [--scenes A,B,...] [--budget 10] [--repeats 2] [--size 512x512]
                           [--methods path,auto] [--reference-time S] [--reference-integrator NAME]
                           [--keep FOLDER]

The scenes are cornell-box, staircase2, veach-bidir, glass-caustic (built in), and mesh: a million triangles under a
uniform sky. DATA is the folder that contains scenes/. Paths have at most eight segments, two threads. Efficiency is
1 / (relMSE x seconds of rendering); the time for the choice of `auto` counts, the start-up of Cycles does not. `bias` is the
difference of mean radiance between Cycles and the reference, with its standard error: materials that Cycles lacks are replaced by
similar ones. References are path-traced, unless another integrator is named. Writes a table in Markdown. Needs Debian's
packages blender and python3-numpy.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "tools"))
from growth import Gltf, height_field  # noqa: E402

SCENES = ("cornell-box", "staircase2", "veach-bidir", "glass-caustic", "mesh")
TRIANGLES = 1_000_000
MAX_DEPTH = 8


def scene_file(name, options, folder):
    """The file that both programs read. It has a camera, which Cycles needs."""
    source = name
    if name == "mesh":
        gltf = Gltf()
        gltf.node(mesh=gltf.mesh(*height_field(round((TRIANGLES / 2) ** 0.5), 2), gltf.material()))
        source = gltf.write(folder, name)
    elif name != "glass-caustic":
        source = options.data / "scenes" / name / f"{name}.glb"
    file = folder / f"{name}-saved.glb"
    subprocess.run([options.etendue, "save", source, "-o", file], check=True, capture_output=True)
    return file


def rendered_reference(file, name, options, folder):
    """A reference by another integrator than the one of `etendue bench`."""
    reference = folder / f"{name}-reference.exr"
    subprocess.run([options.etendue, "render", file, "--size", options.size, "--time", str(options.reference_time),
                    "--seed", "1000003", "--integrator", options.reference_integrator, "--set",
                    f"max-depth={MAX_DEPTH}", "-o", reference], check=True, capture_output=True)
    return reference


def measure(name, options, folder):
    file = scene_file(name, options, folder)
    sky = "1,1,1" if name == "mesh" else "0,0,0"
    cycles = (f"blender --background --python-exit-code 1 --python {HERE / 'cycles.py'} -- {file} {{width}} {{height}} {{spp}} "
              f"{{seed}} {{out}} --max-depth {MAX_DEPTH} --threads 2 --sky {sky}")
    out = (options.keep or folder) / f"{name}-{options.budget:g}"
    command = [options.etendue, "bench", file, "--size", options.size, "--budget", str(options.budget), "--repeats",
               str(options.repeats), "--threads", "2", "--set", f"max-depth={MAX_DEPTH}", "--out", out, "--methods",
               f'{options.methods},external:"{cycles}"']
    if name == "mesh":
        # Both programs see the sky behind the mesh.
        command += ["--env", "uniform", "--set", "environment.backdrop=false", "--set", "environment.visible=true"]
    if options.reference_integrator:
        command += ["--reference", rendered_reference(file, name, options, folder)]
    elif options.reference_time:
        command += ["--reference-time", str(options.reference_time)]
    # Blender takes the modules of the first python3 in PATH: that of Debian has numpy.
    environment = {**os.environ, "PATH": "/usr/bin:" + os.environ["PATH"]}
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
    return json.loads((out / "summary.json").read_text())


def row(name, summary):
    *own, peer = summary["methods"]
    if peer["relmse"] is None:
        sys.exit(f"{name}: Cycles rendered no sample; is blender installed, and the budget long enough?")
    cells = [name, f"{summary['budget']:g}"]
    for method in own:
        ratio = peer["relmse"] * peer["seconds"] / (method["relmse"] * method["seconds"])
        chosen = ", ".join(sorted({choice.split()[0] for choice in method["choices"]}))
        cells.append(f"{ratio:.2f}" + (f" ({chosen})" if chosen else ""))
    bias = peer["bias"], peer["bias_stderr"]
    cells += [f"{peer['relmse']:.3g}", "?" if None in bias else f"{bias[0]:+.2g} ± {bias[1]:.1g}",
              "too noisy" if summary["reference"]["too_noisy"] else ""]
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, required=True)
    parser.add_argument("--scenes", default=",".join(SCENES))
    parser.add_argument("--budget", type=float, default=10)
    parser.add_argument("--repeats", type=int, default=2)
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--methods", default="path,auto")
    parser.add_argument("--reference-time", type=int, default=0)
    parser.add_argument("--reference-integrator", help="needs --reference-time")
    parser.add_argument("--etendue", default=HERE.parent.parent / "build/release/app/cli/etendue")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the reports of etendue bench")
    options = parser.parse_args()
    if options.reference_integrator and not options.reference_time:
        parser.error("--reference-integrator needs --reference-time")
    methods = options.methods.split(",")
    print("| scene | seconds | " + " | ".join(f"`{m}` / Cycles" for m in methods) +
          " | relMSE of Cycles | bias | reference |", flush=True)
    print("|---" * (len(methods) + 5) + "|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for name in options.scenes.split(","):
            print(row(name, measure(name, options, pathlib.Path(folder))), flush=True)


if __name__ == "__main__":
    main()
