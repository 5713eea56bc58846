// The list of robots, the search, and the card of the chosen one.

import { List, make } from "replay/list.js";
import { STATES } from "replay/run.js";

export class FleetPanel {
  /** `colours()` tells which colour each robot has now. */
  constructor(run, shown, colours) {
    this.run = run;
    this.shown = shown;
    this.colours = colours;
    this.card = document.getElementById("card");
    this.search = document.getElementById("search");
    this.list = new List(
      document.getElementById("robot-list"),
      34,
      (button, robot) => this.#fillRow(button, robot),
      (robot) => shown.select(robot === shown.selected ? -1 : robot),
      "No robot has this name.",
    );
    this.search.addEventListener("input", () => this.#filter());
    this.search.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && this.list.items.length) shown.select(this.list.items[0]);
    });
    this.#buildCard();
    this.#filter();
  }

  /** A number finds the robot of that number first, then the robots with a name that contains it. */
  #filter() {
    const wanted = this.search.value.trim().toLowerCase();
    const found = this.run.names.map((_, robot) => robot).filter((robot) => this.run.names[robot].toLowerCase().includes(wanted));
    const exact = /^\d+$/.test(wanted) ? Number(wanted) : -1;
    if (found.includes(exact)) found.unshift(...found.splice(found.indexOf(exact), 1));
    this.list.show(found);
  }

  #fillRow(button, robot) {
    const { run, shown } = this;
    if (!button.firstChild) {
      button.className = "robot";
      button.parts = ["swatch", "name", "state", "speed", "bar"].map((name) => button.appendChild(make("span", name)));
      button.fill = button.parts[4].appendChild(make("i"));
    }
    const [swatch, name, state, speed] = button.parts;
    const segments = run.segments(robot);
    const share = segments ? run.value("reached", robot, 0) / segments : 1;
    setText(name, run.names[robot]);
    const level = run.world.levels.length > 1 ? `${run.levelName(run.value("level", robot, 0))} · ` : "";
    const why = run.why.text(robot);
    setText(state, `${level}${why || STATES[run.state(robot)]}`);
    state.title = why;
    setText(speed, why ? "" : `${run.speed(robot).toFixed(2)} m/s`);
    const colours = this.colours();
    swatch.style.background = colours.palette[colours.of(robot)];
    swatch.dataset.rim = colours.rim(robot);
    state.dataset.state = run.state(robot);
    button.fill.style.transform = `scaleX(${share})`;
    button.setAttribute("aria-pressed", String(robot === shown.selected));
  }

  #buildCard() {
    const { shown } = this;
    this.title = make("strong");
    this.followButton = make("button", "follow", "Follow");
    this.followButton.type = "button";
    this.followButton.addEventListener("click", () => shown.set({ follow: !shown.follow }));
    const close = make("button", "quiet", "×");
    close.type = "button";
    close.setAttribute("aria-label", "Deselect the robot");
    close.addEventListener("click", () => shown.select(-1));
    this.values = make("dl");
    this.cells = Object.fromEntries(
      ["state", "why", "level", "speed", "segments", "reserved", "pose", "goal", "model"].map((key) => {
        const value = make("dd");
        this.values.append(make("dt", "", key), value);
        return [key, value];
      }),
    );
    this.card.append(make("div", "head", this.title, this.followButton, close), this.values);
  }

  #fillCard(robot) {
    const { run, cells } = this;
    const reached = run.value("reached", robot, 0);
    const released = run.value("released", robot, reached);
    setText(this.title, run.names[robot]);
    this.followButton.setAttribute("aria-pressed", String(this.shown.follow));
    setText(cells.state, STATES[run.state(robot)]);
    setText(cells.why, run.why.text(robot) || "–");
    setText(cells.level, run.levelName(run.value("level", robot, 0)));
    setText(cells.speed, `${run.speed(robot).toFixed(2)} of ${run.model(robot).max_speed} m/s`);
    setText(cells.segments, `${reached} of ${run.segments(robot)} reached`);
    setText(cells.reserved, released > reached ? `${released - reached} ahead` : "none ahead");
    const degrees = Math.round((run.pose.yaw[robot] * 180) / Math.PI);
    const heading = ((degrees % 360) + 360) % 360;
    setText(cells.pose, `${run.pose.x[robot].toFixed(2)}, ${run.pose.y[robot].toFixed(2)} m · ${heading}°`);
    setText(cells.goal, run.goal(robot));
    setText(cells.model, run.model(robot).name);
  }

  /** Show what is true now. */
  refresh() {
    const { selected } = this.shown;
    this.card.hidden = selected < 0;
    if (selected >= 0) this.#fillCard(selected);
    this.list.refresh();
  }

  reveal(robot) {
    this.list.reveal(this.list.items.indexOf(robot));
  }
}

function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
