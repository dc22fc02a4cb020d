# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""That programs print what the page of a tutorial shows: checkTutorial.py PAGE FOLDER...

A line "$ COMMAND" of a code block with lines below it runs in the current folder, and prints these lines; where it fails, its error is
among them. FOLDERs have the programs and files that commands name, such as ./tutorial-first-law.

  words      are the same; the page may break lines elsewhere. One line "..." stands for words that are left out
  numbers    with a point are those printed, rounded to the digits that the page shows: as many as do not depend on the processor.
             Others are the same
  commands   for hardware, or that take too long, have a comment above their block: <!-- not run: REASON -->
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys

BLOCK = re.compile(r"^(?:<!-- not run: (.+) -->\n)?```\w*\n(.*?)^```$", re.S | re.M)
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]\d+)?")
IMAGES = pathlib.Path(os.environ.get("VISP_INPUT_IMAGE_PATH", "/usr/share/visp-images-data"), "ViSP-images/calibration")


def outputs(text):
    """Commands that are shown with what they print: number of the line, command, lines below it, reason why it is not run."""
    for found in BLOCK.finditer(text):
        shown = []
        for number, line in enumerate(found[2].splitlines(), text.count("\n", 0, found.start(2)) + 1):
            if line.startswith("$ "):
                shown.append((number, line[2:], [], found[1]))
            elif shown:
                shown[-1][2].append(line)
        yield from (each for each in shown if each[2])


def is_rounded(shown, printed):
    """Whether the printed number, rounded to the digits of the other one, is that one."""
    mantissa, _, exponent = shown.partition("e")
    decimals = len(mantissa.partition(".")[2])
    half = 0.5 * 10.0 ** (int(exponent or 0) - decimals) * (1 + 1e-9)
    return shown == printed or decimals > 0 and abs(float(shown) - float(printed)) <= half


def is_like(shown, printed):
    """Whether two words are alike."""
    if NUMBER.sub("0", shown) != NUMBER.sub("0", printed):
        return False
    return all(map(is_rounded, NUMBER.findall(shown), NUMBER.findall(printed)))


def difference(shown, printed):
    """Where the lines shown are not what is printed: index of the line, some words of it, those printed instead. None where they are."""
    words = [(word, i) for i, line in enumerate(shown) for word in line.split()]
    printed = printed.split()
    at = next((k for k, (word, _) in enumerate(words) if word == "..."), None)
    if at is not None and len(printed) >= len(words):
        printed[at : len(printed) - (len(words) - at - 1)] = ["..."]
    k = next((k for k, ((word, _), other) in enumerate(zip(words, printed)) if not is_like(word, other)), min(len(words), len(printed)))
    if k == len(words) == len(printed):
        return None
    return words[min(k, len(words) - 1)][1], " ".join(word for word, _ in words[k : k + 6]), " ".join(printed[k : k + 6])


def located(command, folders):
    """The words of the command, programs and files by their paths; raises FileNotFoundError."""
    words = shlex.split(command)
    for i, word in enumerate(words):
        if i == 0 or word.startswith("./") or re.fullmatch(r"[\w-]+\.[a-z]+", word):
            paths = (pathlib.Path(folder, word) for folder in (*folders, IMAGES))
            words[i] = next((str(path.resolve()) for path in paths if path.is_file()), None)
            if words[i] is None:
                raise FileNotFoundError(word)
    return words


def check(page, folders):
    """Sentences on what is wrong, and on what is not run; number of outputs compared."""
    faults, notes, compared = [], [], 0
    for number, command, shown, reason in outputs(page.read_text(encoding="utf-8")):
        where = f"{page}:{number}"
        try:
            words = None if reason else located(command, folders)
        except FileNotFoundError as missing:
            reason = f"{missing} is not here"
            if not re.fullmatch(r"visp-[a-z-]+|.*\.pgm", str(missing)):  # these are of an optional part or package
                faults.append(f"{where}: {reason}")
                continue
        if reason:
            notes.append(f"{where}: not run: {reason}")
            continue
        ran = subprocess.run(words, capture_output=True, text=True)
        printed = ran.stdout + (ran.stderr if ran.returncode != 0 else "")  # else it is progress
        found = difference(shown, printed.replace(os.getcwd() + os.sep, ""))
        compared += 1
        if found:
            line, page_says, program_says = found
            faults.append(f'{page}:{number + 1 + line}: the page shows "{page_says}", the program prints "{program_says}"')
        elif ran.returncode != 0 and not ran.stderr:
            faults.append(f"{where}: {command} ended with status {ran.returncode}")
    if not compared:
        faults.append(f"{page}: no output was compared")
    return faults, notes, compared


def main(page, *folders):
    faults, notes, compared = check(pathlib.Path(page), folders)
    print("\n".join([*notes, *faults, f"{compared} outputs compared, {len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
