#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""gnomon-plot draws a crowd of techniques so that it can be read: no name lies on another, on a mark or outside; and times
of microseconds, a single technique and a name with a dollar are no trouble. Exits with 77 where Matplotlib is missing.

  check_plot.py GNOMON_PLOT
"""
import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
script = sys.argv[1]


def load():
    loader = importlib.machinery.SourceFileLoader("gnomon_plot", script)
    spec = importlib.util.spec_from_loader("gnomon_plot", loader)
    module = importlib.util.module_from_spec(spec)
    try:
        loader.exec_module(module)
    except SystemExit as missing:
        sys.exit(77 if missing.code == 3 else missing.code)
    return module


def cell(scale, rows):
    rows = [{"technique": name, "family": family, "comparable_ms": ms * scale, "errors": {"wrong_worst": wrong}}
            for name, family, ms, wrong in rows]
    rows.append({"technique": "not here", "family": "rays", "skipped": "It is missing."})
    return {"scene": "a $cene/1", "backend": "gl", "front": [r["technique"] for r in rows[1:3]],
            "worth_a_name": [r["technique"] for r in rows[:12]], "rows": rows}


# Within a few per cent of each other, as techniques that are all right are.
crowd = [("auto", "volumes", 1.0, 0), ("planar", "planar", 0.8, 900), ("silhouette every 2 frames", "approximate", 0.93, 0)]
crowd += [(f"technique number {i}", ("volumes", "projection", "silhouettes", "approximate")[i % 4], 0.94 + 0.01 * i,
           0 if i % 3 else 7) for i in range(40)]
crowd += [(f"shadow map, sloped {512 << i}", "shadow maps", 3.0 * 2.5 ** i, 400 >> i) for i in range(4)]


def overlaps(a, b):
    return a.x0 < b.x1 and b.x0 < a.x1 and a.y0 < b.y1 and b.y0 < a.y1


module = load()
for scale in (1.0, 1e-3, 4e3):
    plot = module.Plot(cell(scale, crowd))
    figure = plot.draw()
    renderer = figure.canvas.get_renderer()
    notes = [n for axes in figure.axes for n in axes.texts if isinstance(n, module.matplotlib.text.Annotation)]
    names = [n.get_text() for n in notes]
    assert {"planar", "silhouette every 2 frames"} <= set(names), (scale, names)
    assert any(t.get_text().startswith("auto: ") for t in figure.texts), scale
    boxes = [module.matplotlib.text.Text.get_window_extent(n, renderer) for n in notes]
    for i, box in enumerate(boxes):
        assert box.x0 >= 0 and box.x1 <= figure.bbox.x1 and box.y0 >= 0, (scale, names[i])
        for k in range(i):
            assert not overlaps(box, boxes[k]), (scale, names[i], names[k])
        for technique, (on, x, y) in plot.places.items():
            px, py = on.transData.transform((x, y))
            assert not (box.x0 < px < box.x1 and box.y0 < py < box.y1), (scale, names[i], technique)
    assert len(plot.panel.get_xticks()) >= 2, scale

with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    only = cell(1.0, [])
    (folder / "r.json").write_text(json.dumps({"cells": [cell(1.0, crowd), cell(1.0, crowd[:1]) | {"scene": "one"}, only]}))
    done = subprocess.run([sys.executable, script, folder / "r.json", folder], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for name in ("a__cene_1.gl.svg", "a__cene_1.gl.png", "one.gl.svg", "one.gl.png"):
        assert (folder / name).stat().st_size > 1000, name
    (folder / "r.json").write_text("{}")
    done = subprocess.run([sys.executable, script, folder / "r.json", folder], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and "is no report" in done.stderr, done.stderr
