// A cloud in a rectangle by d3-cloud:
// {words: [[text, size], ...], width, height, font, family, runs}
// to {words: [[text, size, x, y, degrees], ...], seconds}; x, y from the middle, on the baseline.
import { readFileSync } from "node:fs";
import { createCanvas, GlobalFonts } from "@napi-rs/canvas";
import cloud from "d3-cloud";

const { words, width, height, font, family, runs } = JSON.parse(readFileSync(0, "utf8"));
GlobalFonts.registerFromPath(font, family);

// Its own choice of angles is at random; one word in four upright, by a seed, as ours.
function generator(seed) {
  let state = seed + 1;
  return () => (state = (state * 16807) % 2147483647) / 2147483647;
}

function place(seed) {
  const random = generator(seed);
  return new Promise((resolve) => {
    cloud()
      .canvas(() => createCanvas(1, 1))
      .size([width, height])
      .words(words.map(([text, size]) => ({ text, size })))
      .font(family)
      .fontSize((word) => word.size)
      .padding(0)
      .rotate(() => (random() < 0.25 ? 90 : 0))
      .random(random)
      .on("end", resolve)
      .start();
  });
}

const seconds = [];
let placed = [];
for (let run = 0; run <= runs; run++) {
  const began = process.cpuUsage();
  placed = await place(0);
  const used = process.cpuUsage(began);
  if (run > 0) seconds.push((used.user + used.system) / 1e6);
}
const found = placed.map(({ text, size, x, y, rotate }) => [text, size, x, y, rotate]);
console.log(JSON.stringify({ words: found, seconds }));
