/** The debug adapter `rapidsim dap`. */

import * as vscode from "vscode";
import type { LanguageServer } from "./languageServer";
import { requireRapidsim } from "./program";

const TYPE = "rapidsim";
/** Data with components and indices: `parts{i}.trans.x`. */
const DATA = /[A-Za-z]\w*(?:\{[^{}]*\}|\.[A-Za-z]\w*)*/g;

export function registerDebugger(server: LanguageServer): vscode.Disposable {
  const configurations: vscode.DebugConfigurationProvider = {
    async resolveDebugConfiguration(folder, configuration) {
      if (!configuration.type) Object.assign(configuration, { type: TYPE, request: "launch", name: "Debug" });
      if (configuration.request === "launch" && !configuration.program) {
        configuration.program = (await server.program())?.program;
      }
      configuration.cwd ??= folder?.uri.fsPath;
      return configuration;
    },
    async resolveDebugConfigurationWithSubstitutedVariables(_, configuration) {
      await vscode.workspace.saveAll(false);
      return requireRapidsim() ? configuration : undefined;
    },
  };
  const adapters: vscode.DebugAdapterDescriptorFactory = {
    createDebugAdapterDescriptor() {
      const program = requireRapidsim();
      return program ? new vscode.DebugAdapterExecutable(program, ["dap"]) : undefined;
    },
  };
  const expressions: vscode.EvaluatableExpressionProvider = {
    provideEvaluatableExpression(document, position) {
      const range = document.getWordRangeAtPosition(position, DATA);
      return range && new vscode.EvaluatableExpression(range);
    },
  };
  return vscode.Disposable.from(
    vscode.debug.registerDebugConfigurationProvider(TYPE, configurations),
    vscode.debug.registerDebugAdapterDescriptorFactory(TYPE, adapters),
    vscode.languages.registerEvaluatableExpressionProvider({ language: "rapid" }, expressions),
  );
}
