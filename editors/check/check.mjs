// Reads every script of the repository with the TextMate grammar, as an editor does, and holds
// what it finds against a reading of its own: comments, strings, numbers and the words that
// statements begin with.
import { readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import oniguruma from "vscode-oniguruma";
import textmate from "vscode-textmate";

const root = fileURLToPath(new URL("../..", import.meta.url));
const require = createRequire(import.meta.url);
await oniguruma.loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")));

const grammarFile = join(root, "editors/linkwork.tmLanguage.json");
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => textmate.parseRawGrammar(readFileSync(grammarFile, "utf8"), grammarFile),
});
const grammar = await registry.loadGrammar("source.linkwork");

/** All scripts below a folder. */
function scripts(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return scripts(path);
    return entry.name.endsWith(".link") ? [path] : [];
  });
}

/** The scope that each character of a line has, the innermost. */
function scopesOf(line, state) {
  const { tokens, ruleStack } = grammar.tokenizeLine(line, state);
  const scopes = Array(line.length).fill("");
  for (const { startIndex, endIndex, scopes: names } of tokens) {
    scopes.fill(names.slice(1).join(" "), startIndex, Math.min(endIndex, line.length));
  }
  return { scopes, ruleStack };
}

/** Where comment and strings of a line are, by a reading of its own. */
function stretches(line) {
  const found = [];
  for (let at = 0; at < line.length; at += 1) {
    if (line[at] === "#") {
      found.push({ from: at, to: line.length, scope: "comment" });
      break;
    }
    if (line[at] === '"') {
      const from = at;
      for (at += 1; at < line.length && line[at] !== '"'; at += 1) if (line[at] === "\\") at += 1;
      found.push({ from, to: at + 1, scope: "string" });
    }
  }
  return found;
}

// That these are the commands is held by the tests of the program.
const { repository } = JSON.parse(readFileSync(grammarFile, "utf8"));
const commands = new Set(repository.command.match.match(/\(([a-z|]+)\)/)[1].split("|"));

const WORD = /[\p{Alphabetic}_][\p{Alphabetic}\p{Nd}_']*/u;
let failures = 0;
let counted = 0;

function expect(isRight, path, number, line, what) {
  counted += 1;
  if (isRight) return;
  failures += 1;
  console.error(`${path}:${number}: ${what}: ${line}`);
}

for (const path of scripts(join(root, "scripts"))) {
  let state = textmate.INITIAL;
  let depth = 0;
  let isOpen = false;
  for (const [index, line] of readFileSync(path, "utf8").split(/\r?\n/).entries()) {
    const { scopes, ruleStack } = scopesOf(line, state);
    state = ruleStack;
    const quiet = stretches(line);
    for (const { from, to, scope } of quiet) {
      const all = scopes.slice(from, to).every((name) => name.startsWith(scope));
      expect(all, path, index + 1, line, `no ${scope} from column ${from + 1}`);
    }
    let code = line;
    for (const { from, to, scope } of quiet) {
      const filler = scope === "string" ? '"' : " ";
      code = code.slice(0, from) + filler.repeat(to - from) + code.slice(to);
    }
    for (const { index: at, 0: text } of code.matchAll(/(?<![\p{Alphabetic}\p{Nd}_'.])\d+(\.\d+)?/gu)) {
      const is = scopes.slice(at, at + text.length).every((name) => name.includes("numeric"));
      expect(is, path, index + 1, line, `no number at column ${at + 1}`);
    }
    // The first word of each statement; a line that goes on begins none.
    let at = 0;
    for (const statement of code.split(/[;{}]/)) {
      const first = statement.match(/^\s*(?:[\p{Alphabetic}_][^\s:="]*\s*:\s*)?/u)[0].length;
      const word = statement.slice(first).match(WORD);
      if (!isOpen && depth === 0 && word && word.index === 0) {
        const scope = scopes[at + first];
        const wanted = commands.has(word[0]) ? "keyword.control" : /variable|support/;
        expect(scope.match(wanted) !== null, path, index + 1, line, `\`${word[0]}\` is ${scope}`);
      }
      for (const char of statement) {
        if ("([".includes(char)) depth += 1;
        if (")]".includes(char)) depth -= 1;
      }
      isOpen = false;
      at += statement.length + 1;
    }
    isOpen = /(,|\\)\s*$/.test(code);
  }
}
console.log(`${counted} places looked at, ${failures} wrong`);
process.exit(failures === 0 && counted > 1000 ? 0 : 1);
