// Whether a page can be used without a mouse and without eyes: every control has a name, the Tab key reaches all of them and
// shows where it is, and text stands out from what is behind it.
import assert from "node:assert/strict";

// Names as a screen reader gets them, of all that can be worked and of figures.
async function names(devtools, where) {
  const roles = ["button", "link", "textbox", "combobox", "slider", "checkbox", "radio", "tab", "spinbutton", "progressbar", "image"];
  const {nodes} = await devtools.send("Accessibility.getFullAXTree");
  const shown = nodes.filter((node) => !node.ignored && roles.includes(node.role?.value));
  for (const node of shown) assert.ok(node.name?.value?.trim(), `${where}: a ${node.role.value} without a name (${JSON.stringify(node.properties?.slice(0, 3))})`);
  return shown.length;
}

// What a view asks the server for comes a little later.
async function settled(page) {
  const size = () => page.evaluate(() => document.querySelectorAll("main *").length);
  for (let before = -1, now = await size(); now !== before; now = await size()) {
    before = now;
    await new Promise((done) => setTimeout(done, 300));
  }
}

// What the Tab key may come to: of a group of radio buttons one, of a list of tabs the chosen one.
async function tab_order(page, where) {
  const wanted = await page.evaluate(() => {
    const can = [...document.querySelectorAll("a[href], button, input, select, textarea, summary, [tabindex='0']")]
      .filter((e) => !e.disabled && e.tabIndex >= 0 && e.type !== "radio" && e.checkVisibility({visibilityProperty: true}) && e.getClientRects().length > 0);
    can.forEach((e, k) => { e.dataset.reach = k; });
    document.activeElement?.blur();
    return can.length;
  });
  const reached = new Set(), unseen = [], kMost = 1000;
  for (let k = 0; k < kMost && reached.size < wanted; ++k) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const e = document.activeElement, style = getComputedStyle(e);
      return {reach: e.dataset?.reach, what: `${e.tagName} ${e.getAttribute("aria-label") ?? e.textContent.slice(0, 30)}`, is_seen: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0};
    });
    if (at.reach === undefined) continue;
    if (reached.has(at.reach)) break;  // once round
    reached.add(at.reach);
    if (!at.is_seen) unseen.push(at.what);
  }
  const missed = await page.evaluate((found) => [...document.querySelectorAll("[data-reach]")].filter((e) => !found.includes(e.dataset.reach))
    .map((e) => `${e.tagName} ${e.getAttribute("aria-label") ?? e.textContent.slice(0, 40)}`), [...reached]);
  await page.evaluate(() => document.querySelectorAll("[data-reach]").forEach((e) => delete e.dataset.reach));
  assert.deepEqual(missed, [], `${where}: the Tab key does not come to these`);
  assert.deepEqual(unseen, [], `${where}: nobody sees that these have the focus`);
  return wanted;
}

// Text against its background by WCAG 2: 4.5 to 1, 3 to 1 where it is large.
async function contrast(page, where) {
  const poor = await page.evaluate(() => {
    const canvas = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
    const rgba = (colour) => {
      canvas.clearRect(0, 0, 1, 1);
      canvas.fillStyle = colour;
      canvas.fillRect(0, 0, 1, 1);
      return [...canvas.getImageData(0, 0, 1, 1).data];
    };
    const light = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4).reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
    const behind = (e) => {
      for (; e; e = e.parentElement) {
        const colour = rgba(getComputedStyle(e).backgroundColor);
        if (colour[3] === 255) return colour;
      }
      return [255, 255, 255, 255];
    };
    const found = [], walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node; (node = walker.nextNode());) {
      const e = node.parentElement, style = getComputedStyle(e);
      if (!node.textContent.trim() || !e.checkVisibility({visibilityProperty: true}) || e.closest("[disabled], option, .hidden, title")) continue;
      const ink = light(rgba(e.closest("svg") ? style.fill : style.color)), paper = light(behind(e.closest("svg")?.parentElement ?? e));
      const ratio = (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05), size = parseFloat(style.fontSize);
      if (ratio < (size >= 24 || (size >= 18.6 && style.fontWeight >= 700) ? 3 : 4.5)) found.push(`${node.textContent.trim().slice(0, 40)}: ${ratio.toFixed(2)}`);
    }
    return [...new Set(found)];
  });
  assert.deepEqual(poor, [], `${where}: text that does not stand out`);
}

export async function check_reach(page, where) {
  await settled(page);
  const devtools = await page.context().newCDPSession(page);
  const named = await names(devtools, where), reached = await tab_order(page, where);
  await contrast(page, where);
  await devtools.detach();
  return `${where}: ${named} names, ${reached} places for the Tab key`;
}
