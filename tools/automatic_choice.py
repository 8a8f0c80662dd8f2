#!/usr/bin/env python3
"""Compares the automatic choice of the integrator with the best integrator in hindsight, in equal time.

    automatic_choice.py [--scenes A,B,...] [--time 10 | --samples N] [--size 128x128] [--repeats 1] [--error relative]

For each scene, `auto` and every integrator that it compared render for the same time, or with the same number of samples.
The runs are interleaved. Squared errors are measured against a reference of ten times this length. The inefficiency of a
run is its squared error times its processor time, which depends little on other programs and includes the pilots of
`auto`; that of an integrator is the mean over the repeats. The ratio is that of `auto` divided by the smallest one of the
integrators. Writes a table in Markdown. With --samples, the pilots have a fixed amount of work, so that the choice does
not depend on other programs.
"""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

SCENES = ("cornell,cornell-spheres,glossy-plates,glass-caustic,caustic-pool,spot-indirect,door-ajar,many-lights,fog,"
          "god-rays")
REFERENCE_LENGTH = 10  # times the time or the samples of a run
GOAL = 1.3


class Scene:
    def __init__(self, name, options, folder):
        self.name, self.options, self.folder = name, options, folder

    def run(self, *arguments):
        command = [self.options.etendue, *map(str, arguments)]
        before = os.times()
        result = subprocess.run(command, capture_output=True, text=True)
        after = os.times()
        if result.returncode != 0:
            raise SystemExit(f"{' '.join(command)}: {result.stderr.strip()}")
        self.processor_seconds = after.children_user + after.children_system - before.children_user - before.children_system
        return json.loads(result.stdout)

    def render(self, file, integrator, length, seed):
        options = self.options
        limit = ["--spp", length * options.samples] if options.samples else ["--time", length * options.time]
        return self.run("render", self.name, "--size", options.size, *limit, "--seed", seed,
                        "--integrator", integrator, "--set", f"auto.error={options.error}",
                        "-o", self.folder / file, "--json", "-")

    def squared_error(self, file):
        errors = self.run("compare", self.folder / file, self.folder / "reference.exr", "--json")
        return errors["relmse"] if self.options.error == "relative" else errors["mse"]

    def measure(self):
        first = self.render("auto.exr", "auto", REFERENCE_LENGTH, 1000)
        candidates = [m["name"] for m in first["automatic"]["methods"] if not m["refusal"]]
        # The reference has the seed of no other run and the integrator that a long pilot found to be the best.
        (self.folder / "auto.exr").rename(self.folder / "reference.exr")
        errors = {name: 0 for name in ["auto", *candidates]}
        chosen = []
        for seed in range(1, self.options.repeats + 1):
            for name in errors:
                statistics = self.render("image.exr", name, 1, seed)
                processor_seconds = self.processor_seconds
                errors[name] += self.squared_error("image.exr") * processor_seconds / self.options.repeats
                if name == "auto":
                    chosen.append(statistics["integrator"])
        return errors, chosen


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scenes", default=SCENES)
    parser.add_argument("--time", type=float, default=10)
    parser.add_argument("--samples", type=int)
    parser.add_argument("--size", default="128x128")
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("--error", default="relative", choices=["relative", "rmse"])
    parser.add_argument("--etendue", default="build/release/app/cli/etendue")
    options = parser.parse_args()
    print("| scene | chosen | best in hindsight | ratio |\n|---|---|---|---:|")
    good, scenes = 0, options.scenes.split(",")
    for name in scenes:
        with tempfile.TemporaryDirectory() as folder:
            errors, chosen = Scene(name, options, pathlib.Path(folder)).measure()
        integrators = {n: e for n, e in errors.items() if n != "auto"}
        best = min(integrators, key=integrators.get) if integrators else chosen[0]
        ratio = errors["auto"] / integrators[best] if integrators else 1
        good += ratio <= GOAL
        print(f"| `{name}` | {', '.join(sorted(set(chosen)))} | {best} | {ratio:.2f} |", flush=True)
    print(f"\nWithin {GOAL} times of the best integrator on {good} of {len(scenes)} scenes.")


if __name__ == "__main__":
    main()
