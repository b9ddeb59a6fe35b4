"""Faces prepared for playing."""

import subprocess
import sys
import threading
import unittest

import numpy as np
import sweepface
from faces import SAMPLE, FaceTest, interrupted, sheet

OPEN = {"jawOpen": 0.7, "eyeBlinkLeft": 0.4}


class Faces(FaceTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.face = sweepface.Face(cls.rig)

    def test_agree_with_the_reference(self):
        pose = self.rig.pose(OPEN)
        positions, normals = self.face.evaluate(OPEN, normals=True)
        self.assertEqual((positions.dtype, positions.shape), (np.float32, (8216, 3)))
        gap = np.linalg.norm(positions - pose.positions(), axis=1).max()
        self.assertLessEqual(gap, self.face.bound(OPEN))
        self.assertLess(self.face.bound(OPEN), 0.01)
        fine = sweepface.Face(self.rig, tolerance=1e-4)
        self.assertLess(fine.bound(OPEN), 0.5 * self.face.bound(OPEN))
        self.assertLess(np.linalg.norm(fine.evaluate(OPEN) - pose.positions(), axis=1).max(), fine.bound(OPEN))
        with self.refuses("must be greater than 0"):
            sweepface.Face(self.rig, tolerance=0)
        with self.refuses("of one frame"):
            self.face.bound(np.zeros((0, 42)))
        cosine = (normals * pose.normals()).sum(axis=1)
        self.assertGreater(np.percentile(cosine, 1), 0.999)

    def test_evaluate_many_frames_at_once(self):
        weights = np.random.default_rng(1).random((20, 42))
        frames, normals = self.face.evaluate(weights, normals=True)
        self.assertEqual(frames.shape, (20, 8216, 3))
        self.assertTrue(np.array_equal(self.face.evaluate(weights.tolist()), frames))
        byVertex = np.zeros((8216, 20, 3), np.float32)
        self.face.evaluate(weights, positions=byVertex.transpose(1, 0, 2))
        self.assertTrue(np.array_equal(byVertex[:, 7], frames[7]))
        for k in (0, 7, 19):
            one, its = self.face.evaluate(weights[k], normals=True)
            self.assertTrue(np.array_equal(frames[k], one))
            self.assertTrue(np.array_equal(normals[k], its))
        self.assertEqual(self.face.evaluate(weights[:0]).shape, (0, 8216, 3))

    def test_write_to_arrays_that_are_given(self):
        whole = np.full((8216, 8), -1, np.float32)
        self.face.evaluate(OPEN, positions=whole[:, 1:4], normals=whole[:, 4:7])
        positions, normals = self.face.evaluate(OPEN, normals=True)
        self.assertTrue(np.array_equal(whole[:, 1:4], positions))
        self.assertTrue(np.array_equal(whole[:, 4:7], normals))
        self.assertTrue((whole[:, [0, 7]] == -1).all())
        only = self.face.evaluate(OPEN, positions=False, normals=True)
        self.assertTrue(np.array_equal(only, normals))
        self.assertIsNone(self.face.evaluate(OPEN, positions=False))
        self.assertEqual(repr(self.face), "<sweepface.Face: 8216 vertices, 16204 triangles, 42 targets>")

    def test_refuse_arrays_that_do_not_fit(self):
        fixed = np.zeros((8216, 3), np.float32)
        fixed.flags.writeable = False
        for array in (
            np.zeros((8216, 3)),
            np.zeros((8215, 3), np.float32),
            np.zeros((8216, 3), np.float32)[::-1],
            np.zeros((3, 8216), np.float32).T,
            np.broadcast_to(np.zeros(3, np.float32), (8216, 3)),
            np.zeros(3 * 8216, np.float32),
            np.zeros((8216, 3), np.dtype(">f4")),
            np.frombuffer(bytearray(12 * 8216 + 1), np.float32, 3 * 8216, offset=1).reshape(-1, 3),
            list(np.zeros((8216, 3), np.float32)),
            fixed,
        ):
            with self.refuses(r"Positions must be written to a float32 array of shape \[8216, 3\]"):
                self.face.evaluate(OPEN, positions=array)
        with self.refuses("Normals must be written to"):
            self.face.evaluate(np.zeros((2, 42)), normals=np.zeros((1, 8216, 3), np.float32))
        same = np.zeros((8217, 3), np.float32)
        for shift in (0, 1):
            with self.refuses("different places"):
                self.face.evaluate(OPEN, positions=same[:-1], normals=same[shift:][:8216])
        frames = np.zeros((8216, 5, 3), np.float32)  # [V, F, 3]
        with self.refuses("different places"):
            self.face.evaluate(np.zeros((3, 42)), positions=frames[:, :3].transpose(1, 0, 2),
                               normals=frames[:, 1:4].transpose(1, 0, 2))
        beside = {"positions": frames[:, :2].transpose(1, 0, 2), "normals": frames[:, 2:4].transpose(1, 0, 2)}
        self.face.evaluate(np.ones((2, 42)), **beside)
        self.assertTrue(np.array_equal(beside["normals"], self.face.evaluate(np.ones((2, 42)), normals=True)[1]))
        folded = np.lib.stride_tricks.as_strided(same, (2, 8216, 3), (12, 12, 4))
        with self.refuses("Positions must be written to"):
            self.face.evaluate(np.zeros((2, 42)), positions=folded)
        with self.refuses("41 weights a frame for 42 targets"):
            self.face.evaluate(np.zeros((2, 41)))
        with self.refuses("Weights must be numbers"):
            self.face.evaluate(np.full((2, 42), np.inf))

    def test_have_the_mesh_that_graphics_cards_want(self):
        corners = len(self.face.points)
        self.assertEqual(self.face.texcoords.shape, (corners, 2))
        self.assertLess(self.face.triangles.max(), corners)
        self.assertEqual(len(self.face.triangles), 16204)
        self.assertLess(self.face.points.max(), self.face.vertex_count)
        places = self.face.evaluate()[self.face.points][self.face.triangles]
        area = np.linalg.norm(np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]), axis=1)
        self.assertGreater(np.median(area), 0)
        self.assertGreater(self.face.table_bytes, 10000)

    def test_come_at_levels_of_detail(self):
        self.assertLessEqual(sweepface.Face(self.rig, vertices=3000).vertex_count, 3000)
        fine = sweepface.Face(self.rig, 2, normals=False)
        self.assertTrue(np.allclose(fine.evaluate(OPEN), self.rig.pose(OPEN).positions(level=2), atol=0.01))
        coarse, close = (sweepface.Face(self.rig, error=e).vertex_count for e in (0.1, 0.01))
        self.assertLess(coarse, close)
        self.assertGreater(sweepface.Face(self.rig, edge_length=0.3).vertex_count, 100)
        with self.refuses("one of vertices, edge_length and error"):
            sweepface.Face(self.rig, vertices=3000, error=0.1)
        with self.refuses("either a level or a budget"):
            sweepface.Face(self.rig, 1, vertices=3000)
        with self.refuses("between 0 and 64, not 65"):
            sweepface.Face(self.rig, 65)
        with self.refuses("."):
            sweepface.Face(self.rig, vertices=3)
        with self.refuses("made without normals"):
            fine.evaluate(OPEN, normals=True)

    def test_move_on_arcs(self):
        arcs = sweepface.Face(self.rig, arcs=True)
        for weight, least, most in ((0, 0, 1e-6), (0.5, 0.05, 1), (1, 0, 0.01)):
            gap = np.abs(arcs.evaluate({"jawOpen": weight}) - self.face.evaluate({"jawOpen": weight})).max()
            self.assertTrue(least <= gap <= most, (weight, gap))
        with self.refuses("No target turns anything"):
            sweepface.Face(sweepface.convert(sheet(), 0.01), arcs=True)

    def test_turn_eyes(self):
        turning = sweepface.Face(self.rig, eyes=True)
        rest = turning.evaluate()
        moved = np.linalg.norm(turning.evaluate({"eyeLookOutLeft": 1}) - rest, axis=1)
        ball = np.flatnonzero(moved > 0.5 * moved.max())
        apart = [np.linalg.norm(p[ball[0]] - p[ball[1:]], axis=1) for p in (rest, turning.evaluate({"eyeLookOutLeft": 0.5}))]
        self.assertLess(np.abs(apart[0] - apart[1]).max(), 0.005)
        with self.refuses("no eyeballs"):
            sweepface.Face(sweepface.convert(sheet(), 0.01), eyes=True)
        again = sheet().with_shapes({"eyeLeft.down": sheet().positions + [0, 0, 1]})
        with self.refuses("no eyeballs"), self.assertWarnsRegex(UserWarning, "like 'eyeLeft.down'"):
            sweepface.Face(sweepface.convert(again, 0.01), eyes=True)

    def test_combine_targets(self):
        flat = sheet().positions
        meshes = sheet().with_shapes({"a": flat + [0, 0, 1], "b": flat + [0, 1, 0], "a_b": flat + [1, 0, 0]})
        face = sweepface.Face(sweepface.convert(meshes, 0.01), combine=True)
        moved = face.evaluate({"a": 0.5, "b": 0.5, "a_b": 9}) - face.evaluate()
        self.assertTrue(np.allclose(moved, [0.25, 0.5, 0.5], atol=0.02))
        many = face.evaluate([[0.5, 0.5, 9], [1, 0, 0]])
        self.assertTrue(np.allclose(many[0] - many[1], [0.25, 0.5, -0.5], atol=0.02))
        with self.refuses("No target is named after others"):
            sweepface.Face(self.rig, combine=True)

    def test_keep_weights_within_limits(self):
        limited = sweepface.Face(self.rig, limits="0:1,jawOpen=0.2:0.8")
        bounds = self.rig.limits("0:1,jawOpen=0.2:0.8")
        self.assertEqual(bounds.shape, (42, 2))
        self.assertTrue(np.array_equal(bounds[self.rig.target("jawOpen")], [0.2, 0.8]))
        self.assertTrue(np.isinf(self.rig.limits("jawOpen=0:1")[self.rig.target("eyeBlinkLeft")]).all())
        for jaw, blink in ((3, 2), (-1, -1), (0.5, 0.5)):
            weights = self.rig.weights({"jawOpen": jaw, "eyeBlinkLeft": blink})
            clipped = np.clip(weights, *bounds.T)
            self.assertTrue(np.array_equal(limited.evaluate(weights), self.face.evaluate(clipped)))
        many = limited.evaluate([np.full(42, 9), np.zeros(42)])
        self.assertTrue(np.array_equal(many[0], self.face.evaluate(np.clip(np.full(42, 9), *bounds.T))))
        turning = sweepface.Face(self.rig, limits="0:0.5", eyes=True)
        half = sweepface.Face(self.rig, eyes=True).evaluate({"eyeLookOutLeft": 0.5})
        self.assertTrue(np.array_equal(turning.evaluate({"eyeLookOutLeft": 1}), half))
        for limits, sentence in (("1:0", "lower one first"), ("0", "0:1"), ("frown=0:1", "frown"), ("0:1,0:2", "twice")):
            with self.refuses(sentence):
                sweepface.Face(self.rig, limits=limits)
            with self.refuses(sentence):
                self.rig.limits(limits)

    def test_end_long_work_when_they_are_interrupted(self):
        program = (
            "face = sweepface.Face(rig, 4)\n"
            "weights = np.random.default_rng(1).random((1000, 42))\n"
            "normals = np.full((1000, face.vertex_count, 3), 9, np.float32)\n"
            "def work(): face.evaluate(weights, positions=False, normals=normals)\n"
            "def left(): return (normals[:, 0, 0] == 9).sum()\n"
        )
        word, _, left = interrupted(program, 0.01)
        self.assertEqual(word, "interrupted")
        self.assertGreater(int(left), 0)

    def test_are_made_of_rigs_alone(self):
        with self.assertRaises(TypeError):
            sweepface.Face(None)

    def test_may_still_play_when_the_program_ends(self):
        program = (
            "import sweepface, threading, time\n"
            f"face = sweepface.Face(sweepface.load({SAMPLE!r}))\n"
            "def play():\n"
            "    while True: face.evaluate()\n"
            "threading.Thread(target=play, daemon=True).start()\n"
            "time.sleep(0.1)\n"
        )
        for _ in range(3):
            subprocess.run([sys.executable, "-c", program], check=True, timeout=60)

    def test_play_in_several_threads(self):
        expected = self.face.evaluate(OPEN)
        results = [None] * 4

        def play(k):
            for _ in range(20):
                results[k] = self.face.evaluate(OPEN)

        threads = [threading.Thread(target=play, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            self.assertTrue(np.array_equal(result, expected))


if __name__ == "__main__":
    unittest.main()
