// The keyboard, and the dialog that explains it.

import { make } from "replay/list.js";
import { LAYERS } from "replay/shown.js";

const HELP = [
  ["space", "play or pause"],
  ["← →", "one sample back or forth"],
  ["page up, page down", "10 s back or forth"],
  ["home, end", "start or end"],
  ["[ ]", "slower, faster"],
  [", .", "previous or next event"],
  ["/", "find a robot"],
  ["J K", "next or previous robot"],
  ["esc", "let go of the robot"],
  ["+ − F", "zoom in, zoom out, show everything"],
  ["shift + arrows", "move the map"],
  ["C", "colour by robot or by state"],
  ...LAYERS.map(({ label, letter }) => [letter.toUpperCase(), `${label.toLowerCase()} on or off`]),
  ["T", "light or dark"],
  ["wheel, pinch; drag", "zoom; move the map"],
  ["click a robot", "follow it"],
];

const MEANING = [
  ["dotted line, ring", "the plan in force, and the goal"],
  ["thin line", "the way driven so far"],
  ["wide band", "reserved: released by the dispatcher and not reached yet"],
  ["arrow", "from a robot that waits to the robot, door or lift that it waits for"],
  ["square; filled", "a task that waits, with its age; one that a robot carries"],
  ["cells", "in a robot's own map: pale = free, full = occupied"],
  ["rim", "tells robots of one colour apart"],
  ["pale bar", "in the Gantt chart: the plan in force, above the execution; a dashed line is a new plan"],
];

export function listenToKeys(actions) {
  let pointing = false; // the control in focus was pressed with a pointer, so it does not need the keys
  const release = () => {
    if (pointing && document.activeElement.matches("button, select, summary, input:not([type=search])")) document.activeElement.blur();
  };
  document.addEventListener("pointerdown", () => (pointing = true), true);
  document.addEventListener("click", (event) => event.target.closest("select") || release());
  document.addEventListener("change", release);
  document.addEventListener("keydown", (event) => {
    if (event.key === "Tab") pointing = false;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const typing = event.target.matches("input[type=search]") || (event.target.matches("select") && !pointing);
    const pressing = event.target.matches("button, summary, [role=tab], input[type=checkbox]");
    if (event.key === "Escape") actions.escape(event.target);
    else if (typing || document.querySelector("dialog[open]")) return;
    else if (event.key === " " && pressing) return;
    else {
      const name = event.shiftKey && event.key.startsWith("Arrow") ? `shift ${event.key}` : event.key.length === 1 ? event.key.toLowerCase() : event.key;
      const action = actions[name];
      if (!action) return;
      event.preventDefault();
      action();
    }
  });
}

export function helpDialog() {
  const dialog = document.getElementById("keys");
  const list = (rows) => make("dl", "", ...rows.flatMap(([name, text]) => [make("dt", "", make("kbd", "", name)), make("dd", "", text)]));
  const close = make("button", "", "Close");
  close.type = "button";
  close.addEventListener("click", () => dialog.close());
  const least = "Robots are drawn in their true size, but never so small that they cannot be seen.";
  const marks = make("section", "", make("h2", "", "Marks"), list(MEANING), make("p", "note", least), close);
  dialog.append(make("div", "", marks, make("section", "", make("h2", "", "Keyboard and mouse"), list(HELP))));
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  return dialog;
}
