/** Commands of rapidsim as tasks, in a terminal. */

import * as path from "node:path";
import * as vscode from "vscode";
import { requireRapidsim } from "./program";

/** Start rapidsim in a terminal, with all files saved; resolve when it ends, or if it is not found. */
export async function runTask(name: string, args: string[], reveal = true): Promise<void> {
  const program = requireRapidsim();
  if (!program) return;
  await vscode.workspace.saveAll(false);
  const folder = vscode.workspace.workspaceFolders?.[0];
  const cwd = folder?.uri.fsPath ?? path.dirname(args[1]);
  const execution = new vscode.ProcessExecution(program, args, { cwd });
  const definition = { type: "rapidsim", arguments: args };
  const task = new vscode.Task(definition, folder ?? vscode.TaskScope.Workspace, name, "RAPID", execution);
  const { Always, Silent } = vscode.TaskRevealKind;
  task.presentationOptions = { reveal: reveal ? Always : Silent, clear: true, showReuseMessage: false };
  const ended = new Promise<void>((resolve) => {
    const listener = vscode.tasks.onDidEndTaskProcess(({ execution: { task: of } }) => {
      if (of.definition.type !== definition.type || of.name !== name) return;
      listener.dispose();
      resolve();
    });
  });
  await vscode.tasks.executeTask(task);
  await ended;
}
