/** Where rapidsim is, and what to do if it is nowhere. */

import { existsSync } from "node:fs";
import * as path from "node:path";
import * as vscode from "vscode";

const INSTALL = 'pip install "rapidsim[edit,view]"';
const NAMES = process.platform === "win32" ? ["rapidsim.exe", "rapidsim.cmd"] : ["rapidsim"];

/** Absolute path of rapidsim: that of the settings, else of the folder's environment, else on the PATH. */
export function findRapidsim(): string | undefined {
  const folders = (vscode.workspace.workspaceFolders ?? []).map((folder) => folder.uri.fsPath);
  const setting = vscode.workspace.getConfiguration("rapidsim").get<string>("path")?.trim();
  if (setting) {
    const wanted = setting.replace("${workspaceFolder}", folders[0] ?? "");
    if (path.isAbsolute(wanted)) return existsSync(wanted) ? wanted : undefined;
    return onPath([wanted]);
  }
  const bin = process.platform === "win32" ? "Scripts" : "bin";
  const environments = folders.flatMap((folder) => [".venv", "venv"].map((name) => path.join(folder, name, bin)));
  return inFolders(environments, NAMES) ?? onPath(NAMES);
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

/** Absolute path of rapidsim; if there is none, the user is told. */
export function requireRapidsim(): string | undefined {
  const found = findRapidsim();
  if (!found) void explain("rapidsim was not found");
  return found;
}

function onPath(names: string[]): string | undefined {
  const folders = (process.env.PATH ?? "").split(path.delimiter);
  return inFolders(folders.filter((folder) => path.isAbsolute(folder)), names);
}

function inFolders(folders: string[], names: string[]): string | undefined {
  return folders.flatMap((folder) => names.map((name) => path.join(folder, name))).find(existsSync);
}
