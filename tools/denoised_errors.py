#!/usr/bin/env python3
"""Errors of raw and denoised images over time, as a table and a chart.

  tools/denoised_errors.py [--etendue PROGRAM] [--scenes LIST] [--spp LIST] [--size N] [--reference-spp N]
                           [--reference-integrator NAME] [--chart FILE.svg] [--images FOLDER]

Renders each scene with `path` and --denoise, and compares both images with a reference that has another seed. The error
is relMSE. The time is that of rendering; the denoised image takes the additional time of the denoiser, which is measured
as the difference of two runs with and without --denoise. --images writes SCENE-SPP-raw.png, SCENE-SPP-denoised.png and
SCENE-reference.png."""
import argparse, json, math, os, subprocess, tempfile, time

DEFAULT_SCENES = "cornell,glossy-plates,caustic-pool,door-ajar"
COLORS = ["#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#8c564b", "#ff7f0e"]


def run(program, *arguments):
    result = subprocess.run([program, *arguments], capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(f"{' '.join(arguments)}\n{result.stderr}")
    return result.stdout


def render(o, scene, samples, seed, output, *more, integrator="path"):
    """Returns the seconds of rendering."""
    text = run(o.etendue, "render", scene, "--size", f"{o.size}x{o.size}", "--spp", str(samples), "--seed", str(seed),
               "--integrator", integrator, "-o", output, "--json", "-", *more)
    return json.loads(text)["seconds"]


def errors(o, image, reference):
    values = json.loads(run(o.etendue, "compare", image, reference, "--json"))
    return values["relmse"], values["flip"]


def measure(o, scene, folder):
    """Rows of samples, rendering seconds, seconds of the denoiser, and both errors of both images."""
    reference = os.path.join(folder, "reference.exr")
    label = os.path.basename(scene).split(".")[0]
    picture = lambda name: ["--png", os.path.join(o.images, f"{label}-{name}.png")] if o.images else []
    render(o, scene, o.reference_spp, 1001, reference, *picture("reference"),
           integrator=o.reference_integrator)
    raw, denoised = (os.path.join(folder, name) for name in ("raw.exr", "denoised.exr"))
    rows = []
    for samples in o.counts:
        start = time.monotonic()
        render(o, scene, samples, 1, raw)
        middle = time.monotonic()
        seconds = render(o, scene, samples, 1, raw, "--denoise", denoised, *picture(f"{samples}-raw"))
        filtering = max(0.0, time.monotonic() - middle - (middle - start))
        if o.images:
            render(o, scene, samples, 1, raw, "--denoise", os.path.join(o.images, f"{label}-{samples}-denoised.png"))
        rows.append((samples, seconds, filtering, *errors(o, raw, reference), *errors(o, denoised, reference)))
    return rows


def chart(results):
    """An SVG of relMSE over seconds, log-log: raw images as dashed lines, denoised ones as solid lines."""
    width, height, left, top, right, bottom = 900, 520, 80, 40, 220, 60
    curves = [(scene, kind, [(row[1] + (row[2] if kind == "denoised" else 0), row[5 if kind == "denoised" else 3]) for row in rows])
              for scene, rows in results.items() for kind in ("raw", "denoised")]
    log = lambda values: [math.log10(v) for v in values]
    xs = log(x for _, _, points in curves for x, _ in points)
    ys = log(y for _, _, points in curves for _, y in points)
    x0, x1, y0, y1 = math.floor(min(xs)), math.ceil(max(xs)), math.floor(min(ys)), math.ceil(max(ys))
    px = lambda x: left + (math.log10(x) - x0) / (x1 - x0) * (width - left - right)
    py = lambda y: top + (y1 - math.log10(y)) / (y1 - y0) * (height - top - bottom)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="13">',
           f'<rect width="{width}" height="{height}" fill="white"/>',
           f'<text x="{left}" y="{top - 14}">relMSE over time: raw (dashed) and denoised (solid)</text>']
    for e in range(x0, x1 + 1):
        out.append(f'<path d="M{px(10.0**e):.1f} {top}V{height - bottom}" stroke="#ccc"/>'
                   f'<text x="{px(10.0**e):.1f}" y="{height - bottom + 20}" text-anchor="middle">{10.0**e:g}</text>')
    for e in range(y0, y1 + 1):
        out.append(f'<path d="M{left} {py(10.0**e):.1f}H{width - right}" stroke="#ccc"/>'
                   f'<text x="{left - 8}" y="{py(10.0**e) + 4:.1f}" text-anchor="end">{10.0**e:g}</text>')
    out.append(f'<text x="{(left + width - right) / 2}" y="{height - 14}" text-anchor="middle">seconds</text>')
    for i, (scene, kind, points) in enumerate(curves):
        color = COLORS[i // 2 % len(COLORS)]
        dash = ' stroke-dasharray="6 4"' if kind == "raw" else ""
        path = "M" + "L".join(f"{px(x):.1f} {py(y):.1f}" for x, y in points)
        out.append(f'<path d="{path}" fill="none" stroke="{color}" stroke-width="2"{dash}/>')
        out += [f'<circle cx="{px(x):.1f}" cy="{py(y):.1f}" r="3" fill="{color}"/>' for x, y in points]
        row = top + 20 * i
        out.append(f'<path d="M{width - right + 15} {row}h28" stroke="{color}" stroke-width="2"{dash}/>'
                   f'<text x="{width - right + 50}" y="{row + 4}">{scene}, {kind}</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--etendue", default="build/release/app/cli/etendue")
    options.add_argument("--scenes", default=DEFAULT_SCENES)
    options.add_argument("--spp", default="4,16,64,256")
    options.add_argument("--size", type=int, default=256)
    options.add_argument("--reference-spp", type=int, default=4096)
    options.add_argument("--reference-integrator", default="path")
    options.add_argument("--chart")
    options.add_argument("--images")
    o = options.parse_args()
    o.counts = [int(n) for n in o.spp.split(",")]
    if o.images:
        os.makedirs(o.images, exist_ok=True)
    results = {}
    print("| scene | samples | rendering, s | denoiser, s | relMSE | denoised | FLIP | denoised |\n|---|---|---|---|---|---|---|---|")
    for scene in o.scenes.split(","):
        with tempfile.TemporaryDirectory() as folder:
            results[os.path.basename(scene).split(".")[0]] = rows = measure(o, scene, folder)
        for samples, seconds, filtering, raw, raw_flip, denoised, flip in rows:
            print(f"| {scene} | {samples} | {seconds:.2f} | {filtering:.2f} | {raw:.3g} | {denoised:.3g} | {raw_flip:.3f} | {flip:.3f} |",
                  flush=True)
    if o.chart:
        with open(o.chart, "w", encoding="utf-8") as file:
            file.write(chart(results))


if __name__ == "__main__":
    main()
