"""Scenes from files and dictionaries, keys that are set, and errors with their file, line and fix."""

import tempfile
import pathlib
import unittest

from surroundings import EXAMPLES, need

need("numpy")
import damslip  # noqa: E402

PROFILE = EXAMPLES / "reference_dam_profile.toml"


class Scenes(unittest.TestCase):
    def test_a_dictionary_is_the_file_it_stands_for(self):
        import tomllib
        tables = tomllib.loads(PROFILE.read_text())
        from_file = damslip.load(PROFILE).screen()
        from_tables = damslip.load(tables, folder=PROFILE.parent).screen()
        self.assertEqual(from_file.json()["displacements"], from_tables.json()["displacements"])
        self.assertEqual(from_file.yield_acceleration, from_tables.yield_acceleration)

    def test_words_with_quotes_and_line_breaks_survive(self):
        import tomllib
        tables = tomllib.loads(PROFILE.read_text())
        for title in ['a "dam"', "C:\\dam", "two\nlines", "Möll"]:
            tables["title"] = title
            shown = title.replace("\n", " ")  # control characters are blanks in titles
            self.assertEqual(damslip.load(tables, folder=PROFILE.parent).title, shown)

    def test_with_leaves_the_scene_as_it_was(self):
        scene = damslip.load(PROFILE)
        before = scene.screen().yield_acceleration
        less = scene.with_(contact__friction=0.7)
        self.assertLess(less.screen().yield_acceleration, before)
        self.assertEqual(scene.screen().yield_acceleration, before)
        self.assertEqual(less.with_(contact__friction=0.77).screen().yield_acceleration, before)
        self.assertEqual(less.with_({"contact.friction": 0.77}).screen().yield_acceleration, before)

    def test_a_wrong_file_names_line_and_fix(self):
        with tempfile.TemporaryDirectory() as folder:
            bad = pathlib.Path(folder) / "bad.toml"
            lines = PROFILE.read_text().replace("../records", str(EXAMPLES.parent / "records")).splitlines()
            at = next(i for i, line in enumerate(lines) if line.startswith("friction"))
            lines[at] = "friction = -0.77"
            bad.write_text("\n".join(lines))
            with self.assertRaises(damslip.InputError) as caught:
                damslip.load(bad)
            self.assertEqual((caught.exception.file, caught.exception.line), (str(bad), at + 1))
            self.assertIn("0.77", caught.exception.fix)
            self.assertIn("contact.friction = -0.77", str(caught.exception))

    def test_all_that_is_wrong_comes_at_once(self):
        with self.assertRaises(damslip.InputError) as caught:
            damslip.load({"contact": {"friction": -1}})
        self.assertGreater(len(caught.exception.diagnostics), 2)
        self.assertTrue(all(d["problem"] for d in caught.exception.diagnostics))

    def test_an_unknown_key_names_the_nearest(self):
        with self.assertRaises(damslip.InputError) as caught:
            damslip.load(PROFILE).with_(contact__frictoin=0.7)
        self.assertIn("contact.friction", caught.exception.fix)

    def test_an_unknown_axis_and_a_value_out_of_range(self):
        scene = damslip.load(PROFILE)
        for axes in [{"fricton": [0.7]}, {"friction": [-0.7]}, {"method": "fee"}]:
            with self.subTest(axes), self.assertRaises(damslip.UsageError) as caught:
                scene.sweep(**axes)
            self.assertTrue(caught.exception.fix)

    def test_a_file_that_is_not_there(self):
        with self.assertRaises(damslip.InputError) as caught:
            damslip.load("no such dam.toml")
        self.assertIn("no such dam.toml", str(caught.exception))

    def test_the_stubs_name_what_is_there(self):
        import ast
        for stub, module in [("_core", damslip._core), ("scene", damslip.scene), ("errors", damslip.errors)]:
            text = (pathlib.Path(damslip.__file__).parent / f"{stub}.pyi").read_text()
            for declared in ast.parse(text).body:
                if not isinstance(declared, ast.ClassDef):
                    continue
                real = getattr(module, declared.name)
                names = {getattr(d, "name", None) or d.target.id for d in declared.body
                         if isinstance(d, (ast.FunctionDef, ast.AnnAssign))}
                if stub != "errors":  # whose attributes are of the objects
                    self.assertEqual({n for n in names if not hasattr(real, n)}, set(), declared.name)
                if stub == "_core":
                    real_names = {n for n in vars(real) if not n.startswith("_")}
                    self.assertEqual(real_names - names, set(), declared.name)

    def test_a_wedge_has_no_finite_elements(self):
        with self.assertRaises(damslip.UsageError):
            damslip.load(EXAMPLES / "rock_wedge.toml").fe()


if __name__ == "__main__":
    unittest.main()
