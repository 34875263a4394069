"""Fragility from Python: the program's bits, its arrays, suites of many records, Ctrl-C."""

import math
import os
import pathlib
import signal
import tempfile
import unittest

from surroundings import EXAMPLES, need, program

need("numpy", "pandas")
import damslip  # noqa: E402
import numpy  # noqa: E402

FRAGILITY = EXAMPLES / "fragility" / "dam.toml"
PROFILE = EXAMPLES / "reference_dam_profile.toml"
TABLES = {"probability": {"seed": 3, "replicates": 2, "variable": [
    {"name": "mu", "key": "contact.friction", "lognormal": {"median": 0.85, "beta": 0.12}}]}}


def burst(folder, i):
    """A wave train of its own length and frequency, in m/s2, of 4 s."""
    file = pathlib.Path(folder) / f"burst{i:02d}.csv"
    t = [0.01 * k for k in range(400)]
    rows = [f"{a:.2f},{math.sin(math.pi * a / 4) ** 2 * math.sin(2 * math.pi * (1 + 0.1 * i) * a):.9f}" for a in t]
    file.write_text("time_s,a_m_s2\n" + "\n".join(rows) + "\n")
    return file


class Fragility(unittest.TestCase):
    def test_the_same_bits_as_the_command(self):
        computed = damslip.load(FRAGILITY).fragility(samples=64, share_rows=16)
        with tempfile.TemporaryDirectory() as folder:
            printed = program("fragility", FRAGILITY, "--samples", "64", "--share-rows", "16", "--json", "--quiet", "--out",
                              folder)
            for table in ["samples", "probabilities"]:
                file = pathlib.Path(folder) / {"samples": "samples.csv", "probabilities": "fragility.csv"}[table]
                lines = file.read_text().splitlines(True)
                self.assertEqual("".join(line for line in lines if not line.startswith("#")), computed.tables[table].csv())
        self.assertEqual(printed, computed.json_text())

    def test_a_key_that_was_set_and_tables_given_are_the_same_as_in_the_file(self):
        text = FRAGILITY.read_text()
        changed = text.replace("median = 0.85, beta = 0.12", "median = 0.9, beta = 0.1").replace(
            "levels_g = [0.05, 0.075, 0.1, 0.125, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4]", "levels_g = [0.2, 0.3]").replace("density_kg_m3 = 2500", "density_kg_m3 = 2450")
        with tempfile.TemporaryDirectory(dir=FRAGILITY.parent) as folder:  # records are relative to the scene
            file = pathlib.Path(folder) / "changed.toml"
            file.write_text(changed.replace('"../../', '"../../../').replace('"hazard.csv"', '"../hazard.csv"'))
            of_file = damslip.load(file).fragility(samples=32, share_rows=0)
        variables = [{"name": "mu", "key": "contact.friction", "kind": "epistemic", "lognormal": {"median": 0.9, "beta": 0.1}},
                     {"name": "uplift", "key": "uplift.model", "kind": "epistemic",
                      "discrete": {"values": ["seepage", "linear"], "weights": [0.7, 0.3]}}]
        given = damslip.load(FRAGILITY).with_(dam__density_kg_m3=2450).fragility(
            levels=[0.2, 0.3], samples=32, share_rows=0, tables={"probability": {"variable": variables}})
        self.assertEqual(of_file.tables["samples"].csv(), given.tables["samples"].csv())
        self.assertEqual(of_file.tables["rates"].csv(), given.tables["rates"].csv())
        plain = damslip.load(FRAGILITY).fragility(levels=[0.2, 0.3], samples=32, share_rows=0)
        self.assertNotEqual(plain.tables["samples"].csv(), given.tables["samples"].csv())

    def test_forty_records_at_ten_levels_in_one_call(self):
        levels = [0.05 * k for k in range(1, 11)]
        with tempfile.TemporaryDirectory() as folder:
            files = [burst(folder, i) for i in range(40)]
            scene = damslip.load(PROFILE)
            result = scene.fragility(records=files, levels=levels, limits_mm=[1, 10], method="rigid",
                                     tables={"suite": {"polarity": "both", "max_scale": 10}})
            pattern = scene.fragility(records=os.path.join(folder, "*.csv"), levels=[9.80665 * g for g in levels],
                                      unit="m/s2", limits_mm=[1, 10], method="rigid", tables={"suite": {"polarity": "both", "max_scale": 10}})
        self.assertEqual(len(result), 40 * 10 * 2)  # nothing is drawn: the whole suite, both ways round
        self.assertTrue(result.complete)
        self.assertEqual(len(result.records), 40)
        self.assertTrue(numpy.isfinite(result.slip).all())
        numpy.testing.assert_array_equal(result.slip, pattern.slip)
        # P is counted from the runs' arrays
        for curve, limit in zip(result.curves, [0.001, 0.01]):
            self.assertAlmostEqual(curve.allowable, limit, delta=1e-15)
            counted = [numpy.mean(result.slip[result.level == k] > limit) for k in range(10)]
            numpy.testing.assert_allclose(curve.probability, counted, rtol=0, atol=1e-12)
            numpy.testing.assert_allclose(curve.intensity, 9.80665 * numpy.array(levels), rtol=1e-14)
        self.assertLess(result.curves[1].probability[0], result.curves[1].probability[-1])  # neither all nor none fail
        self.assertTrue((numpy.diff(result.curves[1].probability) >= 0).all())

    def test_arrays_are_views_and_frames_hold_the_same(self):
        result = damslip.load(FRAGILITY).fragility(samples=16, share_rows=0)
        for array in [result.slip, result.intensity, result.level, result.curves[0].probability]:
            self.assertFalse(array.flags.owndata)
            with self.assertRaises(ValueError):
                array[0] = 1
        frame = result.to_pandas("samples")
        numpy.testing.assert_array_equal(frame["slip_mm"], result.slip / 1e-3)
        numpy.testing.assert_array_equal(frame["mu"], result.drawn("mu"))
        self.assertEqual(result.variables, ["mu", "uplift"])
        self.assertEqual(list(result.to_pandas()["probability"])[:10], list(result.curves[0].probability))
        with self.assertRaises(KeyError):
            result.drawn("friction")
        self.assertIn("<iframe srcdoc=", result._repr_html_())
        self.assertIn("P = 0.5 at PGA", repr(result))
        low, high = result.curves[0].rate
        self.assertLessEqual(low, high)

    def test_what_is_wrong_is_said(self):
        scene = damslip.load(PROFILE)
        with self.assertRaisesRegex(damslip.InputError, r"\[intensity\] is missing"):
            scene.fragility()
        with self.assertRaisesRegex(damslip.UsageError, "unit='km'"):
            scene.fragility(levels=0.1, unit="km", limits_mm=10)
        with self.assertRaisesRegex(damslip.UsageError, "no 'suites'"):
            scene.fragility(levels=0.1, limits_mm=10, tables={"suites": {}})
        with self.assertRaisesRegex(damslip.InputError, "Did you mean polarity"):
            scene.fragility(levels=0.1, limits_mm=10, tables={"suite": {"polarty": "both"}})
        with self.assertRaisesRegex(damslip.InputError, "names no record"):
            scene.fragility(records="nowhere/*.AT2", levels=0.1, limits_mm=10)
        with self.assertRaisesRegex(damslip.UsageError, "jibson"):
            scene.fragility(levels=0.1, limits_mm=10, method="jibson-1998")

    def test_ctrl_c_keeps_finished_runs(self):
        told = []

        def progress(label, done, total):
            told.append(label)
            if done > 0:
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(damslip.Interrupted) as caught:
            damslip.load(FRAGILITY).fragility(samples=20000, share_rows=0, jobs=1, progress=progress)
        result = caught.exception.result
        self.assertFalse(result.complete)
        self.assertTrue(0 < result.finished < len(result))
        self.assertLessEqual(int(numpy.isfinite(result.slip).sum()), result.finished)
        self.assertLessEqual(result.curves[0].probability_low[0], result.curves[0].probability_high[0])


if __name__ == "__main__":
    unittest.main()
