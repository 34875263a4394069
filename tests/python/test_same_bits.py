"""What Python computes is what the program prints, digit for digit: JSON objects and CSV rows of both are equal as texts.
What is measured (seconds, bytes, where reduced rock was found) is left out."""

import json
import unittest

from surroundings import EXAMPLES, SOURCE, need, program

need("numpy")
import damslip  # noqa: E402

MEASURED = {"seconds", "bytes", "origin", "set_up_seconds", "dynamics_seconds", "contact_seconds"}


def without_measured(value):
    if isinstance(value, dict):
        return {k: without_measured(v) for k, v in value.items()
                if k not in MEASURED and not k.endswith(("_s_wall", "_seconds"))}
    if isinstance(value, list):
        return [without_measured(v) for v in value]
    return value


class SameBits(unittest.TestCase):
    maxDiff = 2000

    def same_object(self, printed, computed):
        self.assertEqual(json.dumps(without_measured(json.loads(printed)), indent=1),
                         json.dumps(without_measured(json.loads(computed)), indent=1))

    def test_screening_of_three_examples(self):
        for name in ["reference_dam_profile", "flexible_block", "rock_wedge"]:
            with self.subTest(name):
                file = str(EXAMPLES / f"{name}.toml")
                self.assertEqual(program("screen", file, "--json", "--quiet"), damslip.load(file).screen().json_text())

    def test_finite_elements_of_two_examples(self):
        for name in ["own_dam", "anchored_dam"]:
            with self.subTest(name):
                file = str(EXAMPLES / f"{name}.toml")
                self.same_object(program("fe", file, "--polarity", "1", "--no-mesh-error", "--json", "--quiet"),
                                 damslip.load(file).fe(polarity=1, mesh_error=False).json_text())

    def test_the_question_of_every_command(self):
        """The scene on which Audit3.TheSameQuestionHasTheSameAnswer compares the commands."""
        file = str(SOURCE / "tests" / "audit3" / "same_question" / "dam.toml")
        scene = damslip.load(file)
        self.assertEqual(program("screen", file, "--json", "--quiet"), scene.screen().json_text())
        self.same_object(program("fe", file, "--no-mesh-error", "--json", "--quiet"),
                         scene.fe(mesh_error=False).json_text())
        self.assertEqual(len(scene.fe(mesh_error=False).runs), 2)

    def test_modes(self):
        file = str(EXAMPLES / "koyna.toml")
        self.same_object(program("modes", file, "--json", "--quiet"), damslip.load(file).modes().json_text())

    def test_rows_of_a_sweep(self):
        file = str(EXAMPLES / "reference_dam_profile.toml")
        printed = program("sweep", file, "--friction", "0.7:0.8:0.1", "--uplift", "linear,curtain", "--method",
                          "rigid,rigid-v,fe-reduced", "--quiet")
        rows = damslip.load(file).sweep(friction=[0.7, 0.8], uplift=["linear", "curtain"],
                                        method=["rigid", "rigid-v", "fe-reduced"]).tables["rows"]
        self.assertEqual("".join(line for line in printed.splitlines(True) if not line.startswith("#")), rows.csv())

    def test_a_key_set_is_the_same_as_in_the_file(self):
        file = EXAMPLES / "reference_dam_profile.toml"
        set_to = damslip.load(file).with_(contact__friction=0.71).screen()
        printed = json.loads(program("screen", file, "--friction", "0.71", "--json", "--quiet"))
        self.assertEqual(printed["displacements"], set_to.json()["displacements"])


if __name__ == "__main__":
    unittest.main()
