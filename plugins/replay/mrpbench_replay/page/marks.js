// The shapes of events on the time axis and in the legend; only contacts have the colour of alarms.

/** Which mark an event gets, in the order in which marks are drawn; those of one row lie on one line of the time axis. */
export const MARKS = [
  { name: "door", row: 0, kinds: ["door_opens", "door_closes"], text: "door opens, closes" },
  { name: "lift", row: 1, kinds: ["lift_arrives", "lift_leaves"], text: "lift arrives, leaves" },
  { name: "arrival", row: 2, kinds: ["arrived"], text: "arrival" },
  { name: "other", row: 2, kinds: [""], text: "other event" },
  { name: "recovery", row: 2, kinds: ["recovery", "recovery_failed"], text: "recovery, failed" },
  { name: "plan", row: 2, kinds: ["replan", "replan_failed"], text: "new plan, none found" },
  { name: "switch", row: 2, kinds: ["switch"], text: "switched order" },
  { name: "fault", row: 2, kinds: ["fault", "fault_over"], text: "fault, its end" },
  { name: "contact", row: 2, kinds: ["contact"], text: "contact" },
];
export const ROW = 12; // pixels of a row of marks
const OTHER = MARKS.find(({ name }) => name === "other");
const POLYGONS = {
  lift: [[0, 2], [4, 9.5], [-4, 9.5]],
  recovery: [[0, 1], [4, 6], [0, 11], [-4, 6]],
  fault: [[-4, 2], [4, 2], [0, 10]],
  switch: [[-4, 2], [4, 10], [4, 2], [-4, 10]],
  plan: [[-3, 1], [4, 6], [-3, 11]],
};

export function markOf(kind) {
  return MARKS.find(({ kinds }) => kinds.includes(kind)) ?? OTHER;
}

/** Draw a mark of 11 pixels height at a pixel: the second kind of a mark is hollow. */
export function drawMark(context, theme, kind, x, top = 0) {
  const { name, kinds } = markOf(kind);
  context.fillStyle = context.strokeStyle = { contact: theme.alarm, arrival: theme.muted }[name] ?? theme.ink;
  context.lineWidth = 1.25;
  const path = new Path2D();
  if (name === "arrival") path.rect(x - 0.75, top + 3, 1.5, 8);
  else if (name === "contact") path.rect(x - 1.5, top + 1, 3, 10);
  else if (name === "door") path.rect(x - 2.5, top + 3, 5, 6);
  else if (name === "other") path.arc(x, top + 6, 2, 0, 2 * Math.PI);
  else polygon(path, POLYGONS[name], x, top);
  if (kind === kinds[1]) context.stroke(path);
  else context.fill(path);
}

function polygon(path, points, x, top) {
  points.forEach(([dx, dy], index) => path[index ? "lineTo" : "moveTo"](x + dx, top + dy));
  path.closePath();
}
