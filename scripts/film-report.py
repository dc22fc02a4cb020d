#!/usr/bin/env python3
# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""A 3D view of a report as numbered pictures, FOLDER/000.jpg..., by chromium: scripts/film-report.py report.html FOLDER [--rate HZ] [--view N]"""
import argparse
import base64
import json
import pathlib
import re
import subprocess
import sys

PROBE = """<pre id="film"></pre><script>
window.addEventListener("load", () => setTimeout(async () => {
  const figure = document.querySelectorAll(".view")[VIEW], canvas = figure.querySelector("canvas"), seen = figure.querySelector("img.seen");
  const slider = figure.querySelector("input[type=range]"), film = [];
  const sheet = Object.assign(document.createElement("canvas"), {width: canvas.width, height: canvas.height}), c = sheet.getContext("2d");
  for (let t = 0; t < Number(slider.max) + 1 / RATE; t += 1 / RATE) {
    figure.vispView.setTime(Math.min(t, Number(slider.max)));
    c.drawImage(canvas, 0, 0);
    if (seen) {
      await new Promise((done) => setTimeout(done, 50)); // until it is decoded
      c.drawImage(seen, 10, 10, 0.33 * canvas.width, 0.33 * canvas.width * seen.naturalHeight / seen.naturalWidth);
    }
    film.push(sheet.toDataURL("image/jpeg", 0.92));
  }
  document.getElementById("film").textContent = JSON.stringify(film);
}, 300));</script></body>"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("report", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--rate", type=float, default=15, help="pictures a second of the run")
    parser.add_argument("--view", type=int, default=0, help="which view of the page, from 0")
    options = parser.parse_args()
    page = options.report.read_text(encoding="utf-8")
    options.folder.mkdir(parents=True, exist_ok=True)
    probed = options.folder / "film.html"
    probed.write_text(
        page.replace("</body>", PROBE.replace("RATE", str(options.rate)).replace("VIEW", str(options.view))),
        encoding="utf-8",
    )
    browser = "chromium --headless --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --virtual-time-budget=60000"
    dumped = subprocess.run(
        [*browser.split(), "--window-size=1000,900", "--dump-dom", probed.resolve().as_uri()],
        capture_output=True,
        text=True,
    )
    probed.unlink()
    film = re.search(r'<pre id="film">(\[.*?\])</pre>', dumped.stdout, re.S)
    if not film:
        sys.exit(f"film-report.py: {options.report}: view {options.view} cannot be shown")
    for i, uri in enumerate(json.loads(film.group(1))):
        (options.folder / f"{i:03}.jpg").write_bytes(base64.b64decode(uri.split(",")[1]))


main()
