// What may be pressed by who knows the token.
import { byId, make } from "./dom";
import type { State } from "./types";

const kKey = "bladefit-token";
const kCommands: [name: string, label: string, question: string][] = [
  ["start", "Start", ""],
  ["stop", "Stop", ""],
  ["acknowledge", "Acknowledge alarm", ""],
  ["reset", "Reset …", "Forget all points so far and begin anew? The points stay in the journal; the fit starts from nothing."],
];

async function send(name: string, token: string): Promise<string | null> {
  try {
    const answer = await fetch("/api/command", { method: "POST", body: name, headers: { Authorization: `Bearer ${token}` } });
    return answer.ok ? null : (await answer.text()).trim();
  } catch {
    return "the host does not answer";
  }
}

// Asks in a dialog; null where it is left.
function ask(title: string, secret: boolean): Promise<string | null> {
  const dialog = byId<HTMLDialogElement>("ask");
  const field = make("input", { type: "password", autocomplete: "off", required: true });
  field.setAttribute("aria-label", "Token");
  const form = make("form", { method: "dialog" }, [
    make("h2", { id: "ask-title", textContent: title }), ...(secret ? [field] : []),
    make("div", { className: "buttons" }, [make("button", { value: "yes", textContent: secret ? "Unlock" : "Yes, reset" }), make("button", { value: "", formNoValidate: true, textContent: "Cancel" })])]);
  dialog.replaceChildren(form);
  return new Promise((done) => {
    dialog.onclose = () => done(dialog.returnValue === "yes" ? field.value || "yes" : null);
    dialog.returnValue = "";
    dialog.showModal();
  });
}

export class Commands {
  private token = sessionStorage.getItem(kKey) ?? "";
  private drawn = "";
  private readonly said = make("p", { className: "said" });

  constructor() { this.said.setAttribute("role", "status"); }

  show(state: State): void {
    const look = `${state.commands} ${this.token !== ""}`;
    if (look === this.drawn) return;
    this.drawn = look;
    const box = byId("commands");
    box.hidden = !state.commands;
    const button = (label: string, press: () => void): HTMLElement => {
      const made = make("button", { type: "button", textContent: label });
      made.addEventListener("click", press);
      return made;
    };
    const buttons = this.token
      ? [...kCommands.map(([name, label, question]) => button(label, () => void this.press(name, question))), button("Lock", () => this.keep(""))]
      : [button("Unlock commands", () => void this.unlock())];
    box.replaceChildren(make("div", { className: "buttons" }, buttons), this.said);
  }

  private keep(token: string): void {
    this.token = token;
    if (token) sessionStorage.setItem(kKey, token); else sessionStorage.removeItem(kKey);
    this.drawn = "";
    this.said.textContent = "";
  }

  private async unlock(): Promise<void> {
    const token = await ask("Token of this host", true);
    if (token === null) return;
    const wrong = await send("check", token);
    if (wrong === null) this.keep(token); else this.said.textContent = `Refused: ${wrong}`;
  }

  private async press(name: string, question: string): Promise<void> {
    if (question && (await ask(question, false)) === null) return;
    const wrong = await send(name, this.token);
    this.said.textContent = wrong === null ? `Done: ${name}` : `Refused: ${wrong}`;
  }
}
