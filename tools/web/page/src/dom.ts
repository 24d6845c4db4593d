// Elements by their id, and new ones.

export function byId<Kind extends HTMLElement = HTMLElement>(id: string): Kind {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as Kind;
}

export function make<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, rest: Partial<HTMLElementTagNameMap[Tag]> = {}, children: (Node | string)[] = []): HTMLElementTagNameMap[Tag] {
  const made = Object.assign(document.createElement(tag), rest);
  made.append(...children);
  return made;
}

// Writes a text only where it is another one, so that what is read aloud is news.
export function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

// A table of one head and rows; cells may be elements.
export function fillTable(table: HTMLTableElement, head: string[], rows: (string | Node)[][]): HTMLTableRowElement[] {
  const made = rows.map((cells) => make("tr", {}, cells.map((cell) => make("td", {}, [cell]))));
  table.replaceChildren(
    make("thead", {}, [make("tr", {}, head.map((name) => make("th", { scope: "col", textContent: name })))]), make("tbody", {}, made));
  return made;
}
