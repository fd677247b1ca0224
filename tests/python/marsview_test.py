"""The Python module against the command line and against GDAL."""

import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy

import marsview

ROOT = pathlib.Path(__file__).resolve().parents[2]
MARS = ROOT / "resources/samples/mars_mola_4ppd.tif"
MOUNTAIN = ROOT / "resources/samples/mount_st_helens_30m.tif"
CLI = os.environ["MARSVIEW_CLI"]


def cli(*arguments, text=""):
    done = subprocess.run(
        [CLI, *map(str, arguments)], input=text, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return done.stdout


class OpenMap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mars = marsview.open(MARS)
        cls.mountain = marsview.open(str(MOUNTAIN))

    def test_info_is_that_of_the_command_line(self):
        expected = json.loads(cli("info", MOUNTAIN, "--json"))
        for unknown in ("schema", "void_count", "raw_minimum", "raw_maximum"):
            expected.pop(unknown)
        self.assertEqual(self.mountain.info, expected)
        self.assertEqual(self.mountain.shape, (expected["rows"], expected["columns"]))

    def test_elevations_are_those_of_the_command_line(self):
        random = numpy.random.default_rng(7)
        lons = random.uniform(-180, 360, 200)
        lats = random.uniform(-90, 90, 200)
        lines = "".join(f"{lon!r} {lat!r}\n" for lon, lat in zip(lons.tolist(), lats.tolist()))
        expected = [float(line) for line in cli("sample", MARS, "--stdin", "--lonlat", text=lines).split()]
        found = self.mars.elevation(lons, lats)
        self.assertEqual(found.dtype, numpy.float64)
        numpy.testing.assert_array_equal(found, expected)

    def test_elevations_have_the_shape_of_their_positions(self):
        lats = numpy.linspace(-10, 10, 5)[:, None]
        lons = numpy.array([10.0, 20.0, 30.0])
        grid = self.mars.elevation(lons, lats)
        self.assertEqual(grid.shape, (5, 3))
        self.assertEqual(grid[3, 1], self.mars.elevation(20, 5.0))
        self.assertIsInstance(self.mars.elevation(20, 5), float)
        self.assertTrue(math.isnan(self.mars.elevation(20, 91)))
        self.assertEqual(self.mars.elevation([], []).shape, (0,))

    def test_samples_are_those_of_gdal(self):
        window = (100, 200, 7, 5)
        found = self.mountain.array(window)
        self.assertEqual(found.shape, (5, 7))
        positions = "".join(f"{c} {r}\n" for r in range(200, 205) for c in range(100, 107))
        expected = subprocess.run(
            ["gdallocationinfo", "-valonly", str(MOUNTAIN)],
            input=positions, capture_output=True, text=True, check=True,
        ).stdout.split()
        numpy.testing.assert_array_equal(found.ravel(), [float(v) for v in expected])
        whole = self.mountain.array()
        self.assertEqual(whole.shape, self.mountain.shape)
        self.assertTrue(numpy.isnan(whole[0, 0]))  # the slanted edge of the quadrangle

    def test_map_coordinates(self):
        transform = self.mountain.info["geotransform"]
        x = transform[0] + 100.5 * transform[1]
        y = transform[3] + 200.5 * transform[5]
        self.assertEqual(self.mountain.elevation_map(x, y), self.mountain.array((100, 200, 1, 1))[0, 0])

    def test_overrides_replace_what_the_file_states(self):
        raised = marsview.open(MARS, offset=100.0)
        self.assertEqual(raised.elevation(226, 18), self.mars.elevation(226, 18) + 100.0)
        with self.assertRaisesRegex(TypeError, 'unknown argument "ofset"'):
            marsview.open(MARS, ofset=100.0)

    def test_errors_are_the_sentences_of_the_command_line(self):
        for path, code in (("no/such.tif", "not-found"), (str(ROOT / "README.md"), "unsupported")):
            with self.assertRaises(marsview.Error) as raised:
                marsview.open(path)
            with self.assertRaises(RuntimeError) as printed:
                cli("info", path)
            self.assertEqual(str(printed.exception).strip(), f"marsview-cli: {raised.exception}")
            self.assertEqual(raised.exception.code, code)
        with self.assertRaises(marsview.Error) as raised:
            marsview.open(MARS, crs="EPSG:1")
        self.assertIn('unknown CRS "EPSG:1"; enter an EPSG or IAU code', str(raised.exception))
        with self.assertRaisesRegex(marsview.Error, "window: columns 0 to 2000 .* are not all on"):
            self.mars.array((0, 0, 2000, 1))

    def test_threads_share_a_map(self):
        lons = numpy.linspace(0, 360, 20000)
        expected = self.mars.elevation(lons, 12.0)
        found = [None] * 4

        def read(index):
            found[index] = self.mars.elevation(lons, 12.0)

        threads = [threading.Thread(target=read, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for array in found:
            numpy.testing.assert_array_equal(array, expected)


class Pictures(unittest.TestCase):
    def test_picture_is_that_of_the_command_line(self):
        mars = marsview.open(MARS)
        try:
            pixels = mars.render(size=(160, 100), azimuth_deg=30.0, tilt_deg=40.0)
        except marsview.Error as error:
            self.skipTest(str(error))
        self.assertEqual((pixels.shape, pixels.dtype), ((100, 160, 3), numpy.uint8))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mars.png")
            cli("render", MARS, "-o", path, "--size", "160x100", "--azimuth", 30, "--tilt", 40)
            raw = os.path.join(folder, "mars.raw")
            subprocess.run(["gdal_translate", "-q", "-of", "ENVI", "-co", "INTERLEAVE=BIP", path, raw], check=True)
            expected = numpy.fromfile(raw, numpy.uint8).reshape(100, 160, 3)
        numpy.testing.assert_array_equal(pixels, expected)
        png = mars._repr_png_()
        self.assertTrue(png.startswith(b"\x89PNG"))
        with self.assertRaisesRegex(ValueError, "tilt_deg must be 0 to 85"):
            mars.render(tilt_deg=90)


class Measurements(unittest.TestCase):
    def test_measurements_are_those_of_the_command_line(self):
        mars = marsview.open(MARS)
        points = [(226.0, 18.0), (230.5, 20.25), (228.0, 14.0)]
        lines = "".join(f"{lon},{lat}\n" for lon, lat in points)
        for name, function in (
            ("distance", marsview.measure.distance),
            ("area", marsview.measure.area),
            ("attitude", marsview.measure.attitude),
            ("crater", marsview.measure.crater),
        ):
            expected = json.loads(cli("measure", name, MARS, "--points", "-", "--json", text=lines))
            expected.pop("schema")
            self.assertEqual(function(mars, points), expected, name)
        profile = marsview.measure.profile(mars, points)
        expected = cli("measure", "profile", MARS, "--points", "-", text=lines).splitlines()
        names = expected[0].split(",")
        table = numpy.array([[float(v) for v in line.split(",")] for line in expected[1:]])
        for column, name in enumerate(names):
            numpy.testing.assert_array_equal(profile[name], table[:, column])
        slopes = marsview.measure.slope(mars, points, baseline_m=30000.0)
        expected = json.loads(
            cli("measure", "slope", MARS, "--points", "-", "--baseline", 30000, "--json", text=lines)
        )
        for i, position in enumerate(expected["positions"]):
            self.assertEqual(slopes["slope_deg"][i], position["slope_deg"])
            self.assertEqual(slopes["aspect_deg"][i], position["aspect_deg"])

    def test_positions_are_checked(self):
        mars = marsview.open(MARS)
        with self.assertRaisesRegex(marsview.Error, "latitude 120.* longitude before latitude"):
            marsview.measure.distance(mars, [(0, 120), (0, 0)])
        with self.assertRaisesRegex(ValueError, "points must be an array of N × 2"):
            marsview.measure.distance(mars, [1, 2, 3])


class Contact(unittest.TestCase):
    def test_contact_on_a_map_is_that_of_trace(self):
        mountain = marsview.open(MOUNTAIN)
        random = numpy.random.default_rng(3)
        x, y = 562000.0, 5116000.0
        steps = numpy.cumsum(random.uniform(-40, 40, (400, 2)), axis=0)
        goals = numpy.column_stack([steps + (x, y), numpy.full(400, 1500.0)])
        rows = "x,y,z\n" + "".join(",".join(repr(v) for v in goal) + "\n" for goal in goals.tolist())
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "goals.csv")
            pathlib.Path(path).write_text(rows, encoding="utf-8")
            for name in marsview.contact_models:
                found = marsview.ContactModel(mountain, name, exaggeration=2.0).update(goals)
                printed = cli("trace", MOUNTAIN, "--goals", path, "--model", name, "--exaggeration", 2)
                lines = [line.split(",") for line in printed.splitlines()[1:]]
                proxies = [[float(v) for v in line[:3]] for line in lines]
                numpy.testing.assert_array_equal(found["proxy"], proxies, name)
                numpy.testing.assert_array_equal(found["contact"], [line[3] == "1" for line in lines])
                numpy.testing.assert_array_equal(
                    found["counters"]["faces"], [int(line[6]) for line in lines]
                )

    def test_proxy_on_a_plane_is_the_foot_of_the_goal(self):
        # z = 0.5 x on cells of 2 m, as a transposed, reversed view.
        plane = numpy.tile(numpy.arange(50.0), (40, 1))[::-1].T.copy().T
        model = marsview.ContactModel(plane, cell_size_m=2.0)
        self.assertEqual(model.place((40.0, 40.0, 50.0)), (40.0, 40.0, 50.0))
        touched = model.update([[30.0, 41.0, 20.0], [31.0, 41.0, 10.0]])
        self.assertTrue((touched["contact"] == [False, True]).all())
        normal = numpy.array([-0.5, 0.0, 1.0]) / math.sqrt(1.25)
        goal = numpy.array([31.0, 41.0, 10.0])
        depth = (15.5 - 10.0) / math.sqrt(1.25)
        numpy.testing.assert_allclose(touched["proxy"][1], goal + depth * normal, atol=1e-9)
        numpy.testing.assert_allclose(touched["force_direction"][1], normal, atol=1e-12)
        self.assertAlmostEqual(touched["distance_m"][1], depth)
        self.assertEqual(touched["distance_m"][0], 0.0)

    def test_array_types(self):
        expected = None
        for kind in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"):
            heights = (numpy.arange(100).reshape(10, 10) ** 2 % 61).astype(kind)
            proxy = marsview.ContactModel(heights).update([[3.3, 4.4, 0.0]])["proxy"]
            expected = proxy if expected is None else expected
            numpy.testing.assert_array_equal(proxy, expected, kind)
        with self.assertRaisesRegex(ValueError, "float16 are not supported"):
            marsview.ContactModel(numpy.zeros((3, 3), "f2"))
        with self.assertRaisesRegex(ValueError, "two-dimensional"):
            marsview.ContactModel(numpy.zeros(3))
        with self.assertRaisesRegex(ValueError, 'unknown contact model "magnet"'):
            marsview.ContactModel(numpy.zeros((3, 3)), "magnet")
        with self.assertRaisesRegex(ValueError, "N × 3"):
            marsview.ContactModel(numpy.zeros((3, 3))).update([1.0, 2.0])


class Preparing(unittest.TestCase):
    def test_reports_progress_and_makes_a_map(self):
        with tempfile.TemporaryDirectory() as folder:
            output = os.path.join(folder, "mars.tif")
            fractions = []
            report = marsview.prepare(MARS, output, progress=fractions.append)
            self.assertEqual(report["file"], output)
            self.assertEqual(fractions[-1], 1.0)
            self.assertEqual(fractions, sorted(fractions))
            prepared = marsview.open(output)
            mars = marsview.open(MARS)
            numpy.testing.assert_array_equal(prepared.array(), mars.array())

    def test_an_exception_of_the_callback_stops_it(self):
        # Too large to be done before the first report.
        with tempfile.TemporaryDirectory() as folder:
            source = os.path.join(folder, "large.tif")
            subprocess.run(
                ["gdal_translate", "-q", "-outsize", "8000", "8000", str(MARS), source], check=True
            )

            def fail(_fraction):
                raise KeyError("enough")

            with self.assertRaisesRegex(KeyError, "enough"):
                marsview.prepare(source, os.path.join(folder, "out.tif"), progress=fail)
            with self.assertRaises(marsview.Error) as raised:
                marsview.prepare(source, os.path.join(folder, "out.tif"), progress=lambda _: False)
            self.assertEqual(raised.exception.code, "canceled")


class Documentation(unittest.TestCase):
    def test_stubs_describe_what_there_is(self):
        import ast

        for module, file in ((marsview, "__init__.pyi"), (marsview.measure, "measure.pyi")):
            path = pathlib.Path(marsview.__file__).with_name(file)
            for node in ast.parse(path.read_text(encoding="utf-8")).body:
                if isinstance(node, ast.FunctionDef):
                    self.assertTrue(callable(getattr(module, node.name)), node.name)
                elif isinstance(node, ast.ClassDef) and node.name != "Updates":
                    members = [n.name for n in node.body if isinstance(n, ast.FunctionDef)]
                    for member in members:
                        self.assertTrue(hasattr(getattr(module, node.name), member), member)

    def test_example_of_the_package_runs(self):
        lines = [line[4:] for line in marsview.__doc__.splitlines() if line.startswith("    ")]
        example = "\n".join(lines).replace('"mars_mola_4ppd.tif"', repr(str(MARS)))
        names = {
            "lons": numpy.array([10.0, 20.0]),
            "lats": numpy.array([1.0, 2.0]),
            "goals": [[226.0, 18.0, 5000.0], [226.1, 18.0, 5000.0]],
        }
        try:
            exec(compile(example, "__init__.py", "exec"), names)
        except marsview.Error as error:
            if "OpenGL" not in str(error) and "EGL" not in str(error):
                raise
            self.skipTest(str(error))
        self.assertTrue(names["touched"]["contact"].all())

    def test_examples_of_the_guide_run(self):
        guide = (ROOT / "resources/guide/python.md").read_text(encoding="utf-8")
        python = guide.split("\n## Python\n")[1].split("\n## ")[0]
        blocks = re.findall(r"(?:^    .*\n|^\n)+", python, re.MULTILINE)
        code = "".join(block for block in blocks if "apt install" not in block)
        lines = [line[4:] for line in code.splitlines() if line.startswith("    ")]
        names = {
            "lons": numpy.array([10.0, 20.0]),
            "lats": numpy.array([1.0, 2.0]),
            "goals": [[226.0, 18.0, 5000.0], [226.1, 18.0, 5000.0]],
        }
        ran = 0
        for line in lines:
            if ".render(" in line:
                continue  # needs OpenGL; tested above
            exec(line.replace('"mars_mola_4ppd.tif"', repr(str(MARS))), names)
            ran += 1
        self.assertGreater(ran, 6)
        self.assertTrue(names["touched"]["contact"].all())


if __name__ == "__main__":
    sys.exit(unittest.main(verbosity=2))
