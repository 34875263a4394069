"""Arrays lie in the results, tables become data frames, notebooks get charts."""

import gc
import json
import unittest
import weakref

from surroundings import EXAMPLES, need, program

need("numpy", "pandas")
import damslip  # noqa: E402
import numpy  # noqa: E402

PROFILE = EXAMPLES / "reference_dam_profile.toml"


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.fe = damslip.load(PROFILE).fe(polarity=1, mesh_error=False)

    def test_arrays_are_views_that_keep_the_result_alive(self):
        result = damslip.load(PROFILE).modes(3)
        gone = weakref.ref(result) if hasattr(result, "__weakref__") else None
        frequencies = result.frequencies
        self.assertFalse(frequencies.flags.owndata)
        again = result.frequencies
        self.assertEqual(frequencies.ctypes.data, again.ctypes.data)  # the same memory
        values = frequencies.copy()
        del result, again
        gc.collect()
        junk = [numpy.full(len(values), -1.0) for _ in range(1000)]  # would take freed memory
        numpy.testing.assert_array_equal(frequencies, values)
        self.assertEqual(len(junk), 1000)
        self.assertTrue(gone is None or gone() is not None)

    def test_arrays_cannot_be_written_to(self):
        with self.assertRaises(ValueError):
            self.fe.runs[0].slip_history[0] = 1.0

    def test_a_history_ends_at_the_slip(self):
        run = self.fe.worst
        self.assertEqual(run.slip_history[-1], run.slip)
        self.assertEqual(run.time[-1], run.end_time)
        self.assertEqual(run.pair_slip.shape, (len(run.time), len(run.distance)))
        numpy.testing.assert_allclose(run.pair_slip[-1], run.slip_at_end, rtol=1e-14, atol=1e-18)

    def test_the_error_is_of_step_and_mesh(self):
        run = damslip.load(PROFILE).fe(polarity=1).worst
        self.assertAlmostEqual(run.slip_error, run.step_error + run.mesh_error, delta=1e-12)
        self.assertIsNone(self.fe.worst.mesh_error)  # was not asked for

    def test_tables_become_data_frames(self):
        screening = damslip.load(PROFILE).screen()
        frame = screening.to_pandas()
        self.assertEqual(list(frame["max_slip_m"]), [s.max_slip for s in screening.slips])
        self.assertEqual(len(screening.to_pandas("limit_equilibrium")), len(screening.tables["limit_equilibrium"]))
        with self.assertRaises(KeyError) as caught:
            screening.to_pandas("slips")
        self.assertIn("displacements", str(caught.exception))
        sweep = damslip.load(PROFILE).sweep(friction="0.7:0.8:0.1", method="rigid")
        self.assertEqual(sweep.to_pandas()["slip_m"].dtype, float)

    def test_a_notebook_shows_charts(self):
        shown = damslip.load(PROFILE).screen()._repr_html_()
        self.assertIn("<iframe srcdoc=", shown)
        self.assertIn("Yield acceleration", shown)
        self.assertNotIn("Scene as TOML", shown)

    def test_a_result_says_its_sentence(self):
        printed = json.loads(program("fe", PROFILE, "--polarity", "1", "--no-mesh-error", "--json", "--quiet"))
        self.assertIn(printed["headline"], repr(self.fe))
        self.assertIn(f"{1e3 * self.fe.worst.max_slip:.4g} mm", repr(self.fe))
        self.assertEqual(self.fe.verdict, self.fe.json()["verdict"])

    def test_accuracy_names_a_rung(self):
        found = damslip.load(EXAMPLES / "rock_slope.toml").accuracy(quick=True)
        self.assertIn(found.choice, list(found.to_pandas()["rung"]))


if __name__ == "__main__":
    unittest.main()
