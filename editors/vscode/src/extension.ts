/** RAPID in VS Code: starts the language server and the debugger, runs and records programs. */

import * as vscode from "vscode";
import { registerDebugger } from "./debugging";
import { LanguageServer } from "./languageServer";
import { Recordings } from "./recordings";
import { runTask } from "./runs";

let server: LanguageServer | undefined;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const recordings = new Recordings(context.storageUri ?? context.globalStorageUri);
  const language = (server = new LanguageServer(recordings));
  const command = (name: string, action: (uri?: vscode.Uri) => Promise<unknown>) =>
    context.subscriptions.push(vscode.commands.registerCommand(`rapidsim.${name}`, action));
  command("restart", () => language.restart());
  command("view", (uri) => recordings.view(uri));
  command("runProgram", async (uri) => {
    const found = await language.program(uri);
    if (found) await runTask("Run", ["run", found.program, "--no-record"]);
  });
  command("recordProgram", async (uri) => {
    const found = await language.program(uri);
    if (found) await recordings.record(found.program, found.source);
  });
  command("debugProgram", async (uri) => {
    const folder = uri && vscode.workspace.getWorkspaceFolder(uri);
    const configuration = { type: "rapidsim", request: "launch", name: "Debug", stopOnEntry: true };
    const started = await vscode.debug.startDebugging(folder, configuration);
    if (started) await vscode.commands.executeCommand("workbench.view.debug");
  });
  context.subscriptions.push(
    registerDebugger(language),
    vscode.workspace.onDidGrantWorkspaceTrust(() => language.restart()),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      const settings = ["rapidsim.path", "rapidsim.checkMoves"];
      if (settings.some((setting) => change.affectsConfiguration(setting))) await language.restart();
    }),
  );
  await language.restart();
}

export async function deactivate(): Promise<void> {
  await server?.stop();
}
