// Shapes of given sizes in a disc, none over another, by Penrose:
// {rings: [[[x, y], ...], ...] or radii, room, seed} to {places: [[x, y], ...], seconds, compiled}.
// Rings are convex, round the origin; they are moved, not turned.
import { readFileSync } from "node:fs";
import { compile, optimize, showError } from "@penrose/core";
import { JSDOM } from "jsdom";

// It looks for a browser to set labels in; there are none here.
globalThis.window = new JSDOM("").window;
globalThis.document = window.document;

const { rings, radii, room, seed } = JSON.parse(readFileSync(0, "utf8"));
const count = (rings ?? radii).length;
const names = [...Array(count).keys()].map((k) => `d${k}`);
const side = (2.2 * room).toFixed(3);
const number = (value) => value.toFixed(4);
const corner = (k) => ([x, y]) => `(\`d${k}\`.x + ${number(x)}, \`d${k}\`.y + ${number(y)})`;
const shape = (k) =>
  rings === undefined
    ? `Circle { r: ${number(radii[k])} center: (\`d${k}\`.x, \`d${k}\`.y) }`
    : `Polygon { points: [${rings[k].map(corner(k)).join(", ")}] }`;
const item = (name, k) => `forall Disc \`${name}\` {
  \`${name}\`.x = ?
  \`${name}\`.y = ?
  \`${name}\`.icon = ${shape(k).replace("{ ", "{\n    ").replace(" center", "\n    center").replace(" }", "\n  }")}
}`;
const style = `
canvas {
  width = ${side}
  height = ${side}
}
container {
  shape room = Circle {
    center: (0, 0)
    r: ${number(room)}
  }
}
${names.map(item).join("\n")}
forall Disc d {
  ensure contains(container.room, d.icon)
}
forall Disc a; Disc b {
  ensure disjoint(a.icon, b.icon)
}
`;

const began = process.cpuUsage();
const spent = () => {
  const used = process.cpuUsage(began);
  return (used.user + used.system) / 1e6;
};
const made = await compile({
  domain: "type Disc",
  substance: names.map((name) => `Disc ${name}`).join("\n"),
  style,
  variation: `seed-${seed}`,
});
if (made.isErr()) throw new Error(showError(made.error));
const compiled = spent();
const done = optimize(made.value);
if (done.isErr()) throw new Error(showError(done.error));
const seconds = spent();
const { computeShapes, varyingValues } = done.value;
const place = (drawn, k) => {
  if (rings === undefined) return drawn.center.contents;
  const [x, y] = drawn.points.contents[0];
  return [x - rings[k][0][0], y - rings[k][0][1]];
};
const places = computeShapes(varyingValues).slice(1).map(place);
console.log(JSON.stringify({ places, seconds: [seconds], compiled }));
