#!/usr/bin/env python3
"""Measures how time and memory grow with the size of a scene or of a rendering.

    growth.py [KIND...] -o FOLDER [--largest N] [--steps 5] [--repeats 3] [--seconds 1] [--integrator path]
    growth.py KIND -o FOLDER --write N    only writes the scene of this size

KIND (all by default):
    triangles   a height field of N triangles in the same area, under a uniform sky
    instances   N instances of one mesh in the same area, under a uniform sky
    lights      N emissive squares of the same total power above a floor
    threads     the Cornell box with N threads
    pixels      the Cornell box with N pixels
    samples     the Cornell box with N samples per pixel

Each size is rendered with two numbers of samples. The difference of their processor times gives the time of a sample; the
rest is the start-up: reading the file, compiling the scene, writing the image. Processor time depends little on other
programs. Memory is the peak of the process. Values are medians over the repeats, which alternate between all sizes.
For threads, the time of a sample is the sum over all threads, which is constant if they do not disturb each other.

Fits y = c N^e and prints the exponents e, over all sizes and between the two largest ones. Writes growth.json and a chart KIND.svg for each kind.
"""
import argparse
import array
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

KINDS = ("triangles", "instances", "lights", "threads", "pixels", "samples")
LARGEST = {"triangles": 2_000_000, "instances": 100_000, "lights": 100_000, "threads": os.cpu_count(),
           "pixels": 1 << 20, "samples": 1024}
SMALLEST = {"triangles": 200, "instances": 10, "lights": 10, "threads": 1, "pixels": 1024, "samples": 16}
SIDE = 2.0  # of the floor, m
VALUES = {"time": "time of a sample, us per pixel", "startup": "start-up, s", "memory": "peak memory, MiB"}


class Gltf:
    """A glTF file with its buffer."""

    def __init__(self):
        self.bytes = bytearray()
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "bufferViews": [], "accessors": [], "meshes": [],
                     "materials": [], "nodes": [], "extensionsUsed": ["KHR_materials_specular"],
                     "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 1, "znear": 0.01}}]}
        tilt = -math.pi / 4
        self.node(camera=0, translation=[0, 1.9, 1.9], rotation=[math.sin(tilt / 2), 0, 0, math.cos(tilt / 2)])

    def node(self, **members):
        self.json["nodes"].append(members)

    def accessor(self, values, code, kind, component, count, **bounds):
        data = array.array(code, values).tobytes()
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        self.json["accessors"].append({"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component,
                                       "count": count, "type": kind, **bounds})
        return len(self.json["accessors"]) - 1

    def mesh(self, positions, indices, material):
        low = [min(positions[i::3]) for i in range(3)]
        high = [max(positions[i::3]) for i in range(3)]
        attributes = {"POSITION": self.accessor(positions, "f", "VEC3", 5126, len(positions) // 3, min=low, max=high)}
        self.json["meshes"].append({"primitives": [{
            "attributes": attributes, "indices": self.accessor(indices, "I", "SCALAR", 5125, len(indices)),
            "material": material}]})
        return len(self.json["meshes"]) - 1

    def material(self, color=0.6, emission=0.0):
        self.json["materials"].append({
            "pbrMetallicRoughness": {"baseColorFactor": [color, color, color, 1], "metallicFactor": 0},
            "extensions": {"KHR_materials_specular": {"specularFactor": 0}}})
        if emission > 0:
            strength = {"KHR_materials_emissive_strength": {"emissiveStrength": emission}}
            self.json["materials"][-1]["extensions"].update(strength)
            self.json["materials"][-1]["emissiveFactor"] = [1, 1, 1]
            self.json["extensionsUsed"].append("KHR_materials_emissive_strength")
        return len(self.json["materials"]) - 1

    def write(self, folder, name):
        self.json["scenes"] = [{"nodes": list(range(len(self.json["nodes"])))}]
        self.json["buffers"] = [{"byteLength": len(self.bytes), "uri": name + ".bin"}]
        (folder / (name + ".bin")).write_bytes(self.bytes)
        (folder / (name + ".gltf")).write_text(json.dumps(self.json))
        return str(folder / (name + ".gltf"))


def height_field(n, side):
    """Positions and indices of a wavy grid of n x n squares."""
    positions, indices = [], []
    for z in range(n + 1):
        for x in range(n + 1):
            u, v = x / n, z / n
            height = 0.1 * math.sin(17 * u) * math.cos(13 * v) + 0.02 * math.sin(91 * u + 67 * v)
            positions += [(u - 0.5) * side, height, (v - 0.5) * side]
    for z in range(n):
        for x in range(n):
            a = z * (n + 1) + x
            indices += [a, a + n + 1, a + 1, a + 1, a + n + 1, a + n + 2]
    return positions, indices


def square(side, upwards=True):
    h = side / 2
    return [-h, 0, -h, -h, 0, h, h, 0, h, h, 0, -h], [0, 1, 2, 0, 2, 3] if upwards else [0, 2, 1, 0, 3, 2]


def on_a_grid(count, side):
    """Places in a square, in rows."""
    row = math.ceil(math.sqrt(count))
    for i in range(count):
        yield (i % row + 0.5) / row * side - side / 2, (i // row + 0.5) / row * side - side / 2


def scene_of(kind, size, folder):
    """The scene and its further arguments."""
    gltf, name = Gltf(), f"{kind}-{size}"
    if kind == "triangles":
        gltf.node(mesh=gltf.mesh(*height_field(max(1, round(math.sqrt(size / 2))), SIDE), gltf.material()))
        return gltf.write(folder, name), ["--env", "uniform"]
    if kind == "instances":
        mesh = gltf.mesh(*height_field(6, 1), gltf.material())
        scale = 0.9 * SIDE / math.sqrt(size)
        for x, z in on_a_grid(size, SIDE):
            gltf.node(mesh=mesh, translation=[x, 0.2 * math.sin(9 * x) * math.cos(7 * z), z], scale=[scale] * 3)
        return gltf.write(folder, name), ["--env", "uniform"]
    if kind == "lights":
        gltf.node(mesh=gltf.mesh(*square(SIDE), gltf.material()))
        light = gltf.mesh(*square(0.2 * SIDE / math.sqrt(size), upwards=False), gltf.material(0, 50))
        for x, z in on_a_grid(size, SIDE):
            gltf.node(mesh=light, translation=[x, 0.3 + 0.1 * math.sin(5 * x + 3 * z), z])
        return gltf.write(folder, name), []
    return "cornell", []


def write_scene(kind, size, folder):
    """As scene_of, in another process: the peak memory of a program counts from that of the process that starts it."""
    receiver, sender = os.pipe()
    child = os.fork()
    if child == 0:
        os.write(sender, json.dumps(scene_of(kind, size, folder)).encode())
        os._exit(0)
    os.close(sender)
    with os.fdopen(receiver) as pipe:
        result = json.load(pipe)
    os.waitpid(child, 0)
    return result


class Case:
    def __init__(self, kind, size, options, folder):
        self.kind, self.size, self.options = kind, size, options
        self.scene, self.arguments = write_scene(kind, size, folder)
        self.image = str(folder / f"{kind}-{size}.png")
        side = round(math.sqrt(size)) if kind == "pixels" else options.side
        self.pixels = side * side
        self.threads = size if kind == "threads" else 1
        self.arguments += ["--size", f"{side}x{side}", "--max-depth", "4", "--integrator", options.integrator,
                           "--threads", str(self.threads)]
        self.few, self.many = (size // 2, size) if kind == "samples" else (0, 0)
        self.values = {name: [] for name in VALUES}

    def run(self, samples):
        """Processor seconds and peak MiB."""
        command = [self.options.etendue, "render", self.scene, *self.arguments, "--spp", str(samples), "-o", self.image]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        errors = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        process.stderr.close()
        if process.returncode != 0:
            sys.exit(errors.decode())
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024

    def choose_samples(self):
        """Doubles the number of samples until the difference takes long enough."""
        if self.many > 0:
            return
        base, samples = self.run(1)[0], 4
        while samples < 1 << 16 and self.run(samples)[0] - base < 0.5 * self.options.seconds:
            samples *= 2
        self.few, self.many = samples // 2, 2 * samples

    def measure(self):
        few, many = self.run(self.few), self.run(self.many)
        per_sample = (many[0] - few[0]) / (self.many - self.few)
        self.values["time"].append(1e6 * per_sample / self.pixels)
        self.values["startup"].append(max(0.0, few[0] - self.few * per_sample))
        self.values["memory"].append(many[1])

    def result(self):
        return {"size": self.size, **{name: statistics.median(list_) for name, list_ in self.values.items()}}


def exponent(sizes, values):
    """The slope of log(value) over log(size); None if a value is not positive."""
    if len(sizes) < 2 or min(values) <= 0:
        return None
    x, y = [math.log(s) for s in sizes], [math.log(v) for v in values]
    mean_x, mean_y = statistics.mean(x), statistics.mean(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def chart(kind, rows):
    """A chart with logarithmic axes; each curve is relative to its first value."""
    width, height, left, bottom, right, top = 680, 420, 70, 50, 240, 20
    sizes = [r["size"] for r in rows]
    curves = {name: [r[name] / rows[0][name] for r in rows] for name in VALUES if min(r[name] for r in rows) > 0}
    highest = math.ceil(max(math.log10(max(c)) for c in curves.values()) + 1e-9)
    lowest = math.floor(min(math.log10(min(c)) for c in curves.values()) - 1e-9)
    span = max(1e-9, math.log10(sizes[-1] / sizes[0]))

    def place(size, value):
        return (left + (width - left - right) * math.log10(size / sizes[0]) / span,
                top + (height - top - bottom) * (highest - math.log10(value)) / (highest - lowest))

    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
           f'font-size="13"><rect width="100%" height="100%" fill="white"/>']
    for power in range(lowest, highest + 1):
        y = place(sizes[0], 10.0 ** power)[1]
        svg.append(f'<path d="M{left} {y:.1f}H{width - right}" stroke="#ddd"/>'
                   f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{10.0 ** power:g}</text>')
    for size in sizes:
        x = place(size, 1)[0]
        svg.append(f'<text x="{x:.1f}" y="{height - bottom + 18}" text-anchor="middle">{size:g}</text>')
    for i, (name, curve) in enumerate(curves.items()):
        color = ("#0072b2", "#d55e00", "#009e73")[i]
        points = " ".join("%.1f,%.1f" % place(s, v) for s, v in zip(sizes, curve))
        slope = exponent(sizes, curve)
        svg.append(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="2"/>'
                   f'<text x="{width - right + 10}" y="{top + 20 + 20 * i}" fill="{color}">{VALUES[name].split(",")[0]}: '
                   f'exponent {slope:.2f}</text>')
    svg.append(f'<text x="{(left + width - right) / 2}" y="{height - 10}" text-anchor="middle">{kind}</text>'
               f'<text x="{left}" y="{top - 6}">relative to {sizes[0]} {kind}</text></svg>')
    return "\n".join(svg) + "\n"


def sizes_of(kind, options):
    smallest, largest = SMALLEST[kind], options.largest or LARGEST[kind]
    if largest <= smallest and kind != "threads":
        sys.exit(f"growth.py: --largest: the smallest size of {kind} is {smallest}; give more")
    if kind == "threads":
        return list(range(1, largest + 1))
    steps = max(2, options.steps)
    ratio = (largest / smallest) ** (1 / (steps - 1))
    return [round(smallest * ratio ** i) for i in range(steps)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("kinds", nargs="*", metavar="KIND")
    parser.add_argument("-o", "--out", required=True)
    parser.add_argument("--largest", type=int, default=0, help="largest size of each kind")
    parser.add_argument("--write", type=int, metavar="N", help="only write the scenes of this size")
    parser.add_argument("--steps", type=int, default=5, help="number of sizes")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=1, help="processor time of a rendering")
    parser.add_argument("--side", type=int, default=128, help="side of the images in pixels")
    parser.add_argument("--integrator", default="path")
    parser.add_argument("--etendue", default="build/release/app/cli/etendue")
    options = parser.parse_args()
    for kind in options.kinds:
        if kind not in KINDS:
            parser.error(f"{kind} is not one of {', '.join(KINDS)}")
    out = pathlib.Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    if options.write:
        for kind in options.kinds:
            print(scene_of(kind, options.write, out)[0])
        return
    results = {}
    print("| kind | sizes | time of a sample, us per pixel | exponent | start-up, s | exponent | memory, MiB | exponent |")
    print("|---|---|---|---:|---|---:|---|---:|")
    for kind in options.kinds or KINDS:
        with tempfile.TemporaryDirectory() as folder:
            cases = [Case(kind, size, options, pathlib.Path(folder)) for size in sizes_of(kind, options)]
            for case in cases:
                case.choose_samples()
            for _ in range(options.repeats):
                for case in cases:
                    case.measure()
        rows = [case.result() for case in cases]
        sizes = [r["size"] for r in rows]
        exponents = {name: exponent(sizes, [r[name] for r in rows]) for name in VALUES}
        results[kind] = {"rows": rows, "exponents": exponents}
        (out / f"{kind}.svg").write_text(chart(kind, rows))
        cells = []
        for name in VALUES:
            both = [exponents[name], exponent(sizes[-2:], [r[name] for r in rows[-2:]])]
            cells += [f"{rows[0][name]:.3g} to {rows[-1][name]:.3g}",
                      ", ".join("-" if e is None else f"{e:.2f}" for e in both)]
        print(f"| {kind} | {sizes[0]} to {sizes[-1]} | {' | '.join(cells)} |", flush=True)
    (out / "growth.json").write_text(json.dumps(results, indent=2) + "\n")


if __name__ == "__main__":
    main()
