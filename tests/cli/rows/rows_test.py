# SPDX-License-Identifier: BSD-3-Clause
"""`vericone rows`: tables from text to HDF5 and back byte for byte, and as h5py reads them. Environment as for command.py."""
import csv
import json
import os
import math
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
from decimal import Decimal

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from command import VERICONE, run

try:
    import h5py
    import numpy as np
except ImportError:
    h5py = None


@unittest.skipUnless(os.path.exists(os.path.join(os.path.dirname(VERICONE), "vericone-rows")), "a build without VERICONE_HDF5")
class Rows(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def table(self, count):
        """With numbers of all kinds, words, empty cells and whole numbers; more rows than are packed together."""
        numbers = random.Random(2)
        with open(self.path("table.csv"), "w", encoding="utf-8") as f:
            f.write("# settings, seed 1\n# and more\nrow,fate,least distance [m],tiny,alert [s]\n")
            for i in range(count):
                tiny = f"{numbers.randint(1, 9)}e-{numbers.randint(10, 99)}"
                alert = str(numbers.randint(0, 60)) if i % 3 else ""
                f.write(f"{i},{numbers.choice(['avoided', 'met', ''])},{numbers.uniform(-5, 5)!r},{tiny},{alert}\n")
        return self.path("table.csv")

    def rows(self, *words):
        result = run("rows", *words, "--quiet")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_there_and_back_changes_no_byte(self):
        text = self.table(150_000)
        said = self.rows(text, "--out", self.path("table.h5"), "--json")
        self.assertEqual(self.rows(self.path("table.h5"), "--out", self.path("again.csv"), "--json"), said)
        with open(text, "rb") as one, open(self.path("again.csv"), "rb") as two:
            self.assertEqual(one.read(), two.read())
        self.assertLess(os.path.getsize(self.path("table.h5")), 0.7 * os.path.getsize(text))
        with open(text, encoding="utf-8") as f:
            rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
        found = json.loads(said)
        self.assertEqual(found["rows"], len(rows))
        least = found["columns"][2]
        values = [float(row["least distance [m]"]) for row in rows]
        self.assertEqual((least["numbers"], least["least"], least["most"]), (len(rows), min(values), max(values)))
        self.assertEqual(found["columns"][4]["numbers"], sum(row["alert [s]"] != "" for row in rows))

    @unittest.skipUnless(h5py, "Debian's python3-h5py is not installed")
    def test_another_reader_reads_the_same(self):
        text = self.table(70_000)
        self.rows(text, "--out", self.path("table.h5"))
        with open(text, encoding="utf-8") as f:
            rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
        with h5py.File(self.path("table.h5"), "r") as file:
            names = [file[f"column{k}"].attrs["name"].decode() for k in range(int(file.attrs["columns"]))]
            self.assertEqual(names, list(rows[0]))
            self.assertEqual(file.attrs["comments"].decode(), "# settings, seed 1\n# and more\n")
            self.assertEqual(file["column0"].dtype.kind, "i")
            self.assertEqual(list(file["column0"]), list(range(70_000)))
            words = {value: word for word, value in h5py.check_enum_dtype(file["column1"].dtype).items()}
            self.assertEqual([words[x].replace("(empty)", "") for x in file["column1"][:]], [row["fate"] for row in rows])
            self.assertEqual(list(file["column2"]), [float(row["least distance [m]"]) for row in rows])
            alerts = file["column4"][:]
            self.assertTrue(all((x != x) if row["alert [s]"] == "" else x == float(row["alert [s]"]) for x, row in zip(alerts, rows)))

    def write(self, name, content):
        with open(self.path(name), "wb") as f:
            f.write(content)
        return self.path(name)

    def there_and_back(self, content):
        """What is said of a table, which comes back as it was."""
        said = json.loads(self.rows(self.write("in.csv", content), "--out", self.path("in.h5"), "--json"))
        self.assertEqual(json.loads(self.rows(self.path("in.h5"), "--out", self.path("back.csv"), "--json")), said)
        with open(self.path("back.csv"), "rb") as f:
            self.assertEqual(f.read(), content)
        return said

    def test_every_double_comes_back_bit_for_bit(self):
        numbers = random.Random(3)
        values = [struct.unpack("<d", numbers.randbytes(8))[0] for _ in range(3000)]
        values = [x for x in values if x == x] + [0.0, -0.0, 5e-324, -5e-324, 1.7976931348623157e308, 2.0**53, 2.0**53 - 1,
                                                  2.2250738585072014e-308, 0.1, -1e22, math.inf, -math.inf]
        text = "x\n" + "".join(self.shortest(x) + "\n" for x in values)
        said = self.there_and_back(text.encode())
        self.assertEqual(said["columns"][0]["numbers"], len(values))
        if h5py:
            with h5py.File(self.path("in.h5"), "r") as file:
                found = file["column0"][:].tolist()
            self.assertEqual([struct.pack("<d", x) for x in found], [struct.pack("<d", x) for x in values])

    @staticmethod
    def shortest(x):
        """As C++ writes a double: the shorter of both notations, at least two digits of exponent."""
        if math.isinf(x):
            return "inf" if x > 0 else "-inf"
        sign, digits, exponent = Decimal(repr(x)).as_tuple()
        while len(digits) > 1 and digits[-1] == 0:
            digits, exponent = digits[:-1], exponent + 1
        if digits == (0,):
            return "-0" if sign else "0"
        power = len(digits) + exponent - 1
        word = "".join(map(str, digits))
        scientific = word[0] + ("." + word[1:] if word[1:] else "") + f"e{power:+03d}"
        # A whole number in full, with the digits that the double has.
        fixed = str(abs(int(x))) if exponent >= 0 else format(abs(Decimal(repr(x))), "f").rstrip("0")
        return ("-" if sign else "") + (fixed if len(fixed) <= len(scientific) else scientific)

    def test_cells_of_every_kind_come_back(self):
        said = self.there_and_back(
            "# comment\nid,flag,empty,other digits,large,mixed,µ [m],literal,not a number\n"
            "run-1,true,,1.50,9007199254740993,1,2,(empty),nan\n"
            "run-2,false,,0.10,18446744073709551615,,-0,,1\n".encode())
        self.assertEqual([next(iter(set(c) - {"name"} & set(c) - {"least", "most", "sum"})) for c in said["columns"]],
                         ["words", "words", "words", "words", "words", "numbers", "numbers", "longest", "words"])
        many = "id,x\n" + "".join(f"run-{i},{i}.0\n" for i in range(70_000))
        self.assertEqual([c["longest"] for c in self.there_and_back(many.encode())["columns"]], [9, 7])
        if h5py:
            with h5py.File(self.path("in.h5"), "r") as file:
                self.assertEqual(file["column0"][69_999].decode(), "run-69999")
        self.assertEqual(self.there_and_back(b"a,b\n")["rows"], 0)
        self.there_and_back(b"a\n\n\n1\n")
        integers = "row,number,both\n" + "".join(f"{i},{x},{i}\n" for i, x in ((99999, "99999"), (100000, "1e+05"), (12345678, "0.5")))
        self.assertEqual([c["least"] for c in self.there_and_back(integers.encode())["columns"]], [99999, 0.5, 99999])
        self.there_and_back(b"x,y\n100000,1e+05\n1e+05,100000\n,1e5\n007,+1\n-0,1.\n")

    def refused(self, name, says, out=None, status=2):
        result = run("rows", self.path(name), "--out", self.path(out or ("out.csv" if name.endswith("h5") else "out.h5")))
        self.assertEqual((result.returncode, result.stdout), (status, ""), name)
        self.assertIn(says, result.stderr, name)
        self.assertEqual(result.stderr.count("\n"), 1, name)
        self.assertFalse({"out.csv", "out.h5"} & set(os.listdir(self.folder)), name)

    def test_what_is_no_table_is_refused(self):
        with open(self.table(10), "rb") as f:
            text = f.read()
        for name, content, says in (("cut.csv", text[:-1], "line 13: got a line without an end"),
                                    ("short.csv", text + b"1,2\n", "line 14: got 2 cells, must be 5"),
                                    ("quoted.csv", text + b'"1",2,3,4,5\n', "got a quote"),
                                    ("binary.csv", text + b"\xff\n", "got bytes that are no text"),
                                    ("twice.csv", b"a,a\n", "got a column without a name of its own"),
                                    ("empty.csv", b"", "got no names"),
                                    ("long.csv", b"a\n" + b"x" * 2_000_000 + b"\n", "line 2: got a line of more than 1 MiB"),
                                    ("comments.csv", b"# x\n" * 10_000 + b"a\n", "got 40000 bytes, must be at most 32768"),
                                    ("name.csv", b"n" * 2000 + b"\n", "got a name of 2000 bytes, must be at most 1024"),
                                    ("columns.csv", b",".join(b"%d" % i for i in range(2000)) + b"\n", "got 2000 columns"),
                                    ("wide.csv", b"a,wide\n1," + b"x" * 50_000 + b"\n", "column wide: got rows of 50008 bytes")):
            self.write(name, content)
            self.refused(name, says)
        self.refused(".", "got no file that can be read", "out.h5")
        self.refused("table.csv", "must be NAME.h5: the table is text", "out.csv")
        self.refused("table.csv", "must be NAME.h5 or NAME.csv", "out.txt")

    def test_damaged_files_are_refused(self):
        self.rows(self.table(70_000), "--out", self.path("good.h5"))
        with open(self.path("good.h5"), "rb") as f:
            packed = f.read()
        for k in range(1, 8):
            self.write("cut.h5", packed[:len(packed) * k // 8])
            self.refused("cut.h5", "must be a table that vericone-rows wrote")
        self.write("wrong.h5", packed[:8] + bytes(2000))
        self.refused("wrong.h5", "must be a table that vericone-rows wrote")
        # Compressed bytes have a sum of their own, so what is damaged there is found.
        middle = len(packed) * 3 // 4
        self.write("flipped.h5", packed[:middle] + bytes(b ^ 255 for b in packed[middle:middle + 64]) + packed[middle + 64:])
        self.refused("flipped.h5", "got bytes that cannot be unpacked")

    def test_no_changed_byte_goes_unseen(self):
        with open(self.table(200), "rb") as f:
            text = f.read()
        self.rows(self.path("table.csv"), "--out", self.path("good.h5"))
        with open(self.path("good.h5"), "rb") as f:
            packed = f.read()
        places = random.Random(5)
        refused = 0
        for _ in range(60):
            damaged = bytearray(packed)
            damaged[places.randrange(len(packed))] ^= places.randrange(1, 256)
            result = run("rows", self.write("bad.h5", damaged), "--out", self.path("back.csv"))
            if result.returncode == 0:  # a byte that stands for nothing
                with open(self.path("back.csv"), "rb") as f:
                    self.assertEqual(f.read(), text)
                os.remove(self.path("back.csv"))
                continue
            self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1))
            self.assertFalse(os.path.exists(self.path("back.csv")))
            refused += 1
        self.assertGreater(refused, 30)

    @unittest.skipUnless(h5py, "Debian's python3-h5py is not installed")
    def test_files_of_others_are_refused(self):
        self.rows(self.table(70_000), "--out", self.path("good.h5"))

        def changed(change):
            shutil.copy(self.path("good.h5"), self.path("bad.h5"))
            with h5py.File(self.path("bad.h5"), "r+") as file:
                change(file)

        utf8 = lambda text: np.array(text.encode(), dtype=h5py.string_dtype("utf-8", len(text.encode())))

        def replace(column, **how):
            def change(file):
                name = file[column].attrs["name"]
                del file[column]
                file.create_dataset(column, **how).attrs.create("name", utf8(name.decode()))
            return change

        def attribute(object, name, value):
            def change(file):
                (file[object] if object else file).attrs.create(name, value)
            return change

        packed = {"chunks": (65_536,), "compression": 4, "shuffle": True}
        for change, says in ((lambda file: file.attrs.__delitem__("vericone-rows"), "got another HDF5 file"),
                             (attribute("", "vericone-rows", utf8("2")), "got another HDF5 file"),
                             (attribute("", "columns", utf8("6")), "column5: got"),
                             (attribute("", "columns", utf8("-1")), "got another number of columns"),
                             (attribute("", "columns", utf8("x")), "got another number of columns"),
                             (attribute("", "columns", utf8("0")), "got a column without a name of its own"),
                             (attribute("", "columns", 5), "another attribute columns"),
                             (attribute("", "comments", utf8("no comment\n")), "got other comments"),
                             (attribute("", "comments", np.array([b"# a\n"] * 1000)), "another attribute comments"),
                             (attribute("column2", "name", utf8("a,b")), "got a column without a name of its own"),
                             (attribute("column2", "name", utf8("row")), "got a column without a name of its own"),
                             (attribute("column2", "name", "text of any length"), "column2: got another attribute name"),
                             (lambda file: file["column3"].resize((10,)), "column3: got another number of rows"),
                             (lambda file: file["column3"].resize((10**15,)), "column3: got rows that are missing"),
                             (lambda file: file.__delitem__("column4"), "column4: got"),
                             (replace("column2", data=np.zeros(70_000)), "column2: got rows in another arrangement"),
                             (replace("column2", shape=(70_000, 2), dtype="f8", chunks=(65_536, 2)), "another arrangement"),
                             (replace("column2", data=np.zeros(70_000, "f4"), maxshape=(None,), **packed), "column2: got another type"),
                             (replace("column0", data=np.zeros(70_000, "i4"), maxshape=(None,), **packed), "column0: got another type"),
                             (replace("column0", data=np.full(70_000, 2**60), maxshape=(None,), **packed),
                              "column row, rows 1 to 65536: got whole numbers of 2^53 and more")):
            changed(change)
            with self.subTest(says):
                self.refused("bad.h5", says)

        def other_word(file):
            file["column1"].id.write(h5py.h5s.ALL, h5py.h5s.ALL, np.full(70_000, 7, "u2"), mtype=file["column1"].id.get_type())
        changed(other_word)
        self.refused("bad.h5", "column fate, rows 1 to 65536: got a word that is none of the column's")

    def test_an_interruption_leaves_nothing(self):
        text = self.table(400_000)
        before = set(os.listdir(self.folder))
        for step in ("reading", "packing"):
            with subprocess.Popen([VERICONE, "rows", text, "--out", self.path("out.h5")], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True) as process:
                while step not in process.stderr.readline():
                    self.assertIsNone(process.poll())
                process.send_signal(signal.SIGINT)
                process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130)
            self.assertEqual(set(os.listdir(self.folder)), before)

    def test_a_full_disk_is_named(self):
        small = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
        text = self.table(70_000)
        before = set(os.listdir(self.folder))
        result = run("rows", text, "--out", self.path("out.h5"), "--quiet",
                     preexec_fn=lambda: (signal.signal(signal.SIGXFSZ, signal.SIG_IGN), small()))
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertRegex(result.stderr, r"^vericone: could not write .*out\.h5: File too large\n$")
        self.assertEqual(set(os.listdir(self.folder)), before)


if __name__ == "__main__":
    unittest.main()
