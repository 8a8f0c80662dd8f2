#!/usr/bin/env python3
"""Compares the automatic choice of the integrator with the best integrator in hindsight.

    automatic_choice.py [--scenes A,B,...] [--time 60] [--run 2] [--size 128x128] [--repeats 1] [--error relative]

For each scene, `etendue render --integrator auto --time TIME` makes its choice and is then interrupted. Every integrator
that it compared renders for RUN seconds; the repeats are interleaved. The inefficiency of a run is its squared error
against a reference of ten times this length, times its processor time, which depends little on other programs. The ratio
is the inefficiency of the chosen integrator, divided by the smallest one and by the share of TIME that the choice leaves
for rendering. Writes a table in Markdown.
"""
import argparse
import json
import os
import pathlib
import signal
import subprocess
import tempfile

SCENES = ("cornell,cornell-spheres,glossy-plates,glass-caustic,caustic-pool,spot-indirect,door-ajar,many-lights,fog,"
          "god-rays")
REFERENCE_LENGTH = 10  # times the time of a run
GOAL = 1.3


class Scene:
    def __init__(self, name, options, folder):
        self.name, self.options, self.folder = name, options, folder

    def render_command(self, file, integrator, sampler, seconds, seed):
        return [self.options.etendue, "render", self.name, "--size", self.options.size, "--time", str(seconds), "--seed",
                str(seed), "--integrator", integrator, *(["--sampler", sampler] if sampler else []), "--set",
                f"auto.error={self.options.error}", "-o", str(self.folder / file), "--json",
                str(self.folder / "statistics.json")]

    def choose(self):
        """The statistics of a rendering that is interrupted after the choice."""
        command = self.render_command("choice.exr", "auto", None, self.options.time, 0)
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
            for line in process.stderr:
                if line.startswith("etendue: "):
                    break
            process.send_signal(signal.SIGINT)
            process.stderr.read()
        return json.loads((self.folder / "statistics.json").read_text())

    def processor_seconds(self, *arguments):
        before = os.times()
        subprocess.run(self.render_command(*arguments), check=True, capture_output=True)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system

    def squared_error(self, file):
        command = [self.options.etendue, "compare", self.folder / file, self.folder / "reference.exr", "--json"]
        errors = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        return errors["relmse"] if self.options.error == "relative" else errors["mse"]

    def measure(self):
        choice = self.choose()
        chosen = (choice["integrator"], choice["sampler"])
        left = 1 - choice["automatic"]["seconds"] / self.options.time
        methods = {(m["name"], "sobol") for m in choice["automatic"]["methods"] if not m["refusal"]} | {chosen}
        self.processor_seconds("reference.exr", *chosen, REFERENCE_LENGTH * self.options.run, 1000)
        inefficiency = {method: 0 for method in sorted(methods)}
        for seed in range(1, self.options.repeats + 1):
            for method in inefficiency:
                seconds = self.processor_seconds("image.exr", *method, self.options.run, seed)
                inefficiency[method] += seconds * self.squared_error("image.exr")
        best = min(inefficiency, key=inefficiency.get)
        return chosen, best, inefficiency[chosen] / inefficiency[best] / left


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scenes", default=SCENES)
    parser.add_argument("--time", type=float, default=60)
    parser.add_argument("--run", type=float, default=2)
    parser.add_argument("--size", default="128x128")
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("--error", default="relative", choices=["relative", "rmse"])
    parser.add_argument("--etendue", default="build/release/app/cli/etendue")
    options = parser.parse_args()
    print("| scene | chosen | best in hindsight | ratio |\n|---|---|---|---:|")
    good, scenes = 0, options.scenes.split(",")
    for name in scenes:
        with tempfile.TemporaryDirectory() as folder:
            chosen, best, ratio = Scene(name, options, pathlib.Path(folder)).measure()
        good += ratio <= GOAL
        print(f"| `{name}` | {' '.join(chosen)} | {' '.join(best)} | {ratio:.2f} |", flush=True)
    print(f"\nWithin {GOAL} times of the best integrator on {good} of {len(scenes)} scenes.")


if __name__ == "__main__":
    main()
