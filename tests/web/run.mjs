// Runs the tests of the web page: node tests/web/run.mjs bundle|unit|e2e [FILE...]
// FAROL_BINARY names the program for e2e. Without the packages or the browser it prints why and exits
// with 77, which ctest counts as skipped; under CI=true it fails.
import { spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { reportFiles } from '../../web/report_files.mjs';
import { chromiumPath } from './chromium.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '../..'), packages = join(root, 'build/web');
const [, , kind, ...names] = process.argv;

function skip(reason) {
  const required = process.env.CI === 'true';
  console.log(`${required ? 'FAILED' : 'SKIPPED'}: ${reason}`);
  process.exit(required ? 1 : 77);
}

if (!existsSync(join(packages, 'node_modules'))) skip('no packages of npm in build/web (scripts/setup page)');
const require = createRequire(join(packages, 'package.json'));

function run(files, extra = []) {
  const { status } = spawnSync(process.execPath, ['--test', ...extra, ...files], { stdio: 'inherit' });
  process.exit(status ?? 1);
}

/** Relative paths of all files below a folder. */
const filesBelow = (folder) => readdirSync(folder, { withFileTypes: true }).flatMap((entry) => (entry.isDirectory()
  ? filesBelow(join(folder, entry.name)).map((path) => `${entry.name}/${path}`) : [entry.name])).sort();

if (kind === 'bundle') {
  const fresh = join(packages, `bundle-${process.pid}`), committed = join(root, 'web/page');
  const { status } = spawnSync(process.execPath, [join(root, 'web/build.mjs'), fresh], { stdio: 'inherit' });
  const differ = [];
  if (status === 0) {
    const names = filesBelow(fresh);
    for (const name of new Set([...names, ...filesBelow(committed)])) {
      const both = [fresh, committed].map((folder) => join(folder, name));
      if (!both.every(existsSync) || !readFileSync(both[0]).equals(readFileSync(both[1]))) differ.push(name);
    }
  }
  rmSync(fresh, { recursive: true, force: true });
  if (differ.length > 0) console.log(`web/page is not what its sources give: ${differ.join(', ')}\nFix: run scripts/page and commit web/page`);
  process.exit(status === 0 && differ.length === 0 ? 0 : 1);
} else if (kind === 'unit') {
  // The modules under test are TypeScript: bundled first, with the types checked beside it. The compiler
  // finds the packages above a copy of the sources.
  const stage = join(packages, `stage-${process.version}/web`);
  rmSync(stage, { recursive: true, force: true });
  cpSync(join(root, 'web'), stage, { recursive: true });
  const checked = spawnSync(process.execPath, [join(packages, 'node_modules/typescript/bin/tsc'), '--noEmit', '-p', stage], { stdio: 'inherit' });
  if (checked.status !== 0) process.exit(1);
  // Documents are modules that the service makes; here they are read from the project.
  const paths = { errors: 'api/errors.md', schema: 'api/schema.json' };
  const documents = {
    name: 'documents',
    setup({ onResolve, onLoad }) {
      onResolve({ filter: /^document:/ }, ({ path }) => ({ path: path.slice('document:'.length), namespace: 'document' }));
      onLoad({ filter: /./, namespace: 'document' }, ({ path }) => ({ contents: readFileSync(join(root, paths[path]), 'utf8'), loader: 'text' }));
    },
  };
  const out = join(packages, `unit-${process.version}`);  // one for each Node.js under test
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  const sources = readdirSync(join(here, 'unit')).filter((name) => name.endsWith('.test.ts'));
  await require('esbuild').build({
    entryPoints: sources.map((name) => join(here, 'unit', name)), bundle: true, format: 'esm', platform: 'node', outdir: out,
    outExtension: { '.js': '.mjs' }, plugins: [documents, reportFiles], nodePaths: [join(packages, 'node_modules')], logLevel: 'warning',
  });
  run(sources.map((name) => join(out, name.replace(/\.ts$/, '.mjs'))));
} else if (kind === 'e2e') {
  if (!chromiumPath) skip('there is no Chromium (package chromium-headless-shell, or chromium)');
  const all = readdirSync(join(here, 'e2e')).filter((name) => name.endsWith('.test.mjs'));
  // One after the other: each has a server and a browser of its own.
  run((names.length ? names : all).map((name) => join(here, 'e2e', name)), ['--test-concurrency=1']);
} else {
  console.error('node tests/web/run.mjs bundle|unit|e2e [FILE...]');
  process.exit(2);
}
