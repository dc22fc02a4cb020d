# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares the numbers of a page with what the command beside them prints; called by scripts/numbers.sh.

A claim of claims.json:
  page       file of the repository
  text       words of the page with {names} in place of numbers; spaces stand for any white space
  command    of build/release/bin, OUT is a result folder
  from       by name: "summary.json runs law=pbvs1,plant=D end_rotation_deg" (a path in a JSON file of OUT; name=value or a number chooses in a
             list), "re: ..." (first group of a regular expression on the output; "max: ..." and "sum: ..." take all that it finds), or
             "bench: NAME: COUNTER" (of Google Benchmark; cpu_time is in the unit of the benchmark), or the ratio of two,
             "ratio: NAME: COUNTER / NAME: COUNTER"
  factor     by name: the tolerance as a ratio, for times; without it the number must round to what the page says
  at_most    names of bounds, which the measured number may stay below
  scale      by name: what the measured number is multiplied by, for other units
  for        values of $ for which the claim stands, each by itself
  long       about how many minutes it takes, where it is more than one
  needs      a build with this option: without it the benchmark is not there, and nothing is compared
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
NUMBER = r"(-?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e-?\d+)?)"


class Stale(Exception):
    """A sentence that says what does not fit."""


class Missing(Stale):
    """The same, of a benchmark that is not built."""


def claims(file):
    for claim in json.loads(pathlib.Path(file).read_text(encoding="utf-8")):
        for value in claim.get("for", [None]):
            yield json.loads(json.dumps(claim).replace("$", value)) if value is not None else claim


def pattern_of(text):
    """The template as a regular expression with a group for each name."""
    parts = re.split(r"\{(\w+)\}", text)
    words = [r"\s+".join(re.escape(word) for word in re.split(r"\s+", part)) for part in parts[::2]]
    return parts[1::2], words[0] + "".join(NUMBER + word for word in words[1:])


def found_in(page, text):
    """Where the page has the numbers of the template: (start, end) by name."""
    names, pattern = pattern_of(text)
    found = re.search(pattern, page)
    if not found:
        raise Stale(f'the page does not say "{text}"')
    return {name: found.span(i + 1) for i, name in enumerate(names)}


def printed_in(page, text):
    return {name: page[begin:end] for name, (begin, end) in found_in(page, text).items()}


def like(printed, measured):
    """The measured number with the digits of the printed one."""
    mantissa, e, _ = printed.partition("e")
    decimals = len(mantissa.partition(".")[2])
    if e:
        mantissa, _, exponent = f"{measured:.{decimals}e}".partition("e")
        return f"{mantissa}e{int(exponent)}"
    return f"{measured:,.{decimals}f}" if "," in printed else f"{measured:.{decimals}f}"


def rewrite(page, text, stale):
    """The page with other numbers; stale: measured ones by name."""
    for name, (begin, end) in sorted(found_in(page, text).items(), key=lambda item: -item[1][0]):
        if name in stale:
            page = page[:begin] + like(page[begin:end], stale[name]) + page[end:]
    return page


def chosen(value, step):
    if isinstance(value, list) and step.isdigit():
        return value[int(step)]
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
    kind, _, pattern = source.partition(": ")
    if kind in ("re", "max", "sum"):
        numbers = [float(found.group(1)) for found in re.finditer(pattern, output)]
        if not numbers:
            raise Stale(f"the command does not print {pattern}")
        return {"re": numbers[0], "max": max(numbers), "sum": sum(numbers)}[kind]
    if kind == "ratio":
        over, under = (measured_in("bench: " + part, output, out) for part in pattern.split(" / "))
        return over / under
    if source.startswith("bench:"):
        name, counter = (part.strip() for part in source[6:].rsplit(":", 1))
        runs = json.loads(output[output.index("{\n") : output.rindex("}") + 1])["benchmarks"]
        runs = [run for run in runs if re.sub("/(iterations:.*|process_time|real_time)$", "", run["name"]) == name]
        if len(runs) != 1:
            raise (Stale if runs else Missing)(f"{len(runs)} benchmarks have the name {name}")
        return float(chosen(runs[0], counter))
    file, *steps = source.split(" ")
    value = json.loads((out / file).read_text(encoding="utf-8"))
    for step in steps:
        value = chosen(value, step)
    return float(value)


def fits(printed, measured, factor, at_most=False):
    """Within the factor; without one, whether the measured number rounds to the printed one, or stays below it."""
    mantissa, _, exponent = printed.replace(",", "").partition("e")
    value = float(printed.replace(",", ""))
    if factor:
        return value / factor <= measured <= value * factor
    half = 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])) * (1 + 1e-9)
    return measured <= value + half and (at_most or measured >= value - half)


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
            self.done[command] = (ran.stdout if "--benchmark_format" in command else ran.stdout + ran.stderr, out)
        return self.done[command]


def check(claim, runner):
    """A line for each number, and the stale ones by name; raises Stale where nothing can be compared."""
    printed = printed_in((ROOT / claim["page"]).read_text(encoding="utf-8"), claim["text"])
    benchmark = any(source.startswith(("bench:", "ratio:")) for source in claim["from"].values())
    output, out = runner.run(claim["command"] + (" --benchmark_format=json" if benchmark else ""))
    lines, stale = [], {}
    for name, source in claim["from"].items():
        measured = measured_in(source, output, out) * claim.get("scale", {}).get(name, 1.0)
        factor = claim.get("factor", {}).get(name)
        good = fits(printed[name], measured, factor, name in claim.get("at_most", []))
        if not good:
            stale[name] = measured
        lines.append(f"{'ok   ' if good else 'STALE'} {claim['page']}: {name} {printed[name]}, now {measured:.4g}" + (f" (within {factor:g} times)" if factor else ""))
    return lines, stale


def main(arguments):
    parser = argparse.ArgumentParser(prog="scripts/numbers.sh")
    parser.add_argument("--page", help="only claims of this page")
    parser.add_argument("--long", nargs="?", const=10.0, default=0.0, type=float, metavar="MINUTES", help="also commands that take up to so many (10)")
    parser.add_argument("--list", action="store_true", help="say which commands would run; only look whether the pages have the words")
    parser.add_argument("--update", action="store_true", help="write what is measured now into the pages, where they are stale")
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
                if claim.get("long", 0) > options.long:
                    continue
                lines, measured = check(claim, runner)
                bad = len(measured)
                if options.update and measured:
                    page = ROOT / claim["page"]
                    page.write_text(rewrite(page.read_text(encoding="utf-8"), claim["text"], measured), encoding="utf-8")
            except Missing as reason:
                kind, bad = ("-----", 0) if "needs" in claim else ("STALE", 1)
                lines = [f"{kind} {claim['page']}: {claim['text'][:60]}: {reason}" + (f"; needs {claim['needs']}" if not bad else "")]
            except Stale as reason:
                lines, bad = [f"STALE {claim['page']}: {claim['text'][:60]}: {reason}"], 1
            compared, stale = compared + sum(not line.startswith("-----") for line in lines), stale + bad
            print("\n".join(lines), flush=True)
    print(f"{compared} numbers compared, {stale} stale")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
