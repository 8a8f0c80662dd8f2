"""Renders a glTF file with Cycles, as another renderer of `etendue bench` (docs/guide/comparing.md).

  blender --background --python-exit-code 1 --python cycles.py -- SCENE.glb WIDTH HEIGHT SAMPLES SEED OUT.exr [MAX_BOUNCES]

Materials without a specular layer become Lambertian, and single-sided materials emit on their front side only, as in
glTF; Blender's importer does neither. Lights of KHR_lights_punctual have another unit in Blender, so scenes should be
lit by emissive surfaces. The settings are those of an unbiased path tracer: no denoising, clamping, adaptive sampling, light threshold, caustic
filter or light tree approximation. Needs the packages blender and python3-numpy.
"""

import sys

import numpy

numpy.bool = bool  # the importer of Blender 3.4 uses the old name
import bpy


def arguments():
    names = sys.argv[sys.argv.index("--") + 1 :]
    if len(names) not in (6, 7):
        sys.exit("cycles.py: needs SCENE.glb WIDTH HEIGHT SAMPLES SEED OUT.exr [MAX_BOUNCES]")
    return names[0], *map(int, names[1:5]), names[5], int(names[6]) if len(names) > 6 else 1024


def load(scene_file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=scene_file)
    scene = bpy.context.scene
    cameras = [o for o in scene.objects if o.type == "CAMERA"]
    if not cameras:
        sys.exit("cycles.py: the scene has no camera; write it with etendue save")
    scene.camera = cameras[0]
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
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


def set_up_cycles(scene, samples, seed, bounces):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.seed = seed & 0x7FFFFFFF
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = 0
    cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = True
    cycles.caustics_refractive = True
    for kind in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces"):
        setattr(cycles, kind, bounces)


def set_up_image(scene, width, height, file):
    render = scene.render
    render.resolution_x = width
    render.resolution_y = height
    render.resolution_percentage = 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.image_settings.color_mode = "RGB"
    render.filepath = file
    render.use_file_extension = False
    render.threads_mode = "AUTO"
    scene.view_settings.view_transform = "Raw"


def main():
    scene_file, width, height, samples, seed, file, bounces = arguments()
    scene = load(scene_file)
    correct_materials()
    set_up_cycles(scene, samples, seed, bounces)
    set_up_image(scene, width, height, file)
    bpy.ops.render.render(write_still=True)


main()
