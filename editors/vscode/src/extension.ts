/** RAPID in VS Code: starts the language server and the debugger, runs and records programs. */

import * as vscode from "vscode";
import { startDebugging, registerDebugger } from "./debugging";
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
    const program = await language.program(uri);
    if (program) await runTask("Run", ["run", program, "--no-record"]);
  });
  command("recordProgram", async (uri) => {
    const program = await language.program(uri);
    if (program) await recordings.record(program, uri);
  });
  command("debugProgram", (uri) => startDebugging(uri));
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
