# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""That checkPages.py finds what is wrong in a page, and nothing else: one fault at a time in a repository of one page."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from checkPages import Checker  # noqa: E402

PROGRAM = """#!/bin/sh
case "$*" in *"--rate --help") echo "visp-see: --rate is given without a value" >&2; exit 2 ;; esac
case "$*" in *"--rate -1"*) echo "visp-see: --rate is -1, must be a number > 0" >&2; exit 2 ;; esac
cat <<'END'
Options:
  --out DIR    Result folder
  --rate HZ    Rate
  --help

Examples:
  visp-see {example}
      looks
END
"""


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        for name in ("apps/visp-see", "bin", "data/target", "doc", "scripts", "tutorial/01-see", "modules/see/test"):
            (self.root / name).mkdir(parents=True)
        for name, text in {
            "data/target/box.png": "",
            "demo.sh": "",
            "scripts/do.sh": "case $1 in --all) ;; esac",
            "CMakePresets.json": '{"configurePresets": [{"name": "release"}]}',
            "doc/other.md": "# Other things: a & b\n## Twice\n## Twice\n",
            "modules/see/test/catchSee.cpp": "",
            "tutorial/01-see/tutorial-see.cpp": "",
        }.items():
            (self.root / name).write_text(text)
        self.program()

    def tearDown(self):
        self.folder.cleanup()

    def program(self, example="--rate 5"):
        (self.root / "bin/visp-see").write_text(PROGRAM.replace("{example}", example))
        (self.root / "bin/visp-see").chmod(0o755)

    def faults(self, text, page="README.md"):
        (self.root / page).write_text(text)
        checker = Checker(self.root, self.root / "bin")
        checker.check_all()
        (self.root / page).unlink()
        return checker.faults

    def assert_good(self, text, page="README.md"):
        self.assertEqual(self.faults(text, page), [])

    def assert_fault(self, text, sentence, page="README.md"):
        self.assertEqual(self.faults(text, page), [f"{page}: {sentence}"])

    def test_links(self):
        self.assert_good("# Here\n[a](doc/other.md), [b](#here), [c](doc/other.md#other-things-a--b), [d](doc/other.md#twice-1)")
        self.assert_good("[a](https://nowhere.example/x.md) `[b](c.md)`")
        self.assert_fault("[a](doc/othre.md)", "there is no file doc/othre.md")
        self.assert_good('<img src="data/target/box.png" alt=""> `<img src="b.png">`')
        self.assert_fault('| a<br><img src="data/target/bix.png" alt=""> |', "there is no file data/target/bix.png")
        self.assert_fault("# Here\n[a](#there)", "the page has no heading #there")
        self.assert_fault("[a](doc/other.md#thrice)", "doc/other.md has no heading #thrice")

    def test_files(self):
        self.assert_good("`data/target/box.png`, `data/target/NAME.png`, `data/target/*.png`, `modules/see/test/catchSee`")
        self.assert_fault("`data/target/bix.png`", "there is no file data/target/bix.png")
        self.assert_fault("\\c data/target/bix.png here", "there is no file data/target/bix.png", "doc/page.dox")

    def test_programs_and_options(self):
        for page, block in (("README.md", "```sh\n{}\n```\n"), ("doc/page.dox", "\\verbatim\n$ {}\nsome output --nonsense\n\\endverbatim\n")):
            self.assert_good(block.format("visp-see --rate 5 --out x"), page)
            self.assert_good(block.format("visp-see ... --rate HZ"), page)
            self.assert_good(block.format("mpirun -n 4 visp-see --rate 5 \\\n  --out x && ./tutorial-see"), page)
            self.assert_fault(block.format("visp-see --rat 5"), "visp-see has no option --rat", page)
            self.assert_fault(block.format("echo a | visp-see ... --rat 5"), "visp-see has no option --rat", page)
            self.assert_fault(block.format("visp-see --rate -1"), "visp-see: --rate is -1, must be a number > 0", page)
            self.assert_fault(block.format("visp-saw --rate 5"), "there is no program visp-saw", page)
            self.assert_fault(block.format("./tutorial-saw"), "there is no program tutorial-saw", page)
        self.assert_good("`visp-see --rate`")
        self.assert_fault("`visp-see --rat`", "visp-see has no option --rat")
        self.assert_fault("`./demo.sh visp-see --rat`", "visp-see has no option --rat")

    def test_options_by_themselves(self):
        self.assert_good("`--rate` `--all` `--rng-seed`\n## visp-see\n`--rate`")
        self.assert_fault("`--rat`", "no program has the option --rat")
        self.assert_fault("## visp-see\n`--all`", "visp-see has no option --all")

    def test_scripts_tests_and_presets(self):
        self.assert_good("```sh\nscripts/do.sh --all\ncmake --preset release\n```\n`bin/catchSee`")
        self.assert_fault("`scripts/do.sh --some`", "scripts/do.sh has no option --some")
        self.assert_fault("`scripts/did.sh --all`", "there is no file scripts/did.sh")
        self.assert_fault("```\ncmake --preset rlease\n```\n", "there is no preset rlease")
        self.assert_fault("`catchSaw`", "there is no program catchSaw")

    def test_quoted_code(self):
        (self.root / "tutorial/01-see/see.cpp").write_text("int f()\n{\n  //! [Look]\n  if (a)\n    b();\n  //! [Look]\n}\n")
        page, good = "tutorial/01-see/README.md", "<!-- see.cpp: Look -->\n```cpp\nif (a)\n  b();\n```\n"
        self.assert_good(good, page)
        self.assert_fault(good.replace("b()", "c()"), "the code is not [Look] of see.cpp: checkPages.py --update copies it", page)
        self.assert_fault(good.replace("Look", "Lock"), "see.cpp has no part [Lock]", page)
        self.assert_fault(good.replace("see.cpp", "saw.cpp"), "saw.cpp has no part [Look]", page)
        (self.root / page).write_text(good.replace("b()", "c()") + "more\n")
        Checker(self.root).update()
        self.assertEqual((self.root / page).read_text(), good + "more\n")

    def test_examples_of_the_help(self):
        self.program("--rat 5")
        self.assertEqual(self.faults(""), ["visp-see --help: visp-see has no option --rat"])

    def test_a_program_that_is_not_built(self):
        (self.root / "bin/visp-see").unlink()
        self.assert_fault("`visp-see --rate 5`", "visp-see is not built")


if __name__ == "__main__":
    unittest.main()
