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
[the page of word clouds](benchmarks-words.md#the-peers-own-examples).

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
        "88c1b5e1",
        "Ours: the cat is there at a glance, tail and ears filled, the heaviest words where it is "
        "widest.",
    ),
    "a_new_hope": (
        "baec19b0",
        "Ours: the outline is closed and the greys read. The smallest words, of 4 to 5 px, are "
        "dust.",
    ),
    "colored": (
        "9bb3d5e7",
        "Ours: petals, stem and leaves keep their colours and edges; the peer's are pale.",
    ),
    "parrot": (
        "74fb405a",
        "Ours: bright where the peer's is mostly ground, and the wings' edges are there.",
    ),
    "wordcloud_cn": (
        "aec16c1c",
        "Ours: half as many words again, and the guitar's waist shows.",
    ),
    "single_word": (
        "2bff10ab",
        "**Undecided.** Our rows are strong, but the peer has half as many words again, and its "
        "disc is rounder: at our rim there are bays that no word of 4 px fills.",
    ),
    "simple": (
        "3a26d3b7",
        "Ours: the heaviest word is in the middle, sizes fall evenly, all but the smallest can "
        "be read. The words of 4 to 5 px between large letters cannot, in a face as black as "
        "ours.",
    ),
    "arabic": (
        "2aaf9359",
        "Ours, by a little: bays of large letters are used, and it is even. Much of it is dark "
        "blue and violet on black, as chance chose in both.",
    ),
    "emoji": (
        "925a41ea",
        "Ours: small words are half as large again and spread over all, where the peer has bare "
        "ground at the right and below. Half of ours is bare too: its heaviest entries are wide "
        "and hold the others down. The violet, which chance chose, is hard to read.",
    ),
    "colored_by_group": (
        "45eb9f40",
        "Ours: dense and legible, the heaviest word in the middle. The darkest greys all but "
        "vanish, by the example's own colours.",
    ),
    "frequency": (
        "e52ca6f3",
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
        return f'<img src="{one["file"]}" width="380" alt="{name} by {program}">'
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
