"""Recordings and timelines."""

import json
import unittest
import warnings

import numpy as np
import sweepface
from faces import FaceTest


class Clips(FaceTest):
    def clip(self):
        times = np.arange(61) / 60
        jaw = 0.5 - 0.5 * np.cos(2 * np.pi * times)
        return sweepface.Clip(["JawOpen", "browInnerUp", "tail"], times, np.stack([jaw, jaw / 2, 0 * jaw], axis=1))

    def test_drive_targets_by_their_names(self):
        match = self.clip().match(self.rig)
        self.assertEqual(match["JawOpen"], ["jawOpen"])
        self.assertEqual(match["tail"], [])
        weights = self.clip().weights_of(self.rig)
        self.assertEqual(weights.shape, (61, 42))
        self.assertAlmostEqual(weights[30, self.rig.target_names.index("jawOpen")], 1)
        between = self.clip().weights_of(self.rig, [-1, 0.25, 99])
        self.assertAlmostEqual(between[1].max(), 0.5)
        self.assertTrue((between[[0, 2]] == 0).all())
        with self.assertWarnsRegex(UserWarning, "1 of the clip's 2 names drive no target of the rig: tail"):
            sweepface.Clip(["jawOpen", "tail"], [0], [[1, 1]]).weights_of(self.rig)
        with self.refuses("None of the clip's 1 names"):
            sweepface.Clip(["tail"], [0], [[1]]).weights_of(self.rig)

    def test_make_the_round_trip_through_a_capture(self):
        self.clip().save_csv(self.path("take.csv"))
        back = sweepface.read_clip(self.path("take.csv"))
        self.assertTrue(np.allclose(back.weights_of(self.rig), self.clip().weights_of(self.rig), atol=1e-6))
        self.assertEqual(repr(back)[:28], "<sweepface.Clip: 61 frames o")
        both = sweepface.Clip(["eyeBlink"], [0, 1], [[0.2], [0.1]])  # of no side
        both.save_csv(self.path("both.csv"))
        back = sweepface.read_clip(self.path("both.csv"))
        self.assertTrue(np.array_equal(back.weights_of(self.rig), both.weights_of(self.rig)))

    def test_become_few_keys(self):
        keys = self.clip().keys(1e-3)
        self.assertLess(len(keys["times"]), 12)
        self.assertEqual(keys["values"].shape, (len(keys["times"]), 3))
        self.assertEqual(keys["slopes_in"].shape, keys["slopes_out"].shape)

    def test_lose_noise(self):
        noise = 0.05 * np.random.default_rng(1).standard_normal((200, 1))
        clip = sweepface.Clip(["jawOpen"], np.arange(200) / 60, 0.5 + noise)
        self.assertLess(clip.smoothed(cutoff=0.2, speed_gain=0).weights.std(), 0.5 * noise.std())
        with self.refuses("cutoff"):
            clip.smoothed(cutoff=0)

    def test_drive_faces_that_name_targets_otherwise(self):
        renamed = self.clip().renamed({"tail": "jawOpen", "JawOpen": {"eyeBlinkLeft": 0.5}}, self.rig)
        weights = renamed.weights_of(self.rig, [0.5])[0]
        self.assertAlmostEqual(weights[self.rig.target_names.index("eyeBlinkLeft")], 0.5)
        with self.assertWarnsRegex(UserWarning, "the clip has no horn"):
            self.clip().renamed({"horn": "jawOpen"}, self.rig)
        with self.refuses("A factor must be a number"):
            self.clip().renamed({"tail": {"jawOpen": "half"}}, self.rig)
        with self.refuses("wings"):
            self.clip().renamed({"tail": "wings"}, self.rig)
        with self.refuses("no number within"):
            self.clip().renamed({"tail": {"jawOpen": 2000}}, self.rig)
        with self.refuses("a name, a list of names, a dict of numbers, or None"):
            self.clip().renamed({"tail": 5}, self.rig)
        with self.assertRaisesRegex(ValueError, "Names are empty"):
            self.clip().renamed({}, self.rig)
        several = self.clip().renamed({"JawOpen": ["jawOpen", "eyeBlinkLeft"], "browInnerUp": None}, self.rig)
        self.assertEqual([np.count_nonzero(row) for row in several.weights_of(self.rig, [0.5])], [2])

    def test_are_baked_from_timelines(self):
        events = [{"at": 0, "to": {"jawOpen": 1}, "drive": "accelerate-brake", "seconds": 0.5}]
        with open(self.path("line.json"), "w") as file:
            json.dump({"seconds": 1, "events": events}, file)
        weights = sweepface.read_clip(self.path("line.json")).weights_of(self.rig, [0, 0.25, 0.5, 1])
        self.assertTrue(np.allclose(weights[:, self.rig.target_names.index("jawOpen")], [0, 0.5, 1, 1], atol=1e-3))
        quick = {"at": 0, "to": {"jawOpen": 1}, "frequency": 5000, "damping": 1e-4}
        region = {"name": "cheeks", "points": [[0, 8, 9]], "fade": 2}
        for told, sentence in (({"events": [quick]}, "more quickly"), ({"events": events, "regions": [region]}, "its regions are left out")):
            with open(self.path("line.json"), "w") as file:
                json.dump({"seconds": 1, **told}, file)
            with self.assertWarnsRegex(UserWarning, sentence):
                sweepface.read_clip(self.path("line.json"))
        with self.refuses("tells its own times"):
            sweepface.read_clip(self.path("line.json"), frames_per_second=30)

    def test_refuse_what_makes_no_sense(self):
        for arguments, sentence in (
            ((["a"], [0, 0], [[1], [1]]), "increase"),
            ((["a"], [0, np.nan], [[1], [1]]), "increase"),
            ((["a"], [0, 1], [[1]]), r"an array \[2, 1\]"),
            ((["a"], [0], [[np.nan]]), "Weights must be numbers"),
        ):
            with self.refuses(sentence):
                sweepface.Clip(*arguments)
        with self.refuses("none.csv"):
            sweepface.read_clip(self.path("none.csv"))
        with open(self.path("take.txt"), "w"):
            pass
        with self.refuses("neither a .csv"):
            sweepface.read_clip(self.path("take.txt"))
        with self.refuses("between 0 and 1000"):
            sweepface.read_clip(self.path("take.csv"), frames_per_second=-1)
        with self.refuses("between 0 and 1000"):
            self.clip().save_csv(self.path("take.csv"), 2000)
        self.clip().save_csv(self.path("take.csv"))
        with self.refuses("no animations to choose from"):
            sweepface.read_clip(self.path("take.csv"), animation="talk")

    def test_have_the_names_of_a_capture_in_another_encoding(self):
        with open(self.path("take.csv"), "wb") as file:
            file.write(b"Timecode,jawOpen,m\xfcnd\n0,0.5,1\n1,1,0\n")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            clip = sweepface.read_clip(self.path("take.csv"))
        self.assertEqual(clip.names, ["jawOpen", "m\\xfcnd"])
        self.assertEqual(clip.match(self.rig), {"jawOpen": ["jawOpen"], "m\\xfcnd": []})


if __name__ == "__main__":
    unittest.main()
