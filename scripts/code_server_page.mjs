// A page with VS Code in it, and what a user does there. `code_server.py` sets the environment.

import { createRequire } from "node:module";

const { chromium } = createRequire(process.env.MODULES)("playwright-core");

/** Open a folder in the editor, in a window of a size [pixels]. */
export async function openFolder(folder, { width = 1200, height = 700, scale = 1 } = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ["--no-sandbox", "--disable-gpu"],
  });
  const page = await browser.newPage({ viewport: { width, height }, deviceScaleFactor: scale });
  page.setDefaultTimeout(60_000);
  await page.goto(`${process.env.URL}?folder=${encodeURIComponent(folder)}`);
  await page.waitForSelector(".explorer-folders-view .monaco-list-row");
  return page;
}

/** Open a file of the folder, and wait until the language server has answered. */
export async function openFile(page, name) {
  await page.dblclick(`.explorer-folders-view .monaco-list-row[aria-label^="${name}"]`);
  await page.waitForSelector(".codelens-decoration a");
}

export async function pressKeys(page, ...keys) {
  for (const key of keys) await page.keyboard.press(key);
}

/** Put the cursor at a line and column. */
export async function goTo(page, line, column) {
  await page.click(".monaco-editor .view-lines", { position: { x: 400, y: 8 } });
  await page.keyboard.press("Control+G");
  await page.waitForSelector(".quick-input-widget input");
  await page.keyboard.type(`${line}:${column}`);
  await page.keyboard.press("Enter");
  await page.waitForTimeout(300);
}

/** Move the pointer onto an element, without a scroll of what is around it. */
export async function pointAt(page, locator, fraction = 0.5) {
  const box = await locator.boundingBox();
  await page.mouse.move(box.x + box.width * fraction - 3, box.y + box.height / 2);
  await page.mouse.move(box.x + box.width * fraction, box.y + box.height / 2, { steps: 4 });
}

/** Close the messages in the corner. */
export async function closeMessages(page) {
  for (const close of await page.$$(".notifications-toasts .codicon-notifications-clear")) {
    await close.click().catch(() => undefined);
  }
}
