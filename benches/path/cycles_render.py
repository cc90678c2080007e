#!/usr/bin/env python3
"""cycles_render.py SCENE.json SPP SEED THREADS OUT.exr: draws a scene of `cargo xtask bench path` with Blender's Cycles.

Without denoiser, adaptive sampling and clamping. Balls and tubes become meshes. Prints one line of JSON."""
import json, math, os, sys, time

scene, spp, seed, threads, out = sys.argv[1:]
import bpy
from mathutils import Matrix, Vector

description = json.load(open(scene))
folder = os.path.dirname(os.path.abspath(scene))
start = time.perf_counter()
bpy.ops.wm.read_factory_settings(use_empty=True)
world = bpy.context.scene
world.render.engine = "CYCLES"
cycles = world.cycles
cycles.device, cycles.samples, cycles.seed = "CPU", int(spp), int(seed)
cycles.use_adaptive_sampling = cycles.use_denoising = False
bounces = description["max_depth"] - 2
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = bounces
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0.0
cycles.blur_glossy = 0.0
cycles.caustics_reflective = cycles.caustics_refractive = True
cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
render = world.render
render.threads_mode, render.threads = "FIXED", int(threads)
render.resolution_x = render.resolution_y = description["size"]
render.resolution_percentage = 100
render.filepath = out
render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"


def nodes_of(owner):
    owner.use_nodes = True
    owner.node_tree.nodes.clear()
    return owner.node_tree


def material(name, m):
    tree = nodes_of(made := bpy.data.materials.new(name))
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    if m["kind"] == "matte":
        surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
        surface.inputs["Color"].default_value = (*m["color"], 1)
    elif m["kind"] == "metal":
        surface = tree.nodes.new("ShaderNodeBsdfMetallic")
        surface.fresnel_type = "PHYSICAL_CONDUCTOR"
        surface.distribution = "MULTI_GGX"
        surface.inputs["IOR"].default_value = m["eta"]
        surface.inputs["Extinction"].default_value = m["k"]
        surface.inputs["Roughness"].default_value = m["roughness"]
    else:
        surface = tree.nodes.new("ShaderNodeBsdfGlass")
        surface.inputs["IOR"].default_value = m["ior"]
        surface.inputs["Roughness"].default_value = 0
    shader = surface.outputs[0]
    if m.get("emission"):
        glow = tree.nodes.new("ShaderNodeEmission")
        glow.inputs["Color"].default_value = (*m["emission"], 1)
        front = tree.nodes.new("ShaderNodeMath")
        front.operation = "SUBTRACT"
        front.inputs[0].default_value = 1
        tree.links.new(tree.nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], front.inputs[1])
        tree.links.new(front.outputs[0], glow.inputs["Strength"])
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(shader, both.inputs[0])
        tree.links.new(glow.outputs[0], both.inputs[1])
        shader = both.outputs[0]
        made.cycles.emission_sampling = "FRONT"
    tree.links.new(shader, output.inputs[0])
    return made


materials = {name: material(name, m) for name, m in description["materials"].items()}
meshes = {}


def mesh(kind, make, name):
    """One mesh for each kind and material, which all of them share."""
    if (kind, name) not in meshes:
        made = bpy.data.meshes.new(kind)
        make(made)
        made.materials.append(materials[name])
        meshes[kind, name] = made
    return meshes[kind, name]


def of(vertices, faces):
    return lambda made: (made.from_pydata(vertices, [], faces), made.update())


def ball(made):
    import bmesh
    shape = bmesh.new()
    bmesh.ops.create_uvsphere(shape, u_segments=96, v_segments=48, radius=1)
    shape.to_mesh(made)
    shape.free()
    made.shade_smooth()


def tube(made):
    count = 96
    ring = [(math.cos(2 * math.pi * i / count), math.sin(2 * math.pi * i / count)) for i in range(count)]
    vertices = [(x, y, z) for z in (0, 1) for x, y in ring]
    sides = [(i, (i + 1) % count, count + (i + 1) % count, count + i) for i in range(count)]
    caps = [tuple(reversed(range(count))), tuple(range(count, 2 * count))]
    made.from_pydata(vertices, [], sides + caps)
    made.update()
    for face in made.polygons[:count]:
        face.use_smooth = True


CUBE = of(
    [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
    [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)],
)
SQUARE = of([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)])


def columns(x, y, z, at):
    return Matrix([[x[i], y[i], z[i], at[i]] for i in range(3)] + [[0, 0, 0, 1]])


def add(shape):
    name, kind = shape["material"], shape["kind"]
    if kind == "sphere":
        data, place = mesh(kind, ball, name), Matrix.Translation(shape["center"]) @ Matrix.Scale(shape["radius"], 4)
    elif kind == "rectangle":
        a, b = map(Vector, shape["edges"])
        data, place = mesh(kind, SQUARE, name), columns(a, b, a.cross(b).normalized(), shape["corner"])
    elif kind == "box":
        data, place = mesh(kind, CUBE, name), columns(*shape["columns"], shape["center"])
    else:
        base, axis = Vector(shape["base"]), Vector(shape["top"]) - Vector(shape["base"])
        z = axis.normalized()
        x = (Vector((0, 1, 0)) if abs(z[1]) < 0.9 else Vector((1, 0, 0))).cross(z).normalized()
        data, place = mesh(kind, tube, name), columns(x * shape["radius"], z.cross(x) * shape["radius"], axis, base)
    thing = bpy.data.objects.new(kind, data)
    thing.matrix_world = place
    world.collection.objects.link(thing)


for shape in description["shapes"]:
    add(shape)
sky = world.world = bpy.data.worlds.new("sky")
tree = nodes_of(sky)
back, output = tree.nodes.new("ShaderNodeBackground"), tree.nodes.new("ShaderNodeOutputWorld")
tree.links.new(back.outputs[0], output.inputs[0])
if description.get("environment"):
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(os.path.join(folder, description["environment"]))
    picture.image.colorspace_settings.name = "Linear Rec.709"
    # Cycles has z up, and its maps begin elsewhere: (z, x, y) in place of (x, y, z).
    apart, together = tree.nodes.new("ShaderNodeSeparateXYZ"), tree.nodes.new("ShaderNodeCombineXYZ")
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], apart.inputs[0])
    for to, source in enumerate((2, 0, 1)):
        tree.links.new(apart.outputs[source], together.inputs[to])
    tree.links.new(together.outputs[0], picture.inputs["Vector"])
    tree.links.new(picture.outputs[0], back.inputs[0])
else:
    back.inputs[1].default_value = 0
camera, seen = bpy.data.cameras.new("camera"), description["camera"]
eye = bpy.data.objects.new("camera", camera)
world.collection.objects.link(eye)
world.camera = eye
camera.sensor_fit, camera.angle_y, camera.clip_start = "VERTICAL", math.radians(seen["fov"]), 0.001
z = (Vector(seen["eye"]) - Vector(seen["target"])).normalized()
x = Vector((0, 1, 0)).cross(z).normalized()
eye.matrix_world = columns(x, z.cross(x), z, seen["eye"])
load = time.perf_counter() - start
start = time.perf_counter()
bpy.ops.render.render(write_still=True)
print(json.dumps({"version": bpy.app.version_string, "load": load, "render": time.perf_counter() - start}))
