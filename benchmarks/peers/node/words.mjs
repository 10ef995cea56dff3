// A cloud in a rectangle by d3-cloud:
// {words: [[text, size], ...], width, height, font, family, runs, drawing, alone}
// to {words: [[text, size, x, y, degrees], ...], seconds}; x, y from the middle, on the baseline.
// The drawing is a PNG whose grey is "alone" where one word lies, and their sum where several do.
import { readFileSync, writeFileSync } from "node:fs";
import { createCanvas, GlobalFonts } from "@napi-rs/canvas";
import cloud from "d3-cloud";

const given = JSON.parse(readFileSync(0, "utf8"));
const { words, width, height, font, family, runs, drawing, alone } = given;
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

const picture = createCanvas(width, height);
const pen = picture.getContext("2d");
pen.fillStyle = "black";
pen.fillRect(0, 0, width, height);
pen.globalCompositeOperation = "lighter";
pen.fillStyle = `rgb(${alone}, ${alone}, ${alone})`;
pen.textAlign = "center";
for (const { text, size, x, y, rotate } of placed) {
  pen.save();
  pen.translate(width / 2 + x, height / 2 + y);
  pen.rotate((rotate * Math.PI) / 180);
  pen.font = `${size}px "${family}"`;
  pen.fillText(text, 0, 0);
  pen.restore();
}
writeFileSync(drawing, picture.toBuffer("image/png"));

const found = placed.map(({ text, size, x, y, rotate }) => [text, size, x, y, rotate]);
console.log(JSON.stringify({ words: found, seconds }));
