"""About sixty runs of every kind, and the hashes of all that they write.

Before a change that is to alter nothing, and after it::

    python tools/same_bytes.py keep before.json
    python tools/same_bytes.py compare before.json [NAME ...]

Runs are small; together they take a few minutes. Seconds are left out of what is hashed: they
are all that may differ between two runs of one recipe.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import os
import shlex
import shutil
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from packwork.cli import app

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"

INPUTS = {
    "jar.svg": "jar/jar.svg",
    "window.svg": "poster/window.svg",
    "poster.toml": "poster/recipe.toml",
    "coffee.csv": "chart-coffee/coffee.csv",
    "cup.svg": "chart-coffee/cup.svg",
    "nobel.csv": "chart-nobel/nobel-us.csv",
    "words.csv": "words-icons/words.csv",
    "arabic.ttf": "words-arabic/NotoNaskhArabic-Bold.ttf",
}
"""Files of the examples that runs read, by the name that they have there."""

SPEECH = """Bears eat honey, and bees make honey. A bee is small, a bear is large; the forest
is larger. Honey runs slowly, bees fly quickly, bears climb the old trees of the forest. """

ARABIC = "عسل 9\nدب 7\nغابة 5\nنحلة 4\nشجرة 3\nنهر 2\n"
HINDI = "शहद 9\nभालू 7\nजंगल 5\nमधुमक्खी 4\nपेड़ 3\n"

KILOGRAMS = "kg of coffee, 2019/20"
"""A column of the table of coffee."""

NO_FONT = "no font installed"
"""What a run says whose script no font of this machine has: it is left out, and said so."""

RUNS = {
    "fill": "fill heart -n 12 -o a.svg -o a.geojson -o a.dxf -o a.png --pixels 200",
    "fill-shared": "fill bear star moon -n 14 --sizes shared -o a.svg -o a.geojson",
    "fill-shared-free-turns": "fill usa icons -n 14 --sizes shared --rotate free -o a.geojson",
    "fill-fixed": "fill square cup.svg star -n 4 --sizes fixed --canvas 800 -o a.geojson",
    "fill-weights": "fill circle star moon heart -n 9 --weights shares.csv --sizes shared -o a.svg",
    "fill-distance-field": "fill cat -n 10 --start distance-field -o a.geojson",
    "fill-medial-axis": "fill cat -n 10 --start medial-axis -o a.geojson",
    "fill-scatter": "fill cat -n 10 --start scatter -o a.geojson",
    "fill-first-fit": "fill cat star -n 20 --sizes shared --start first-fit -o a.geojson",
    "fill-no-finish": "fill heart -n 10 --finish none -o a.geojson",
    "fill-best": "fill drop star moon -n 6 --effort best --epochs 300 -o a.geojson",
    "fill-paper": "fill circle -n 10 --preset paper -o a.geojson",
    "fill-mask": "fill mask.png -n 10 -o a.svg -o a.geojson",
    "fill-text": "fill 'text:AB|C' -n 16 -o a.svg -o a.geojson",
    "fill-text-arabic": "fill text:سلام --font arabic.ttf -n 10 -o a.geojson",
    "fill-parts": "fill islands -n 16 --apart -o a.geojson",
    "fill-padding": "fill heart -n 8 --canvas 80mm --padding 1mm -o a.dxf -o a.svg -o a.geojson",
    "fill-angles": "fill hexagon -n 8 --rotate 0,90 -o a.geojson",
    "fill-limited": "fill hexagon -n 8 --rotate 20 -o a.geojson",
    "fill-stretch": "fill heart -n 8 --stretch 1.5 -o a.geojson",
    "fill-gaps": "fill heart -n 8 --target-coverage 0.85 --max-items 40 -o a.geojson",
    "fill-filler": "fill heart -n 8 --target-coverage 0.85 --max-items 30 --filler star -o a.svg",
    "fill-hero": "fill heart -n 10 --hero owl@50%,45%=30% --palette okabe-ito -o a.svg",
    "fill-forces": "fill square star heart -n 12 --force 'balance horizontal' -o a.geojson",
    "fill-align": "fill circle star heart -n 12 --force 'align horizontal' -o a.geojson",
    "fill-holes": "fill square circle ring -n 6 --holes keep -o a.geojson",
    "fill-around": "fill around:photo0.png -n 8 -o a.svg",
    "fill-loss": "fill heart -n 8 --loss evenness=0 -o a.geojson",
    "fill-film": "fill heart -n 6 --film a.svg --film a.gif --fps 4 --seconds 1 --film-pixels 80",
    "fill-lottie": "fill heart star -n 4 --film a.json --seconds 1 -o a.geojson",
    "rules": "run poster.toml -o a.geojson",
    "words": "words heart speech.txt -n 14 -o a.svg -o a.geojson -o a.dxf",
    "words-live": "words heart speech.txt -n 8 --text live -o a.svg",
    "words-mixed": "words circle words.csv -n 14 --rotate mixed --color-by weight -o a.svg",
    "words-free": "words cat words.csv -n 10 --sizes free -o a.geojson",
    "words-levels": "words cat words.csv -n 10 --start distance-field -o a.geojson",
    "words-add": "words apple words.csv -n 10 --add star --add bird --rotate 15 -o a.svg",
    "words-arabic": "words circle arabic.txt -o a.svg",
    "words-hindi": "words circle hindi.txt -o a.svg",
    "words-photos": "words square words.csv -n 8 --photos photo1.png "
    "--share words=60%,photos=40% -o a.svg",
    "photos": "photos moon photo0.png photo1.png photo2.png -n 8 --rotate 15 -o a.svg -o a.geojson",
    "photos-cut": "photos circle photo0.png photo1.png --shape circle --border 4% -o a.png",
    "chart": f"chart circle coffee.csv --size-by '{KILOGRAMS}' --label-by country -o a.svg",
    "chart-units": "chart heart units.csv --size-by n --unit 2 --color-by name -o a.geojson",
    "chart-grouped": "chart circle units.csv --size-by n --by kind -o a.svg -o a.geojson",
    "chart-bars": "chart none nobel.csv --by year --by-step 40 --color-by category -o a.geojson",
    "pile": "pile square star moon -n 12 --size 14% --open top -o a.svg -o a.geojson",
    "pile-jar": "pile jar.svg -n 10 --size 12% --emit top --release 2 -o a.geojson",
    "pile-round": "pile none circle -n 12 --force 'towards centre' --compact -o a.geojson",
    "stay": "fill heart -n 13 --start FIRST --stay -o a.geojson",
    "edited": "fill heart -n 12 --start FIRST -o a.geojson",
    "fill-alone": "fill cat star -n 1 --rotate free -o a.geojson",
    "fill-even-lines": "fill heart cup.svg icons -n 8 --stroke-width even -o a.geojson",
    "fill-even-and-far": "fill square -n 6 --padding 6% --stroke-width even -o a.geojson",
    "fill-regions": "run regions.toml -o a.geojson",
    "fill-apart-gaps": "fill heart -n 8 --apart --target-coverage 0.8 --max-items 20 -o a.geojson",
    "fill-colour-rule": "run colour.toml -o a.geojson",
    "words-smallest": "words heart words.csv -n 14 --smallest 4% --film a.svg -o a.geojson",
    "words-largest": "words cat words.csv -n 8 --largest 9% -o a.geojson",
    "photos-starts": "photos moon photo0.png photo1.png -n 7 -o a.geojson",
    "photos-cut-film": "photos heart photo0.png -n 6 --edge crop --film a.svg -o a.geojson",
    "chart-film": "chart circle units.csv --size-by n --by kind --film a.svg -o a.geojson",
    "pile-film": "pile square star -n 6 --size 15% --film a.svg --seconds 1 -o a.geojson",
    "stay-film": "fill heart -n 13 --start FIRST --stay --film a.svg --seconds 1 -o a.geojson",
    "stay-elsewhere": "fill cat -n 12 --start FIRST --stay --force down -o a.geojson",
}
"""Command lines. FIRST: what ``fill`` wrote as GeoJSON."""

CHEAP = "--effort draft -q"


def made_inputs(folder: Path) -> None:
    """Write what runs read, by formula, into a folder."""
    for name, source in INPUTS.items():
        shutil.copy(EXAMPLES / source, folder / name)
    (folder / "speech.txt").write_text(SPEECH, encoding="utf-8")
    (folder / "arabic.txt").write_text(ARABIC, encoding="utf-8")
    (folder / "hindi.txt").write_text(HINDI, encoding="utf-8")
    rule = 'container = "cat"\nitems = ["star", "moon"]\ncount = 9\nsizes = "{}"\n[[rules]]\n{}\n'
    colour = rule.format("shared", 'items = "star"\ncolor = "red"')
    (folder / "colour.toml").write_text(colour, encoding="utf-8")
    region = rule.format("free", 'items = "star"\ncount = 3\nregion = [0, 0, "100%", "50%"]')
    (folder / "regions.toml").write_text(region, encoding="utf-8")
    (folder / "shares.csv").write_text("star,3\nmoon,2\nheart,1\n", encoding="utf-8")
    table = "name,n,kind\n" + "".join(f"{'abcd'[k % 4]},{k + 3},{'xy'[k % 2]}\n" for k in range(8))
    (folder / "units.csv").write_text(table, encoding="utf-8")
    y, x = np.mgrid[0:90, 0:120]
    Image.fromarray(((x - 60) ** 2 + (1.5 * (y - 45)) ** 2 > 3400).astype(np.uint8) * 255).save(
        folder / "mask.png"
    )
    for k in range(3):
        red = 120 + 90 * np.sin((k + 2) * x / 23) * np.exp(-((y - 45) ** 2) / 400)
        image = np.stack([red, 90 + y, 30 * k + 0 * x], axis=-1)
        Image.fromarray(image.astype(np.uint8)).save(folder / f"photo{k}.png")


def hashes(names: Sequence[str]) -> dict[str, dict[str, str]]:
    """Exit code and hash of each file that each run writes, by the run's name."""
    found: dict[str, dict[str, str]] = {}
    with tempfile.TemporaryDirectory() as place:
        inputs = Path(place, "inputs")
        inputs.mkdir()
        made_inputs(inputs)
        for name in names:
            found[name] = _one(name, inputs, Path(place, name))
            sys.stdout.write(" ".join([name, *found[name].values()]) + "\n")
            sys.stdout.flush()
    return found


def _one(name: str, inputs: Path, folder: Path) -> dict[str, str]:
    shutil.copytree(inputs, folder)
    before = set(folder.iterdir())
    first = folder.parent / "fill" / "a.geojson"
    cheap = CHEAP.replace("--effort draft", "") if "pile" in name else CHEAP
    if name in ("fill-best", "photos-starts") or RUNS[name].startswith("run "):
        cheap = cheap.replace("--effort draft", "")
    words = shlex.split(f"{RUNS[name]} {cheap}".replace("FIRST", "first.geojson"))
    if "FIRST" in RUNS[name]:
        if not first.exists():
            _one("fill", inputs, first.parent)
        shutil.copy(first, folder / "first.geojson")
        before.add(folder / "first.geojson")
    told = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stderr(told):
        try:
            code = app(words, standalone_mode=False) or 0
        except SystemExit as ending:
            code = ending.code
    if code == 2 and NO_FONT in told.getvalue():
        return {"left out": NO_FONT}
    if code == 2:
        sys.exit(f"{name}: {told.getvalue().strip()}")
    made = sorted(set(folder.iterdir()) - before)
    return {"exit": str(code)} | {p.name: _hash(p) for p in made}


def _hash(path: Path) -> str:
    data = path.read_bytes()
    if path.suffix == ".geojson":
        data = json.dumps(_timeless(json.loads(data)), sort_keys=True).encode()
    return hashlib.sha256(data).hexdigest()[:16]


def _timeless(value: Any) -> Any:
    """JSON without its seconds and the versions of what made it."""
    if isinstance(value, dict):
        left_out = ("seconds", "versions", "version", "machine")
        return {key: _timeless(each) for key, each in value.items() if key not in left_out}
    return [_timeless(each) for each in value] if isinstance(value, list) else value


def main() -> None:
    """Keep hashes in a file, or compare those of now with a file's."""
    if len(sys.argv) < 3 or sys.argv[1] not in ("keep", "compare"):
        sys.exit(__doc__)
    os.environ["COLUMNS"] = "100"
    path, names = Path(sys.argv[2]), sys.argv[3:] or list(RUNS)
    adds = sys.argv[1] == "keep" and sys.argv[3:] and path.exists()
    kept = json.loads(path.read_text(encoding="utf-8")) if sys.argv[1] == "compare" or adds else {}
    found = hashes(names)
    if sys.argv[1] == "keep":
        path.write_text(json.dumps(kept | found, indent=1), encoding="utf-8")
        return
    unlike = [name for name in names if found[name] != kept.get(name)]
    for name in unlike:
        sys.stdout.write(f"{name}: {kept.get(name)} became {found[name]}\n")
    sys.exit(f"{len(unlike)} of {len(names)} runs differ" if unlike else 0)


if __name__ == "__main__":
    main()
