"""Renders a glTF file with Cycles, as another renderer of `etendue bench` (docs/guide/comparing.md).

  blender --background --python-exit-code 1 --python cycles.py -- SCENE.glb WIDTH HEIGHT SAMPLES SEED OUT.exr
          [--max-depth N] [--sky R,G,B | --sky MAP.exr] [--sky-rotation RADIANS] [--threads N]

  --max-depth     number of path segments from camera to light, as in Etendue; 0 (default): no limit, at least 2 otherwise
  --sky           radiance of a uniform sky, or an equirectangular map; black by default. The importer ignores the
                  environment of the file
  --sky-rotation  rotation of the map about the vertical axis (environment.rotation)
  --threads       number of threads; 0 (default): one per hardware thread

Materials without a specular layer become Lambertian, and single-sided materials emit on their front side only, as in
glTF; Blender's importer does neither. Intensities of point and directional lights are used without conversion to watts,
so that emissive surfaces and lights have the same unit. Spot lights are refused, because their cones have another
falloff in Blender. The settings are those of an unbiased path tracer: no denoising,
clamping, adaptive sampling, light threshold, caustic filter or light tree approximation. Needs the packages blender and
python3-numpy.
"""

import argparse
import sys

import numpy

numpy.bool = bool  # the importer of Blender 3.4 uses the old name
import bpy

UNLIMITED_BOUNCES = 1024


def arguments():
    parser = argparse.ArgumentParser(prog="cycles.py")
    parser.add_argument("scene")
    for name in ("width", "height", "samples", "seed"):
        parser.add_argument(name, type=int)
    parser.add_argument("out")
    parser.add_argument("--max-depth", type=int, default=0)
    parser.add_argument("--sky", default="0,0,0")
    parser.add_argument("--sky-rotation", type=float, default=0)
    parser.add_argument("--threads", type=int, default=0)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    if options.max_depth == 1 or options.max_depth < 0:
        parser.error("--max-depth: Cycles always samples lights at the first surface; give 0, or 2 or more")
    return options


def color_of(text):
    """The three numbers of a colour; None if the text is the name of a file."""
    try:
        values = [float(v) for v in text.split(",")]
    except ValueError:
        return None
    return (values * 3)[:3] if len(values) == 1 else values if len(values) == 3 else None


def set_up_sky(world, sky, rotation):
    world.use_nodes = True
    tree = world.node_tree
    background = next(n for n in tree.nodes if n.type == "BACKGROUND")
    background.inputs["Strength"].default_value = 1
    color = color_of(sky)
    if color:
        background.inputs["Color"].default_value = (*color, 1)
        return
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Rotation"].default_value = (0, 0, rotation)
    environment = tree.nodes.new("ShaderNodeTexEnvironment")
    environment.image = bpy.data.images.load(sky)
    environment.image.colorspace_settings.name = "Linear"
    tree.links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs[0], environment.inputs["Vector"])
    tree.links.new(environment.outputs["Color"], background.inputs["Color"])
    world.cycles.sampling_method = "AUTOMATIC"


def load(options):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=options.scene, convert_lighting_mode="COMPAT")
    scene = bpy.context.scene
    cameras = [o for o in scene.objects if o.type == "CAMERA"]
    if not cameras:
        sys.exit("cycles.py: the scene has no camera; write it with etendue save")
    scene.camera = cameras[0]
    scene.world = bpy.data.worlds.new("sky")
    set_up_sky(scene.world, options.sky, options.sky_rotation)
    for light in bpy.data.lights:
        if light.type == "SPOT":
            sys.exit("cycles.py: the cones of spot lights have another falloff in Blender")
        if light.type == "POINT":
            light.shadow_soft_size = 0
        elif light.type == "SUN":
            light.angle = 0
    return scene


def specular_of(tree):
    """The factor of KHR_materials_specular, which the importer stores in a group without effect."""
    factors = [n.inputs["Specular"].default_value for n in tree.nodes if n.type == "GROUP" and "Specular" in n.inputs]
    return factors[0] if factors else 1


def make_lambertian(tree, principled):
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    color = principled.inputs["Base Color"]
    diffuse.inputs["Color"].default_value = color.default_value
    if color.links:
        tree.links.new(color.links[0].from_socket, diffuse.inputs["Color"])
    emission = tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = principled.inputs["Emission"].default_value
    emission.inputs["Strength"].default_value = principled.inputs["Emission Strength"].default_value
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    if not any(emission.inputs["Color"].default_value[:3]):
        tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
        return
    front = tree.nodes.new("ShaderNodeMixShader")
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    tree.links.new(geometry.outputs["Backfacing"], front.inputs["Fac"])
    both = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(diffuse.outputs[0], both.inputs[0])
    tree.links.new(emission.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], front.inputs[1])
    tree.links.new(diffuse.outputs[0], front.inputs[2])
    tree.links.new(front.outputs[0], output.inputs["Surface"])


def correct_materials():
    for material in bpy.data.materials:
        tree = material.node_tree
        principled = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
        if not principled:
            continue
        specular = specular_of(tree)
        principled.inputs["Specular"].default_value *= specular
        if specular == 0 and principled.inputs["Metallic"].default_value == 0:
            make_lambertian(tree, principled)


def set_up_cycles(scene, options):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = options.samples
    cycles.seed = options.seed & 0x7FFFFFFF
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = 0
    cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = True
    cycles.caustics_refractive = True
    # Light samples at the first surface, a path of two segments, are 0 bounces.
    bounces = options.max_depth - 2 if options.max_depth > 0 else UNLIMITED_BOUNCES
    for kind in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "volume_bounces"):
        setattr(cycles, kind, bounces)
    cycles.transparent_max_bounces = UNLIMITED_BOUNCES


def set_up_image(scene, options):
    render = scene.render
    render.resolution_x = options.width
    render.resolution_y = options.height
    render.resolution_percentage = 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.image_settings.color_mode = "RGB"
    render.filepath = options.out
    render.use_file_extension = False
    render.threads_mode = "FIXED" if options.threads > 0 else "AUTO"
    if options.threads > 0:
        render.threads = options.threads
    scene.view_settings.view_transform = "Raw"


def main():
    options = arguments()
    scene = load(options)
    correct_materials()
    set_up_cycles(scene, options)
    set_up_image(scene, options)
    bpy.ops.render.render(write_still=True)


main()
