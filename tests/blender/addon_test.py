"""The add-on in Blender: blender -b --factory-startup --python-exit-code 1 --python addon_test.py -- TOOL"""

import csv
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from types import SimpleNamespace

import bpy
import numpy
from mathutils import Vector
from mathutils.kdtree import KDTree

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../blender"))
import sweepface_io as addon  # noqa: E402

TOOL = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
TOLERANCE = 1e-3


def tool(*arguments):
    return subprocess.run([TOOL, *map(str, arguments)], check=True, capture_output=True, encoding="utf-8").stdout


class Watched:
    """An operator as the user starts it, but without Blender, which has no windows here: tests send its events."""

    def __init__(self, **properties):
        self.reports = []
        self.__dict__.update(properties)
        self.steps = self.work_in_folder(bpy.context, is_watched=True)
        self.result = self.step()

    def report(self, level, text):
        self.reports.append((*level, text))

    def send(self, kind, value="NOTHING"):
        self.result = self.modal(bpy.context, SimpleNamespace(type=kind, value=value))
        return self.result

    def wait(self):
        """Lets time pass until Blender may forget the operator; returns its result."""
        while self in addon.WAITING:
            self.process.wait(60)
            self.send("TIMER")
        return self.send("MOUSEMOVE") if self.is_done else self.result


def watched(kind, **properties):
    functions = {"work": kind.work, "bl_label": kind.bl_label}
    return type(kind.__name__, (Watched, kind.__bases__[0]), functions)(**properties)


class InBlender(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.preferences.addon_enable(module=addon.__name__)
        bpy.context.preferences.addons[addon.__name__].preferences.tool = TOOL
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        """Writes a file into the test's folder; returns its path."""
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def sheet(self):
        """A sheet of 6 x 6 quads, standing upright, with shape keys; the active object."""
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=6, y_subdivisions=6, rotation=(1.5, 0.2, 0.1), scale=(2, 3, 1))
        shown = bpy.context.active_object
        for name in ("skin", "lips"):
            shown.data.materials.append(bpy.data.materials.new(name))
        shown.data.polygons[7].material_index = 1
        shown.shape_key_add(name="Basis")
        for name, height in (("jawOpen", 0.2), ("smile", 0.1)):
            for point in shown.shape_key_add(name=name, from_mix=False).data:
                point.co.z += height * (1 - point.co.x**2) * (1 + point.co.y)
        return shown

    def saved(self, shown, **options):
        """Saves an object as a face; returns a folder of its meshes."""
        bpy.context.view_layer.objects.active = shown
        face, meshes = self.path("face.sweep"), self.path("meshes")
        self.assertEqual(bpy.ops.export_scene.sweep(filepath=face, tolerance=TOLERANCE, **options), {"FINISHED"})
        tool("export", face, "-o", meshes)
        return meshes

    def face(self):
        """A sheet that was saved as a face, so that it can move; the active object."""
        shown = self.sheet()
        self.saved(shown, pack=False)
        return shown

    def told(self, kind, **properties):
        """Runs an operator as the user starts it; returns what it reports."""
        if kind is addon.PlayClip:
            properties = {"smooth": False, "combine": False, "names": ""} | properties
        job = watched(kind, **properties)
        job.wait()
        return job.reports

    def assert_moves(self, names):
        """Checks that the active object has these targets, and that they move."""
        keys = addon.keys_of(bpy.context.active_object)
        self.assertEqual(set(keys), names)
        bpy.context.scene.frame_set(24)
        for key in keys.values():
            key.value = 0.5
        bpy.ops.object.sweepface_move(law="linear", seconds=1)
        for key in keys.values():
            self.assertAlmostEqual(addon.curve_of(key).evaluate(12), 0.25, places=5)

    def assert_near(self, found, expected, within=TOLERANCE):
        self.assertEqual(numpy.shape(found), numpy.shape(expected))
        self.assertLessEqual(abs(numpy.subtract(found, expected)).max(), within)

    def assert_refused(self, call, part):
        with self.assertRaisesRegex(RuntimeError, part):
            call()

    def expected(self, shown, places):
        """Positions as Blender has them, but with y up as in the file instead of z."""
        world = [shown.matrix_world @ vector for vector in map(Vector, places)]
        return [(p.x, p.z, -p.y) for p in world]


class AddOn(InBlender):
    def test_saves_shape_keys_as_targets(self):
        shown = self.sheet()
        for pack in (False, True):
            meshes = self.saved(shown, pack=pack)
            self.assertEqual(sorted(os.listdir(os.path.join(meshes, "expressions"))), ["jawOpen.obj", "smile.obj"])
            keys = shown.data.shape_keys.key_blocks
            for name, file in (("Basis", "neutral"), ("jawOpen", "expressions/jawOpen"), ("smile", "expressions/smile")):
                found = addon.places_in(os.path.join(meshes, file + ".obj"))
                self.assert_near(found, self.expected(shown, [p.co for p in keys[name].data]))
            info = json.loads(tool("info", self.path("face.sweep"), "--json"))
            self.assertAlmostEqual(info["tolerance"], TOLERANCE, places=8)

    def test_saves_the_limit_of_a_cage(self):
        shown = self.sheet()
        self.assertEqual(addon.levels_of(shown), 0)
        modifier = shown.modifiers.new(name="Smooth", type="SUBSURF")
        modifier.levels, modifier.boundary_smooth = 1, "PRESERVE_CORNERS"
        self.assertEqual(addon.levels_of(shown), 1)
        meshes = self.saved(shown, pack=False, subdivide=1)
        shown.data.shape_keys.key_blocks["smile"].value = 1
        mesh = shown.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
        places = self.expected(shown, [vertex.co for vertex in mesh.vertices])
        found = addon.places_in(os.path.join(meshes, "expressions/smile.obj"))
        self.assertEqual(len(found), len(places))
        tree = KDTree(len(places))
        for k, place in enumerate(places):
            tree.insert(place, k)
        tree.balance()
        self.assertLessEqual(max(tree.find(place)[2] for place in found), 2 * TOLERANCE)
        self.assertEqual(len({tree.find(place)[1] for place in found}), len(places))

    def test_a_cage_has_the_levels_of_its_modifier_and_two_at_most(self):
        shown = self.sheet()
        modifier = shown.modifiers.new(name="Smooth", type="SUBSURF")
        modifier.levels = 3
        self.assertEqual(addon.levels_of(shown), 2)
        modifier.subdivision_type = "SIMPLE"
        self.assertEqual(addon.levels_of(shown), 0)
        modifier.subdivision_type, modifier.show_viewport = "CATMULL_CLARK", False
        self.assertEqual(addon.levels_of(shown), 0)

    def test_saves_the_texture_coordinates_that_are_active(self):
        shown = self.sheet()
        shown.data.uv_layers.new(name="other")
        shown.data.uv_layers.active_index = 1
        for place in shown.data.uv_layers[1].data:
            place.uv = (0.25, 0.75)
        self.saved(shown, pack=False)
        bpy.ops.import_scene.sweep(filepath=self.path("face.sweep"))
        layer = bpy.context.active_object.data.uv_layers[0]
        self.assert_near([place.uv for place in layer.data], [(0.25, 0.75)] * len(layer.data), 1e-5)

    def test_names_of_materials_continue_no_line(self):
        shown = self.sheet()
        shown.data.materials[1].name = "lips\\"
        self.saved(shown, pack=False)
        bpy.ops.import_scene.sweep(filepath=self.path("face.sweep"))
        opened = bpy.context.active_object.data
        self.assertEqual([material.name for material in opened.materials], ["skin", "lips"])
        self.assertEqual(len(opened.polygons), 36)

    def test_saves_what_a_key_adds_to_another_and_where_its_group_lets_it(self):
        shown = self.sheet()
        keys = shown.data.shape_keys.key_blocks
        keys["smile"].relative_key = keys["jawOpen"]
        group = shown.vertex_groups.new(name="left")
        group.add(range(20, 30), 0.5, "REPLACE")
        keys["smile"].vertex_group = "left"
        found = addon.places_in(os.path.join(self.saved(shown, pack=False), "expressions/smile.obj"))
        expected = []
        for k, (rest, jaw, smile) in enumerate(zip(*(keys[n].data for n in ("Basis", "jawOpen", "smile")))):
            expected.append(rest.co + (0.5 if 20 <= k < 30 else 0) * (smile.co - jaw.co))
        self.assert_near(found, self.expected(shown, expected))

    def test_a_mirrored_object_is_not_inside_out(self):
        shown = self.sheet()
        normals = []
        for scale in (1, -1):
            shown.scale.x = 2 * scale
            bpy.context.view_layer.update()
            neutral = os.path.join(self.saved(shown, pack=False), "neutral.obj")
            normals.append(addon.numbers_of(addon.read_lines(neutral), "vn").mean(axis=0))
        self.assertGreater(normals[0] @ normals[1], 0.9)

    def test_opens_what_it_saved(self):
        shown = self.sheet()
        meshes = self.saved(shown, pack=False)
        shown.select_set(True)
        self.assertEqual(bpy.ops.import_scene.sweep(filepath=self.path("face.sweep")), {"FINISHED"})
        opened = bpy.context.active_object
        self.assertIsNot(opened, shown)
        self.assertEqual(bpy.context.selected_objects, [opened])
        self.assertTrue(all(polygon.use_smooth for polygon in opened.data.polygons))
        self.assertEqual([key.name for key in opened.data.shape_keys.key_blocks], ["Basis", "jawOpen", "smile"])
        self.assertEqual([m.name for m in opened.data.materials], ["skin", "lips"])
        self.assertEqual([p.material_index for p in opened.data.polygons], [p.material_index for p in shown.data.polygons])
        for before, after in zip(shown.data.polygons, opened.data.polygons):
            self.assertEqual(list(before.vertices), list(after.vertices))
            for k, m in zip(before.loop_indices, after.loop_indices):
                self.assert_near(opened.data.uv_layers[0].data[m].uv, shown.data.uv_layers[0].data[k].uv, 1e-6)
        for key in opened.data.shape_keys.key_blocks:
            file = "neutral" if key.name == "Basis" else f"expressions/{key.name}"
            self.assert_near([p.co for p in key.data], addon.places_in(os.path.join(meshes, file + ".obj")), 1e-6)
        for a, b in zip(shown.data.vertices, opened.data.vertices):
            self.assert_near(opened.matrix_world @ b.co, shown.matrix_world @ a.co)

    def test_opens_finer_meshes(self):
        self.saved(self.sheet(), pack=False)
        bpy.ops.import_scene.sweep(filepath=self.path("face.sweep"), lod=3)
        opened = bpy.context.active_object
        self.assertEqual(len(opened.data.polygons), 9 * 36)
        self.assertEqual(len(opened.data.shape_keys.key_blocks), 3)

    def test_a_face_that_is_opened_in_edit_mode_becomes_active(self):
        self.face()
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.import_scene.sweep(filepath=self.path("face.sweep"))
        self.assertEqual((bpy.context.active_object.name, bpy.context.mode), ("face", "OBJECT"))

    def test_only_meshes_are_saved_and_only_faces_move(self):
        bpy.ops.object.empty_add()
        self.assertFalse(bpy.ops.export_scene.sweep.poll())
        self.sheet()
        self.assertTrue(bpy.ops.export_scene.sweep.poll())
        self.assertFalse(bpy.ops.object.sweepface_move.poll())

    def test_says_what_is_wrong(self):
        shown = self.sheet()
        self.write("bad.sweep", "GIF")
        self.assert_refused(lambda: bpy.ops.import_scene.sweep(filepath=self.path("bad.sweep")), "does not begin with")
        save = lambda: bpy.ops.export_scene.sweep(filepath=self.path("face.sweep"))
        key = shown.data.shape_keys.key_blocks["smile"]
        key.name = "a/b"
        self.assert_refused(save, "The shape key 'a/b' cannot be the name of a target")
        shown.data.shape_keys.use_relative = False
        self.assert_refused(save, "shape keys of Grid are absolute")
        self.assertFalse(os.path.exists(self.path("face.sweep")))
        preferences = bpy.context.preferences.addons[addon.__name__].preferences
        preferences.tool = "/nowhere/sweepface"
        self.addCleanup(setattr, preferences, "tool", TOOL)
        self.assert_refused(lambda: bpy.ops.import_scene.sweep(filepath=self.path("bad.sweep")), "Cannot run /nowhere/sweepface")

    def test_moves_to_the_pose_of_the_sliders(self):
        shown = self.face()
        self.assertFalse(addon.curve_of(shown.data.shape_keys.key_blocks["smile"]))
        scene, blocks = bpy.context.scene, shown.data.shape_keys.key_blocks
        scene.render.fps = 30
        scene.frame_set(40)
        blocks["jawOpen"].value = 0.8
        bpy.ops.object.sweepface_move(law="accelerate-brake", seconds=1)
        curve = addon.curve_of(blocks["jawOpen"])
        self.assertFalse(addon.curve_of(blocks["smile"]), "it rests")
        for frame in range(10, 41):
            t = (frame - 10) / 30
            expected = 0.8 * (2 * t * t if t < 0.5 else 1 - 2 * (1 - t) ** 2)
            self.assertAlmostEqual(curve.evaluate(frame), expected, places=5)
        scene.frame_set(55)  # from the current pose to another
        blocks["jawOpen"].value, blocks["smile"].value = 0.2, 1
        bpy.ops.object.sweepface_move(law="newton", seconds=0.5)
        for frame in range(40, 56):
            t = (frame - 40) / 15
            self.assertAlmostEqual(curve.evaluate(frame), 0.8 - 0.6 * t * t, places=5)
            self.assertAlmostEqual(addon.curve_of(blocks["smile"]).evaluate(frame), t * t, places=5)
        scene.frame_set(70)
        self.assert_refused(lambda: bpy.ops.object.sweepface_move(seconds=0.5), "in this pose already")

    def test_frames_may_be_of_any_length(self):
        shown = self.face()
        scene, key = bpy.context.scene, shown.data.shape_keys.key_blocks["smile"]
        scene.render.fps, scene.render.fps_base = 24, 2
        scene.frame_set(24)
        key.value = 1
        bpy.ops.object.sweepface_move(law="linear", seconds=1)
        self.assertAlmostEqual(addon.curve_of(key).evaluate(18), 0.5, places=5)

    def test_what_was_before_and_behind_a_motion_stays(self):
        shown = self.face()
        scene, keys = bpy.context.scene, shown.data.shape_keys.key_blocks
        scene.frame_set(24)
        keys["jawOpen"].value = 1
        bpy.ops.object.sweepface_move(law="accelerate-brake", seconds=1)
        curve = addon.curve_of(keys["jawOpen"])
        keys["jawOpen"].keyframe_insert("value", frame=40)
        before = [curve.evaluate(frame) for frame in range(9)]
        scene.frame_set(20)
        keys["jawOpen"].value = 0
        bpy.ops.object.sweepface_move(law="newton", seconds=0.5)  # from frame 8 on
        self.assert_near([curve.evaluate(frame) for frame in range(9)], before, 1e-4)
        self.assertAlmostEqual(curve.evaluate(14), before[8] * 0.75, places=4)
        self.assertAlmostEqual(curve.evaluate(20), 0, places=5)
        self.assertAlmostEqual(curve.evaluate(40), 1, places=5)

    def test_a_straight_line_behind_the_last_key_stays_until_the_motion(self):
        key = self.face().data.shape_keys.key_blocks["jawOpen"]
        for frame, value in ((0, 0), (10, 0.2)):
            key.value = value
            key.keyframe_insert("value", frame=frame)
        curve = addon.curve_of(key)
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
        curve.extrapolation = "LINEAR"
        bpy.context.scene.frame_set(44)
        before = [curve.evaluate(frame) for frame in range(21)]
        key.value = 0
        bpy.ops.object.sweepface_move(law="linear", seconds=1)  # from frame 20 on
        self.assert_near([curve.evaluate(frame) for frame in range(21)], before, 1e-4)

    def test_keys_set_by_hand_stay_as_they_were(self):
        shown = self.face()
        scene, keys = bpy.context.scene, shown.data.shape_keys.key_blocks
        for kind in ("AUTO_CLAMPED", "AUTO", "VECTOR", "ALIGNED", "CONSTANT", "LINEAR", "BOUNCE", "ELASTIC", "BACK", "SINE"):
            shown.data.shape_keys.animation_data_clear()
            for frame, value in ((0, 0.1), (10, 0.8), (30, 0.2), (60, 0.9), (80, 0.1)):
                keys["jawOpen"].value = value
                keys["jawOpen"].keyframe_insert("value", frame=frame)
            curve = addon.curve_of(keys["jawOpen"])
            for point in curve.keyframe_points:
                if kind in ("AUTO_CLAMPED", "AUTO", "VECTOR", "ALIGNED"):
                    point.handle_left_type = point.handle_right_type = kind
                else:
                    point.interpolation = kind
            curve.update()
            frames = range(-5, 23)
            before, behind = [curve.evaluate(frame) for frame in frames], [curve.evaluate(frame) for frame in range(60, 90)]
            scene.frame_set(46)
            keys["jawOpen"].value = 0.5
            bpy.ops.object.sweepface_move(law="linear-force", seconds=1)  # from frame 22 on
            self.assert_near([curve.evaluate(frame) for frame in frames], before, 1e-3)
            self.assert_near([curve.evaluate(frame) for frame in range(60, 90)], behind, 1e-5)
            self.assertAlmostEqual(curve.evaluate(46), 0.5, places=5)

    def test_what_was_before_stays_beside_and_without_keys_there(self):
        key = self.face().data.shape_keys.key_blocks["jawOpen"]
        self.write("take.csv", "Timecode,JawOpen\n0,0\n1,0.5\n")
        for hand, subframe in ((10, 0.02), (10, 0.015), (60, 0)):  # a key right before the clip, or far behind it
            key.id_data.animation_data_clear()
            key.value = 0.9
            key.keyframe_insert("value", frame=hand)
            bpy.context.scene.frame_set(10, subframe=subframe)
            bpy.ops.object.sweepface_clip(filepath=self.path("take.csv"))
            curve = addon.curve_of(key)
            self.assert_near([curve.evaluate(frame) for frame in (-5, 9, 9.9)], [0.9] * 3, 1e-6)
            self.assertAlmostEqual(curve.evaluate(22), 0.25, delta=0.003)
            self.assertAlmostEqual(curve.evaluate(60), 0.9 if hand == 60 else 0.5, places=5)

    def test_a_motion_may_begin_right_behind_a_key(self):
        shown = self.face()
        scene, key = bpy.context.scene, shown.data.shape_keys.key_blocks["jawOpen"]
        for seconds in (0.333, 1 / 3, 0.3326):
            shown.data.shape_keys.animation_data_clear()
            scene.frame_set(10)
            key.value = 1
            bpy.ops.object.sweepface_move(law="accelerate-brake", seconds=0.25)
            scene.frame_set(18)
            key.value = 0
            bpy.ops.object.sweepface_move(law="accelerate-brake", seconds=seconds)
            curve = addon.curve_of(key)
            for frame in range(10, 19):
                t = (frame - 18) / 24 / seconds + 1
                expected = 1 - (2 * t * t if t < 0.5 else 1 - 2 * (1 - t) ** 2) if t > 0 else 1
                self.assertAlmostEqual(curve.evaluate(frame), expected, delta=0.004, msg=(seconds, frame))

    def test_a_motion_is_done_again_otherwise(self):
        shown = self.face()
        key = shown.data.shape_keys.key_blocks["smile"]
        bpy.context.scene.frame_set(24)
        key.value = 0.8
        pose = json.dumps({"jawOpen": 0, "smile": key.value})
        key.value = 0  # as undoing leaves it
        bpy.ops.object.sweepface_move(law="linear", seconds=0.5, pose=pose)
        self.assertAlmostEqual(addon.curve_of(key).evaluate(18), 0.4, places=5)

    def test_what_rests_in_a_motion_has_no_other_keys_meanwhile(self):
        shown = self.face()
        scene, keys = bpy.context.scene, shown.data.shape_keys.key_blocks
        for frame, value in ((0, 0), (12, 1), (24, 0)):
            keys["jawOpen"].value = value
            keys["jawOpen"].keyframe_insert("value", frame=frame)
        scene.frame_set(24)
        keys["smile"].value = 1
        bpy.ops.object.sweepface_move(law="linear", seconds=1)
        self.assertEqual(addon.curve_of(keys["jawOpen"]).evaluate(12), 0)
        self.assertAlmostEqual(addon.curve_of(keys["smile"]).evaluate(12), 0.5, places=5)

    def test_keys_that_the_file_lacks_are_told(self):
        shown = self.face()
        bpy.context.scene.frame_set(24)
        shown.shape_key_add(name="wink", from_mix=False).value = 0.5
        self.assert_refused(lambda: bpy.ops.object.sweepface_move(), "has no targets for wink; save the face again")

    def test_names_that_no_list_of_weights_can_have_are_told(self):
        shown = self.sheet()
        key = shown.data.shape_keys.key_blocks["smile"]
        key.name = "a, b"
        self.saved(shown, pack=False)
        bpy.context.scene.frame_set(24)
        key.value = 1
        self.assert_refused(lambda: bpy.ops.object.sweepface_move(), "'a, b' has a comma or a blank at an end; rename it")

    def test_curves_that_cannot_be_changed_are_told(self):
        shown = self.face()
        scene, keys = bpy.context.scene, shown.data.shape_keys.key_blocks
        keys["jawOpen"].keyframe_insert("value", frame=0, group="mouth")
        curve = addon.curve_of(keys["jawOpen"])
        scene.frame_set(24)
        keys["smile"].value = 1
        for locked in (curve, curve.group):
            locked.lock = True
            self.assert_refused(lambda: bpy.ops.object.sweepface_move(), "The F-curve of jawOpen is locked")
            locked.lock = False
        curve.modifiers.new("NOISE")
        self.assert_refused(lambda: bpy.ops.object.sweepface_move(), "The F-curve of jawOpen has modifiers")
        animation = shown.data.shape_keys.animation_data
        animation.nla_tracks.new().strips.new("old", 0, animation.action)
        self.assert_refused(lambda: bpy.ops.object.sweepface_clip(filepath="take.csv"), "are moved by NLA strips")
        self.assertIsNone(addon.curve_of(keys["smile"]))

    def test_strips_that_are_muted_are_in_nobodys_way(self):
        shown = self.face()
        keys = shown.data.shape_keys.key_blocks
        keys["jawOpen"].keyframe_insert("value", frame=0)
        animation = shown.data.shape_keys.animation_data
        track = animation.nla_tracks.new()
        track.strips.new("old", 0, animation.action)
        track.mute = True
        bpy.context.scene.frame_set(24)
        keys["smile"].value = 1
        bpy.ops.object.sweepface_move(law="linear", seconds=1)
        self.assertAlmostEqual(addon.curve_of(keys["smile"]).evaluate(12), 0.5, places=5)

    def test_what_is_linked_from_another_file_is_told(self):
        self.face()
        bpy.ops.wm.save_as_mainfile(filepath=self.path("face.blend"))
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.preferences.addon_enable(module=addon.__name__)
        with bpy.data.libraries.load(self.path("face.blend"), link=True) as (there, here):
            here.objects = there.objects
        [shown] = here.objects
        bpy.context.collection.objects.link(shown)
        bpy.context.view_layer.objects.active = shown
        self.assert_refused(lambda: bpy.ops.object.sweepface_clip(filepath="take.csv"), "Grid is linked from another file; make it local")

    def test_what_moves_otherwise_than_by_keys_is_told(self):
        shown = self.face()
        keys = shown.data.shape_keys.key_blocks
        keys["smile"].driver_add("value").driver.expression = "0.25"
        take = self.write("take.csv", "Timecode,JawOpen,smile\n0,0,0\n1,0.5,1\n")
        told = [("WARNING", "Drivers move the shape keys smile, whatever their keys say.")]
        self.assertEqual(self.told(addon.PlayClip, filepath=take), told)
        shown.shape_key_remove(keys["jawOpen"])
        self.assertEqual(self.told(addon.PlayClip, filepath=take), [("WARNING", "There are no shape keys jawOpen."), *told])

    def test_advice_that_nobody_can_follow_is_not_told(self):
        self.face()
        take = self.write("take.csv", "Timecode,JawOpen,smile,HeadYaw\n0,0,0,0\n1,0.5,1,0.3\n")
        self.assertEqual(self.told(addon.PlayClip, filepath=take), [])

    def test_faces_of_several_meshes_and_animations_of_their_own_move(self):
        for name in ("head", "teeth"):
            shown = self.sheet()
            shown.name = shown.data.name = name
            if name == "teeth":
                shown.data.shape_keys.key_blocks["jawOpen"].name = "bite"
        keys = bpy.data.objects["teeth"].data.shape_keys
        keys.key_blocks["bite"].keyframe_insert("value", frame=0)
        bpy.data.objects["head"].keyframe_insert("location", frame=0)
        numpy.bool = bool  # Blender 3.4's glTF add-on predates numpy 1.24, which removed it
        bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
        bpy.ops.export_scene.gltf(filepath=self.path("two.glb"))
        tool("convert", self.path("two.glb"), "-o", self.path("two.sweep"))
        bpy.ops.import_scene.sweep(filepath=self.path("two.sweep"))
        self.assert_moves({"jawOpen", "smile", "bite"})

    def test_targets_that_blender_calls_otherwise_move(self):
        odd = ["Basis", "j" * 70]
        self.face()
        tool("export", self.path("face.sweep"), "-o", self.path("odd"))
        for name, other in zip(("jawOpen", "smile"), odd):
            os.rename(self.path(f"odd/expressions/{name}.obj"), self.path(f"odd/expressions/{other}.obj"))
        tool("convert", self.path("odd/neutral.obj"), self.path("odd/expressions"), "-o", self.path("odd.sweep"))
        bpy.ops.import_scene.sweep(filepath=self.path("odd.sweep"))
        self.assert_moves(set(odd))

    def test_cuts_of_a_timeline_are_between_two_frames(self):
        shown = self.face()
        with open(self.path("line.json"), "w", encoding="utf-8") as file:
            json.dump({"seconds": 2, "events": [{"at": 1, "to": {"smile": 1}, "drive": "cut"},
                                                {"at": 1.5, "to": {"jawOpen": 1}, "drive": "newton", "seconds": 0.5}]}, file)
        bpy.context.scene.frame_set(0)
        bpy.ops.object.sweepface_clip(filepath=self.path("line.json"))
        smile, jaw = (addon.curve_of(shown.data.shape_keys.key_blocks[name]) for name in ("smile", "jawOpen"))
        for frame in range(49):
            self.assertAlmostEqual(smile.evaluate(frame), float(frame >= 24), delta=0.01, msg=frame)
            self.assertAlmostEqual(jaw.evaluate(frame), max(0, (frame - 36) / 12) ** 2, delta=0.005, msg=frame)

    def test_a_timeline_of_regions_is_told(self):
        self.face()
        line = self.write("line.json", json.dumps(
            {"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}, "region": "a"}],
             "regions": [{"name": "a", "points": [[0, 0, 0]], "over": "space", "whole": 0.5, "fade": 1}]}))
        self.assert_refused(lambda: bpy.ops.object.sweepface_clip(filepath=line), "cannot show the regions of a timeline")

    def test_faces_with_a_corner_twice_can_be_edited(self):
        with open(self.path("odd.obj"), "w", encoding="utf-8") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                       "f 1/1 2/2 3/3 4/4\nf 2/1 5/2 5/2 3/3\nf 1 2 1\n")
        tool("convert", self.path("odd.obj"), "-o", self.path("odd.sweep"))
        bpy.ops.import_scene.sweep(filepath=self.path("odd.sweep"))
        shown = bpy.context.object.data
        self.assertEqual(sorted(len(polygon.vertices) for polygon in shown.polygons), [3, 4])
        self.assertEqual(len(shown.uv_layers[0].data), 7)
        self.assertFalse(shown.validate())  # nothing to mend

    def test_saves_in_edit_mode_and_in_the_order_of_keys(self):
        shown = self.sheet()
        for name in ("zeta", "alpha"):
            shown.shape_key_add(name=name, from_mix=False).data[24].co.z += 0.5
        bpy.ops.object.mode_set(mode="EDIT")
        self.saved(shown, pack=False)
        self.assertEqual(shown.mode, "EDIT")
        targets = json.loads(tool("info", self.path("face.sweep"), "--json"))["targets"]
        self.assertEqual(targets, ["jawOpen", "smile", "zeta", "alpha"])

    def test_a_spring_overshoots(self):
        shown = self.face()
        key = shown.data.shape_keys.key_blocks["smile"]
        bpy.context.scene.frame_set(24)
        key.value = 1
        bpy.ops.object.sweepface_move(law="spring", seconds=1, frequency=2, damping=0.2)
        bpy.context.scene.frame_set(6)  # half a swing
        self.assertGreater(key.value, 1.4)
        for frequency, damping in ((2, 0.2), (0.5, 0.5), (2, 5)):
            bpy.context.scene.frame_set(60)
            key.value = 0.8
            bpy.ops.object.sweepface_move(law="spring", seconds=0.5, frequency=frequency, damping=damping)
            for frame in (60, 90):
                self.assertAlmostEqual(addon.curve_of(key).evaluate(frame), 0.8, places=5)

    def test_a_spring_that_is_still_far_away_is_told(self):
        key = self.face().data.shape_keys.key_blocks["smile"]
        bpy.context.scene.frame_set(24)
        key.value = 1
        [(_, text)] = self.told(addon.MoveToPose, law="spring", seconds=0.3, frequency=1, damping=0.1, pose="")
        self.assertRegex(text, "^The spring is .* away from smile when the time is over; give it more seconds")

    def test_a_bounce_keeps_the_speed_that_it_is_told(self):
        key = self.face().data.shape_keys.key_blocks["smile"]
        bpy.context.scene.frame_set(48)
        key.value = 1
        bpy.ops.object.sweepface_move(law="bounce", seconds=1, restitution=0.8)
        # It hits after 1/9 of the time, and keeps 0.8 ** 2 of the height.
        self.assertAlmostEqual(addon.curve_of(key).evaluate(24 + 24 / 9 * 1.8), 1 - 0.8**2, delta=0.01)

    def test_a_clip_is_smoothed_and_combined_if_it_is_asked_for(self):
        shown = self.sheet()
        shown.shape_key_add(name="jawOpen_smile", from_mix=False).data[24].co.z += 0.5
        self.saved(shown, pack=False)
        rows = "".join(f"{k / 24:.6f},{0.5 + 0.05 * (-1) ** k},0.5\n" for k in range(25))
        take = self.write("take.csv", "Timecode,jawOpen,smile\n" + rows)
        keys = shown.data.shape_keys.key_blocks
        for is_asked in (False, True):
            bpy.ops.object.sweepface_clip(filepath=take, smooth=is_asked, combine=is_asked)
            curve, both = (addon.curve_of(keys[name]) for name in ("jawOpen", "jawOpen_smile"))
            middle = bpy.context.scene.frame_current + 12
            self.assertEqual(abs(curve.evaluate(middle) - curve.evaluate(middle + 1)) < 0.06, is_asked)
            self.assertEqual(bool(both), is_asked)
        self.assertAlmostEqual(both.evaluate(middle), 0.25, delta=0.03)

    def test_a_slider_without_keys_follows_a_clip_in_which_it_rests(self):
        key = self.face().data.shape_keys.key_blocks["smile"]
        key.value = 0.5
        bpy.ops.object.sweepface_clip(filepath=self.write("take.csv", "Timecode,JawOpen,smile\n0,0,0\n1,0.5,0\n"))
        self.assertEqual(addon.curve_of(key).evaluate(5), 0)

    def test_plays_a_clip_instead_of_what_was_there(self):
        shown = self.face()
        rows = [[f"{k / 24:.6f}", 2, 0.1 * (k % 7), -0.05 * k] for k in range(25)]
        with open(self.path("take.csv"), "w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([["Timecode", "BlendShapeCount", "JawOpen", "smile"], *rows])
        scene, blocks = bpy.context.scene, shown.data.shape_keys.key_blocks
        scene.frame_end = 20
        scene.frame_set(10)
        blocks["jawOpen"].keyframe_insert("value", frame=20)
        bpy.ops.object.sweepface_clip(filepath=self.path("take.csv"))
        for k, (_, _, jaw, smile) in enumerate(rows):
            self.assertAlmostEqual(addon.curve_of(blocks["jawOpen"]).evaluate(10 + k), jaw, delta=0.003)
            self.assertAlmostEqual(addon.curve_of(blocks["smile"]).evaluate(10 + k), smile, delta=0.003)
        self.assertEqual(scene.frame_end, 34)
        self.write("names.json", '{"jawOpen": "smile", "smile": null}')
        scene.frame_set(50)
        bpy.ops.object.sweepface_clip(filepath=self.path("take.csv"), names=self.path("names.json"))
        self.assertAlmostEqual(addon.curve_of(blocks["smile"]).evaluate(56), 0.6, delta=0.003)
        scene.frame_set(34)
        self.assertAlmostEqual(blocks["smile"].value, -1.2, delta=0.003)


class WhileTheToolRuns(InBlender):
    """What the user may do meanwhile, and what may go wrong."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.path("temporary"))
        before = tempfile.tempdir
        tempfile.tempdir = self.path("temporary")
        self.addCleanup(setattr, tempfile, "tempdir", before)

    def tearDown(self):
        self.assertEqual(addon.WAITING, [])
        self.assertEqual(os.listdir(self.path("temporary")), [])

    def tool(self, lines):
        """Has the add-on run a script instead of the tool, in the test's folder."""
        path = self.path("tool")
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"#!/bin/sh\ncd {self.folder.name}\n{lines}\n")
        os.chmod(path, 0o755)
        bpy.context.preferences.addons[addon.__name__].preferences.tool = path

    def await_file(self, name):
        end = time.monotonic() + 60
        while not os.path.exists(self.path(name)) and time.monotonic() < end:
            time.sleep(0.01)

    def await_and_remove(self, name):
        self.await_file(name)
        os.remove(self.path(name))

    def export(self, **options):
        """Begins to save the active object, in place of another file."""
        self.write("face.sweep", "old")
        options = {"pack": False, "tolerance": 0, "subdivide": 0} | options
        return watched(addon.ExportSweep, filepath=self.path("face.sweep"), **options)

    def assert_untouched(self):
        with open(self.path("face.sweep"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "old")
        self.assertFalse([name for name in os.listdir(self.folder.name) if name.endswith(".tmp")])

    def test_what_is_saved_is_what_was_there_at_first(self):
        shown = self.sheet()
        keys = shown.data.shape_keys.key_blocks
        expected = self.expected(shown, [point.co for point in keys["smile"].data])
        job = self.export(tolerance=TOLERANCE, pack=True)
        self.assertEqual(job.result, {"RUNNING_MODAL"})
        self.assertEqual(job.send("A", "PRESS"), {"PASS_THROUGH"}, "Blender goes on")
        for point in keys["smile"].data:
            point.co.z += 1
        shown.location.x = 5
        shown.shape_key_remove(keys["jawOpen"])
        self.assertEqual(job.wait(), {"FINISHED", "PASS_THROUGH"})
        self.assertRegex(job.reports[-1][1], "bytes")
        self.assertEqual(list(addon.keys_of(shown)), ["smile"])
        tool("export", self.path("face.sweep"), "-o", self.path("meshes"))
        self.assert_near(addon.places_in(self.path("meshes/expressions/smile.obj")), expected)

    def test_the_object_may_vanish(self):
        bpy.data.objects.remove(self.face())
        shown = self.sheet()
        saving = self.export()
        bpy.data.objects.remove(shown)
        self.assertEqual(saving.wait(), {"FINISHED", "PASS_THROUGH"})
        shown = self.face()
        shown.data.shape_keys.key_blocks["smile"].value = 1
        moving = watched(addon.MoveToPose, law="linear", seconds=1, pose="")
        bpy.data.objects.remove(shown)
        self.assertEqual(moving.wait(), {"CANCELLED"})
        self.assertEqual(moving.reports, [("ERROR", "Grid was removed or renamed in the meantime; try again.")])

    def test_a_motion_ends_where_the_frame_and_the_sliders_were(self):
        shown = self.face()
        keys = shown.data.shape_keys.key_blocks
        bpy.context.scene.frame_set(24)
        keys["smile"].value = 0.8
        job = watched(addon.MoveToPose, law="linear", seconds=0.5, pose="")
        bpy.context.scene.frame_set(50)
        keys["smile"].value = 0.1
        job.wait()
        places = [tuple(point.co) for point in addon.curve_of(keys["smile"]).keyframe_points]
        self.assert_near(places, [(12, 0), (24, 0.8)], 1e-5)

    def test_a_clip_lengthens_the_scene_where_it_began(self):
        self.face()
        self.write("take.csv", "Timecode,JawOpen\n0,0\n1,0.5\n")
        scene = bpy.context.scene
        scene.frame_end = 5
        scene.frame_set(10)
        job = watched(addon.PlayClip, filepath=self.path("take.csv"), smooth=False, combine=False, names="")
        other = bpy.data.scenes.new("other")
        other.frame_end = 7
        bpy.context.window.scene = other
        job.wait()
        self.assertEqual((scene.frame_end, other.frame_end), (34, 7))

    def test_a_face_arrives_while_another_is_edited(self):
        shown = self.face()
        job = watched(addon.ImportSweep, filepath=self.path("face.sweep"), lod=0)
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertEqual(job.wait(), {"FINISHED", "PASS_THROUGH"})
        self.assertEqual((bpy.context.active_object, bpy.context.mode), (shown, "EDIT_MESH"))
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.context.view_layer.objects.active = bpy.data.objects["face"]
        self.assert_moves({"jawOpen", "smile"})

    def test_several_operators_wait_at_a_time(self):
        self.sheet()
        self.tool("exec sleep 60")
        jobs = [self.export(), self.export()]
        self.assertEqual(addon.WAITING, jobs)
        for job in jobs:
            job.send("ESC", "PRESS")
            self.assertEqual(job.wait(), {"CANCELLED"})

    def test_how_far_the_tool_is_can_be_read(self):
        self.sheet()
        self.tool("""[ $SWEEPFACE_PROGRESS ] || exit 1
            echo 'sweepface: warning: 3 % fold.' >&2; echo 'sweepface: 7 % reading' >&2; touch began
            while [ -e began ]; do sleep 0.05; done
            echo 'sweepface: 42 % fitting' >&2; touch went_on
            while [ -e went_on ]; do sleep 0.05; done; echo '9 bytes'""")
        job = self.export()
        for file, expected in (("began", "7 % reading"), ("went_on", "42 % fitting")):
            self.await_file(file)
            job.send("TIMER")
            self.assertEqual(job.progress, expected)
            os.remove(self.path(file))
        job.wait()
        self.assertEqual(job.reports, [("WARNING", "3 % fold."), ("INFO", "9 bytes")])

    def test_escape_cancels(self):
        self.sheet()
        self.tool("trap 'echo sweepface: Interrupted. >&2; exit 130' TERM\ntouch ready\nwhile :; do sleep 0.05; done")
        job = self.export()
        self.await_and_remove("ready")
        self.assertEqual(job.send("TIMER"), {"RUNNING_MODAL"})
        self.assertEqual(job.send("ESC", "RELEASE"), {"PASS_THROUGH"})
        self.assertEqual(job.send("ESC", "PRESS"), {"RUNNING_MODAL"})
        self.assertEqual(job.send("ESC", "PRESS"), {"PASS_THROUGH"}, "for others")
        self.assertEqual(job.wait(), {"CANCELLED"})
        self.assertEqual(job.process.returncode, 130)
        self.assertEqual(job.reports, [("INFO", "Cancelled")])
        self.assert_untouched()

    def test_escape_between_two_runs_cancels(self):
        self.tool("""echo "$1" >> runs; echo '{"targets": []}'""")
        job = watched(addon.ImportSweep, filepath=self.path("face.sweep"), lod=0)
        job.process.wait(60)
        job.send("ESC", "PRESS")
        self.assertEqual(job.wait(), {"CANCELLED"})
        self.assertEqual(job.reports, [("INFO", "Cancelled")])
        self.assertEqual(addon.read_lines(self.path("runs")), ["info"])

    def test_escape_may_come_too_late(self):
        shown = self.sheet()
        job = self.export()
        job.process.wait(60)
        job.send("ESC", "PRESS")
        self.assertEqual(job.wait(), {"FINISHED", "PASS_THROUGH"})
        self.assertEqual(shown[addon.SOURCE], self.path("face.sweep"))

    def test_the_undo_step_waits_until_no_brush_is_at_work(self):
        self.sheet()
        job = self.export()
        while addon.WAITING:
            self.assertEqual(job.send("TIMER"), {"RUNNING_MODAL"} if addon.WAITING else {"PASS_THROUGH"})
            time.sleep(0.01)
        self.assertEqual(job.send("TIMER"), {"PASS_THROUGH"})
        self.assertEqual(job.send("LEFTMOUSE", "RELEASE"), {"PASS_THROUGH"})
        self.assertEqual(job.send("Z", "PRESS"), {"FINISHED", "PASS_THROUGH"})

    def test_quitting_ends_the_tool_even_if_it_does_not_listen(self):
        self.sheet()
        for lines in ("touch ready\nexec sleep 60", "trap '' TERM\ntouch ready\nwhile :; do sleep 0.05; done"):
            self.tool(lines)
            job = self.export()
            self.await_and_remove("ready")
            job.cancel(bpy.context)
            self.assertLess(job.process.returncode, 0)
            self.assertEqual(job.reports, [])
            self.assert_untouched()

    def test_choosing_no_file_does_nothing(self):
        addon.ToolOperator().cancel(bpy.context)

    def test_the_add_on_may_be_switched_off(self):
        self.sheet()
        self.tool("exec sleep 60")
        job = self.export()
        bpy.ops.preferences.addon_disable(module=addon.__name__)
        self.assertIsNotNone(job.process.returncode)
        self.assert_untouched()

    def test_the_tool_may_fail(self):
        self.sheet()
        for lines, part in (("echo 'sweepface: The disk is full.' >&2; exit 1", "^The disk is full.$"),
                            ("kill -9 $$", "tool ended with -9.$")):
            self.tool(lines)
            job = self.export()
            self.assertEqual(job.wait(), {"CANCELLED"})
            self.assertEqual(job.reports[0][0], "ERROR")
            self.assertRegex(job.reports[0][1], part)
            self.assert_untouched()
            self.assert_refused(lambda: bpy.ops.export_scene.sweep(filepath=self.path("face.sweep")), part[1:-1])

    def test_the_tool_may_vanish(self):
        self.face()
        self.tool(f'rm "$0"; exec "{TOOL}" "$@"')
        job = watched(addon.ImportSweep, filepath=self.path("face.sweep"), lod=0)
        self.assertEqual(job.wait(), {"CANCELLED"})
        self.assertRegex(job.reports[-1][1], "^Cannot run .*tool .No such file or directory.; say in")
        self.assertEqual(self.export().result, {"CANCELLED"})

    def test_the_tool_may_say_much(self):
        self.tool("yes out | head -n 1000000\nyes 'sweepface: warning: err' | head -n 1000 >&2\necho the end\n"
                  "head -c 3000000 /dev/zero >&2")
        said = []

        class Much(addon.ToolOperator):
            bl_label = "Much"

            def work(self, _context, _folder):
                said.append((yield from addon.run_tool(self, "talk")))

        job = watched(Much)
        self.assertEqual(job.wait(), {"FINISHED", "PASS_THROUGH"})
        self.assertEqual(said[0].count("out\n"), 1000000)
        self.assertTrue(said[0].endswith("the end\n"))
        self.assertEqual(job.reports.count(("WARNING", "err")), 1000)


result = unittest.main(argv=["addon_test"], exit=False, verbosity=2).result
sys.exit(not result.wasSuccessful())
