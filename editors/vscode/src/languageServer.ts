/** The language server and its commands. */

import { spawn, type ChildProcess } from "node:child_process";
import * as vscode from "vscode";
import { CloseAction, ErrorAction, LanguageClient } from "vscode-languageclient/node";
import { explain, requireRapidsim } from "./program";
import type { Recordings } from "./recordings";

/** Exit code of rapidsim for wrong usage, such as a package that is not installed. */
const USAGE = 2;
const MOST_RESTARTS = 3;

interface Program {
  source: string;
  program: string;
}

/** Logs errors of the connection; what has gone wrong is said once, with what helps. */
class QuietClient extends LanguageClient {
  override error(message: string, data?: unknown): void {
    super.error(message, data, false);
  }
}

export class LanguageServer {
  private client: LanguageClient | undefined;

  constructor(private readonly recordings: Recordings) {}

  /** Start the server, again if it runs, in a folder that the user trusts. */
  async restart(): Promise<void> {
    await this.stop();
    if (!vscode.workspace.isTrusted) return;
    const program = requireRapidsim();
    if (!program) return;
    let [errors, starts, ended] = ["", 0, Promise.resolve<number | null>(null)];
    const start = async (): Promise<ChildProcess> => {
      starts++;
      const process = spawn(program, ["lsp"]);
      ended = new Promise((resolve) => process.once("close", resolve));
      process.once("error", (error) => (errors += error.message));
      process.stderr.on("data", (data) => (errors = (errors + data).slice(-2000)));
      return process;
    };
    const closed = async () => {
      const again = (await ended) !== USAGE && starts <= MOST_RESTARTS;
      const reason = errors.trim().split(/\s*[\r\n]+\s*/).slice(-2).join("; ");
      if (!again) void explain(`\`rapidsim lsp\` has ended${reason && `: ${reason}`}`);
      return { action: again ? CloseAction.Restart : CloseAction.DoNotRestart, handled: true };
    };
    const client = new QuietClient("rapidsim", "RAPID", start, {
      documentSelector: [{ language: "rapid" }],
      initializationOptions: { checkMoves: vscode.workspace.getConfiguration("rapidsim").get("checkMoves") },
      errorHandler: { error: () => ({ action: ErrorAction.Continue, handled: true }), closed },
      initializationFailedHandler: () => false,
      middleware: { executeCommand: (name, args, next) => this.execute(name, args, next) },
    });
    this.client = client;
    await client.start().catch(() => undefined);
  }

  async stop(): Promise<void> {
    const client = this.client;
    this.client = undefined;
    if (client?.isRunning()) await client.dispose();
  }

  /** A file, by default that of the active editor, and the path of the program that it belongs to. */
  async program(uri = vscode.window.activeTextEditor?.document.uri): Promise<Program | undefined> {
    if (uri?.scheme !== "file") {
      void vscode.window.showErrorMessage("Open a module that is saved: programs are run from their files.");
      return undefined;
    }
    const parameters = { command: "rapidsim.program", arguments: [uri.toString()] };
    // Without a server, as when its package is not installed, the file can still be run.
    const asked = this.client?.sendRequest<string | null>("workspace/executeCommand", parameters);
    const program = await asked?.catch(() => null);
    return { source: uri.fsPath, program: program ?? uri.fsPath };
  }

  /** Let the server run what a code lens names, and show what it recorded. */
  private async execute<T>(name: string, args: any[], next: (name: string, args: any[]) => T): Promise<unknown> {
    if (name !== "rapidsim.record") return next(name, args);
    const result: any = await next(name, [...args, await this.recordings.prepare()]);
    if (result?.recording) await this.recordings.show(result.recording);
    return result;
  }
}
