// The controls over the map and the tabs beside it.

import { make } from "replay/list.js";

/** Check boxes for the layers, and the choice of colours. */
export function layerControls(shown) {
  const box = document.getElementById("layers");
  const inputs = shown.offered.map(({ key, label, letter }) => {
    const input = make("input");
    input.type = "checkbox";
    input.id = `layer-${key}`;
    input.addEventListener("change", () => shown.setLayer(key, input.checked));
    const chip = make("label", "chip", input, make("i", key), make("span", "", label));
    chip.title = `${label} on or off (${letter.toUpperCase()})`;
    box.append(chip);
    return [key, input];
  });
  const colour = make("select");
  colour.id = "colour";
  colour.append(new Option("by robot", "robot"), new Option("by state", "state"));
  colour.addEventListener("change", () => shown.set({ colour: colour.value }));
  box.append(make("label", "chip", make("span", "", "Colour"), colour));
  const refresh = () => {
    for (const [key, input] of inputs) input.checked = shown.layers[key];
    colour.value = shown.colour;
  };
  shown.addEventListener("change", refresh);
  refresh();
}

/** Buttons for the levels of a building that has several, with the number of robots there; what is returned counts them. */
export function levelControls(run, shown) {
  const box = document.getElementById("levels");
  const names = run.world.levels.map((_, level) => run.levelName(level));
  box.hidden = names.length < 2;
  const buttons = names.map((name, level) => {
    const button = make("button", "", name);
    button.type = "button";
    button.addEventListener("click", () => shown.set({ level, follow: false }));
    return button;
  });
  box.append(...buttons.reverse());
  const refresh = () => {
    const robots = new Array(names.length).fill(0);
    for (let robot = 0; robot < run.count; robot++) robots[run.value("level", robot, 0)]++;
    buttons.toReversed().forEach((button, level) => {
      const text = `${names[level]} · ${robots[level]}`;
      if (button.textContent !== text) button.textContent = text;
      button.title = `Show level ${names[level]}, ${robots[level]} robots`;
      button.setAttribute("aria-pressed", String(level === shown.level));
    });
  };
  if (box.hidden) return () => {};
  shown.addEventListener("change", refresh);
  refresh();
  return refresh;
}

export function tabs(changed) {
  const all = [...document.querySelectorAll("[role=tab]:not([hidden])")];
  const choose = (chosen) => {
    for (const tab of all) {
      const open = tab === chosen;
      tab.setAttribute("aria-selected", String(open));
      tab.tabIndex = open ? 0 : -1;
      document.getElementById(tab.getAttribute("aria-controls")).hidden = !open;
    }
    changed();
  };
  for (const tab of all) {
    tab.addEventListener("click", () => choose(tab));
    tab.addEventListener("keydown", (event) => {
      const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!by) return;
      event.stopPropagation();
      event.preventDefault();
      const next = all[(all.indexOf(tab) + by + all.length) % all.length];
      next.focus();
      choose(next);
    });
  }
  choose(all[0]);
  return (id) => choose(document.getElementById(id));
}
