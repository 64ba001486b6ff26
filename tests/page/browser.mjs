// What the tests of pages share: headless Chromium, what goes wrong in a page, and whether a curve was drawn.
import {existsSync} from "node:fs";

const kChromium = "/usr/bin/chromium";
const kFlags = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync"];

function skip(reason) {
  console.log(`SKIPPED: ${reason}`);
  process.exit(77);
}

// A function that starts the browser with its profile in a folder; where there is none, the test is skipped at once.
export async function find_browser() {
  const playwright = await import("playwright-core").catch(() => skip("playwright-core is not in node_modules; run 'npm ci --ignore-scripts'"));
  if (!existsSync(kChromium)) skip(`${kChromium} is missing; install chromium`);
  return (profile) => playwright.chromium.launchPersistentContext(profile,
    {executablePath: kChromium, args: kFlags, viewport: {width: 1280, height: 900}, colorScheme: "light"});
}

// Adds to `problems` every script error of a page, every message of an error that `expected` does not match, and every
// request for an address that `own` does not match.
export function watch(page, problems, own, expected = /$^/) {
  page.on("pageerror", (error) => problems.push(error.stack));
  page.on("console", (message) => { if (message.type() === "error" && !expected.test(message.text())) problems.push(message.text()); });
  page.on("request", (request) => { if (!own.test(request.url())) problems.push(`asked for ${request.url()}`); });
}

// The addresses of a studio's page.
export const kStudio = /^(http:\/\/127\.0\.0\.1:|data:|blob:)/;

// Whether a curve was drawn: axes and grid are grey, curves are coloured.
export const has_ink = (figure) => figure.locator("canvas").evaluate((canvas) => {
  const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let coloured = 0;
  for (let i = 0; i < data.length; i += 4) {
    const rgb = [data[i], data[i + 1], data[i + 2]];
    if (data[i + 3] > 128 && Math.max(...rgb) - Math.min(...rgb) > 60) coloured++;
  }
  return coloured > 150;
});
