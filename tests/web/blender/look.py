"""What Blender makes of a GLB: blender -b --factory-startup --python look.py -- IN.glb OUT.json [WEIGHTS OUT.png]

Writes the shape keys of every mesh and their values at every frame of the animations; or, at weights
and with the jaw bone turned, the vertices, and renders a small picture.
"""
import json
import sys

import bpy
import numpy
from mathutils import Matrix

numpy.bool = bool  # Blender 3.4's glTF add-on predates numpy 1.24

source, report, *rest = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=source)
scene = bpy.context.scene
meshes = [o for o in scene.objects if o.type == "MESH"]
said = {"meshes": {}}
for each in meshes:
    keys = each.data.shape_keys
    said["meshes"][each.data.name] = {
        "keys": [k.name for k in keys.key_blocks[1:]] if keys else [],
        "materials": [m.name for m in each.data.materials],
        "uvs": len(each.data.uv_layers),
        "groups": [g.name for g in each.vertex_groups],
        "frames": [],
    }
if not rest:
    for each in meshes:  # the importer sets aside all animations but the first
        keys = each.data.shape_keys
        if keys and keys.animation_data and keys.animation_data.nla_tracks:
            keys.animation_data.action = keys.animation_data.nla_tracks[0].strips[0].action
            keys.animation_data.nla_tracks[0].mute = True
    last = max((int(round(a.frame_range[1])) for a in bpy.data.actions), default=0)
    for frame in range(last + 1):
        scene.frame_set(frame)
        for each in meshes:
            keys = each.data.shape_keys
            if keys:
                said["meshes"][each.data.name]["frames"].append([k.value for k in keys.key_blocks[1:]])
else:
    weights = dict((n, float(w)) for n, w in (p.split("=") for p in rest[0].split(",")))
    for each in scene.objects:  # the jaw bone turned, without animations
        each.animation_data_clear()
        if each.pose:
            for bone in each.pose.bones:
                bone.matrix_basis = Matrix.Rotation(0.2 if bone.name == "jaw" else 0, 4, "X")
    for each in meshes:
        keys = each.data.shape_keys
        if keys:
            keys.animation_data_clear()
            for key in keys.key_blocks[1:]:
                key.value = weights.get(key.name, 0)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    for each in meshes:
        shown = each.evaluated_get(depsgraph)
        said["meshes"][each.data.name]["vertices"] = [
            list(shown.matrix_world @ v.co) for v in shown.to_mesh().vertices]
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.rotation_euler, sun.data.energy = (0.9, 0.3, 0), 3
    scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new("world")
    if not scene.camera:
        scene.camera = next(o for o in scene.objects if o.type == "CAMERA")
    scene.render.engine = "CYCLES"
    scene.cycles.use_denoising = False
    scene.cycles.device, scene.cycles.samples, scene.cycles.seed = "CPU", 16, 1
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 240, 240, 100
    scene.render.image_settings.color_mode = "RGB"
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.render.filepath = rest[1]
    bpy.ops.render.render(write_still=True)
with open(report, "w") as out:
    json.dump(said, out)
