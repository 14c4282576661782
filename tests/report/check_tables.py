#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""scripts/report-tables fills every table of docs/speed-and-error.md from a report of two techniques and a skipped one, and
says so of what is none.

  check_tables.py SOURCE_FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[1])


def row(technique, family, ms, wrong, ratio):
    return {"technique": technique, "family": family, "summary": "s.", "caveat": "Because.",
            "errors": {"wrong_worst": wrong}, "frame_ms": {"median": ms},
            "against_auto": {"mean": ratio, "low": ratio - 0.01, "high": ratio + 0.01}}


report = {"version": "9.9", "command": "gnomon report", "machine": {"processor": "P", "cores": 2, "system": "S"},
          "width": 1, "height": 2, "frames": 3, "rounds": 4, "degrees_per_frame": 0.5,
          "cells": [{"scene": "place", "kind": "hero", "backend": "gl", "adapter": "A", "triangles": 1234,
                     "rows": [row("auto", "volumes", 2.0, 0, 1.0), row("depth-pass", "volumes", 1.0, 0, 0.5),
                              row("shadow map, sloped 512", "shadow maps", 30.0, 4321, 15.0),
                              {"technique": "gone", "family": "rays", "summary": "s.", "caveat": "", "skipped": "No."}]}]}


def run(folder, text):
    folder = pathlib.Path(folder)
    (folder / "report.json").write_text(text, encoding="utf-8")
    document = folder / "document.md"
    document.write_text((source / "docs/speed-and-error.md").read_text(encoding="utf-8"), encoding="utf-8")
    done = subprocess.run([sys.executable, source / "scripts/report-tables", folder / "report.json", "--document", document],
                          capture_output=True, text=True, check=False)
    return done, document.read_text(encoding="utf-8")


with tempfile.TemporaryDirectory() as folder:
    done, text = run(folder, json.dumps(report))
    assert done.returncode == 0, done.stderr
    for part in ("gnomon 9.9, P, 2 cores, S; gl: A. 1×2 pixels",
                 "| place | hero | 1,234 | 2 | 0 | 15 × (sloped 512) | 4,321 | – | – | – | – |",
                 "| place | `depth-pass` | 0.50 [0.49, 0.51] | Because. |",
                 "| shadow map, sloped 512 | 4,321 |", "| gone | – |", "| depth-pass | 0.50 |"):
        assert part in text, part
    assert text.count("<!-- table: ") == text.count("<!-- end of table -->") == 5, text.count("<!-- table: ")
    done, _ = run(folder, "{}")
    assert done.returncode == 1 and "is no report" in done.stderr, done.stderr
