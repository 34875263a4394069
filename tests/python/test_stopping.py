"""Other threads run while the library computes; progress is told; Ctrl-C keeps the rows that are finished."""

import os
import signal
import threading
import time
import unittest

from surroundings import EXAMPLES, need

need("numpy")
import damslip  # noqa: E402

PROFILE = EXAMPLES / "reference_dam_profile.toml"


class Stopping(unittest.TestCase):
    def test_ctrl_c_keeps_finished_rows(self):
        scene = damslip.load(PROFILE)
        told = []

        def progress(label, done, total):
            told.append((label, done, total))
            if 0.0 < done:  # the earthquakes have begun
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(damslip.Interrupted) as caught:
            scene.sweep(friction="0.5:1.0:0.005", method=["rigid", "fe"], jobs=1, progress=progress)
        rows = caught.exception.result
        self.assertFalse(rows.complete)
        self.assertTrue(told)
        self.assertLess(rows.finished, len(rows))
        self.assertEqual(len(rows.tables["rows"]), len(rows))  # those that are not there say so
        statuses = rows.tables["rows"].to_dict()["status"]
        self.assertEqual(sum(status != "interrupted" for status in statuses), rows.finished)

    def test_an_error_of_progress_comes_through(self):
        def progress(label, done, total):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            damslip.load(PROFILE).fe(mesh_error=False, progress=progress)

    def test_other_threads_go_on(self):
        counted = []
        over = threading.Event()

        def count():
            while not over.is_set():
                counted.append(1)
                time.sleep(0.005)

        other = threading.Thread(target=count)
        other.start()
        began = time.monotonic()
        damslip.load(PROFILE).fe(polarity=1, mesh_error=False)
        took = time.monotonic() - began
        over.set()
        other.join()
        self.assertGreater(len(counted), 10 * took)  # 200 a second on an idle machine; none with the lock held


if __name__ == "__main__":
    unittest.main()
