# SPDX-License-Identifier: MIT
"""That gnomon-savings measures a scene with and without each saving, that what is left out costs fragments, and that tables
are made of it, but none for publication of a quick run."""
import json
import pathlib
import subprocess
import sys
import tempfile

source, program, output = map(pathlib.Path, sys.argv[1:4])
results = output / "savings.json"


def require(holds, claim):
    if not holds:
        sys.exit("not so: " + claim)


def run(script, *arguments):
    return subprocess.run([sys.executable, source / script, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


measured = run("bench/savings/gnomon-savings", "--program", program, "--out", results, "--work", output, "--quick", "--size",
               "320x180")
require(measured.returncode == 0, "the room is measured: " + measured.stderr)
data = json.loads(results.read_text(encoding="utf-8"))
fragments = {r["without"]: r["fragments"] for r in data["rows"]}
require({"nothing", "clamp", "scissor", "depth-pass", "all"} <= set(fragments), "each saving has its row")
with_slabs = fragments.pop("nothing, with slabs")
require(0 < with_slabs <= fragments["nothing"], "slabs cost no fragments")
require(all(f >= fragments["nothing"] > 0 for f in fragments.values()), "no saving costs fragments")
require(fragments["clamp"] > 1.5 * fragments["nothing"], "in a room clamping saves fragments")
require(fragments["all"] == max(fragments.values()), "nothing costs more than to do without all of them")

with tempfile.TemporaryDirectory() as folder:
    document = pathlib.Path(folder) / "performance.md"
    original = (source / "docs/performance.md").read_text(encoding="utf-8")
    document.write_text(original, encoding="utf-8")
    published = run("scripts/performance-tables", "--savings", results, "--document", document)
    require(published.returncode != 0 and document.read_text(encoding="utf-8") == original, "a quick run is not published")
    full = pathlib.Path(folder) / "full.json"
    full.write_text(json.dumps(data | {"quick": False}), encoding="utf-8")
    published = run("scripts/performance-tables", "--savings", full, "--document", document)
    require(published.returncode == 0, "a full one is: " + published.stderr)
    kept = lambda t: [p for p in t.split("<!-- table: ") if not p.startswith("savings-")]
    text = document.read_text(encoding="utf-8")
    require(text != original and kept(text) == kept(original), "and changes its own tables alone")
    fill = text.split("<!-- table: savings-fill -->")[1].split("<!-- end of table -->")[0]
    require(fill.strip().splitlines()[0].endswith("| without all | with slabs |"), "slabs have a column of their own")
    frames = text.split("<!-- table: savings-frames -->")[1].split("<!-- end of table -->")[0].strip().splitlines()
    require(len(frames) == 3 and frames[2].startswith("| room |") and "×" in frames[2], "the room's frames are timed")
