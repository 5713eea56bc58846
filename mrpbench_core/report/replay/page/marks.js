// The shapes of events on the time line and in the legend; only contacts have the colour of alarms.

/** Which mark an event gets, in the order in which marks are drawn. */
export const MARKS = [
  { name: "arrival", kinds: ["arrived"] },
  { name: "door", kinds: ["door_opens", "door_closes"] },
  { name: "lift", kinds: ["lift_leaves", "lift_arrives"] },
  { name: "other event", kinds: [] },
  { name: "contact", kinds: ["contact"] },
];
const OTHER = MARKS[3];

export function markOf(kind) {
  return MARKS.find(({ kinds }) => kinds.includes(kind)) ?? OTHER;
}

/** Draw a mark of 11 pixels height at a pixel: closing and leaving are hollow. */
export function drawMark(context, theme, kind, x, top = 0) {
  const { name } = markOf(kind);
  context.fillStyle = context.strokeStyle = { contact: theme.alarm, arrival: theme.muted }[name] ?? theme.ink;
  context.lineWidth = 1.25;
  const path = new Path2D();
  if (name === "arrival") path.rect(x - 0.75, top + 3, 1.5, 8);
  else if (name === "contact") path.rect(x - 1.5, top + 1, 3, 10);
  else if (name === "door") path.rect(x - 2.5, top + 3, 5, 6);
  else polygon(path, name === "lift" ? [[0, 2], [4, 9.5], [-4, 9.5]] : [[0, 1], [4, 6], [0, 11], [-4, 6]], x, top);
  if (kind === "door_closes" || kind === "lift_leaves") context.stroke(path);
  else context.fill(path);
}

function polygon(path, points, x, top) {
  points.forEach(([dx, dy], index) => path[index ? "lineTo" : "moveTo"](x + dx, top + dy));
  path.closePath();
}
