// A plugin of esbuild: files of the report of `farol grade` as texts, for reports that the page writes.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..'), ownWords = 'part.page/';

/** The words of view.js by their ids, as JSON: those that grade/report/report.cpp gives it. */
function wordsIn(language) {
  const all = Object.entries(JSON.parse(readFileSync(join(root, `core/languages/${language}.json`), 'utf8')));
  return JSON.stringify(Object.fromEntries(all.filter(([id]) => id.startsWith(ownWords)).map(([id, text]) => [id.slice(ownWords.length), text])));
}

/** `report:NAME` is a file of grade/report, `report:words/LANGUAGE` the words of a language. */
export const reportFiles = {
  name: 'report files',
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^report:/ }, ({ path }) => ({ path: path.slice('report:'.length), namespace: 'report' })); // names of chunks hash this
    onLoad({ filter: /./, namespace: 'report' }, ({ path }) => ({
      contents: path.startsWith('words/') ? wordsIn(path.slice('words/'.length)) : readFileSync(join(root, 'grade/report', path), 'utf8'), loader: 'text',
    }));
  },
};
