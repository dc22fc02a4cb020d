# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""What pages say that a reader may click or type is there: checkPages.py [--bin FOLDER] [--update] [ROOT].

Pages are all Markdown files and .dox pages of the repository and, with --bin, what the programs print for --help. Checked are

  links      files, figures, and headings after a #; web links are not followed
  files      paths of the repository, in commands and in code spans
  commands   programs of the repository, their options (each is in --help) and values (the program reads them before it prints its
             help; nothing runs), options of scripts, presets of CMake, names of test programs and of tutorials
  code       a block below a comment <!-- FILE.cpp: Part --> is the part of the file beside the page between its two lines //! [Part];
             --update writes it so

Nothing here needs hardware: a command for a robot or a camera is read like any other. A word in capitals or with "..." or "<" is a place
for the reader's own; commands with one are not read by the program, only their options are looked up.
"""
import argparse
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import textwrap

FOLDERS = ("apps", "cmake", "data", "doc", "lab", "modules", "python", "scripts", "support", "test", "tutorial")
PATH = re.compile(rf"(?<![\w./-])(?:\./)?((?:{'|'.join(FOLDERS)})/[\w./-]*\w/?|demo\.sh|test\.sh|[A-Z]+\.md)(?![\w*{{<$-])")
OWN = re.compile(r"\.\.\.|[<|*$]|(?<!\w)(?!README)[A-Z][A-Z_]*(?![\w-])")  # a place for the reader's own word
OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")
FOREIGN = ["--bind-to", "--prefix", "--rng-seed"]  # of mpirun, CMake and Catch2
PROGRAM = re.compile(r"visp-(?!direct$|images-data$)[a-z-]+[a-z]")


QUOTED = re.compile(r"(?<=^<!-- )([\w.-]+): (\w+) -->\n```cpp\n(.*?)^```", re.S | re.M)


def part_of(file, name):
    """The lines of a program between //! [name] and //! [name], without the indentation that they share; None where they are not there."""
    found = file.is_file() and re.search(rf"^ *//! \[{name}\]\n(.*?)^ *//! \[{name}\]$", file.read_text(encoding="utf-8"), re.S | re.M)
    return textwrap.dedent(re.sub(r"^ *//! \[\w+\]\n", "", found[1], flags=re.M)) if found else None


def headings(text):
    """The anchors that a forge makes of headings."""
    anchors = set()
    for heading in re.findall(r"^#+ +(.*?) *$", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M), re.M):
        plain = re.sub(r"\]\([^)]*\)|[`*\[]", "", heading)
        anchor = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        anchors.add(next(a for a in (anchor, *(f"{anchor}-{i}" for i in range(1, 99))) if a not in anchors))
    return anchors


def blocks_of(text, is_page):
    """Lines of code blocks, with lines that go on joined; a prompt marks commands among output."""
    pattern = r"^\\verbatim()\n(.*?)^\\endverbatim" if is_page else r"^```(\w*)\n(.*?)^```"
    for language, block in re.findall(pattern, text, re.S | re.M):
        if language not in ("", "sh"):
            continue
        lines = block.replace("\\\n", " ").splitlines()
        prompted = [line[2:] for line in lines if line.startswith("$ ")]
        yield from prompted or lines


def spans_of(text, is_page):
    prose = re.sub(r"^(?:```.*?^```|\\verbatim.*?^\\endverbatim)", "", text, flags=re.S | re.M)
    pattern = r"(?s)<tt>(.*?)</tt>|`([^`]+)`|\\c ([^\s,;:)]+)" if is_page else r"`([^`]+)`"
    for found in re.finditer(pattern, prose):
        yield re.sub(r"\s+", " ", next(filter(None, found.groups())))


def commands_in(line):
    """Words of each command of a line of the shell."""
    try:
        words = shlex.split(line, comments=True)
    except ValueError:  # not a command
        return
    command = []
    for word in [*words, ";"]:
        if word in ("&&", "||", "|", ";") or word.endswith(";"):
            command += [word[:-1]] if len(word) > 1 and word.endswith(";") else []
            if command:
                yield command
            command = []
        elif not (not command and "=" in word):  # a variable before the program
            command.append(word)


class Checker:
    def __init__(self, root, bin_folder=None):
        self.root, self.bin, self.faults, self.counts = root, bin_folder, [], {"links": 0, "files": 0, "commands": 0, "quotations": 0}
        self.helps, self.done, self.page, self.anywhere = {}, set(), "", []  # helps: what each call says
        names = (path.stem for folder in FOLDERS for path in (root / folder).rglob("*.cpp"))
        self.sources = {name for name in names if re.match(r"catch|perf|tutorial-", name)}
        presets = root / "CMakePresets.json"
        self.presets = {p["name"] for p in json.loads(presets.read_text())["configurePresets"]} if presets.is_file() else set()

    def fault(self, sentence):
        if (self.page, sentence) not in self.done:
            self.done.add((self.page, sentence))
            self.faults.append(f"{self.page}: {sentence}")

    def help_of(self, program):
        """Text of --help; None where there is no such program or it is not known."""
        if program not in self.helps:
            path = self.bin / program
            ran = path.is_file() and subprocess.run([path, "--help"], capture_output=True, text=True)
            self.helps[program] = ran.stdout if ran and ran.returncode == 0 else None
        return self.helps[program]

    def options_of(self, program):
        """The first words of the lines of options: the examples below may name others."""
        return [o for names in re.findall(r"^  (-\S+)", self.help_of(program) or "", re.M) for o in names.split(",")]

    def check_options(self, name, options, known):
        for option in options:
            if option.split("=")[0] not in known:
                self.fault(f"{name} has no option {option.split('=')[0]}" if name else f"no program has the option {option}")

    def check_option(self, span, heading):
        """An option by itself: of the program of the section, or of any program or script."""
        self.counts["commands"] += 1
        if PROGRAM.fullmatch(heading):
            self.check_options(heading, OPTION.findall(span), self.options_of(heading))
            return
        if not self.anywhere:
            scripts = [self.root / "demo.sh", *(self.root / "scripts").rglob("*.[sp][hy]"), *(self.root / "python").rglob("*.py")]
            self.anywhere = FOREIGN + [o for path in scripts if path.is_file() for o in OPTION.findall(path.read_text())]
            self.anywhere += [o for program in (self.root / "apps").glob("visp-*") for o in self.options_of(program.name)]
        self.check_options("", OPTION.findall(span), self.anywhere)

    def check_program(self, words):
        name, arguments = words[0], words[1:]
        self.counts["commands"] += 1
        if OWN.search(name):
            return
        if not (self.root / "apps" / name).is_dir():
            self.fault(f"there is no program {name}")
        elif self.bin:
            if self.help_of(name) is None:
                self.fault(f"{name} is not built")
                return
            self.check_options(name, [w for w in arguments if w.startswith("--")], self.options_of(name))
            if arguments and not any(OWN.search(word) for word in arguments):
                call = (name, *arguments)
                if call not in self.helps:
                    self.helps[call] = self.faults_of(name, arguments)
                if self.helps[call]:
                    self.fault(self.helps[call])

    def faults_of(self, name, arguments):
        """What the program finds wrong with the command line itself. Files of the reader are not there: status 1."""
        while arguments and arguments[-1].startswith((">", "2>")) or arguments[-2:-1] in ([">"], ["2>"]):
            arguments = arguments[:-1]
        with tempfile.TemporaryDirectory() as nowhere:
            ran = subprocess.run([self.bin / name, *arguments, "--help"], capture_output=True, text=True, cwd=nowhere)
        mentioned = arguments[-1].startswith("--") and " is given without " in ran.stderr  # an option in a sentence, without its value
        return ran.stderr.strip() if ran.returncode == 2 and not mentioned else ""

    def check_command(self, words):
        while words and words[0] in ("sudo", "nice", "time", "mpirun", "-n", "-np") or words and words[0].isdigit():
            words = words[1:]
        if not words:
            return
        name, script = pathlib.PurePath(words[0]).name, re.sub(r"^\./", "", words[0])
        if name == "demo.sh":
            inner = words[1:] if words[1:] and words[1].startswith("visp-") else ["visp-servo-compare", *words[1:]]
            self.check_program(inner)
        elif PROGRAM.fullmatch(name):
            self.check_program([name, *words[1:]])
        elif script.endswith(".sh") and (self.root / script).is_file() and name != "test.sh":  # which hands them to ctest
            self.counts["commands"] += 1
            self.check_options(script, [w for w in words[1:] if w.startswith("--")], OPTION.findall((self.root / script).read_text()))
        elif name in ("cmake", "ctest") and "--preset" in words:
            self.counts["commands"] += 1
            preset = words[words.index("--preset") + 1]
            if preset not in self.presets and not OWN.search(preset):
                self.fault(f"there is no preset {preset}")
        elif re.fullmatch(r"(?:(?:catch|perf)[A-Z]\w*|tutorial-[a-z0-9-]+)(?:\.cpp)?", name):
            self.counts["commands"] += 1
            if re.sub(r"\.cpp$", "", name) not in self.sources and not OWN.search(name):
                self.fault(f"there is no program {name}")

    def check_files(self, text):
        for path in PATH.findall(text):
            self.counts["files"] += 1
            here = (self.root / self.page).parent
            if not ((self.root / path).exists() or (here / path).exists() or [*self.root.glob(f"{path}.*")] or OWN.search(path)):
                self.fault(f"there is no file {path}")

    def check_links(self, text):
        folder = (self.root / self.page).parent
        prose = re.sub(r"^```.*?^```|`[^`\n]*`", "", text, flags=re.S | re.M)
        for target in re.findall(r"\]\(([^()\s]+)\)", prose) + re.findall(r'<img src="([^"]+)"', prose):
            if re.match(r"(https?|mailto):|[.][.]/[.][.]/actions/", target):  # the last: on the forge, beside the repository
                continue
            self.counts["links"] += 1
            file, _, anchor = target.partition("#")
            path = folder / file if file else self.root / self.page
            if not path.exists():
                self.fault(f"there is no file {file}")
            elif anchor and anchor not in headings(path.read_text(encoding="utf-8")):
                self.fault(f"{file or 'the page'} has no heading #{anchor}")

    def check_code(self, text):
        for file, name, block in QUOTED.findall(text):
            self.counts["quotations"] += 1
            part = part_of((self.root / self.page).parent / file, name)
            if part is None:
                self.fault(f"{file} has no part [{name}]")
            elif part != block:
                self.fault(f"the code is not [{name}] of {file}: checkPages.py --update copies it")

    def check_text(self, page, text):
        self.page, is_page = str(page), str(page).endswith(".dox")
        if not is_page:
            self.check_links(text)
            self.check_code(text)
        for line in blocks_of(text, is_page):
            self.check_files(line)
            for words in commands_in(line):
                self.check_command(words)
        for heading, section in re.findall(r"(?:^## +(.*?)\n|\A)(.*?)(?=^## |\Z)", text, re.S | re.M):
            for span in spans_of(section, is_page):
                self.check_files(span)
                if self.bin and span.startswith("--"):
                    self.check_option(span, heading)
                for words in commands_in(span):
                    self.check_command(words)

    def check_help(self, program):
        """Its examples."""
        self.page = f"{program} --help"
        text = (self.help_of(program) or "").replace("\\\n", " ")
        for line in re.findall(r"^  ((?:mpirun |echo )?.*?visp-[a-z].*)$", text, re.M):
            for words in commands_in(line):
                self.check_command(words)

    def check_numbers(self, file):
        """Commands whose output is compared with numbers of pages."""
        self.page = str(file.relative_to(self.root))
        for claim in json.loads(file.read_text(encoding="utf-8")):
            for words in commands_in(claim["command"]):
                self.check_command(words)

    def pages(self):
        pages = [*self.root.glob("*.md")]
        for folder in FOLDERS:
            pages += [p for suffix in ("md", "dox") for p in (self.root / folder).rglob(f"*.{suffix}")]
        return sorted(pages)

    def update(self):
        """Copies the code that pages quote."""
        for page in self.pages():
            text = page.read_text(encoding="utf-8")
            new = QUOTED.sub(lambda m: f"{m[1]}: {m[2]} -->\n```cpp\n{part_of(page.parent / m[1], m[2]) or m[3]}```", text)
            if new != text:
                page.write_text(new, encoding="utf-8")

    def check_all(self):
        pages = self.pages()
        for page in pages:
            if page.name != "CHANGELOG.md" or self.root not in page.parents:  # which names what was
                self.check_text(page.relative_to(self.root), page.read_text(encoding="utf-8"))
        if self.bin:
            for program in sorted((self.root / "apps").glob("visp-*")):
                self.check_help(program.name)
        claims = self.root / "scripts/numbers/claims.json"
        if claims.is_file():
            self.check_numbers(claims)
        return len(pages)


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=pathlib.Path, help="folder of the programs")
    parser.add_argument("--update", action="store_true", help="copies the code that pages quote")
    parser.add_argument("root", type=pathlib.Path, nargs="?", default=pathlib.Path(__file__).resolve().parents[2])
    options = parser.parse_args(arguments)
    checker = Checker(options.root, options.bin)
    if options.update:
        checker.update()
    pages = checker.check_all()
    print("\n".join(checker.faults) or f"{pages} pages: " + ", ".join(f"{n} {what}" for what, n in checker.counts.items()) + " are good")
    return 1 if checker.faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
