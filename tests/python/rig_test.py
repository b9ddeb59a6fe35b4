"""Faces from files and from meshes, what they hold, and the files made of them."""

import json
import os
import pickle
import subprocess
import types
import unittest
import zipfile

import numpy as np
import sweepface
from faces import SAMPLE, FaceTest, interrupted, sheet


class Files(FaceTest):
    def test_give_back_the_same_bytes(self):
        with open(SAMPLE, "rb") as file:
            stored = file.read()
        self.assertEqual(self.rig.encode(), stored)
        for data in (stored, bytearray(stored), np.frombuffer(stored, np.uint8)):
            self.assertEqual(sweepface.decode(data).encode(), stored)
        self.rig.save(self.path("copy.sweep"))
        self.assertEqual(sweepface.load(self.path("copy.sweep")).target_names, self.rig.target_names)

    def test_may_be_pickled_for_other_processes(self):
        self.assertEqual(pickle.loads(pickle.dumps(self.rig)).encode(), self.rig.encode())

    def test_say_what_is_wrong_with_them(self):
        with self.refuses("none.sweep"):
            sweepface.load(self.path("none.sweep"))
        with self.refuses(r"\\xff.sweep"):
            sweepface.load(self.path("\udcff.sweep"))
        with self.refuses("The upload"):
            sweepface.decode(b"not a face", "The upload")
        with self.refuses("memory"):
            sweepface.load(SAMPLE, memory=1000)
        with self.refuses("no/folder.sweep"):
            self.rig.save(self.path("no/folder.sweep"))
        for save, name in (
            (self.rig.save, "a.glb"),
            (self.rig.save_glb, "a.sweep"),
            (self.rig.save_usd, "a.usdc"),
            (self.rig.save_obj, "a.ply"),
        ):
            with self.refuses("must end in"):
                save(self.path(name))

    def test_are_packed_and_stripped_into_others(self):
        packed = self.rig.packed(0.01)
        bare = packed.stripped("order,uv")
        self.assertLess(len(packed.encode()), len(self.rig.encode()) / 2)
        self.assertLess(len(bare.encode()), len(packed.encode()))
        gap = np.linalg.norm(packed.pose().positions() - self.rig.pose().positions(), axis=1)
        self.assertGreater(gap.max(), 0)
        self.assertLessEqual(gap.max(), 0.01)
        with self.refuses("order, uv"):
            self.rig.stripped("teeth")
        with self.refuses(r"^Packed texture coordinates have 8 to 16 bits, not 99\.$"):
            self.rig.packed(texture_bits=99)

    def test_become_objs(self):
        self.rig.save_obj(self.path("open.obj"), {"jawOpen": 1})
        back = sweepface.read_meshes(self.path("open.obj"))
        self.assertTrue(np.array_equal(back.positions, self.rig.pose({"jawOpen": 1}).positions()))
        self.assertTrue(np.array_equal(back.texcoords, self.rig.meshes().texcoords))

    def test_become_glbs_with_clips(self):
        clip = sweepface.Clip(["JawOpen", "tail"], [0, 0.5, 1], [[0, 0], [1, 0], [0, 0]])
        self.rig.save_glb(self.path("face.glb"), clip=clip, weights={"jawOpen": 0.5})
        with open(self.path("face.glb"), "rb") as file:
            data = file.read()
        document = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
        self.assertEqual(document["meshes"][0]["extras"]["targetNames"], self.rig.target_names)
        self.assertEqual(len(document["animations"]), 1)
        back = sweepface.read_clip(self.path("face.glb")).weights_of(self.rig, [0.5])
        self.assertAlmostEqual(back[0, self.rig.target_names.index("jawOpen")], 1, places=6)
        with self.refuses("jawOpenn"):
            self.rig.save_glb(self.path("face.glb"), weights={"jawOpenn": 0.5})
        with self.refuses("key_tolerance is for the keys of a clip"):
            self.rig.save_glb(self.path("face.glb"), key_tolerance=0.01)
        with self.refuses("time_codes_per_second is for the frames of a clip"):
            self.rig.save_usd(self.path("face.usda"), time_codes_per_second=24)

    def test_keep_to_budgets_in_files(self):
        for save, name in ((self.rig.save_glb, "far.glb"), (self.rig.save_usd, "far.usda")):
            save(self.path(name), vertices=3000)
            size = os.path.getsize(self.path(name))
            save(self.path(name), error=0.5)
            self.assertLess(os.path.getsize(self.path(name)), size)
            with self.refuses("either a level or a budget"):
                save(self.path(name), level=2, vertices=3000)
            with self.refuses("one of vertices, edge_length and error"):
                save(self.path(name), edge_length=1, vertices=3000)
            with self.refuses("vertices"):
                save(self.path(name), vertices=10)

    def test_become_usds_with_clips(self):
        clip = sweepface.Clip(["JawOpen", "tail"], [7, 7.5, 8], [[0, 0], [1, 0], [0, 0]])
        path = self.path("face.usda")
        self.rig.save_usd(path, clip=clip, weights={"jawOpen": 0.5}, time_codes_per_second=30, meters_per_unit=1)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.assertIn("    endTimeCode = 30\n    framesPerSecond = 30\n    metersPerUnit = 1\n    startTimeCode = 0\n", text)
        self.assertIn("]," + "\n" + 16 * " " + "15: [", text)
        self.assertEqual(text.count("def BlendShape"), len(self.rig.target_names))
        self.rig.save_usd(path, level=2, morph_normals=True, z_up=True)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.assertIn('upAxis = "Z"', text)
        self.assertEqual(text.count("normalOffsets"), len(self.rig.target_names))
        archive = self.path("face.usdz")
        self.rig.save_usd(archive, level=2, morph_normals=True, z_up=True)
        with zipfile.ZipFile(archive) as file:
            self.assertIsNone(file.testzip())
            self.assertEqual(file.namelist(), ["face.usda"])
            self.assertEqual(file.read("face.usda").decode(), text)
        self.rig.save_usd(self.path("face.usd"), level=2, morph_normals=True, z_up=True)
        with open(self.path("face.usd"), encoding="utf-8") as file:
            self.assertEqual(file.read(), text)
        with self.refuses("leave the pivot out"):
            self.rig.save_usd(path, pivot=[0, 0, 0])
        with self.refuses("Metres a unit"):
            self.rig.save_usd(path, meters_per_unit=-1)


class Contents(FaceTest):
    def test_agree_with_the_tool(self):
        info = json.loads(subprocess.run([os.environ["SWEEPFACE_TOOL"], "info", SAMPLE, "--json"], check=True, capture_output=True).stdout)
        self.assertEqual(self.rig.target_names, info["targets"])
        self.assertEqual(self.rig.patch_count, info["patches"])
        self.assertEqual(self.rig.vertex_count, 8216)

    def test_describe_the_wireframe(self):
        arcs, edges = self.rig.arcs, self.rig.patch_edges
        self.assertEqual(edges.shape, (self.rig.patch_count, 2))
        sides = self.rig.patch_sides(3)
        ends = [(arcs[arc] if forward else arcs[arc][::-1]) for side in sides for arc, forward in side]
        for (_, end), (start, _) in zip(ends, ends[1:] + ends[:1]):
            self.assertEqual(end, start)
        self.assertEqual(self.rig.ribbons.shape[1], 3)
        self.assertEqual(self.rig.units, "cm")
        self.assertEqual(self.rig.arc_ribbons.shape, (len(arcs),))
        self.assertLess(self.rig.arc_ribbons.max(), len(self.rig.ribbons))
        with self.refuses("There is no patch -1"):
            self.rig.patch_sides(-1)

    def test_are_linear_in_the_stored_vectors(self):
        neutral, jaw = self.rig.vectors(), self.rig.vectors("jawOpen")
        self.assertEqual(neutral.shape, jaw.shape)
        self.assertGreater(np.abs(jaw).max(), 0.1)
        with self.refuses("no target named 'frown'"):
            self.rig.vectors("frown")

    def test_are_shown(self):
        self.assertEqual(repr(self.rig), f"<sweepface.Rig: 8216 vertices, {self.rig.patch_count} patches, 42 targets>")
        picture = self.rig.render({"jawOpen": 1}, width=120, height=160)
        self.assertEqual(picture.shape, (160, 120, 3))
        self.assertGreater(picture.std(), 20)
        sweepface.save_png(self.path("open.png"), picture)
        with open(self.path("open.png"), "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")
        with self.refuses("8-bit numbers"):
            sweepface.save_png(self.path("open.png"), picture[:, :, 0])
        self.assertTrue((picture != self.rig.render(width=120, height=160)).any())
        with self.refuses("shaded, patches"):
            self.rig.render(style="oil")
        with self.refuses("needs meshes to compare with"):
            self.rig.render(style="error")
        with self.refuses("16"):
            self.rig.render(width=1)

    def test_are_not_shown_when_that_is_interrupted(self):
        program = "def work(): rig.render(width=4000, height=4000)\ndef left(): return 0\n"  # takes half a minute
        word, seconds, _ = interrupted(program, 0.1)
        self.assertEqual(word, "interrupted")
        self.assertLess(float(seconds), 6)


class Poses(FaceTest):
    def test_have_the_surface_and_its_derivatives_at_any_place(self):
        pose = self.rig.pose({"jawOpen": 0.5, "eyeBlinkLeft": 1})
        patch, h = np.arange(5), 1e-5
        point = pose.at(patch, 0.5, 0.5)
        self.assertEqual(point.shape, (5, 3))
        along = (pose.at(patch, 0.5 + h, 0.5) - pose.at(patch, 0.5 - h, 0.5)) / (2 * h)
        self.assertTrue(np.allclose(pose.at(patch, 0.5, 0.5, du=1), along, atol=1e-6))
        across = pose.at(patch, 0.5, 0.5, dv=1)
        normal = np.cross(along, across)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        self.assertTrue(np.allclose(pose.normal(patch, 0.5, 0.5), normal, atol=1e-6))
        self.assertEqual(pose.at(0, [[0.1, 0.2], [0.3, 0.4]], 0.5).shape, (2, 2, 3))

    def test_of_patches_are_sweeps_of_their_sides(self):
        pose, (m, n) = self.rig.pose({"jawOpen": 1}), self.rig.patch_edges[7]
        basis, u, v = self.rig.bases(7)[0], np.linspace(0, m, 9), np.linspace(0, n, 5)
        sides = np.stack([pose.at(7, end, v, du=k) * float(m) ** k for end in (0, m) for k in range(3)])
        swept = np.einsum("ui,ivk->uvk", basis(u / m), sides)
        self.assertTrue(np.allclose(swept, pose.at(7, u[:, None], v[None, :]), atol=1e-12))

    def test_find_places_that_follow(self):
        rest, smile = self.rig.pose(), self.rig.pose({"mouthSmileLeft": 1})
        patch, u, v = rest.nearest(rest.positions()[[10, 2000, 5000]])
        self.assertTrue(np.allclose(rest.at(patch, u, v), rest.positions()[[10, 2000, 5000]], atol=1e-6))
        self.assertTrue(np.allclose(smile.at(patch, u, v), smile.positions()[[10, 2000, 5000]], atol=1e-5))

    def test_are_linear_in_weights(self):
        weights = np.zeros(42)
        weights[3], weights[7] = 0.25, 0.5
        rest, one, other = (self.rig.pose(w).positions() for w in (None, 4 * weights * (np.arange(42) == 3), 2 * weights * (np.arange(42) == 7)))
        blended = self.rig.pose(weights).positions()
        self.assertTrue(np.allclose(blended, rest + 0.25 * (one - rest) + 0.5 * (other - rest), atol=1e-12))

    def test_are_watertight_at_any_level(self):
        pose = self.rig.pose()
        self.assertEqual(pose.positions().shape, (8216, 3))
        self.assertGreater(len(pose.positions(level=2)), 2 * 8216)
        normals = pose.normals(level=2)
        self.assertTrue(np.allclose(np.linalg.norm(normals, axis=1), 1))
        joins = pose.joins()
        self.assertLessEqual({"boundary", "c2", "spoke"}, set(joins["join_class"]))
        self.assertLess(joins["position_gap"].max(), 1e-13)
        smooth = joins["join_class"] == "c2"
        self.assertLess(joins["second_jump"][smooth].max(), 1e-9)

    def test_have_boundary_and_control_curves(self):
        curves = self.rig.pose().curves(per_edge=4)
        self.assertEqual({len(curve) % 4 for curve in curves["boundary"]}, {1})
        self.assertEqual(len(curves["control"]), len(curves["control_arcs"]))
        node = self.rig.arcs[curves["boundary_arcs"][0], 0]
        for curve, arc in zip(curves["boundary"], curves["boundary_arcs"]):
            if self.rig.arcs[arc, 0] == node:
                self.assertTrue(np.allclose(curve[0], curves["boundary"][0][0]))

    def test_refuse_places_that_there_are_not(self):
        pose = self.rig.pose()
        for place in ((-1, 0, 0), (self.rig.patch_count, 0, 0), (2**32, 0, 0), (0, -0.1, 0), (0, 0, 1e9), (0, np.nan, 0)):
            with self.refuses("There is no patch|outside of patch"):
                pose.at(*place)
        with self.refuses("orders 0 to 3"):
            pose.at(0, 0, 0, du=4)
        with self.refuses("whole numbers"):
            pose.at(0.5, 0, 0)
        self.assertEqual(pose.at([], [], []).shape, (0, 3))
        with self.refuses("between 0 and 64"):
            pose.positions(level=65)
        with self.refuses("Point 0 must have coordinates within"):
            pose.nearest([[0, 0, np.inf]])

    def test_refuse_weights_that_make_no_sense(self):
        for weights, sentence in (
            ({"jawOpenn": 1}, "jawOpenn"),
            ({"jawOpen": np.nan}, "Weights must be numbers"),
            (np.full(42, 1e9), "Weights must be numbers"),
            ([1, 2], "2 weights for 42 targets"),
            ({"jawOpen": None}, "The weight of 'jawOpen' must be a number"),
            ({1: 1}, "The name of a target must be a text"),
            ("jawOpen", "None, a dict, or an array of numbers"),
        ):
            with self.refuses(sentence):
                self.rig.pose(weights)

    def test_refuse_weights_that_change_while_they_are_read(self):
        class Hostile:
            def __float__(self):
                weights.clear()
                raise ValueError

        weights = {"jawOpen": Hostile(), "eyeBlinkLeft": 1.0}
        with self.refuses("must be a number"):
            self.rig.pose(weights)

    def test_take_weights_by_name_in_any_mapping(self):
        weights = self.rig.weights(types.MappingProxyType({"jawOpen": 0.5}))
        self.assertEqual(weights[self.rig.target("jawOpen")], 0.5)
        self.assertEqual(weights.sum(), 0.5)
        with self.refuses("jawShut"):
            self.rig.target("jawShut")


class Conversion(FaceTest):
    def test_keeps_every_vertex_within_the_tolerance(self):
        meshes = sheet()
        rig = sweepface.convert(meshes, 0.01)
        self.assertEqual((rig.tolerance, rig.target_names), (0.01, ["lift"]))
        for weights, shape in ((None, meshes.positions), ({"lift": 1}, meshes.targets["lift"])):
            gap = np.linalg.norm(rig.pose(weights).positions() - shape, axis=1)
            self.assertLessEqual(gap.max(), 0.01)

    def test_of_its_own_meshes_makes_the_round_trip(self):
        meshes = self.rig.meshes()
        self.assertEqual(len(meshes.faces), 8102)
        self.assertEqual(list(meshes.targets), self.rig.target_names)
        self.assertTrue(np.array_equal(meshes.positions, self.rig.pose().positions()))

    def test_packs_and_reports_what_it_does(self):
        told = []
        rig = sweepface.convert(sheet(), 0.01, pack=True, progress=lambda what, done: told.append((what, done)))
        self.assertLess(len(rig.encode()), 1500)
        self.assertTrue(all(isinstance(what, str) and 0 <= done <= 1 for what, done in told))
        small = sweepface.convert(sheet(), max_bytes=len(rig.encode()) + 20)
        self.assertLessEqual(len(small.encode()), len(rig.encode()) + 20)
        self.assertLess(small.tolerance, rig.tolerance)

    def test_measures_the_result(self):
        meshes = sheet()
        measured = sweepface.measure(sweepface.convert(meshes, 0.01), meshes, mixtures=3)
        self.assertEqual([shape.name for shape in measured.shapes], ["neutral", "lift"])
        self.assertEqual(len(measured.mixtures), 3)
        self.assertLessEqual(measured.worst.distance.max, 0.01)
        self.assertGreaterEqual(measured.worst.distance.max, measured.worst.distance.p999)
        self.assertEqual(measured.worst.folds, 0)
        quick = sweepface.measure(sweepface.convert(meshes, 0.01), meshes, mixtures=0, facets=False)
        self.assertEqual(quick.worst.distance.max, measured.worst.distance.max)
        self.assertIsNone(quick.worst.folds)
        self.assertIsNone(quick.worst.shading_rms)
        with self.refuses("vertices"):
            sweepface.measure(self.rig, meshes)

    def test_warns_as_python_does(self):
        meshes = sheet()
        still = sweepface.Meshes(meshes.positions, meshes.faces, {"faint": meshes.positions + [0, 0, 1e-5]})
        with self.assertWarnsRegex(UserWarning, "faint"):
            sweepface.convert(still, 0.01)

    def test_ends_with_an_exception_of_progress(self):
        def stop(what, done):
            raise KeyboardInterrupt

        meshes = self.rig.meshes()
        with self.assertRaises(KeyboardInterrupt):
            sweepface.convert(meshes, progress=stop)

    def test_refuses_meshes_that_make_no_sense(self):
        square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        for arguments, sentence in (
            ((square, [(0, 1, 2, 4)]), "Face 0 has vertex 4, but there are 4"),
            ((square, [(0, 1, 2, -1)]), "Face 0 has vertex -1"),
            (([[0, 0]], []), "three numbers a row"),
            ((square, [(0, 1, 2, 3)], {"up": square[:3]}), "'up' has 3 vertices, but the neutral has 4"),
        ):
            with self.refuses(sentence):
                sweepface.Meshes(*arguments)
        with self.refuses("two numbers a row"):
            sweepface.Meshes(square, [(0, 1, 2, 3)], texcoords=square)
        with self.refuses("Every corner"):
            sweepface.Meshes(square, [(0, 1, 2, 3)], texcoords=[[0, 0]], corner_texcoords=[0, 0, 0, 1])
        with self.refuses("larger than the mesh"):
            sweepface.convert(sheet(), 100)
        with self.refuses("Positions must be numbers within 1e30 of 0"):
            sweepface.Meshes(np.full((4, 3), np.nan), [(0, 1, 2, 3)])
        with self.refuses("Every face must be a sequence of vertices"):
            sweepface.Meshes(square, [0, 1, 2, 3])
        with self.refuses("Targets must be a dict"):
            sweepface.Meshes(square, [(0, 1, 2, 3)], [square])
        for most in (-1, 0, "many"):
            with self.refuses("max_bytes must be"):
                sweepface.convert(sheet(), max_bytes=most)
        with self.refuses("progress must be a function"):
            sweepface.convert(sheet(), progress=3)
        with self.refuses("packed"):
            sweepface.convert(sheet(), normal_tolerance=1)
        with self.refuses("texture_bits is for packed rigs"):
            sweepface.convert(sheet(), texture_bits=12)

    def test_changes_shapes_and_keeps_the_rest(self):
        meshes = self.rig.meshes()
        open_wide = 2 * meshes.targets["jawOpen"] - meshes.positions
        other = meshes.with_shapes({"wide": open_wide})
        self.assertEqual(list(other.targets), ["wide"])
        self.assertTrue(np.array_equal(other.targets["wide"], open_wide))
        self.assertTrue(np.array_equal(other.texcoords, meshes.texcoords))
        self.assertEqual(len(other.corner_texcoords), sum(map(len, other.faces)))
        with self.refuses("3 positions for 8216 vertices"):
            meshes.with_shapes({}, positions=np.zeros((3, 3)))

    def test_subdivides_cages(self):
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        limit = sweepface.Meshes(corners, faces, {"wide": 2 * corners}).subdivided(2)
        self.assertEqual(len(limit.faces), 6 * 4 * 4)
        self.assertTrue(np.allclose(limit.positions[:8], corners / 2))
        self.assertTrue(np.allclose(limit.targets["wide"], 2 * limit.positions))
        with self.refuses("1 to 5 levels"):
            limit.subdivided(6)

    def test_reads_and_writes_meshes(self):
        sheet().save_glb(self.path("sheet.glb"))
        back = sweepface.read_meshes(self.path("sheet.glb"))
        self.assertEqual(repr(back), "<sweepface.Meshes: 30 vertices, 20 faces, 1 targets>")
        for names in ("face", ["face"]):
            self.assertEqual(len(sweepface.read_meshes(self.path("sheet.glb"), meshes=names).faces), 20)
        with self.refuses("sheet.glb: no object with meshes and no mesh is named 'head'; there are 'face'."):
            sweepface.read_meshes(self.path("sheet.glb"), meshes="head")
        with open(self.path("square.obj"), "w") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        self.assertEqual(sweepface.read_meshes(self.path("square.obj")).faces, [(0, 1, 2, 3)])
        with open(self.path("square.obj")) as neutral, open(self.path("lifted.obj"), "w") as lifted:
            lifted.write(neutral.read().replace("1 1 0", "1 1 1"))
        both = sweepface.read_meshes(self.path("square.obj"), self.path("lifted.obj"))
        self.assertEqual(both.targets["lifted"][2, 2], 1)
        with self.refuses("square.obj has a single mesh"):
            sweepface.read_meshes(self.path("square.obj"), meshes=["square"])
        with self.refuses("meshes must be names"):
            sweepface.read_meshes(self.path("square.obj"), meshes=5)
        with self.refuses("none.obj"):
            sweepface.read_meshes(self.path("none.obj"))


if __name__ == "__main__":
    unittest.main()
