// Facts of the run: header, key figures, metrics, configuration, events.

import { clockText } from "replay/clock.js";
import { List, make } from "replay/list.js";

const PARTIAL = "partial, because the recording ends before the run";
const STAGES = ["execution", "planning"]; // the order of the key figures

export function fillHeader(run) {
  const { facts, world, count } = run;
  document.getElementById("title").textContent = world.name.replaceAll("_", " ");
  document.getElementById("subtitle").textContent = `${count} ${count === 1 ? "robot" : "robots"} · ${facts.planner}`;
  document.getElementById("run-id").textContent = facts.run_id.slice(0, 12);
  const status = document.getElementById("status");
  status.textContent = facts.status.replaceAll("_", " ");
  status.classList.toggle("good", facts.status === "succeeded");
  if (facts.error) status.title = `${facts.error.stage}: ${facts.error.message}`;
}

export function fillFigures(run) {
  const metrics = run.facts.metrics.filter(({ value }) => value != null);
  const chosen = STAGES.flatMap((stage) => metrics.filter(({ primary }) => primary === stage));
  document.getElementById("figures").append(
    ...chosen.map((metric) => {
      const figure = make("div", "figure", make("b", "", ...withUnit(metric)), make("span", "", `${label(metric)}${run.facts.partial ? " (partial)" : ""}`));
      figure.title = `${metric.name}: ${metric.text}${run.facts.partial ? `; ${PARTIAL}` : ""}`;
      return figure;
    }),
  );
}

export function fillAbout(run, { scans: thinning, trajectories, maps }) {
  const { facts } = run;
  const page = document.getElementById("about");
  if (facts.error) page.append(make("p", "error", `${facts.error.stage}: ${facts.error.message}`));
  if (facts.partial) page.append(make("p", "note", `The values of this run are ${PARTIAL}.`));
  page.append(section("choices", facts.choices.map(([name, value]) => [name, [value]]), true));
  for (const [title, metrics] of groups(facts.metrics)) {
    const rows = metrics.map((metric) => [metric.name.slice(title.length + 1).replaceAll("_", " "), withUnit(metric), metric.text]);
    page.append(section(title, rows, metrics.some(({ primary }) => primary)));
  }
  if (thinning && (thinning.beam_step > 1 || thinning.scan_step > 1)) {
    page.append(make("p", "note", `This page has one in ${thinning.scan_step} lidar scans, with one in ${thinning.beam_step} beams.`));
  }
  if (trajectories?.step > 1) page.append(make("p", "note", `This page has one in ${trajectories.step} recorded commands of controllers.`));
  if (maps?.step) page.append(make("p", "note", `This page has the maps of robots every ${maps.step} s.`));
  const configuration = make("pre", "", JSON.stringify(facts.config, null, 2));
  page.append(make("details", "", make("summary", "", "configuration"), configuration));
}

/** The name of a metric's column without the unit, which follows the value. */
function label({ name, unit }) {
  const words = name.slice(name.lastIndexOf(".") + 1);
  return (unit && words.endsWith(`_${unit}`) ? words.slice(0, -unit.length - 1) : words).replaceAll("_", " ");
}

/** Metrics by all but the last part of their name. */
function groups(metrics) {
  const found = new Map();
  for (const metric of metrics) {
    const title = metric.name.slice(0, metric.name.lastIndexOf("."));
    found.set(title, [...(found.get(title) ?? []), metric]);
  }
  return found;
}

function section(title, rows, open) {
  const list = make("dl");
  for (const [name, value, text] of rows) {
    const term = make("dt", "", name);
    if (text) term.title = text;
    list.append(term, make("dd", "", ...value));
  }
  const details = make("details", "", make("summary", "", title), list);
  details.open = open;
  return details;
}

function withUnit({ value, unit }) {
  if (value === null) return ["–"];
  if (typeof value === "boolean") return [value ? "yes" : "no"];
  if (typeof value !== "number") return [String(value)];
  if (unit === "B") return [`${(value / 2 ** 20).toPrecision(3)} `, make("small", "", "MiB")];
  if (unit === "s" && value !== 0 && Math.abs(value) < 0.1) return [`${(value * 1000).toPrecision(3)} `, make("small", "", "ms")];
  const text = Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(4)));
  return unit && unit !== "1" ? [`${text} `, make("small", "", unit)] : [text];
}

/** An event in one line. */
export function eventText(run, [time, kind, robot, detail]) {
  return [clockText(time), kind.replaceAll("_", " "), detail, run.names[robot]].filter(Boolean).join(" ");
}

export class EventPanel {
  constructor(run, choose) {
    this.run = run;
    const contacts = run.contacts.map(([first, last, robot, other]) => [first, "contact", robot, run.touchedName(other), last]);
    this.items = [...run.events, ...contacts].sort((left, right) => left[0] - right[0]);
    const fill = (button, item) => this.#fill(button, item);
    this.list = new List(document.getElementById("event-list"), 34, fill, choose, "No events were recorded.");
    this.list.show(this.items);
  }

  #fill(button, [time, kind, robot, detail]) {
    button.className = "event";
    button.dataset.kind = kind;
    const name = robot < 0 ? "" : this.run.names[robot];
    const what = [kind.replaceAll("_", " "), detail].filter(Boolean).join(": ");
    button.replaceChildren(make("time", "", clockText(time)), make("span", "what", what), make("span", "actor", name));
    button.classList.toggle("past", time <= this.run.now);
  }

  /** The first event after, or the last before, a time; undefined if there is none. */
  next(time, forward) {
    const away = (item) => (forward ? item[0] > time + 1e-3 : item[0] < time - 1e-3);
    return forward ? this.items.find(away) : this.items.findLast(away);
  }
}
