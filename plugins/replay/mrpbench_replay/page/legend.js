// What colours and marks mean; only what occurs in the run.

import { make } from "replay/list.js";
import { drawMark, markOf, MARKS } from "replay/marks.js";
import { STATES } from "replay/run.js";

const SIZE = 12; // pixels of a mark

/** Fill the legend; returns a function that draws its marks in the colours of a theme. */
export function legend(run) {
  const box = document.getElementById("legend");
  for (const state of statesOf(run)) {
    const swatch = make("i");
    swatch.style.background = `var(--state-${STATES[state].replace(" ", "-")})`;
    box.append(make("span", "", swatch, STATES[state]));
  }
  const kinds = new Set([...run.events.map(([, kind]) => kind), ...(run.contacts.length ? ["contact"] : [])]);
  const marks = MARKS.filter((mark) => [...kinds].some((kind) => markOf(kind) === mark));
  const drawn = marks.flatMap((mark) => {
    const canvases = mark.kinds.map(() => Object.assign(make("canvas"), { width: 2 * SIZE, height: 2 * SIZE }));
    box.append(make("span", "", ...canvases, mark.text));
    return mark.kinds.map((kind, index) => [canvases[index].getContext("2d"), kind]);
  });
  return (theme) => {
    for (const [context, kind] of drawn) {
      context.setTransform(2, 0, 0, 2, 0, 0);
      context.clearRect(0, 0, SIZE, SIZE);
      drawMark(context, theme, kind, SIZE / 2);
    }
  };
}

function statesOf(run) {
  const seen = new Set();
  const every = Math.max(1, Math.floor((run.samples * run.count) / 200000));
  for (let robot = 0; robot < run.count; robot++) {
    for (let sample = 0; sample < run.samples; sample += every) seen.add(run.state(robot, sample));
  }
  return [...seen].sort();
}
