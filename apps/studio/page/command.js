// The command that does the same, to be taken to a terminal.
import {html, useState} from "/htm.mjs";
import {command_text} from "/ask.js";

export function Command({words}) {
  const [copied, set_copied] = useState(false);
  const text = command_text(words);
  const copy = () => navigator.clipboard.writeText(text).then(() => {
    set_copied(true);
    setTimeout(() => set_copied(false), 1500);
  });
  return html`<div class="command"><code>${text}</code>
    <button class="plain" onClick=${copy} aria-label="Copy the command">${copied ? "Copied" : "Copy"}</button></div>`;
}
