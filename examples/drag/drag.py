"""An owl is dragged through a full heart; all others make room, and close up behind it."""

from __future__ import annotations

import itertools

import numpy as np

import packwork as pw
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.placing import Move

BACKGROUND = "#fbf1de"
WAY = ((0.28, 0.25), (0.5, 0.42), (0.72, 0.25), (0.5, 0.72))
"""Corners of the drag, shares of the canvas."""

layout = pw.fill("heart", "icons", count=90, seed=4)
layout.save("before.png", background=BACKGROUND, pixels=500)

session = layout.edit(record=True)
(owl,) = session.find("owl#1")
session.scale("owl#1", 1.6)
session.settle()
poses, canvas = session.document.poses, layout.container
corners = [(float(poses.x[owl]), float(poses.y[owl]))]
corners += [(x * canvas.width, y * canvas.height) for x, y in WAY]

session.apply(Grab(items=(owl,)))
for begin, end in itertools.pairwise(corners):
    for share in np.linspace(0, 1, 25)[1:]:
        x, y = np.array(begin) + share * (np.array(end) - begin)
        session.apply(Move(item=owl, x=float(x), y=float(y)))
        session.flow(epochs=8)
    if end == corners[2]:
        session.layout.save("dragged.png", background=BACKGROUND, pixels=500)
session.apply(Drop())
found = session.settle()
session.polish(300)

made = session.layout
made.save("after.svg", background=BACKGROUND)
made.save("after.png", background=BACKGROUND, pixels=480)
made.save_film(
    "drag.svg", background=BACKGROUND, fps=12, seconds=6, film_pixels=420, easing="linear"
)
