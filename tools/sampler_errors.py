#!/usr/bin/env python3
"""Mean squared errors of the samplers on several scenes, as a table.

  tools/sampler_errors.py [--etendue PROGRAM] [--samplers LIST] [--scenes LIST] [--spp LIST] [--seeds N] [--size N] [--low-pass SIGMA]

Renders each scene with `path` and every sampler, and compares it with a reference that takes 64 times the largest
number of samples with another seed. A sampler may have settings: hammersley:scrambling=rotation. The values are the mean
over the seeds, relative to the first sampler of the list. With --low-pass, both images are filtered by a Gaussian of this
standard deviation in pixels first: the error that is seen from a distance."""
import argparse, json, math, os, subprocess, tempfile

DEFAULT_SCENES = "cornell,cornell-spheres,glossy-plates,spot-indirect,many-lights,door-ajar,god-rays"


def run(program, *arguments):
    result = subprocess.run([program, *arguments], capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(f"{' '.join(arguments)}\n{result.stderr}")
    return result.stdout


def render(program, scene, size, samples, seed, output, sampler="sobol"):
    name, *settings = sampler.split(":")
    run(program, "render", scene, "--size", f"{size}x{size}", "--spp", str(samples), "--seed", str(seed), "--integrator", "path",
        "--sampler", name, *(a for s in settings for a in ("--set", f"{name}.{s}")), "-o", output)


def squared_error(program, image, reference, low_pass):
    return json.loads(run(program, "compare", image, reference, "--low-pass", str(low_pass), "--json"))["mse"]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--etendue", default="build/release/app/cli/etendue")
    options.add_argument("--samplers", default="sobol,pmj02,halton,lattice,niederreiter,stratified,random")
    options.add_argument("--scenes", default=DEFAULT_SCENES)
    options.add_argument("--spp", default="16,64,256")
    options.add_argument("--seeds", type=int, default=4)
    options.add_argument("--size", type=int, default=48)
    options.add_argument("--low-pass", type=float, default=0)
    options.add_argument("--reference-spp", type=int, help="default: 64 times the largest number of samples")
    o = options.parse_args()
    samplers, counts = o.samplers.split(","), [int(n) for n in o.spp.split(",")]
    ratios = {(s, n): [] for s in samplers for n in counts}
    print("| scene | samples | " + " | ".join(f"`{s}`" for s in samplers) + " |")
    print("|---|---|" + "---|" * len(samplers))
    with tempfile.TemporaryDirectory() as folder:
        for scene in o.scenes.split(","):
            reference, image = os.path.join(folder, "reference.exr"), os.path.join(folder, "image.exr")
            render(o.etendue, scene, o.size, o.reference_spp or 64 * max(counts), 1000, reference)
            label = os.path.splitext(os.path.basename(scene))[0]
            for n in counts:
                errors = {}
                for s in samplers:
                    total = 0
                    for seed in range(o.seeds):
                        render(o.etendue, scene, o.size, n, seed, image, s)
                        total += squared_error(o.etendue, image, reference, o.low_pass)
                    errors[s] = total / o.seeds
                    ratios[s, n].append(math.log(errors[s] / errors[samplers[0]]))
                first = errors[samplers[0]]
                print(f"| {label} | {n} | {first:.3g} | " + " | ".join(f"{errors[s] / first:.2f}" for s in samplers[1:]) + " |",
                      flush=True)
    for n in counts:
        means = (math.exp(sum(ratios[s, n]) / len(ratios[s, n])) for s in samplers[1:])
        print(f"| geometric mean | {n} | 1 | " + " | ".join(f"{m:.2f}" for m in means) + " |")


if __name__ == "__main__":
    main()
