# SPDX-License-Identifier: MIT
"""That gnomon-peers draws and measures a scene by every peer that was built, that tables can be made of it, and that it
refuses what cannot be compared."""
import json
import pathlib
import subprocess
import sys
import tempfile

source, programs, output = map(pathlib.Path, sys.argv[1:4])
peers = sys.argv[4:]


def require(holds, claim):
    if not holds:
        sys.exit("not so: " + claim)


def run(program, *arguments):
    return subprocess.run([sys.executable, source / program, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


def measure(*arguments):
    return run("bench/peers/gnomon-peers", "--programs", programs, "--out", output / "peers.json", "--pictures", output,
               "--quick", "--size", "320x180", *arguments)


measured = measure("--peers", ",".join(peers), "--scenes", "room", "--motions", "lights")
require(measured.returncode == 0, "every peer draws the room: " + measured.stderr)
data = json.loads((output / "peers.json").read_text(encoding="utf-8"))
require([r["peer"] for r in data["rows"]] == peers, "each peer has its row")
for row, about in zip(data["rows"], data["peers"]):
    require(all(row["frame_ms"][k]["median"] > 0.0 for k in ("with", "without")), "frames take time")
    require(about["casters"] == 30 and about["lights"] == 2, "all draw the same scene")
    for kind in ("with", "without"):
        picture = output / f"room-{row['peer']}-{kind}.png"
        require(picture.read_bytes().startswith(b"\x89PNG"), f"{picture} is a picture")
for row in data["rows"]:
    if row["peer"] != "vk":
        require(row["dry_processor_ms"]["with"]["median"] > row["dry_processor_ms"]["without"]["median"] > 0.0,
                f"shadows cost the processor something in {row['peer']}")
if "gl" in peers and "vk" in peers:
    means = {a["peer"]: a["mean_with"] for a in data["peers"]}
    require(abs(means["gl"] - means["vk"]) < 0.5, "gnomon's backends draw the same")

refused = measure("--peers", peers[0], "--scenes", "nowhere")
require(refused.returncode != 0 and "nowhere" in refused.stderr, "a scene that is not there is refused")
require(run("scripts/performance-tables", "--peers", output / "peers.json", "--check").returncode == 0,
        "tables can be made of it")
with tempfile.TemporaryDirectory() as folder:
    document = pathlib.Path(folder) / "performance.md"
    original = (source / "docs/performance.md").read_text(encoding="utf-8")
    document.write_text(original, encoding="utf-8")
    published = run("scripts/performance-tables", "--peers", output / "peers.json", "--document", document)
    require(published.returncode != 0 and document.read_text(encoding="utf-8") == original,
            "a quick run is not published")
    full = pathlib.Path(folder) / "full.json"
    full.write_text(json.dumps(data | {"quick": False}), encoding="utf-8")
    published = run("scripts/performance-tables", "--peers", full, "--document", document)
    require(published.returncode == 0, "a full one is: " + published.stderr)
    text = document.read_text(encoding="utf-8")
    kept = lambda t: [p for p in t.split("<!-- table: ") if not p.startswith("peers-")]
    require(text != original and kept(text) == kept(original), "and changes the peers' tables alone")
