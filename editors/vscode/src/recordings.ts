/** Recordings: a report next to the program, and from there the recording in its viewer. */

import * as path from "node:path";
import * as vscode from "vscode";
import { runTask } from "./runs";

/** What a page of a report may do: show itself, and fetch nothing. */
const POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; font-src data:";

export class Recordings {
  private panel: vscode.WebviewPanel | undefined;
  private recording = "";

  constructor(private readonly storage: vscode.Uri) {}

  /** Path of the report that is shown next. */
  get report(): string {
    return vscode.Uri.joinPath(this.storage, "report.html").fsPath;
  }

  /** Run a program in a terminal, and show its report. */
  async record(program: string, source?: vscode.Uri): Promise<void> {
    await this.prepare();
    const file = source?.fsPath ?? vscode.window.activeTextEditor?.document.fileName ?? program;
    const recording = path.format({ ...path.parse(file), base: undefined, ext: ".rrd" });
    await runTask("Record", ["run", program, "--record", recording, "--report", this.report]);
    await this.show(recording);
  }

  /** Remove the last report, so that a run that writes none shows none. */
  async prepare(): Promise<void> {
    await vscode.workspace.fs.createDirectory(this.storage);
    await vscode.workspace.fs.delete(vscode.Uri.file(this.report)).then(undefined, () => undefined);
  }

  /** Show the report that a run has written, beside the program. */
  async show(recording: string): Promise<void> {
    const content = await vscode.workspace.fs.readFile(vscode.Uri.file(this.report)).then(undefined, () => undefined);
    if (!content) return;
    this.recording = recording;
    const title = `Run of ${path.basename(recording, ".rrd")}`;
    const place = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
    if (!this.panel) {
      const options = { enableScripts: true, enableFindWidget: true, retainContextWhenHidden: true };
      this.panel = vscode.window.createWebviewPanel("rapidsim.report", title, place, options);
      this.panel.onDidDispose(() => (this.panel = undefined));
    }
    const page = Buffer.from(content).toString("utf8");
    this.panel.title = title;
    this.panel.webview.html = page.replace("<head>", `<head><meta http-equiv="Content-Security-Policy" content="${POLICY}">`);
    this.panel.reveal(undefined, true);
  }

  /** Open a recording in the viewer, a program with a window of its own. */
  async view(uri?: vscode.Uri): Promise<void> {
    const recording = uri?.scheme === "file" ? uri.fsPath : this.recording;
    if (recording) await runTask("View", ["view", recording], false);
  }
}
