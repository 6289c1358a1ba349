/** Recordings: a report beside the program, and from there the recording in its viewer. */

import * as path from "node:path";
import * as vscode from "vscode";
import { runTask } from "./runs";

/** A page of a report may show itself, and fetch nothing. */
const POLICY = ["default-src 'none'", "style-src 'unsafe-inline'", "script-src 'unsafe-inline'", "img-src data:"];
const HEAD = `<head><meta http-equiv="Content-Security-Policy" content="${POLICY.join("; ")}">`;
const VIEW = "rapidsim.view";
const LINK = `<p style="text-align: right"><a href="command:${VIEW}">Open the recording in the viewer</a></p>`;

export class Recordings {
  private panel: vscode.WebviewPanel | undefined;
  private recording = "";

  constructor(private readonly storage: vscode.Uri) {}

  /** Remove the last report, so that a run that writes none shows none; return the path of the next. */
  async prepare(): Promise<string> {
    const report = this.report();
    await vscode.workspace.fs.createDirectory(this.storage);
    await vscode.workspace.fs.delete(report).then(undefined, () => undefined);
    return report.fsPath;
  }

  /** Run a program in a terminal, and show its report; the recording lies next to the source. */
  async record(program: string, source: string): Promise<void> {
    const recording = path.format({ ...path.parse(source), base: undefined, ext: ".rrd" });
    await runTask("Record", ["run", program, "--record", recording, "--report", await this.prepare()]);
    await this.show(recording);
  }

  /** Show the report that a run has written, beside the program. */
  async show(recording: string): Promise<void> {
    const content = await vscode.workspace.fs.readFile(this.report()).then(undefined, () => undefined);
    if (!content) return;
    this.recording = recording;
    const place = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
    const options = { enableScripts: true, enableCommandUris: [VIEW], enableFindWidget: true };
    if (!this.panel) {
      this.panel = vscode.window.createWebviewPanel("rapidsim.report", "", place, options);
      this.panel.onDidDispose(() => (this.panel = undefined));
    }
    const panel = this.panel;
    panel.title = `Run of ${path.basename(recording, ".rrd")}`;
    const page = Buffer.from(content).toString("utf8");
    panel.webview.html = page.replace("<head>", HEAD).replace("<main>", `<main>${LINK}`);
    panel.reveal(undefined, true);
  }

  /** Open a recording in the viewer, a program with a window of its own. */
  async view(uri?: vscode.Uri): Promise<void> {
    const recording = uri?.scheme === "file" ? uri.fsPath : this.recording;
    if (recording) await runTask("View", ["view", recording]);
  }

  private report(): vscode.Uri {
    return vscode.Uri.joinPath(this.storage, "report.html");
  }
}
