"""Parts of a face that move in their own way."""

import collections
import json
import os
import pickle
import subprocess
import unittest

import numpy as np
import sweepface
from faces import SAMPLE, FaceTest, sheet

CHEEKS = {"points": [[4.5, -1, 7], [-4.5, -1, 7]], "over": "space", "whole": 1, "fade": 3}


class RegionTest(FaceTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shares = cls.rig.paint(**CHEEKS)
        cls.regions = cls.rig.divide([sweepface.Region("cheeks", cls.shares, mass=4, delay=0.1)])
        cls.jaw = cls.rig.target("jawOpen")

    def weights(self, rest, cheeks):
        weights = np.zeros((2, 42))
        weights[:, self.jaw] = rest, cheeks
        return weights

    def write(self, name, document):
        with open(self.path(name), "w") as file:
            json.dump(document, file)
        return self.path(name)


class Painting(RegionTest):
    def test_can_be_pickled(self):
        copy = pickle.loads(pickle.dumps(self.regions[1]))
        self.assertEqual(repr(copy), repr(self.regions[1]))
        self.assertTrue(np.array_equal(copy.shares, self.regions[1].shares))

    def test_fades_with_the_distance(self):
        nodes = self.rig.pose().nodes()
        self.assertEqual((nodes.shape, self.shares.shape), ((self.rig.node_count, 3), (self.rig.node_count,)))
        distance = np.min([np.linalg.norm(nodes - point, axis=1) for point in CHEEKS["points"]], axis=0)
        t = np.clip((distance - 1) / 3, 0, 1)
        self.assertTrue(np.allclose(self.shares, 1 - t**3 * (t * (6 * t - 15) + 10), atol=1e-12))

    def test_takes_arrays_of_any_layout(self):
        points = np.array(CHEEKS["points"])
        for other in (np.asfortranarray(points), np.repeat(points, 2, axis=1)[:, ::2]):
            self.assertTrue(np.array_equal(self.rig.paint(**{**CHEEKS, "points": other}), self.shares))

    def test_takes_lines_curves_and_nodes(self):
        line = self.rig.paint(line=CHEEKS["points"], over="space", whole=1, fade=3)
        self.assertTrue((line >= self.shares).all() and (line > self.shares).any())
        curve = self.rig.paint(curves=["c12"], fade=2)
        self.assertTrue((curve[self.rig.arcs[12]] == 1).all())
        single = self.rig.paint(nodes={"n5": 0.25})
        self.assertEqual(single[5], 0.25)

    def test_makes_bands_that_cover_the_face(self):
        bands = self.rig.paint(points=[[0, 8, 9]], fade=6, bands=4)
        self.assertEqual(bands.shape, (4, self.rig.node_count))
        one = self.rig.paint(points=[[0, 8, 9]], fade=6, bands=1)
        self.assertTrue(np.array_equal(one, [self.rig.paint(points=[[0, 8, 9]], fade=6)]))
        self.assertTrue(np.allclose(bands.sum(axis=0), 1))

    def test_leaves_the_rest(self):
        self.assertEqual([region.name for region in self.regions], ["rest", "cheeks"])
        self.assertTrue(np.allclose(self.regions[0].shares + self.regions[1].shares, 1))
        self.assertEqual((self.regions[1].mass, self.regions[1].stiffness, self.regions[1].delay), (4, 1, 0.1))
        self.assertEqual(repr(self.regions[1]), "<sweepface.Region 'cheeks': mass 4, stiffness 1, delay 0.1 s>")
        everything = self.rig.divide([sweepface.Region("all", np.ones(self.rig.node_count))])
        self.assertEqual([region.name for region in everything], ["all"])

    def test_is_read_from_files(self):
        document = {"regions": [{"name": "cheeks", "mass": 4, "delay": 0.1, **CHEEKS}]}
        for regions in (
            self.rig.read_regions(self.write("cheeks.json", document)),
            self.rig.parse_regions(json.dumps(document)),
        ):
            self.assertEqual([region.name for region in regions], ["rest", "cheeks"])
            self.assertTrue(np.array_equal(regions[1].shares, self.regions[1].shares))
        timeline = self.write("line.json", {"seconds": 1, "events": []})
        self.assertEqual([region.name for region in self.rig.read_regions(timeline)], ["rest"])

    def test_refuses_what_makes_no_sense(self):
        for brush, sentence in (
            ({}, "says nowhere where it is"),
            ({"points": [1, 2, 3]}, "three numbers a row"),
            ({"points": [[np.nan, 0, 0]]}, "not finite"),
            ({"points": "here"}, "Points must be an array"),
            ({"points": [[0, 8, 9]], "whole": np.nan}, "finite and at least 0"),
            ({"points": [[0, 8, 9]], "over": "hills"}, "'surface' or 'space', not 'hills'"),
            ({"parts": "skin"}, "Parts must be a list of names"),
            ({"parts": ["wings"]}, "wings"),
            ({"curves": [12]}, "Curves must be a list of names"),
            ({"curves": ["c99999"]}, "c99999"),
            ({"nodes": {"n5": 2}}, "not from 0 to 1"),
            ({"nodes": ["n5"]}, "Nodes must be a dict"),
            ({"points": [[0, 8, 9]], "fade": 1, "bands": 0}, "bands must be from 1 to 32"),
            ({"points": [[0, 8, 9]], "fade": 1, "bands": 2.5}, "bands must be a whole number"),
        ):
            with self.refuses(sentence):
                self.rig.paint(**brush)
        for arguments, sentence in ((("a", np.zeros((2, 2))), "array of numbers"), (("a", "b"), "."), ((b"\xff", [1]), "control characters")):
            with self.assertRaisesRegex((sweepface.Error, TypeError), sentence):
                sweepface.Region(*arguments)
        for matter in ({"mass": 0}, {"mass": np.nan}, {"stiffness": 1e9}, {"delay": -1}):
            with self.refuses("from 0"):
                sweepface.Region("a", self.shares, **matter)
        for regions, sentence in (
            ([sweepface.Region("", self.shares)], "no name"),
            ([sweepface.Region("a", self.shares)] * 2, "Two regions are named 'a'"),
            ([sweepface.Region("a", self.shares[1:])], "1292 shares for 1293 nodes"),
            ([sweepface.Region("a", 2 * self.shares)], "not from 0 to 1"),
            ([sweepface.Region(str(k), self.shares) for k in range(33)], "at most 32"),
        ):
            for take in (self.rig.divide, lambda r: sweepface.Face(self.rig, regions=r), lambda r: self.rig.pose(None, r)):
                with self.refuses(sentence):
                    take(regions)
        for listed in (3, ["a"], [None], "regions", collections.UserDict(a=1)):
            with self.refuses("Regions must be a list of regions"):
                self.rig.divide(listed)
        with self.refuses("The text has no regions"):
            self.rig.parse_regions("{}")
        with self.refuses("cheeks.json.*regions.0"):
            self.rig.read_regions(self.write("cheeks.json", {"regions": [{"name": "cheeks"}]}))
        with self.refuses("none.json"):
            self.rig.read_regions(self.path("none.json"))


class Faces(RegionTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.face = sweepface.Face(cls.rig, regions=cls.regions)

    def test_have_weights_in_every_region(self):
        self.assertEqual([region.name for region in self.face.regions], ["rest", "cheeks"])
        self.assertEqual(sweepface.Face(self.rig).regions, [])
        weights = self.weights(1, 0.2)
        exact = self.rig.pose(weights, self.regions).positions()
        gap = np.linalg.norm(self.face.evaluate(weights) - exact, axis=1).max()
        self.assertLessEqual(gap, self.face.bound(weights))
        self.assertGreater(np.abs(exact - self.rig.pose({"jawOpen": 1}).positions()).max(), 0.04)

    def test_move_as_a_whole_by_one_set(self):
        exact = self.rig.pose({"jawOpen": 1}).positions()
        self.assertTrue(np.array_equal(self.rig.pose({"jawOpen": 1}, self.regions).positions(), exact))
        whole = self.face.evaluate({"jawOpen": 1})
        self.assertTrue(np.allclose(whole, exact, atol=0.01))
        for same in (self.weights(1, 1)[0], self.weights(1, 1)[:1], self.weights(1, 1)):
            self.assertTrue(np.array_equal(self.face.evaluate(same), whole))
            self.assertTrue(np.allclose(self.rig.pose(same, self.regions).positions(), exact, atol=1e-12))

    def test_evaluate_many_frames_at_once(self):
        weights = np.random.default_rng(1).random((6, 2, 42))
        frames, normals = self.face.evaluate(weights, normals=True)
        self.assertEqual(frames.shape, (6, 8216, 3))
        strided = np.asfortranarray(weights)
        self.assertTrue(np.array_equal(self.face.evaluate(strided), frames))
        one, its = self.face.evaluate(weights[4], normals=True)
        self.assertTrue(np.array_equal(frames[4], one))
        self.assertTrue(np.array_equal(normals[4], its))
        same = self.face.evaluate(weights[:, :1])
        self.assertTrue(np.array_equal(same, self.face.evaluate(np.repeat(weights[:, :1], 2, axis=1))))
        self.assertEqual(self.face.evaluate(weights[:0]).shape, (0, 8216, 3))

    def test_divide_themselves(self):
        face = sweepface.Face(self.rig, regions=[sweepface.Region("cheeks", self.shares)])
        self.assertTrue(np.array_equal(face.evaluate(self.weights(1, 0)), self.face.evaluate(self.weights(1, 0))))
        whole = sweepface.Face(self.rig, regions=[])
        self.assertTrue(np.array_equal(whole.evaluate({"jawOpen": 1}), sweepface.Face(self.rig).evaluate({"jawOpen": 1})))

    def test_keep_eyeballs_whole(self):
        half = sweepface.Region("half", np.where(self.rig.pose().nodes()[:, 1] > 4, 0.7, 0.2))
        face = sweepface.Face(self.rig, regions=[half], eyes=True)
        self.assertTrue({0, 1} & set(face.regions[1].shares))  # of the eyeballs alone
        looking, rest = np.zeros((2, 2, 42)), face.evaluate()
        looking[[0, 1], [0, 1], self.rig.target("eyeLookOutLeft")] = 1
        moved = np.linalg.norm(face.evaluate(looking) - rest, axis=2)
        ball = np.flatnonzero(moved.max(axis=0) > 0.1)
        self.assertGreater(len(ball), 20)
        still, turned = sorted(moved, key=lambda ways: ways[ball].max())
        self.assertLess(still[ball].max(), 0.005)
        whole = sweepface.Face(self.rig, eyes=True)
        alone = np.linalg.norm(whole.evaluate({"eyeLookOutLeft": 1}) - whole.evaluate(), axis=1)
        self.assertLess(np.abs(turned - alone)[ball].max(), 0.005)

    def test_refuse_weights_of_other_shapes(self):
        for weights, sentence in (
            (np.zeros((3, 42)), "weights of 3 regions for a face that has 2"),
            (np.zeros((5, 3, 42)), "weights of 3 regions for a face that has 2"),
            (np.zeros((2, 41)), "41 weights a frame for 42 targets"),
            (np.zeros((1, 5, 2, 42)), "at most three axes"),
            (np.full((2, 42), np.nan), "Weights must be numbers"),
        ):
            with self.refuses(sentence):
                self.face.evaluate(weights)
        with self.refuses("unless the face is divided"):
            sweepface.Face(self.rig).evaluate(np.zeros((1, 2, 42)))
        with self.refuses("of one frame"):
            self.rig.pose(np.zeros((1, 2, 42)), self.regions)
        with self.refuses("Regions must be a list"):
            sweepface.Face(self.rig, regions=3)


class Motions(RegionTest):
    def test_of_heavy_and_late_regions_lag(self):
        motion = sweepface.RegionalMotion(self.rig.weights(), self.regions)
        motion.move_to(self.rig.weights({"jawOpen": 1}), "accelerate-brake", seconds=0.5)
        self.assertEqual((motion.positions.shape, motion.regions), ((2, 42), ["rest", "cheeks"]))
        motion.advance(0.05)
        self.assertGreater(motion.positions[0, self.jaw], 0)
        self.assertEqual(motion.positions[1, self.jaw], 0)
        motion.advance(0.45)
        rest, cheeks = motion.positions[:, self.jaw]
        self.assertEqual(rest, 1)
        self.assertAlmostEqual(cheeks, 2 * 0.4**2)  # set out at 0.1, twice as slow: half of the way at 0.6
        self.assertGreater(motion.velocities[1, self.jaw], 0)
        self.assertTrue(motion.moves())
        motion.advance(0.6)
        self.assertEqual(motion.positions[1, self.jaw], 1)
        self.assertFalse(motion.moves())

    def test_of_one_region_leave_the_others(self):
        motion = sweepface.RegionalMotion([0, 0], self.regions)
        motion.move_in("cheeks", 1, 0.5, "cut")
        motion.put_in(0, 0, 0.25)
        motion.advance(0.2)
        self.assertTrue(np.array_equal(motion.positions, [[0.25, 0], [0, 0.5]]))
        motion.move_one(0, 1, "cut")
        motion.advance(0.2)
        self.assertTrue(np.array_equal(motion.positions[:, 0], [1, 1]))
        motion.push(1, 2, drag=1)
        self.assertTrue(np.allclose(motion.velocities[:, 1], [2, 0.5]))

    def test_refuse_what_makes_no_sense(self):
        motion = sweepface.RegionalMotion([0], self.regions)
        for region, sentence in (("nose", "no region 'nose'; there are rest, cheeks"), (2, "no region 2"), (-1, "a name or a number")):
            with self.refuses(sentence):
                motion.move_in(region, 0, 1)
            with self.refuses(sentence):
                motion.put_in(region, 0, 1)
        with self.refuses("no use for 'seconds'"):
            motion.move_in("cheeks", 0, 1, "spring", seconds=1)
        with self.refuses("0 to 1e10 seconds"):
            motion.advance(np.nan)
        for call in (lambda: motion.move_to([1, 2]), lambda: motion.move_one(9, 1), lambda: motion.push(0, np.nan, 1)):
            with self.refuses("."):
                call()
        with self.refuses("1 to 32 regions"):
            sweepface.RegionalMotion([0], [])


class Clips(RegionTest):
    def clip(self):
        times = np.linspace(0, 1, 61)
        return sweepface.Clip(["jawOpen", "HeadYaw"], times, np.stack([times**2, 0.1 * times], axis=1))

    def test_play_late_in_heavy_regions(self):
        clips = self.clip().in_regions(self.regions)
        self.assertGreater(clips.seconds, 1.1)
        self.assertEqual((len(clips.of_regions), clips.whole.names), (2, ["jawOpen", "HeadYaw"]))
        self.assertTrue(np.array_equal(clips.whole.angles()["head"], self.clip().angles()["head"]))
        weights = clips.weights_of(self.rig, [0, 0.5, 1, clips.seconds])
        self.assertEqual(weights.shape, (4, 2, 42))
        self.assertTrue(np.allclose(weights[:, 0], self.clip().weights_of(self.rig, [0, 0.5, 1, 9])))
        self.assertLess(weights[1, 1, self.jaw], 0.2)
        self.assertAlmostEqual(weights[3, 1, self.jaw], 1, places=3)
        stiff = self.clip().in_regions(self.regions, frequency=20).weights_of(self.rig, [0.5])
        self.assertAlmostEqual(stiff[0, 1, self.jaw], 0.4**2, delta=0.02)
        self.assertEqual(repr(clips)[:36], "<sweepface.RegionalClips: 2 regions,")

    def test_have_their_own_frames_if_no_times_are_given(self):
        clips = self.clip().in_regions(self.regions)
        times = np.union1d(*(clip.times.round(9) for clip in clips.of_regions))
        weights = clips.weights_of(self.rig)
        self.assertTrue(np.allclose(weights, clips.weights_of(self.rig, times), atol=1e-6))
        self.assertAlmostEqual(weights[-1, 1, self.jaw], 1, places=3)

    def test_take_regions_as_the_face_has_them(self):
        cheeks = [sweepface.Region("cheeks", self.shares, mass=4)]  # without the rest
        timeline = sweepface.parse_timeline(json.dumps({"seconds": 1, "events": [{"at": 0, "to": {"jawOpen": 1}}]}))
        for call in (self.clip().in_regions, timeline.in_regions, lambda r: sweepface.RegionalMotion([0], r)):
            with self.refuses("take what Rig.divide makes of them"):
                call(cheeks)
            call(sweepface.Face(self.rig, regions=cheeks).regions)

    def test_agree_with_the_tool(self):
        times = np.linspace(0, 1, 61)
        columns = {"jawOpen": times**2, "eyeLookOutLeft": times, "leftEyeYaw": -0.3 * times, "rightEyePitch": 0.2 * times}
        clip = sweepface.Clip(list(columns), times, np.stack(list(columns.values()), axis=1))
        clip.save_csv(self.path("take.csv"))
        self.write("cheeks.json", {"regions": [{"name": "cheeks", "mass": 4, "delay": 0.1, **CHEEKS}]})
        options = "--clip take.csv --regions cheeks.json --eyes on --limits 0:0.6 --fps 2 -q -o frames/".split()
        tool = os.environ["SWEEPFACE_TOOL"]
        subprocess.run([tool, "animate", os.path.abspath(SAMPLE), *options], check=True, cwd=self.folder, capture_output=True)
        clip = sweepface.read_clip(self.path("take.csv"))
        late = clip.in_regions(self.regions)
        moments = [0, 0.5, 1, 1.5, 2]
        face = sweepface.Face(self.rig, eyes=True, limits="0:0.6", regions=self.regions)
        frames = face.evaluate(late.weights_of(self.rig, moments), look=clip.angles(moments))
        self.assertGreater(np.abs(frames[2] - frames[1]).max(), 0.1)
        for f, frame in enumerate(frames):
            with open(self.path(f"frames/frame_{f:04}.obj")) as file:
                told = [line.split()[1:4] for line in file if line.startswith("v ")]
            self.assertLess(np.abs(frame - np.array(told, float)).max(), 0.005)

    def test_refuse_what_makes_no_sense(self):
        for told in ({"frequency": 0}, {"frequency": np.nan}, {"damping": -1}):
            with self.refuses("the spring on which heavy regions hang"):
                self.clip().in_regions(self.regions, **told)
        with self.refuses("needs a region"):
            self.clip().in_regions([])
        clips = self.clip().in_regions(self.regions)
        with self.refuses("Times must be an array of numbers"):
            clips.weights_of(self.rig, "late")
        with self.refuses("not nan"):
            clips.weights_of(self.rig, [np.nan])
        with self.refuses("None of the clip's 1 names"):
            sweepface.Clip(["tail"], [0], [[1]]).in_regions(self.regions).weights_of(self.rig, [0])


class Timelines(RegionTest):
    def timeline(self, region="cheeks"):
        drive = {"drive": "accelerate-brake", "seconds": 0.5}
        events = [{"at": 0, "to": {"jawOpen": 1}, **drive}, {"at": 0, "to": {"mouthSmileLeft": 1}, **drive, "region": region}]
        return {"seconds": 1, "loops": 2, "events": events}

    def test_move_single_regions(self):
        timeline = sweepface.read_timeline(self.write("line.json", self.timeline()))
        self.assertEqual((timeline.seconds, timeline.loops), (1, 2))
        self.assertEqual(repr(timeline), "<sweepface.Timeline: 2 events, 2.00 s>")
        weights = timeline.in_regions(self.regions).weights_of(self.rig, [0.25, 2])
        smile = self.rig.target("mouthSmileLeft")
        self.assertAlmostEqual(weights[0, 0, self.jaw], 0.5, places=3)
        self.assertAlmostEqual(weights[0, 1, self.jaw], 2 * 0.15**2, places=3)
        self.assertTrue(np.allclose(weights[1, :, self.jaw], 1, atol=1e-3))
        self.assertTrue(np.allclose(weights[1, :, smile], [0, 1], atol=1e-3))

    def test_refuse_regions_that_there_are_not(self):
        timeline = sweepface.parse_timeline(json.dumps(self.timeline("nose")))
        with self.refuses("nose"):
            timeline.in_regions(self.regions)
        with self.refuses("nose"):
            sweepface.read_clip(self.write("line.json", self.timeline("nose")))
        with self.refuses("^The timeline.*JSON"):
            sweepface.parse_timeline("{")
        with self.refuses("my line"):
            sweepface.parse_timeline("{}", "my line")
        with self.refuses("none.json"):
            sweepface.read_timeline(self.path("none.json"))


class Parts(RegionTest):
    def test_are_targets_of_their_own(self):
        parts = sweepface.RegionalTargets(self.rig, self.regions, ["jawOpen"])
        self.assertEqual(parts.rig.target_names[42:], ["jawOpen@rest", "jawOpen@cheeks"])
        self.assertEqual(list(parts.wholes[40:]), [40, 41, self.jaw, self.jaw])
        weights = self.weights(0.3, 0.8)
        spread = parts.spread(weights)
        self.assertTrue(np.allclose(spread[[self.jaw, 42, 43]], [0.3, 0, 0.5]))
        exact = self.rig.pose(weights, self.regions).positions()
        self.assertTrue(np.allclose(parts.rig.pose(spread).positions(), exact, atol=1e-12))
        self.assertTrue(np.array_equal(parts.spread([weights, weights])[1], spread))
        self.assertTrue(np.array_equal(parts.spread({"jawOpen": 1})[[self.jaw, 42, 43]], [1, 0, 0]))
        self.assertEqual(len(self.rig.target_names), 42)
        all_of_them = sweepface.RegionalTargets(self.rig, self.regions)
        self.assertGreater(len(all_of_them.rig.target_names), 60)

    def test_refuse_weights_that_they_cannot_show(self):
        parts = sweepface.RegionalTargets(self.rig, self.regions, ["jawOpen"])
        weights = self.weights(0.3, 0.8)
        weights[1, 0] = 0.5
        with self.refuses("The weights of 'eyeBlinkLeft' differ between regions"):
            parts.spread(weights)

    def test_refuse_targets_that_there_are_not(self):
        with self.refuses("frown"):
            sweepface.RegionalTargets(self.rig, self.regions, ["frown"])
        with self.refuses("Targets must be a list of names"):
            sweepface.RegionalTargets(self.rig, self.regions, "jawOpen")
        with self.refuses("regions"):
            sweepface.RegionalTargets(self.rig, None)
        with self.assertRaises(TypeError):
            sweepface.RegionalTargets(None, self.regions)


class Sheets(FaceTest):
    def test_are_divided_too(self):
        rig = sweepface.convert(sheet(), 0.01)
        left = sweepface.Region("left", (rig.pose().nodes()[:, 0] < 2.5).astype(float))
        face = sweepface.Face(rig, regions=[left])
        moved = face.evaluate([[0], [1]]) - face.evaluate()
        self.assertGreater(moved[:, 2].max(), 0.1)
        self.assertTrue(np.allclose(moved[sheet().positions[:, 0] == 5], 0, atol=0.01))


if __name__ == "__main__":
    unittest.main()
