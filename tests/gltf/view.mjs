// Opens the given .glb files in headless Chromium with three.js and writes a picture beside each.
import { createServer } from "node:http";
import { existsSync } from "node:fs";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import process from "node:process";
import { fileURLToPath } from "node:url";

const kSkipped = 77;
const kChromium = process.env.CHROMIUM ?? "/usr/bin/chromium";
const kHere = path.dirname(fileURLToPath(import.meta.url));
const kTypes = { ".html": "text/html", ".js": "text/javascript", ".glb": "model/gltf-binary" };

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(kSkipped);
}

// Serves this folder, and the N-th file as /model/N.
function serve(models) {
  const server = createServer(async (request, response) => {
    const url = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
    const model = url.match(/^\/model\/(\d+)$/);
    const file = model ? models[Number(model[1])] : path.join(kHere, path.normalize(url));
    try {
      const body = await readFile(file);
      response.writeHead(200, { "Content-Type": kTypes[path.extname(file)] ?? "application/octet-stream" });
      response.end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

// Shows one model. Returns the problem, or nothing.
async function view(page, port, index, picture) {
  await page.goto(`http://127.0.0.1:${port}/viewer.html?model=/model/${index}`);
  await page.waitForFunction(() => window.shown, null, { timeout: 60_000 });
  const shown = await page.evaluate(() => window.shown);
  await page.screenshot({ path: picture });
  console.log(`${picture}: ${JSON.stringify(shown)}`);
  if (shown.error) return shown.error;
  // A lit surface has many shades and fills a part of the picture; a blank picture does not.
  const is_blank = shown.colors.different < 50 || shown.colors.drawn_share < 0.05;
  return is_blank ? "the picture is blank" : null;
}

if (!existsSync(kChromium)) skip("Chromium is not installed; ./run test installs it");
const { chromium } = await import("playwright-core").catch(() => skip("playwright-core is not installed; ./run test installs it"));
const models = process.argv.slice(2);
const server = await serve(models);
const profile = await mkdtemp(path.join(tmpdir(), "flytri-viewer-"));
const browser = await chromium.launchPersistentContext(profile, {
  executablePath: kChromium,
  viewport: { width: 800, height: 600 },
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync"],
});
let failures = 0;
try {
  const page = await browser.newPage();
  for (const [index, model] of models.entries()) {
    const problem = await view(page, server.address().port, index, model.replace(/\.glb$/, ".png"));
    if (problem) console.log(`${model}: ${problem}`);
    failures += problem ? 1 : 0;
  }
} finally {
  await browser.close();
  server.close();
  await rm(profile, { recursive: true, force: true });
}
process.exit(failures > 0 ? 1 : 0);
