"""fe --frames N, read with VTK's own reader: times, blocks, and values against the CSV files of the same run."""

import csv
import pathlib
import tempfile
import unittest

from surroundings import EXAMPLES, need, program

need("numpy", "vtkmodules.vtkIOXML", "vtkmodules.util.numpy_support")
import numpy  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader  # noqa: E402
import xml.etree.ElementTree as xml  # noqa: E402

FRAMES = 11


def rows_of(file):
    with open(file) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def blocks_of(file):
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    if reader.GetErrorCode():
        raise AssertionError(f"{file}: VTK's error {reader.GetErrorCode()}")
    read = reader.GetOutput()
    blocks = {}
    for i in range(read.GetNumberOfBlocks()):
        blocks[read.GetMetaData(i).Get(read.NAME())] = read.GetBlock(i)
    return blocks


def values(block, name):
    array = block.GetPointData().GetArray(name)
    if array is None:
        raise AssertionError(f"no array {name}")
    return vtk_to_numpy(array)


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        out = pathlib.Path(cls.folder.name)
        program("fe", EXAMPLES / "reference_dam_profile.toml", "--polarity", "1", "--no-mesh-error", "--frames", FRAMES,
                "--out", out, "--quiet")
        cls.out = out
        cls.history = rows_of(next(out.glob("history_*.csv")))
        cls.base = rows_of(next(out.glob("base_*.csv")))
        series = next(out.glob("frames_*.pvd"))
        cls.entries = [(float(e.get("timestep")), out / e.get("file")) for e in xml.parse(series).iter("DataSet")]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_times_are_spread_over_the_record(self):
        times = numpy.array([time for time, file in self.entries])
        record_end = 20.0  # of the record: 4001 samples at 0.005 s, or as its steps have it
        history = numpy.array([float(row["time_s"]) for row in self.history])
        self.assertEqual(times[0], history[0])
        self.assertEqual(times[-1], history[-1])  # the run-out's end
        step = history[1] - history[0]
        spread = times[times <= record_end + 1e-9][:FRAMES]
        numpy.testing.assert_allclose(spread, numpy.linspace(0.0, record_end, FRAMES), atol=step)

    def test_each_frame_has_its_blocks(self):
        for _, file in self.entries:
            blocks = blocks_of(file)
            self.assertEqual(list(blocks), ["dam", "rock", "water", "joints"])
            for name, block in blocks.items():
                self.assertGreater(block.GetNumberOfCells(), 0, name)
                points = block.GetNumberOfPoints()
                self.assertEqual(block.GetPointData().GetArray(0).GetNumberOfTuples(), points)
            self.assertEqual(values(blocks["dam"], "displacement_m").shape[1], 3)
            self.assertTrue(numpy.isfinite(values(blocks["dam"], "stress_xx_yy_xy_Pa")).all())

    def test_joints_slip_as_the_history_says(self):
        distance = numpy.array([float(row["distance_m"]) for row in self.base])
        # area of a pair: half of both elements beside it
        area = numpy.gradient(distance) * numpy.where((distance == distance[0]) | (distance == distance[-1]), 0.5, 1.0)
        by_time = {float(row["time_s"]): float(row["slip_m"]) for row in self.history}
        for time, file in self.entries:
            slip = values(blocks_of(file)["joints"], "slip_m")
            self.assertAlmostEqual(float((slip * area).sum() / area.sum()), by_time[time], delta=1e-12)

    def test_the_last_frame_is_the_end(self):
        last = blocks_of(self.entries[-1][1])
        for array, column in [("slip_m", "slip_m"), ("opening_m", "opening_m"), ("normal_pressure_Pa", "pressure_Pa"),
                              ("shear_Pa", "shear_Pa")]:
            printed = numpy.array([float(row[column]) for row in self.base])
            numpy.testing.assert_array_equal(values(last["joints"], array), printed, array)

    def test_lines_lie_on_the_base_and_carry_its_water(self):
        joints = blocks_of(self.entries[0][1])["joints"]
        points = vtk_to_numpy(joints.GetPoints().GetData())
        self.assertEqual(len(points), len(self.base))
        numpy.testing.assert_allclose(points[:, 0], [float(row["distance_m"]) for row in self.base], atol=1e-12)
        water = values(joints, "water_pressure_Pa")
        self.assertGreater(water[0], 0.9 * 1000 * 9.81 * 60)  # full head at the heel, 62.5 m
        self.assertLess(water[-1], 0.1 * water[0])

    def test_the_water_answers_the_earthquake(self):
        start, middle = (blocks_of(self.entries[i][1])["water"] for i in (0, FRAMES // 2))
        self.assertEqual(float(abs(values(start, "pressure_Pa")).max()), 0.0)  # at rest: none beyond the static one
        self.assertGreater(float(abs(values(middle, "pressure_Pa")).max()), 1e3)

    def test_lift_joints_are_lines_of_their_own(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            program("fe", EXAMPLES / "cracked_upper_block.toml", "--polarity", "1", "--no-mesh-error", "--frames", 2,
                    "--out", out, "--quiet")
            last = sorted(next(out.glob("frames_*/")).glob("*.vtm"))[-1]
            joints = blocks_of(last)["joints"]
            heights = vtk_to_numpy(joints.GetPoints().GetData())[:, 1]
            on_base = len(rows_of(next(out.glob("base_*.csv"))))
            self.assertEqual(int((heights == 0.0).sum()), on_base)
            self.assertEqual(set(heights[on_base:]), {51.5})  # the scene's lift joint
            self.assertEqual(joints.GetNumberOfCells(), joints.GetNumberOfPoints() - 2)

    def test_the_run_is_the_same_without_frames(self):
        with tempfile.TemporaryDirectory() as other:
            program("fe", EXAMPLES / "reference_dam_profile.toml", "--polarity", "1", "--no-mesh-error", "--out", other,
                    "--quiet")
            for kind in ["history", "base", "contact"]:
                mine = next(self.out.glob(f"{kind}_*.csv"))
                self.assertEqual(mine.read_bytes(), (pathlib.Path(other) / mine.name).read_bytes())


if __name__ == "__main__":
    unittest.main()
