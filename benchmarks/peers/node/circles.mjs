// Circles round each other by d3-hierarchy: {radii, runs} to {circles: [[x, y, r], ...], seconds}.
import { readFileSync } from "node:fs";
import { packSiblings } from "d3-hierarchy";

const { radii, runs } = JSON.parse(readFileSync(0, "utf8"));
const seconds = [];
let circles = [];
for (let run = 0; run <= runs; run++) {
  circles = radii.map((r) => ({ r }));
  const began = process.cpuUsage();
  packSiblings(circles);
  const used = process.cpuUsage(began);
  if (run > 0) seconds.push((used.user + used.system) / 1e6);
}
console.log(JSON.stringify({ circles: circles.map(({ x, y, r }) => [x, y, r]), seconds }));
