"""docs/words-pairs.md, of its manifest."""

from __future__ import annotations

import textwrap

from benchmarks.kit.manifests import Manifest

NAME, FILE = "words-pairs", "words-pairs.md"
LINE = 100

PAGE = """# Words: eleven pairs

Made by `{command}` on {date}.
{machine}; wordcloud {peer}.

The examples of the `wordcloud` package, from its source distribution and unchanged, run once with
that package and once with `packwork.wordcloud` under its name; in six of them a picture of ours
[stands in](#sources) for one that may not be published. **Left the peer's picture, right ours.**
Most examples give no seed, so each run draws another picture; these are of one run, not the best of
several. Where an example gives no font, each package takes its default: the peer a thin one of
fixed width, ours a black one. How long each took, and all figures, are on
[the page of word clouds](words.md#the-peers-own-examples).

Under each pair stands whether we would choose ours, and if not, why; by eye.

{pairs}

## Sources

The examples' code is of the peer's source distribution (MIT), and so are the texts, by many hands,
of which the pictures show single words; no file of it is in this repository. Six examples take the
shape or the colours of a picture by others: two stencils and a drawing "taken from" websites, a
photograph, and an ink painting whose licence allows study alone. No licence that we know of lets us
publish what is made of these. For them the same programs ran with pictures of ours of the same
size in their place, as said at each; the verdicts are of what is shown here. The command also draws
the eleven as they come, for looking at, into `build/words-pairs`.
"""

PAIR = """## {name}

{stand_in}| wordcloud | packwork |
| :---: | :---: |
| {peer} | {ours} |

{figures}

{verdict}"""

VERDICTS = {
    "masked": (
        "0d27d3da",
        "Ours: the cat is there at a glance, ears and tail filled, the heaviest word where it "
        "is widest. In the peer's it stands on end and is as light as its neighbours.",
    ),
    "a_new_hope": (
        "c7ca6ced",
        "Ours: the outline is closed, the two heaviest words fill the body and the greys read. "
        "The smallest words, of 4 to 5 px, are dust.",
    ),
    "colored": (
        "8638d912",
        "Ours: petals, stem and leaves keep their colours and edges; the peer's are pale. "
        "Beside its heaviest word many are of one size, by the example's own 40 px at most.",
    ),
    "parrot": (
        "c5b40f7e",
        "Ours: bright where the peer's is mostly ground, and the wings' edges are there. Both "
        "lose the feelers.",
    ),
    "wordcloud_cn": (
        "5ba76f3c",
        "Ours: more than half as many words again, and the guitar's waist and neck show.",
    ),
    "single_word": (
        "8fa88d29",
        "Ours: strong rows, and no two large words beside each other look alike, where the peer "
        "has pale yellow on white. The peer has half as many words again; at our rim are steps "
        "that no word of 4 px fills.",
    ),
    "simple": (
        "b4ce0431",
        "Ours: the heaviest word is in the middle and stands out, all but the smallest can be "
        "read, and none is lost against the ground. The words of 4 to 5 px between large "
        "letters cannot be read, in a face as black as ours.",
    ),
    "arabic": (
        "a9c2d69c",
        "Ours: the heaviest words lie in each other's bays, small ones in theirs, and what is "
        "bare is even; the peer's violet is hard to read.",
    ),
    "emoji": (
        "41191ebb",
        "Ours: the faces are what is seen first, small words lie in them and beside them, all "
        "can be read. About as much of it is bare as of the peer's: most of the example's 72 "
        "entries are of one low frequency, and stay small.",
    ),
    "colored_by_group": (
        "4b7e4d58",
        "Ours: dense and legible, the heaviest word in the middle. The darkest greys all but "
        "vanish, by the example's own colours, in both.",
    ),
    "frequency": (
        "f57eeacd",
        "Only ours runs. The example cuts its text at blanks alone, so words hold line breaks, "
        "which Pillow does not measure for the peer.",
    ),
}
"""By example: how the SHA-256 of our picture begins that was judged, and which of the two we would
choose, and why not ours. To be written again with the pictures."""

NOT_SAID = "Not judged yet."
EARLIER = "(Said of an earlier run's pictures.)"


def page(manifest: Manifest) -> str:
    """All pairs, in the order in which they were made."""
    return PAGE.format(
        command=manifest["command"], date=manifest["date"], machine=manifest["machine"],
        peer=manifest["peer"],
        pairs="\n\n".join(_pair(name, one) for name, one in manifest["pairs"].items()),
    )  # fmt: skip


def _pair(name: str, one: Manifest) -> str:
    programs = one["programs"]
    stand_in = one["stands_in_for"]
    return PAIR.format(
        name=name,
        stand_in=f"With a picture of ours in place of `{stand_in}`.\n\n" if stand_in else "",
        peer=_picture(name, "wordcloud", programs["wordcloud"]),
        ours=_picture(name, "packwork", programs["packwork"]),
        figures=_figures(programs),
        verdict=verdict(name, programs["packwork"].get("sha256", "")),
    )


def verdict(name: str, sha256: str) -> str:
    """What was said of a pair, and whether of these pictures."""
    judged, text = VERDICTS.get(name, (sha256, NOT_SAID))
    return textwrap.fill(text if sha256.startswith(judged) else f"{text} {EARLIER}", LINE)


def _picture(name: str, program: str, one: Manifest) -> str:
    if "file" in one:
        return f'<img src="../{one["file"]}" width="380" alt="{name} by {program}">'
    if "lacks" in one:
        return f"not run: lacks {one['lacks']}"
    return f"stops with `{one.get('fails', 'no picture')}`"


def _figures(programs: Manifest) -> str:
    """Words, sizes and ink of those that drew something."""
    return " ".join(
        f"{program}: {cloud['words']} words, largest over median "
        f"{cloud['largest'] / cloud['median']:.1f}, ink {cloud['ink']:.2f}."
        for program, one in programs.items()
        for cloud in one.get("clouds", [])[:1]
    )
