// One picture of docs/editor.md; `build_editor_pictures.py` starts it with a name, a folder and a file.

import { tmpdir } from "node:os";

const { openFolder, openFile, goTo, pointAt, pressKeys, closeMessages } = await import(process.env.PAGE);
const [name, folder, picture] = process.argv.slice(2);

const SCENES = {
  async "editor-problems"(page) {
    await pressKeys(page, "Control+B", "Control+Shift+M");
    await page.waitForSelector(".markers-panel .monaco-list-row:has-text('cannot be reached')");
    await goTo(page, 43, 1);
    await page.waitForTimeout(1000);
    await pointAt(page, page.locator(".view-line span", { hasText: /^pPlace$/ }).last());
    await page.waitForSelector(".monaco-hover .hover-row");
  },
  async "editor-record"(page) {
    await pressKeys(page, "Control+B");
    await page.click(".codelens-decoration a:text('Record')");
    await page.waitForSelector(".webview");
    await page.waitForSelector(".codelens-decoration:has-text('last run')");
    await goTo(page, 25, 1);
    await moveEdge(page, page.locator(".editor-group-container").nth(1), { right: 100 });
    await page.mouse.move(400, 300);
    await page.mouse.wheel(0, 200);
    await page.waitForTimeout(3000);
    await closeMessages(page);
  },
  async "editor-debugger"(page) {
    await goTo(page, 37, 5);
    await pressKeys(page, "F9", "F5");
    await page.waitForSelector(".debug-top-stack-frame-line, .debug-top-stack-frame-column");
    await page.click(".pane-header[aria-label^='Watch']");
    await page.click(".pane-header[aria-label^='Breakpoints']");
    await pressKeys(page, "Control+J");
    await moveEdge(page, page.locator(".part.editor"), { right: 90 });
    await moveEdge(page, page.locator(".pane", { has: page.locator(".debug-call-stack") }), { down: 315 });
    for (const scope of ["Robot", "Signals"]) {
      await page.click(`.debug-variables .scope:has-text("${scope}")`);
      await page.waitForTimeout(700);
    }
    // On a busy computer the adapter may give up the search for the time.
    await page.waitForSelector(".debug-call-stack :text('t = ')");
    await page.mouse.move(900, 560);
  },
};

/** Move the left edge of a part of the window to the right, or its upper edge down. */
async function moveEdge(page, part, { right = 0, down = 0 }) {
  const box = await part.boundingBox();
  const x = right ? box.x - 1 : box.x + box.width / 2;
  const y = down ? box.y : box.y + box.height / 2;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + right, y + down, { steps: 5 });
  await page.mouse.up();
}

const page = await openFolder(folder, { width: 1160, height: 640, scale: 1.5 });
try {
  await openFile(page, "PickAndPlace.mod");
  await SCENES[name](page);
  await page.waitForTimeout(1500);
  await page.screenshot({ path: picture });
} catch (problem) {
  await page.screenshot({ path: process.env.FAILURE ?? `${tmpdir()}/rapidsim-editor-failure.png` });
  throw problem;
} finally {
  await page.context().browser().close();
}
