// A long list of buttons of which only those in sight exist.

export class List {
  /** `fill(button, item)` shows an item in a button; `choose(item)` is called when it is pressed. */
  constructor(element, height, fill, choose, empty) {
    this.element = element;
    this.height = height;
    this.fill = fill;
    this.choose = choose;
    this.items = [];
    this.sizer = element.appendChild(document.createElement("div"));
    this.sizer.className = "sizer";
    this.note = element.appendChild(document.createElement("p"));
    this.note.className = "note";
    this.note.textContent = empty;
    this.buttons = [];
    element.addEventListener("scroll", () => this.refresh());
    element.addEventListener("keydown", (event) => this.#move(event));
  }

  show(items) {
    this.items = items;
    this.sizer.style.height = `${items.length * this.height}px`;
    this.note.hidden = items.length > 0;
    this.refresh();
  }

  /** Fill the buttons in sight anew. */
  refresh() {
    if (!this.element.clientHeight) return;
    const first = Math.floor(this.element.scrollTop / this.height);
    const count = Math.min(Math.ceil(this.element.clientHeight / this.height) + 1, this.items.length);
    while (this.buttons.length < count) this.#add();
    this.buttons.forEach((button, slot) => {
      // an item keeps its button while it is in sight, so that focus and presses are not lost
      const index = first + ((((slot - first) % this.buttons.length) + this.buttons.length) % this.buttons.length);
      const inSight = index < this.items.length && index < first + count;
      button.hidden = !inSight;
      if (!inSight) return;
      button.style.transform = `translateY(${index * this.height}px)`;
      button.index = index;
      this.fill(button, this.items[index]);
    });
  }

  #add() {
    const button = this.sizer.appendChild(document.createElement("button"));
    button.type = "button";
    button.style.height = `${this.height}px`;
    button.addEventListener("click", () => this.choose(this.items[button.index]));
    this.buttons.push(button);
  }

  /** Bring an item into sight. */
  reveal(index) {
    const { element, height } = this;
    if (index < 0) return;
    if (index * height < element.scrollTop) element.scrollTop = index * height;
    const bottom = (index + 1) * height - element.clientHeight;
    if (bottom > element.scrollTop) element.scrollTop = bottom;
    this.refresh();
  }

  #move(event) {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!by || document.activeElement.index === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const index = Math.min(Math.max(document.activeElement.index + by, 0), this.items.length - 1);
    this.reveal(index);
    this.buttons.find((button) => !button.hidden && button.index === index)?.focus();
  }
}

/** An element with a class, text and children. */
export function make(tag, name, ...children) {
  const element = document.createElement(tag);
  if (name) element.className = name;
  element.append(...children);
  return element;
}
