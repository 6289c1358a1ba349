// What a user of VS Code sees: problems, squiggles, lenses, the debugger at a breakpoint. Prints it as JSON.

import { tmpdir } from "node:os";

const { openFolder, openFile, goTo, pressKeys } = await import(process.env.PAGE);
const [folder, file, line] = process.argv.slice(2);

const page = await openFolder(folder);
const texts = (selector) => page.$$eval(selector, (found) => found.map((one) => one.textContent.replaceAll("\u00a0", " ")));
try {
  await openFile(page, file);
  await pressKeys(page, "Control+Shift+M");
  await page.waitForSelector(".markers-panel .monaco-list-row");
  const seen = {
    problems: await texts(".markers-panel .monaco-list-row"),
    squiggles: (await page.$$(".squiggly-error, .squiggly-warning")).length,
    lenses: await texts(".codelens-decoration"),
    buttons: await page.$$eval(".editor-actions a.action-label", (found) => found.map((one) => one.ariaLabel)),
    language: (await texts("[id='status.editor.mode']"))[0].trim(),
  };
  await goTo(page, line, 9);
  await pressKeys(page, "F9", "F5");
  await page.waitForSelector(".debug-top-stack-frame-line, .monaco-editor .debug-top-stack-frame-column");
  await page.waitForSelector(".debug-call-stack .stack-frame");
  seen.stack = await texts(".debug-call-stack .stack-frame");
  seen.scopes = await texts(".debug-variables .scope");
  console.log(JSON.stringify(seen));
} catch (problem) {
  await page.screenshot({ path: process.env.FAILURE ?? `${tmpdir()}/rapidsim-editor-failure.png` });
  throw problem;
} finally {
  await page.context().browser().close();
}
