# SPDX-License-Identifier: MIT
"""That scripts/performance-tables makes tables of what gnomon-bench writes, changes nothing outside
the markers, and refuses what must not be published."""
import json
import pathlib
import subprocess
import sys
import tempfile

source, results = map(pathlib.Path, sys.argv[1:3])
script = [sys.executable, str(source / "scripts/performance-tables")]


def run(*arguments):
    return subprocess.run([*script, *map(str, arguments)], capture_output=True, text=True, check=False)


def require(holds, claim):
    if not holds:
        sys.exit("not so: " + claim)


checked = run(results, "--check")
require(checked.returncode == 0, "the results have what the tables need: " + checked.stderr)
data = json.loads(results.read_text(encoding="utf-8"))
strategies = {s["name"] for r in data["rows"] + data["literature"] + data["scenes"] for s in r["strategies"]}
require({"brute_force", "edge_stack", "edge_stack_naive", "vnv", "edge_list", "hextree"} <= strategies,
        "every strategy of the literature was run")
require(all(s["time_ns"]["median"] > 0 and s["time_ns"]["low"] <= s["time_ns"]["high"]
            for r in data["rows"] for s in r["strategies"]), "times are positive and intervals ordered")

with tempfile.TemporaryDirectory() as folder:
    document = pathlib.Path(folder) / "performance.md"
    original = (source / "docs/performance.md").read_text(encoding="utf-8")
    document.write_text(original, encoding="utf-8")
    published = run(results, "--document", document)
    require(published.returncode != 0 and "quick" in published.stderr, "a quick run is not published")
    require(document.read_text(encoding="utf-8") == original, "nor does it change the document")

    full = pathlib.Path(folder) / "full.json"
    full.write_text(json.dumps(data | {"quick": False}), encoding="utf-8")
    require(run(full, "--document", document).returncode == 0, "the document can be filled")
    text = document.read_text(encoding="utf-8")
    prose = lambda t: [part.split("<!-- end of table -->")[-1] for part in t.split("<!-- table:")]
    require(prose(text) == prose(original), "what lies outside the markers stays")
    require("sphere-10k" in text and "`hextree`" in text, "what was measured is in the tables")
    require(run(full, "--document", document).returncode == 0 and
            document.read_text(encoding="utf-8") == text, "the same results make the same document")

    full.write_text(json.dumps(data | {"disagreements": ["x finds another answer."]}), encoding="utf-8")
    require(run(full, "--check").returncode != 0, "strategies that disagree are refused")
