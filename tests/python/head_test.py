"""Angles of eyes and head."""

import json
import unittest

import numpy as np
import sweepface
from faces import FaceTest

NAMES = ["jawOpen", "HeadYaw", "HeadPitch", "HeadRoll", "LeftEyeYaw", "RightEyePitch"]


def take():
    return sweepface.Clip(NAMES, [2, 3], [[0] * 6, [1, 0.1, 0.2, 0.3, 0.4, 0.5]])


class Angles(FaceTest):
    def test_of_clips_are_right_handed(self):
        angles = take().angles()
        self.assertEqual(sorted(angles), ["head", "left_eye", "right_eye"])
        self.assertTrue(np.array_equal(angles["head"], [[0, 0, 0], [-0.1, 0.2, -0.3]]))
        self.assertTrue(np.array_equal(angles["left_eye"][1], [-0.4, 0, 0]))
        between = take().angles([2.5, 99])
        self.assertTrue(np.allclose(between["right_eye"], [[0, 0.25, 0], [0, 0.5, 0]]))
        with self.refuses("not nan"):
            take().angles([np.nan])

    def test_tell_whether_anything_turns(self):
        self.assertTrue(take().turns_head and take().turns_eyes)
        still = sweepface.Clip(NAMES, [0], [[1, 0, 0, 0, 0, 0]])
        self.assertFalse(still.turns_head or still.turns_eyes)
        self.assertFalse(sweepface.Clip([], [], np.zeros((0, 0))).turns_head)
        self.assertEqual(sweepface.Clip([], [], np.zeros((0, 0))).angles()["head"].shape, (0, 3))

    def test_make_quaternions(self):
        half = np.pi / 2
        turns = sweepface.quaternion_of([[half, 0, 0], [0, half, 0], [0, 0, half]])
        self.assertTrue(np.allclose(turns, np.sqrt(0.5) * np.array([[0, 1, 0, 1], [1, 0, 0, 1], [0, 0, 1, 1]])))
        angles = np.random.default_rng(1).uniform(-1, 1, (4, 5, 3))
        self.assertTrue(np.allclose(np.linalg.norm(sweepface.quaternion_of(angles), axis=-1), 1))
        self.assertEqual(sweepface.quaternion_of(angles[:, ::2]).shape, (4, 3, 4))
        self.assertTrue(np.array_equal(sweepface.quaternion_of(angles[1, 2]), sweepface.quaternion_of(angles)[1, 2]))
        for wrong in (0.5, [0.1, 0.2], np.zeros((3, 2))):
            with self.refuses(r"\[..., 3\]"):
                sweepface.quaternion_of(wrong)
        with self.refuses("finite"):
            sweepface.quaternion_of([np.inf, 0, 0])


class Eyes(FaceTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.face = sweepface.Face(cls.rig, eyes=True)

    def ballOf(self, rest, moved):
        return np.flatnonzero(np.linalg.norm(moved - rest, axis=1) > 1e-3)

    def test_turn_by_angles(self):
        rest, aside = self.face.evaluate(), self.face.evaluate(look={"left_eye": [0.3, 0]})
        ball = self.ballOf(rest, aside)
        self.assertTrue((rest[ball, 0] > 0).all())
        centre = rest[ball].min(axis=0) / 2 + rest[ball].max(axis=0) / 2
        front = ball[rest[ball, 2].argmax()]
        self.assertGreater(aside[front, 0], rest[front, 0])  # to the face's left
        arms = rest[ball] - rest[ball[0]], aside[ball] - aside[ball[0]]
        cosine, sine = np.cos(0.3), np.sin(0.3)
        turned = arms[0] @ np.array([[cosine, 0, -sine], [0, 1, 0], [sine, 0, cosine]])
        self.assertLess(np.abs(turned - arms[1]).max(), 0.01)
        self.assertLess(np.abs(aside[ball].mean(axis=0) - centre).max(), 1)

    def test_do_not_follow_weights_then(self):
        ahead = self.face.evaluate({"eyeLookOutLeft": 1}, look={"left_eye": [0, 0], "right_eye": [0, 0]})
        ball = self.ballOf(self.face.evaluate(), self.face.evaluate(look={"left_eye": [0.3, 0]}))
        self.assertLess(np.linalg.norm(ahead - self.face.evaluate(), axis=1)[ball].max(), 0.05)
        self.assertGreater(np.abs(self.face.evaluate({"eyeLookOutLeft": 1}) - ahead)[ball].max(), 0.1)

    def test_turn_in_every_frame(self):
        times = [2, 2.25, 3]
        weights, angles = take().weights_of(self.rig, times), take().angles(times)
        frames = self.face.evaluate(weights, look=angles)
        for f in range(3):
            look = {name: angle[f] for name, angle in angles.items()}
            self.assertTrue(np.array_equal(frames[f], self.face.evaluate(weights[f], look=look)))
        same = self.face.evaluate(weights, look={"left_eye": angles["left_eye"], "right_eye": [0.2, 0.1]})
        look = {"left_eye": angles["left_eye"][2], "right_eye": [0.2, 0.1, 0.7]}
        self.assertTrue(np.array_equal(same[2], self.face.evaluate(weights[2], look=look)))
        strided = {"left_eye": np.asfortranarray(angles["left_eye"]), "right_eye": np.tile([0.2, 0.1], (6, 1))[::2]}
        self.assertTrue(np.array_equal(self.face.evaluate(weights, look=strided), same))
        none = {"left_eye": np.zeros((0, 3)), "right_eye": [0, 0]}
        self.assertEqual(self.face.evaluate(weights[:0], look=none).shape, (0, 8216, 3))

    def test_refuse_angles_that_make_no_sense(self):
        for look, sentence in (
            ({"nose": [0, 0]}, "no 'nose'"),
            ({3: [0, 0]}, "must be a text"),
            ([0, 0], "must be a dict"),
            ({"left_eye": 1}, "yaw, pitch and roll"),
            ({"left_eye": [1]}, "yaw, pitch and roll"),
            ({"left_eye": np.zeros((2, 3))}, "each of 1 frames"),
            ({"left_eye": np.zeros((0, 3))}, "each of 1 frames"),
            ({"left_eye": "up"}, "must be an array"),
            ({"left_eye": [np.nan, 0]}, "finite"),
        ):
            with self.refuses(sentence):
                self.face.evaluate(look=look)
        with self.refuses("made without eyes that turn"):
            sweepface.Face(self.rig).evaluate(look={"left_eye": [0, 0]})


class Heads(FaceTest):
    def rotations(self, **told):
        self.rig.save_glb(self.path("take.glb"), clip=take(), **told)
        with open(self.path("take.glb"), "rb") as file:
            data = file.read()
        document = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
        animation = document["animations"][0]
        starts = {document["accessors"][sampler["input"]]["min"][0] for sampler in animation["samplers"]}
        self.assertEqual(starts, {0}, "whenever the take began")
        paths = [channel["target"]["path"] for channel in animation["channels"]]
        places = [node["translation"] for node in document["nodes"] if node.get("name") == "head"]
        return paths.count("rotation"), places

    def test_turn_the_whole_model_of_a_file(self):
        self.assertEqual(self.rotations()[0], 0)
        count, (place,) = self.rotations(head=True)
        self.assertEqual(count, 1)
        positions = self.rig.pose().positions()
        middle = (positions.min(axis=0) + positions.max(axis=0)) / 2
        self.assertTrue(np.allclose(place, middle, atol=0.1))
        self.assertTrue(np.allclose(self.rotations(head=True, pivot=np.array([9, 1, 9, 2, 9, 3])[1::2])[1], [[1, 2, 3]]))

    def test_refuse_what_makes_no_sense(self):
        path = self.path("take.glb")
        with self.refuses("give one"):
            self.rig.save_glb(path, head=True)
        with self.refuses("no angles of the head"):
            self.rig.save_glb(path, clip=sweepface.Clip(["jawOpen"], [0], [[1]]), head=True)
        with self.refuses("leave the pivot out"):
            self.rig.save_glb(path, clip=take(), pivot=[0, 0, 0])
        for pivot in ([1, 2], [np.inf, 0, 0], "here", [[1, 2, 3]]):
            with self.refuses("The pivot must be"):
                self.rig.save_glb(path, clip=take(), head=True, pivot=pivot)


if __name__ == "__main__":
    unittest.main()
