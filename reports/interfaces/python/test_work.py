"""Progress, cancellation, Ctrl-C, threads, warnings, improvement and evaluation; the command's mesh."""
import os
import signal
import subprocess
import tempfile
import threading
import time
import unittest
import warnings

from testing_support import SPACING, numpy, two_balls, write_nrrd

import cbc3d


class Work(unittest.TestCase):
    def test_it_is_the_command_s_mesh_at_any_number_of_threads(self):
        with tempfile.TemporaryDirectory() as folder:
            write_nrrd(folder + "/balls.nrrd", two_balls(), SPACING)
            subprocess.run([os.environ["CBC3D_COMMAND"], "mesh", folder + "/balls.nrrd", "--out", folder + "/balls.vtu",
                            "--quiet"], check=True)
            expected = cbc3d.read(folder + "/balls.vtu")
        for threads in (1, 2):
            mesh = cbc3d.mesh(two_balls(), SPACING, threads=threads)
            numpy.testing.assert_array_equal(mesh.points, expected.points)
            numpy.testing.assert_array_equal(mesh.tets, expected.tets)
            numpy.testing.assert_array_equal(mesh.labels, expected.labels)

    def test_progress(self):
        seen = []
        cbc3d.mesh(two_balls(), SPACING, progress=lambda stage, fraction: seen.append((stage, fraction)))
        fractions = [fraction for _, fraction in seen]
        self.assertGreater(len(seen), 4)
        self.assertEqual(fractions, sorted(fractions))
        self.assertTrue(all(0 <= f <= 1 for f in fractions) and all(isinstance(s, str) for s, _ in seen))

    def test_a_callback_ends_the_work(self):
        with self.assertRaises(cbc3d.Cancelled):
            cbc3d.mesh(two_balls(), SPACING, progress=lambda stage, fraction: fraction < 0.3)

        def fail(stage, fraction):
            raise KeyError(stage)

        for work in (lambda: cbc3d.mesh(two_balls(), SPACING, progress=fail),
                     lambda: cbc3d.evaluate(cbc3d.mesh(two_balls(), SPACING), two_balls(), SPACING, progress=fail)):
            with self.assertRaises(KeyError):
                work()

    def test_ctrl_c(self):
        calls = []

        def interrupt(stage, fraction):
            calls.append(stage)
            os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            cbc3d.mesh(two_balls(), SPACING, progress=interrupt)
        self.assertEqual(len(calls), 1)
        # Within a step: the work is left behind before it has ended.
        balls = numpy.zeros((100, 100, 100), "uint8")
        k, j, i = numpy.mgrid[:100, :100, :100]
        for label, x in ((1, 30), (2, 65)):
            balls[(i - x) ** 2 + (j - 50) ** 2 + (k - 50) ** 2 < 28 ** 2] = label

        def interrupt_later(stage, fraction):
            if fraction > 0.4 and not interrupt_later.timers:
                interrupt_later.timers.append(threading.Timer(0.05, lambda: os.kill(os.getpid(), signal.SIGINT)))
                interrupt_later.timers[0].start()

        interrupt_later.timers = []
        with self.assertRaises(KeyboardInterrupt):
            cbc3d.mesh(balls, threads=1, progress=interrupt_later)
        # What is left behind ends by itself, at its next step.
        while cbc3d._core.works_left_behind():
            time.sleep(0.01)
        # Without a callback, from another thread, while the interpreter's lock is free.
        threading.Timer(0.05, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(1000):
                cbc3d.mesh(two_balls(), SPACING)

    def test_ctrl_c_ends_the_call_before_the_step_ends(self):
        """By CPU time, which says how far the work has come however slow the machine is."""
        balls = numpy.zeros((100, 100, 100), "uint8")
        k, j, i = numpy.mgrid[:100, :100, :100]
        for label, x in ((1, 30), (2, 65)):
            balls[(i - x) ** 2 + (j - 50) ** 2 + (k - 50) ** 2 < 28 ** 2] = label
        begins = []
        cbc3d.mesh(balls, threads=1, progress=lambda *step: begins.append(time.process_time()))
        seconds = numpy.diff(begins)
        longest = int(seconds.argmax())

        def interrupt_at(cpu_seconds):
            while time.process_time() < cpu_seconds:
                time.sleep(0.001)
            os.kill(os.getpid(), signal.SIGINT)

        began, interrupters = [], []

        def progress(stage, fraction):
            began.append(time.process_time())
            if len(began) == longest + 1:
                interrupters.append(threading.Thread(target=interrupt_at, args=(began[-1] + 0.05 * seconds[longest],)))
                interrupters[0].start()

        with self.assertRaises(KeyboardInterrupt):
            cbc3d.mesh(balls, threads=1, progress=progress)
        spent = time.process_time() - began[-1]
        while cbc3d._core.works_left_behind():
            time.sleep(0.01)
        interrupters[0].join()
        # The signal comes after a twentieth of the step; a call that waited for the step's end would have spent the whole.
        self.assertLess(spent, 0.6 * seconds[longest])
        # What was left behind has ended at the next step, and did not ask the callback any more.
        self.assertEqual(len(began), longest + 1)

    def test_other_threads_run_meanwhile(self):
        counted, ended = [0], threading.Event()

        def count():
            while not ended.is_set():
                counted[0] += 1

        counter = threading.Thread(target=count)
        counter.start()
        before = []
        cbc3d.mesh(two_balls(), SPACING, progress=lambda stage, fraction: before.append(counted[0]))
        ended.set()
        counter.join()
        self.assertGreater(before[-1], before[0])

    def test_warnings_are_given(self):
        array = two_balls()
        array[2, 2, 2] = 5  # one voxel, which the preset "paper" drops
        with self.assertWarns(cbc3d.MeshWarning):
            mesh = cbc3d.mesh(array, SPACING, preset="paper")
        self.assertTrue(mesh.warnings)

    def test_jobs_that_fail(self):
        array = numpy.zeros((20, 20, 20), "uint8")
        array[10, 10, 10] = 1
        with warnings.catch_warnings(), self.assertRaises(cbc3d.JobError):
            warnings.simplefilter("ignore")
            cbc3d.mesh(array, preset="paper", lattice_spacing=20, finest_spacing=20)

    def test_labels_are_chosen(self):
        for choices, labels in (({"labels": 8}, {8}), ({"labels": [3]}, {3}), ({"labels": "3,8"}, {3, 8}),
                                ({"labels": numpy.array([3]), "keep_rest": True}, {3, 9}), ({"background": (0, 3)}, {8})):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                mesh = cbc3d.mesh(two_balls(), SPACING, preset="paper", iterations=0, lattice_spacing=6, **choices)
            self.assertEqual(set(mesh.labels.tolist()), labels, choices)
        self.assertEqual(mesh.names, {})
        for choices, text in (({"labels": 5}, "no label 5, which labels names"), ({"keep_rest": True}, "keep_rest without labels"),
                              ({"labels": "a"}, "labels 'a'"), ({"volume": 0}, "has 3 axes"), ({"names": 5}, "names"),
                              ({"names": {"a": "b"}}, "names")):
            with self.assertRaises(cbc3d.InputError) as caught:
                cbc3d.mesh(two_balls(), SPACING, **choices)
            self.assertIn(text, str(caught.exception))
        with self.assertRaises(cbc3d.InputError):
            cbc3d.evaluate(mesh, two_balls(), SPACING, colour=1)

    def test_volumes(self):
        coarse = {"preset": "paper", "iterations": 0, "lattice_spacing": 6}
        one = cbc3d.mesh(two_balls(), SPACING, **coarse)
        times = numpy.stack([two_balls() * 0, two_balls()])
        for array, axes in ((times, "kji"), (numpy.moveaxis(times, 0, -1).transpose(2, 1, 0, 3), "ijk")):
            mesh = cbc3d.mesh(array, SPACING, volume=1, axes=axes, **coarse)
            numpy.testing.assert_array_equal(mesh.points, one.points)
            for volume in (2, -1, "one"):
                with self.assertRaises(cbc3d.InputError) as caught:
                    cbc3d.mesh(array, SPACING, volume=volume, axes=axes)
                self.assertEqual(caught.exception.parameter, "volume")

    def test_names(self):
        array = two_balls()
        array[2, 2, 2] = 5  # one voxel, which the preset "paper" drops
        with self.assertWarnsRegex(cbc3d.MeshWarning, r"speck \(5\)"):
            mesh = cbc3d.mesh(array, SPACING, preset="paper", names={3: "left ball", 5: "speck", 7: "of no voxel"})
        self.assertEqual(mesh.names, {3: "left ball", 5: "speck"})
        with tempfile.TemporaryDirectory() as folder:
            table = folder + "/names.csv"
            with open(table, "w") as file:
                file.write("3,left ball,#c85008\n8,right ball\n")
            mesh = cbc3d.mesh(two_balls(), SPACING, names=table)
        self.assertEqual(mesh.names, {3: "left ball", 8: "right ball"})
        self.assertEqual(mesh.colours, {3: (200, 80, 8)})
        self.assertEqual(cbc3d.improve(mesh).names, mesh.names)
        found = cbc3d.evaluate(mesh, two_balls(), SPACING, certified=False)
        self.assertEqual(found["label_names"], {"3": "left ball", "8": "right ball"})
        self.assertEqual({row["label"]: row["name"] for row in found["fidelity"]["per_label"]}, mesh.names)

    def test_improve(self):
        rough = cbc3d.mesh(two_balls(), SPACING, preset="paper")
        for arguments in ((), (two_balls(), SPACING)):
            better = cbc3d.improve(rough, *arguments, min_dihedral=15)
            self.assertEqual(set(better.labels.tolist()), {3, 8})
            quality = cbc3d.evaluate(better, two_balls(), SPACING)["quality"]
            self.assertGreaterEqual(quality["min_dihedral_deg"], 14.99)
        thin = cbc3d.improve(rough, two_balls(), SPACING, decimate=True)
        self.assertLess(len(thin.tets), len(rough.tets))
        with self.assertRaises(cbc3d.InputError):
            cbc3d.improve(rough, two_balls(), SPACING, origin=(1000, 0, 0))
        with self.assertRaises(cbc3d.InputError):
            cbc3d.improve(rough, max_deviation=-1)

    def test_evaluate(self):
        found = cbc3d.evaluate(cbc3d.mesh(two_balls(), SPACING), two_balls(), SPACING)
        self.assertGreaterEqual(found["quality"]["min_dihedral_deg"], 19.99)
        self.assertLess(found["fidelity"]["hausdorff_mm"], 2.5)
        self.assertEqual(found["fidelity"]["missing_labels"], [])
        self.assertTrue(found["topology"]["conforming"])


if __name__ == "__main__":
    unittest.main(warnings="ignore")
