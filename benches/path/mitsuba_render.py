#!/usr/bin/env python3
"""mitsuba_render.py VARIANT SCENE.json SPP SEED THREADS OUT.pfm: draws a scene of `cargo xtask bench path` with Mitsuba 3.

Renders twice and counts the second time, so that what is compiled for the scene is not counted. Prints one line of JSON."""
import json, os, sys, time

variant, scene, spp, seed, threads, out = sys.argv[1:]
import drjit as dr, mitsuba as mi

mi.set_variant(variant)
if variant.startswith("llvm"):
    dr.set_thread_count(int(threads))
description = json.load(open(scene))
folder = os.path.dirname(os.path.abspath(scene))
T = mi.ScalarTransform4f


def material(m):
    if m["kind"] == "matte":
        return {"type": "diffuse", "reflectance": {"type": "rgb", "value": m["color"]}}
    if m["kind"] == "metal":
        eta, k = ({"type": "rgb", "value": m[name]} for name in ("eta", "k"))
        return {"type": "roughconductor", "distribution": "ggx", "alpha": m["roughness"] ** 2, "eta": eta, "k": k}
    return {"type": "dielectric", "int_ior": m["ior"], "ext_ior": 1.0}


def columns(x, y, z, at):
    rows = [[x[i], y[i], z[i], at[i]] for i in range(3)] + [[0, 0, 0, 1]]
    return T(rows)


def along(base, top, radius):
    """From the z axis, 0 to 1, with radius 1, to a thing between two points."""
    import numpy as np
    axis = np.subtract(top, base)
    length = np.linalg.norm(axis)
    z = axis / length
    x = np.cross([0, 1, 0] if abs(z[1]) < 0.9 else [1, 0, 0], z)
    x /= np.linalg.norm(x)
    return columns(x * radius, np.cross(z, x) * radius, axis, base)


def add(result, index, shape):
    m = description["materials"][shape["material"]]
    common = {"bsdf": {"type": "ref", "id": shape["material"]}}
    if m.get("emission"):
        common["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": m["emission"]}}
    kind = shape["kind"]
    if kind == "sphere":
        result[f"s{index}"] = {"type": "sphere", "center": shape["center"], "radius": shape["radius"], **common}
    elif kind == "rectangle":
        a, b = ([c / 2 for c in edge] for edge in shape["edges"])
        n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        middle = [shape["corner"][i] + a[i] + b[i] for i in range(3)]
        result[f"s{index}"] = {"type": "rectangle", "to_world": columns(a, b, n, middle), **common}
    elif kind == "box":
        result[f"s{index}"] = {"type": "cube", "to_world": columns(*shape["columns"], shape["center"]), **common}
    else:
        place = along(shape["base"], shape["top"], shape["radius"])
        result[f"s{index}"] = {"type": "cylinder", "to_world": place, **common}
        result[f"t{index}"] = {"type": "disk", "to_world": place @ T().translate([0, 0, 1]), **common}
        result[f"b{index}"] = {"type": "disk", "to_world": place @ T().rotate([1, 0, 0], 180), **common}


start = time.perf_counter()
camera = description["camera"]
everything = {
    "type": "scene",
    "integrator": {"type": "path", "max_depth": description["max_depth"], "rr_depth": 5},
    "sensor": {
        "type": "perspective",
        "fov": camera["fov"],
        "fov_axis": "y",
        "near_clip": 0.001,
        "to_world": T().look_at(origin=camera["eye"], target=camera["target"], up=[0, 1, 0]),
        "film": {"type": "hdrfilm", "width": description["size"], "height": description["size"], "rfilter": {"type": "box"}},
        "sampler": {"type": "independent", "sample_count": int(spp)},
    },
}
if description.get("environment"):
    everything["sky"] = {"type": "envmap", "filename": os.path.join(folder, description["environment_to_the_poles"])}
for name, m in description["materials"].items():
    everything[name] = {"id": name, **material(m)}
for index, shape in enumerate(description["shapes"]):
    add(everything, index, shape)
loaded = mi.load_dict(everything)
load = time.perf_counter() - start
extra = {"spp": int(spp)}


def draw(seed):
    start = time.perf_counter()
    picture = mi.Bitmap(mi.render(loaded, seed=seed, **extra))
    return picture, time.perf_counter() - start


warm = description["size"] > 0 and variant.startswith("llvm")
if warm:
    draw(int(seed) + 1000)
picture, seconds = draw(int(seed))
picture.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False).write(out)
print(json.dumps({"version": mi.__version__, "load": load, "render": seconds}))
