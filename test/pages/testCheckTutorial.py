# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""That checkTutorial.py finds what a page shows and a program does not print, and nothing else."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from checkTutorial import NUMBER, check, difference, outputs  # noqa: E402

PAGES = sorted(pathlib.Path(__file__).resolve().parents[2].glob("tutorial/*/README.md"))
PRINTED = "Error 0.978651 m at 1000 places, 2.47933e-09 off.\nLine two\nand three\nDone: it holds.\n"
PAGE = """# See

```
$ ./tutorial-see
Error 0.978651 m at 1000 places, 2.47933e-09
off.
Line two and three
Done: it holds.
```
"""
OTHER = "```\n$ visp-see --all\nIt moves.\n```\n"


class Tutorial(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        (self.root / "printed").write_text(PRINTED)
        self.program("tutorial-see", f"cat {self.root}/printed")

    def tearDown(self):
        self.folder.cleanup()

    def program(self, name, script):
        (self.root / name).write_text(f"#!/bin/sh\n{script}\n")
        (self.root / name).chmod(0o755)

    def check(self, text):
        """Faults and notes without the name of the page, number of outputs compared."""
        page = self.root / "README.md"
        page.write_text(text)
        faults, notes, compared = check(page, [self.root])
        return [fault.replace(f"{page}:", "") for fault in faults], [note.replace(f"{page}:", "") for note in notes], compared

    def assert_good(self, text):
        self.assertEqual(self.check(text), ([], [], 1))

    def assert_fault(self, text, sentence):
        self.assertEqual(self.check(text)[0], [sentence])

    def test_words(self):
        self.assert_good(PAGE)
        for old, new, line, shown, printed in (
            ("it holds", "it held", 8, "held.", "holds."),
            ("Done:", "Done", 8, "Done it holds.", "Done: it holds."),
            ("m at", "mm at", 5, "mm at 1000 places, 2.47933e-09 off.", "m at 1000 places, 2.47933e-09 off."),
            ("two and", "two", 7, "three Done: it holds.", "and three Done: it holds."),
            ("Done: it holds.\n", "", 7, "", "Done: it holds."),
            ("holds.\n", "holds.\nReally\n", 9, "Really", ""),
        ):
            self.assert_fault(PAGE.replace(old, new), f'{line}: the page shows "{shown}", the program prints "{printed}"')

    def test_numbers(self):
        for printed, shown, good in (
            ("0.978651", "0.97865 0.98 1.0", True),
            ("0.978651", "0.978652 0.97 -0.98 1 0.978651e-01 0.98a", False),
            ("1000", "1001 999 1e3 1000.5 0", False),
            ("2.47933e-09", "2.4793e-09 2.5e-09", True),
            ("2.47933e-09", "2.47932e-09 2.4e-09 2.47933e-08 2e-09", False),
        ):
            for number in shown.split():
                faults, _, _ = self.check(PAGE.replace(printed, number))
                self.assertEqual([fault.split(":")[0] for fault in faults], [] if good else ["5"], number)

    def test_what_is_left_out(self):
        self.assert_good(PAGE.replace("Line two and three", "..."))
        self.assert_good(PAGE.replace("Done: it holds.", "..."))
        for old, new, line, shown, printed in (
            ("Line two and three", "...\nfour", 8, "four Done: it holds.", "three Done: it holds."),
            ("two and", "two\n...\nand", 8, "... and three Done: it holds.", "and three Done: it holds."),
        ):
            self.assert_fault(PAGE.replace(old, new), f'{line}: the page shows "{shown}", the program prints "{printed}"')

    def test_a_page_without_output(self):
        for page in ("# See\n", "```\n$ ./tutorial-see\n```\n", PAGE.replace("$ ", ""), PAGE.replace("```\n$", "<!-- not run: needs a robot -->\n```\n$")):
            faults, _, _ = self.check(page)
            self.assertEqual(faults, [" no output was compared"], page)

    def test_commands_that_are_not_run(self):
        self.assertEqual(self.check(f"{PAGE}<!-- not run: needs a robot -->\n{OTHER}"), ([], ["12: not run: needs a robot"], 1))
        self.assertEqual(self.check(PAGE + OTHER), ([], ["11: not run: visp-see is not here"], 1))
        self.program("visp-see", "echo It stands.")
        self.assert_fault(PAGE + OTHER, '12: the page shows "moves.", the program prints "stands."')
        self.assert_fault(PAGE + OTHER.replace("--all", "goal.json"), "11: goal.json is not here")
        (self.root / "tutorial-see").unlink()
        self.assertEqual(self.check(PAGE)[0][0], "4: ./tutorial-see is not here")

    def test_programs_that_fail(self):
        self.program("visp-see", "echo It moves.; exit 3")
        self.assert_fault(PAGE + OTHER, "11: visp-see --all ended with status 3")
        self.program("visp-see", "echo It moves.; echo no robot >&2; exit 3")
        self.assert_fault(PAGE + OTHER, '12: the page shows "", the program prints "no robot"')
        self.assertEqual(self.check(PAGE + OTHER.replace("moves.", "moves.\nno robot")), ([], [], 2))
        self.program("visp-see", "echo 50 % >&2; echo It moves.")
        self.assertEqual(self.check(PAGE + OTHER), ([], [], 2))

    def test_each_word_and_digit_of_the_tutorials(self):
        self.assertGreaterEqual(len(PAGES), 13)
        for page in PAGES:
            shown = [lines for _, _, lines, _ in outputs(page.read_text(encoding="utf-8"))]
            self.assertTrue(shown, page)
            for lines in shown:
                self.assertIsNone(difference(lines, "\n".join(lines)), page)
                for i, line in enumerate(lines):
                    changed = [line.replace(word, word + "x", 1) for word in line.split() if word != "..."]
                    for number in NUMBER.finditer(line):
                        for k in (k for k in range(*number.span()) if line[k].isdigit()):
                            changed.append(f"{line[:k]}{(int(line[k]) + 1) % 10}{line[k + 1:]}")
                    for text in changed:
                        found = difference([*lines[:i], text, *lines[i + 1 :]], "\n".join(lines))
                        self.assertTrue(found and found[0] == i, f"{page}: {text}")


if __name__ == "__main__":
    unittest.main()
