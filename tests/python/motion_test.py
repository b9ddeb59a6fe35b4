"""Laws of motion over arrays of times."""

import unittest

import numpy as np
import sweepface
from faces import FaceTest

TIMES = np.linspace(0, 1, 21)


class Trajectories(FaceTest):
    def all(self):
        t = sweepface.Trajectory
        return {
            "law": t.by_law("newton", 0, 2, 1),
            "constant": t.constant_force(0, 2, 1, velocity=1),
            "linear": t.linear_force(0, 2, 1, velocity=1, end_velocity=-1),
            "two": t.two_forces(0, 2, 1, velocity=1, turn=0.3),
            "spring": t.spring(0, 2, frequency=3, damping=0.3, velocity=1),
            "bounce": t.bounce(0, 2, 0.4, restitution=0.5),
            "impulse": t.impulse(0, 3, 2),
            "periodic": t.periodic_force(0, 2, 1, 0.25, [(1, 2), (0, 3)]),
        }

    def test_their_velocity_is_the_derivative_of_their_position(self):
        inside, h = TIMES[1:-1] + 0.0137, 1e-6
        for name, path in self.all().items():
            position, velocity, acceleration = path(inside)
            self.assertEqual(position.shape, inside.shape)
            before, after = path(inside - h), path(inside + h)
            self.assertTrue(np.allclose((after[0] - before[0]) / (2 * h), velocity, atol=1e-5), name)
            self.assertTrue(np.allclose((after[1] - before[1]) / (2 * h), acceleration, atol=1e-3), name)

    def test_newton_is_the_square_of_the_time(self):
        position, _, acceleration = self.all()["law"](TIMES)
        self.assertTrue(np.allclose(position, 2 * TIMES**2))
        self.assertTrue(np.allclose(acceleration, 4))

    def test_move_until_they_have_arrived(self):
        path = self.all()["two"]
        self.assertTrue(path.moves(0.5))
        self.assertFalse(path.moves(1.01))

    def test_refuse_what_makes_no_sense(self):
        with self.refuses("must be numbers, not nan"):
            self.all()["law"]([np.nan])
        with self.refuses("brake"):
            sweepface.Trajectory.by_law("slow", 0, 1, 1)
        with self.refuses("."):
            sweepface.Trajectory.spring(0, 1, frequency=-1)
        with self.refuses("."):
            sweepface.Trajectory.constant_force(0, 1, 0)


class Motions(FaceTest):
    def test_go_from_one_set_of_weights_to_another(self):
        motion = sweepface.Motion([0, 1, 0.5], [1, 1, 0], law="brake", seconds=2, mass=3)
        positions = motion.positions([0, 1, 2, 9])
        self.assertTrue(np.allclose(positions, [[0, 1, 0.5], [0.75, 1, 0.125], [1, 1, 0], [1, 1, 0]]))
        self.assertTrue(np.allclose(motion.velocities([0])[0], [1, 0, -0.5]))
        self.assertTrue(np.allclose(motion.forces([0.5])[0], [-1.5, 0, 0.75]))
        self.assertEqual(motion.seconds, 2)

    def test_know_every_law(self):
        self.assertEqual(sweepface.laws, ("linear", "newton", "brake", "accelerate-brake", "linear-force"))
        for law in sweepface.laws:
            self.assertEqual(sweepface.Motion([0], [1], law).positions([1])[0, 0], 1)

    def test_refuse_sets_of_different_sizes(self):
        with self.refuses("."):
            sweepface.Motion([0, 1], [1])


class Live(FaceTest):
    def test_turns_round_without_a_jump(self):
        motion = sweepface.LiveMotion([0.0, 1.0])
        motion.move_to([1, 0], "spring", frequency=2, damping=0.5)
        motion.advance(0.1)
        position, velocity = motion.positions, motion.velocities
        motion.move_one(0, 0, "accelerate-brake", seconds=0.5)
        self.assertTrue(np.allclose(motion.positions, position))
        self.assertTrue(np.allclose(motion.velocities, velocity))
        motion.advance(0.6)
        self.assertEqual(motion.positions[0], 0)
        self.assertTrue(motion.moves())
        self.assertAlmostEqual(motion.now, 0.7)

    def test_is_pushed(self):
        motion = sweepface.LiveMotion([0])
        motion.push(0, 2, drag=1)
        self.assertAlmostEqual(motion.velocities[0], 2)

    def test_refuses_what_there_is_not(self):
        motion = sweepface.LiveMotion([0])
        for told in ({"speed": 1}, {"seconds": 1}):
            with self.refuses("The drive 'spring' has no use for '(speed|seconds)'"):
                motion.move_to([1], "spring", **told)
        with self.refuses("frequency must be a number"):
            motion.move_to([1], "spring", frequency="2")
        for seconds in (-1, np.nan, np.inf):
            with self.refuses("0 to 1e10 seconds"):
                motion.advance(seconds)
        with self.refuses("cut"):
            motion.move_to([1], "jump")
        with self.refuses("."):
            motion.move_one(1, 1)
        with self.refuses("."):
            motion.move_to([np.nan])
        with self.refuses("Goals must be an array .* Rig.weights makes one of a dict"):
            motion.move_to({"jawOpen": 1})
        with self.refuses("Rig.target tells that of a name"):
            motion.move_one("jawOpen", 1)
        with self.refuses("start must be an array"):
            sweepface.Motion({"jawOpen": 0}, [1])


if __name__ == "__main__":
    unittest.main()
