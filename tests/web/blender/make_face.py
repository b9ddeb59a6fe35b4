"""Makes a GLB such as faces come in: blender -b --factory-startup --python make_face.py -- OUT.glb

A head of two materials with textures, two UV sets and vertex colours, and a row of teeth, both with
shape keys and bound to a skeleton that nods; eyes that are bound but have no shape keys; a hat with
a shape key that is not bound but stands on a turned and scaled node of its own; a camera.
"""
import math
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Blender 3.4's glTF add-on predates numpy 1.24


def image(name, colour):
    picture = bpy.data.images.new(name, 32, 32)
    pixels = []
    for y in range(32):
        for x in range(32):
            shade = 0.8 if (x // 4 + y // 4) % 2 else 1.0
            pixels += [c * shade for c in colour] + [1.0]
    picture.pixels = pixels
    picture.pack()
    return picture


def material(name, colour, uv):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made["sheen"] = 0.25  # an extra that must come through
    nodes, links = made.node_tree.nodes, made.node_tree.links
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image(name + "_colour", colour)
    place = nodes.new("ShaderNodeUVMap")
    place.uv_map = uv
    links.new(place.outputs["UV"], texture.inputs["Vector"])
    links.new(texture.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.6
    return made


def sphere(n, place):
    """Six grids of n × n quads."""
    known, vertices, faces = {}, [], []

    def at(p):
        if p not in known:
            known[p] = len(vertices)
            q = Vector([math.tan((2 * c / n - 1) * math.pi / 4) for c in p]).normalized()
            vertices.append(place(q))
        return known[p]

    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    face = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, i + a, j + b
                        face.append(at(tuple(p)))
                    faces.append(face if side else face[::-1])
    return vertices, faces


def add(name, vertices, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    made = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(made)
    for layer, turn in (("UVMap", 0.0), ("Detail", 0.7)):
        uvs = mesh.uv_layers.new(name=layer)
        for loop in mesh.loops:
            p = mesh.vertices[loop.vertex_index].co
            around = math.atan2(p.x, -p.y + 1e-6) / (2 * math.pi) + 0.5
            uvs.data[loop.index].uv = ((around + turn) % 1.0, 0.5 + 0.3 * p.z)
    return made


def bump(p, centre, width):
    return math.exp(-(p - Vector(centre)).length_squared / width ** 2)


def shape(made, name, move):
    if not made.data.shape_keys:
        made.shape_key_add(name="Basis")
    key = made.shape_key_add(name=name)
    for point, vertex in zip(key.data, made.data.vertices):
        point.co = vertex.co + move(vertex.co)


def jaw_share(p):
    return 1 / (1 + math.exp(12 * (p.z + 0.35))) * (1 / (1 + math.exp(8 * (p.y + 0.1))))


def bind(made, skeleton, share):
    groups = {name: made.vertex_groups.new(name=name) for name in ("neck", "head", "jaw")}
    for vertex in made.data.vertices:
        for name, weight in share(vertex.co).items():
            if weight > 0:
                groups[name].add([vertex.index], weight, "REPLACE")
    made.parent = skeleton
    made.modifiers.new("Armature", "ARMATURE").object = skeleton


def make_skeleton():
    bones = bpy.data.armatures.new("skeleton")
    made = bpy.data.objects.new("skeleton", bones)
    bpy.context.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode="EDIT")
    places = {"neck": ((0, 0.1, -1.6), (0, 0.1, -0.9)), "head": ((0, 0.1, -0.9), (0, 0.1, 0.5)),
              "jaw": ((0, 0.1, -0.3), (0, -0.9, -0.8))}
    for name, (head, tail) in places.items():
        bone = bones.edit_bones.new(name)
        bone.head, bone.tail = head, tail
    bones.edit_bones["head"].parent = bones.edit_bones["neck"]
    bones.edit_bones["jaw"].parent = bones.edit_bones["head"]
    bpy.ops.object.mode_set(mode="POSE")
    head = made.pose.bones["head"]
    head.rotation_mode = "QUATERNION"
    for frame, angle in ((0, 0.0), (12, 0.2), (24, 0.0)):
        head.rotation_quaternion = (math.cos(angle / 2), math.sin(angle / 2), 0, 0)
        head.keyframe_insert("rotation_quaternion", frame=frame)
    made.animation_data.action.name = "nod"
    bpy.ops.object.mode_set(mode="OBJECT")
    return made


def make():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    skeleton = make_skeleton()

    def skull(q):
        nose = 0.25 * bump(q, (0, -1, -0.05), 0.2)
        return Vector((0.8 * q.x, 0.9 * q.y - nose, 1.1 * q.z))

    head = add("head", *sphere(16, skull))
    head.data.materials.append(material("skin", (0.9, 0.65, 0.5), "UVMap"))
    head.data.materials.append(material("lips", (0.8, 0.3, 0.3), "Detail"))
    for polygon in head.data.polygons:
        polygon.material_index = int(bump(polygon.center, (0, -0.85, -0.5), 0.3) > 0.4)
    colours = head.data.color_attributes.new("Tint", "BYTE_COLOR", "CORNER")
    for loop in head.data.loops:
        p = head.data.vertices[loop.vertex_index].co
        colours.data[loop.index].color = (1, 0.75 + 0.25 * p.z / 1.1, 0.75 + 0.25 * p.x, 1)
    shape(head, "jawOpen", lambda p: jaw_share(p) * Vector((0, 0.1, -0.35)))
    shape(head, "smile", lambda p: bump(p, (0.4, -0.7, -0.5), 0.3) * Vector((0.12, 0.05, 0.15))
          + bump(p, (-0.4, -0.7, -0.5), 0.3) * Vector((-0.12, 0.05, 0.15)))
    shape(head, "browUp", lambda p: bump(p, (0, -0.85, 0.4), 0.4) * Vector((0, 0, 0.1)))
    bind(head, skeleton, lambda p: {"jaw": 0.9 * jaw_share(p), "head": 1 - 0.9 * jaw_share(p) - 0.5 * max(0, -p.z - 0.7),
                                    "neck": 0.5 * max(0, -p.z - 0.7)})

    teeth = add("teeth", *sphere(4, lambda q: Vector((0.25 * q.x, -0.6 + 0.1 * q.y, -0.5 + 0.06 * q.z))))
    teeth.data.materials.append(material("enamel", (0.95, 0.95, 0.9), "UVMap"))
    shape(teeth, "jawOpen", lambda p: Vector((0, 0.1, -0.3)))
    shape(teeth, "bite", lambda p: Vector((0, -0.1 * (p.z + 0.5), 0.02)))
    bind(teeth, skeleton, lambda p: {"jaw": 1.0})

    for side in (-1, 1):
        eye = add("eye" + "LR"[side > 0],
                  *sphere(5, lambda q: Vector((0.3 * side, -0.72, 0.2)) + 0.14 * q))
        eye.data.materials.append(material("eye" + "LR"[side > 0], (0.9, 0.9, 1.0), "UVMap"))
        bind(eye, skeleton, lambda p: {"head": 1.0})

    hat = add("hat", *sphere(6, lambda q: Vector((q.x, q.y, 0.35 * q.z))))
    hat.data.materials.append(material("felt", (0.2, 0.3, 0.6), "UVMap"))
    shape(hat, "tilt", lambda p: Vector((0, 0, 0.2 * p.x)))
    hat.location, hat.scale, hat.rotation_euler = (0.1, 0.1, 1.1), (0.7, 0.75, 0.6), (0.1, 0.2, 0.5)

    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0, -7, 0), (math.pi / 2, 0, 0)
    bpy.context.collection.objects.link(camera)
    bpy.context.scene["studio"] = "sweepface"


make()
bpy.ops.export_scene.gltf(filepath=sys.argv[-1], export_format="GLB", export_morph=True,
                          export_morph_normal=True, export_skins=True, export_extras=True,
                          export_cameras=True, export_animations=True, export_yup=True)
