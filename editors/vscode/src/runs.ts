/** Commands of rapidsim as tasks, in a terminal. */

import * as path from "node:path";
import * as vscode from "vscode";
import { requireRapidsim } from "./program";

/** Start rapidsim in a terminal of its own; return its exit code when it ends, undefined if it does not start. */
export async function runTask(name: string, args: string[], reveal = true): Promise<number | undefined> {
  const program = requireRapidsim();
  if (!program) return undefined;
  await vscode.workspace.saveAll(false);
  const folder = vscode.workspace.workspaceFolders?.[0];
  const cwd = folder?.uri.fsPath ?? path.dirname(args[1]);
  const execution = new vscode.ProcessExecution(program, args, { cwd });
  const definition = { type: "rapidsim", arguments: args };
  const task = new vscode.Task(definition, folder ?? vscode.TaskScope.Workspace, name, "RAPID", execution);
  const { Always, Silent } = vscode.TaskRevealKind;
  task.presentationOptions = { reveal: reveal ? Always : Silent, clear: true, showReuseMessage: false };
  const running = await vscode.tasks.executeTask(task);
  return new Promise((resolve) => {
    const listener = vscode.tasks.onDidEndTaskProcess((ended) => {
      if (ended.execution !== running) return;
      listener.dispose();
      resolve(ended.exitCode);
    });
  });
}
