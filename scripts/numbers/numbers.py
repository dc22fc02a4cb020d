# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares the numbers of a page with what the command beside them prints; called by scripts/numbers.sh.

A claim of claims.json:
  page       file of the repository
  text       words of the page with {names} in place of numbers; spaces stand for any white space
  command    of build/release/bin, OUT is a result folder
  from       by name: "summary.json runs law=pbvs1,plant=D end_rotation_deg" (a path in a JSON file of OUT; name=value chooses in a
             list), or "re: ..." (first group of a regular expression on the output)
  factor     by name: the tolerance as a ratio, for times; without it the number must round to what the page says
  for        values of $ for which the claim stands, each by itself
  long       takes minutes
"""
import argparse
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NUMBER = r"(-?\d+(?:\.\d+)?)"


class Stale(Exception):
    """A sentence that says what does not fit."""


def claims(file):
    for claim in json.loads(pathlib.Path(file).read_text(encoding="utf-8")):
        for value in claim.get("for", [None]):
            yield json.loads(json.dumps(claim).replace("$", value)) if value is not None else claim


def pattern_of(text):
    """The template as a regular expression with a group for each name."""
    parts = re.split(r"\{(\w+)\}", text)
    words = [r"\s+".join(re.escape(word) for word in re.split(r"\s+", part)) for part in parts[::2]]
    return parts[1::2], words[0] + "".join(NUMBER + word for word in words[1:])


def printed_in(page, text):
    names, pattern = pattern_of(text)
    found = re.search(pattern, page)
    if not found:
        raise Stale(f'the page does not say "{text}"')
    return dict(zip(names, found.groups()))


def chosen(value, step):
    if isinstance(value, list):
        wanted = dict(pair.split("=") for pair in step.split(","))
        fitting = [v for v in value if all(str(v.get(key)) == w for key, w in wanted.items())]
        if len(fitting) != 1:
            raise Stale(f"{len(fitting)} entries have {step}")
        return fitting[0]
    if step not in value:
        raise Stale(f"the result has no field {step}")
    return value[step]


def measured_in(source, output, out):
    if source.startswith("re:"):
        found = re.search(source[3:].strip(), output)
        if not found:
            raise Stale(f"the command does not print {source[3:].strip()}")
        return float(found.group(1))
    file, *steps = source.split(" ")
    value = json.loads((out / file).read_text(encoding="utf-8"))
    for step in steps:
        value = chosen(value, step)
    return float(value)


def fits(printed, measured, factor):
    """Within the factor; without one, whether the measured number rounds to the printed one."""
    value = float(printed)
    if factor:
        return value / factor <= measured <= value * factor
    decimals = len(printed.partition(".")[2])
    return abs(measured - value) <= 0.5 * 10.0**-decimals * (1 + 1e-9)


class Runner:
    """Runs each command once."""

    def __init__(self, bin_folder, scratch):
        self.bin, self.scratch, self.done = bin_folder, scratch, {}

    def run(self, command):
        if command not in self.done:
            out = self.scratch / str(len(self.done))
            environment = {**os.environ, "OMP_NUM_THREADS": "1"}
            words = shlex.split(command)
            while "=" in words[0]:
                name, _, value = words.pop(0).partition("=")
                environment[name] = value
            program = self.bin / words[0]
            if not program.is_file():
                raise Stale(f"{words[0]} is not built")
            ran = subprocess.run(
                [program, *(str(out) if word == "OUT" else word for word in words[1:])],
                capture_output=True,
                text=True,
                cwd=ROOT,
                env=environment,
            )
            if ran.returncode != 0:
                raise Stale(f"{command} ended with status {ran.returncode}: {ran.stderr.strip()[-200:]}")
            self.done[command] = (ran.stdout + ran.stderr, out)
        return self.done[command]


def check(claim, runner):
    """One line for each number, stale ones first; raises Stale where nothing can be compared."""
    printed = printed_in((ROOT / claim["page"]).read_text(encoding="utf-8"), claim["text"])
    output, out = runner.run(claim["command"])
    lines, stale = [], 0
    for name, source in claim["from"].items():
        measured = measured_in(source, output, out)
        factor = claim.get("factor", {}).get(name)
        good = fits(printed[name], measured, factor)
        stale += not good
        lines.append(f"{'ok   ' if good else 'STALE'} {claim['page']}: {name} {printed[name]}, now {measured:.4g}" + (f" (within {factor:g} times)" if factor else ""))
    return lines, stale


def main(arguments):
    parser = argparse.ArgumentParser(prog="scripts/numbers.sh")
    parser.add_argument("--page", help="only claims of this page")
    parser.add_argument("--long", action="store_true", help="also commands that take minutes")
    parser.add_argument("--list", action="store_true", help="say which commands would run; only look whether the pages have the words")
    parser.add_argument("--claims", default=ROOT / "scripts/numbers/claims.json")
    parser.add_argument("--bin", default=ROOT / "build/release/bin", type=pathlib.Path)
    options = parser.parse_args(arguments)
    compared = stale = 0
    with tempfile.TemporaryDirectory() as scratch:
        runner = Runner(options.bin, pathlib.Path(scratch))
        for claim in claims(options.claims):
            if options.page and claim["page"] != options.page:
                continue
            try:
                if options.list:
                    printed = printed_in((ROOT / claim["page"]).read_text(encoding="utf-8"), claim["text"])
                    print(f"{claim['page']}: {', '.join(f'{k} {v}' for k, v in printed.items())}: {claim['command']}")
                    continue
                if claim.get("long") and not options.long:
                    continue
                lines, bad = check(claim, runner)
            except Stale as reason:
                lines, bad = [f"STALE {claim['page']}: {claim['text'][:60]}: {reason}"], 1
            compared, stale = compared + len(lines), stale + bad
            print("\n".join(lines), flush=True)
    print(f"{compared} numbers compared, {stale} stale")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
