#!/usr/bin/env python3
"""Efficiency of settings of `path` relative to its defaults, as a table.

  tools/estimator_efficiency.py [--etendue PROGRAM] [--scenes LIST] [--settings LIST] [--spp N] [--seeds N] [--size N]
                                [--all="ARGUMENTS"]

Efficiency is 1 / (mean squared error x processor time of rendering). All settings render a scene in turn with the same
seeds on one thread and are compared with a reference of another seed. The time of a rendering of one sample is
subtracted. A value above 1 helps. The settings of a list are separated by commas, those that belong together by "+".
integrator=NAME and sampler=NAME select these; other settings are parameters of the integrator. All renderings have the
arguments of --all, such as --all="--env sky --set max-depth=2"."""
import argparse, json, os, resource, shlex, subprocess, tempfile

SCENES = "cornell,glossy-plates,many-lights,door-ajar,glass-caustic"
SETTINGS = ("heuristic=balance,heuristic=cutoff,heuristic=maximum,heuristic=constant,heuristic=partition,light-samples=2,"
            "light-samples=4,lights=every,roulette-start=64,survival-rule=albedo,survival-rule=constant,least-survival=0.5,"
            "integrator=distribution+branching=first-rough+branches-1=4,integrator=distribution+branches-1=2+branches-2=2,"
            "sampler=random,sampler=antithetic,sampler=blue-noise")


def run(program, *arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    result = subprocess.run([program, *arguments], capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(f"{' '.join(arguments)}\n{result.stderr}")
    return result.stdout, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--etendue", default="build/release/app/cli/etendue")
    options.add_argument("--scenes", default=SCENES)
    options.add_argument("--settings", default=SETTINGS)
    options.add_argument("--spp", type=int, default=64)
    options.add_argument("--reference", type=int, default=16384)
    options.add_argument("--seeds", type=int, default=6)
    options.add_argument("--size", type=int, default=64)
    options.add_argument("--all", default="")
    o = options.parse_args()
    scenes, settings = o.scenes.split(","), ["", *o.settings.split(",")]
    table = {s: [] for s in settings}
    with tempfile.TemporaryDirectory() as folder:
        reference, image = os.path.join(folder, "reference.exr"), os.path.join(folder, "image.exr")

        def render(scene, spp, seed, output, setting="", threads=1):
            values = dict(s.split("=", 1) for s in setting.split("+") if s)
            integrator, sampler = values.pop("integrator", "path"), values.pop("sampler", "sobol")
            sets = [a for name, value in values.items() for a in ("--set", f"{integrator}.{name}={value}")]
            return run(o.etendue, "render", scene, "--size", f"{o.size}x{o.size}", "--spp", str(spp), "--seed", str(seed),
                       "--integrator", integrator, "--sampler", sampler, "--threads", str(threads), *sets, *shlex.split(o.all),
                       "-o", output)[1]

        for scene in scenes:
            render(scene, o.reference, 1000, reference, threads=0)
            work = {s: [0.0, 0.0] for s in settings}
            for seed in range(o.seeds):
                for s in settings:
                    start = render(scene, 1, seed, image, s)
                    work[s][1] += max(render(scene, o.spp, seed, image, s) - start, 1e-3)
                    work[s][0] += json.loads(run(o.etendue, "compare", image, reference, "--json")[0])["mse"]
            error, seconds = work[""]
            for s in settings:
                table[s].append((error * seconds / (work[s][0] * work[s][1]), error / work[s][0]))
    print("| setting | " + " | ".join(f"`{os.path.splitext(os.path.basename(s))[0]}`" for s in scenes) + " |")
    print("|---|" + "---|" * len(scenes))
    for s in settings[1:]:
        print(f"| `{s}` | " + " | ".join(f"{efficiency:.2f} ({gain:.2f})" for efficiency, gain in table[s]) + " |")


if __name__ == "__main__":
    main()
