/** Where rapidsim is, and what to do if it is nowhere. */

import { existsSync } from "node:fs";
import * as path from "node:path";
import * as vscode from "vscode";

const INSTALL = 'pip install "rapidsim[edit,view]"';
const [BIN, SUFFIX] = process.platform === "win32" ? ["Scripts", ".exe"] : ["bin", ""];

/** Absolute path of rapidsim: that of the settings, else of the folder's environment, else on the PATH.
 *
 * If there is none, the user is told. */
export function requireRapidsim(): string | undefined {
  const folders = (vscode.workspace.workspaceFolders ?? []).map((folder) => folder.uri.fsPath);
  const setting = vscode.workspace.getConfiguration("rapidsim").get<string>("path", "").trim();
  const wanted = setting.replace("${workspaceFolder}", folders[0] ?? "");
  const environments = folders.flatMap((folder) => [".venv", "venv"].map((name) => path.join(folder, name, BIN)));
  const onPath = (process.env.PATH ?? "").split(path.delimiter).filter((folder) => path.isAbsolute(folder));
  const named = [...(setting ? [] : environments), ...onPath].map((folder) => path.join(folder, wanted || "rapidsim"));
  const candidates = path.isAbsolute(wanted) ? [wanted] : named;
  const found = candidates.flatMap((file) => [file + SUFFIX, file]).find((file) => existsSync(file));
  if (!found) void explain(setting ? `There is no ${setting}` : "rapidsim was not found");
  return found;
}

/** Say what is wrong with rapidsim, and offer what helps. */
export async function explain(problem: string): Promise<void> {
  const [copy, settings, retry] = ["Copy the Command", "Set the Path", "Try Again"];
  const text = `${problem}. Install it with: ${INSTALL}, or set where it is (rapidsim.path).`;
  const choice = await vscode.window.showErrorMessage(text, copy, settings, retry);
  if (choice === copy) await vscode.env.clipboard.writeText(INSTALL);
  if (choice === settings) await vscode.commands.executeCommand("workbench.action.openSettings", "rapidsim.path");
  if (choice === retry) await vscode.commands.executeCommand("rapidsim.restart");
}
