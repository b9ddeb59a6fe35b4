"""The solutions of the sixth-order equation, as NumPy sees them."""

import unittest

import numpy as np
import sweepface
from faces import FaceTest


class Basis(FaceTest):
    def test_solves_its_equation(self):
        eta, lambda_ = -150.0, 4000.0
        basis = sweepface.SweepBasis(1, eta, lambda_)
        # S'''''' by differences of the third derivative, S'''' and S'' likewise exact.
        u, h = np.linspace(0.2, 0.8, 7), 1e-3
        third = [basis(u + k * h, order=3) for k in (-2, -1, 0, 1, 2)]
        fourth = (third[0] - 8 * third[1] + 8 * third[3] - third[4]) / (12 * h)
        sixth = (-third[0] + 2 * third[1] - 2 * third[3] + third[4]) / (2 * h**3)
        residual = sixth + eta * fourth + lambda_ * basis(u, order=2)
        self.assertLess(np.abs(residual).max(), 1e-3 * np.abs(sixth).max())

    def test_has_its_end_conditions(self):
        basis = sweepface.SweepBasis(eta=-10, lambda_=50, length=3)
        ends = np.concatenate([basis([0, 1], order=k) for k in range(3)])
        self.assertTrue(np.array_equal(ends[::2], np.eye(6)[:3]))
        self.assertTrue(np.array_equal(ends[1::2], np.eye(6)[3:]))

    def test_is_quintic_hermite_without_parameters(self):
        u = np.linspace(0, 1, 11)
        expected = 1 - 10 * u**3 + 15 * u**4 - 6 * u**5
        self.assertTrue(np.allclose(sweepface.SweepBasis()(u)[:, 0], expected, atol=1e-15))

    def test_of_fourth_order_is_cubic_hermite_without_lambda(self):
        u = np.linspace(0, 1, 11)
        basis = sweepface.TangentBasis()
        self.assertEqual(basis(u).shape, (11, 4))
        self.assertTrue(np.allclose(basis(u)[:, 0], 1 - 3 * u**2 + 2 * u**3, atol=1e-15))

    def test_refuses_resonances_and_what_makes_no_sense(self):
        with self.refuses("grow|no solution|resonan"):
            sweepface.SweepBasis(eta=80.7836, lambda_=1)
        with self.refuses("rho must not be zero"):
            sweepface.SweepBasis(rho=0)
        with self.refuses("orders 0 to 3, not 4"):
            sweepface.SweepBasis()([0.5], order=4)
        with self.refuses("u is between 0 and 1, not 1.1"):
            sweepface.SweepBasis()([1.1])
        with self.refuses("must be an array of numbers"):
            sweepface.SweepBasis()([[0.5]])


class Controls(FaceTest):
    def setUp(self):
        super().setUp()
        t = np.linspace(0, 1, 5)
        self.boundary = np.stack([t, t**2, 0 * t], axis=1)
        self.second = self.boundary + [0, 0, 0.1]
        self.third = self.boundary + [0, 0.1, 0.3]

    def test_make_the_round_trip(self):
        first, second = sweepface.derivatives_from_controls(self.boundary, self.second, self.third, 0.1, 0.25)
        back = sweepface.controls_from_derivatives(self.boundary, first, second, 0.1, 0.25)
        self.assertTrue(np.allclose(back[0], self.second, atol=1e-14))
        self.assertTrue(np.allclose(back[1], self.third, atol=1e-14))

    def test_stand_at_their_chord_lengths(self):
        u2, u3 = sweepface.spacing_from_chords(self.boundary, self.second, self.third, 2)
        self.assertAlmostEqual(u2, 0.05)
        self.assertGreater(u3, u2)

    def test_refuse_equal_parameters_and_other_counts(self):
        with self.refuses("different finite parameters"):
            sweepface.derivatives_from_controls(self.boundary, self.second, self.third, 0.1, 0.1)
        with self.refuses("as many points as the boundary curve, 5"):
            sweepface.derivatives_from_controls(self.boundary, self.second[1:], self.third, 0.1, 0.2)
        with self.refuses("would not be finite"):
            sweepface.controls_from_derivatives(self.boundary, self.second, self.third, np.nan, 1)
        with self.refuses("three numbers a row"):
            sweepface.controls_from_derivatives([1, 2, 3], self.second, self.third, 0.1, 0.2)


if __name__ == "__main__":
    unittest.main()
