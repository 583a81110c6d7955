// Runs the tests of the web page: node tests/web/run.mjs unit|e2e [FILE...]
// FAROL_BINARY names the program for e2e. Ends with 77, which ctest takes for skipped, where the
// packages or the browser are not there, and says so.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '../..'), packages = join(root, 'build/web');
const [, , kind, ...names] = process.argv;

function skip(reason) {
  console.log(`SKIPPED: ${reason}`);
  process.exit(77);
}

if (!existsSync(join(packages, 'node_modules'))) skip('the packages of the web page could not be had when the program was built');
const require = createRequire(join(packages, 'package.json'));

function run(files, extra = []) {
  const { status } = spawnSync(process.execPath, ['--test', ...extra, ...files], { stdio: 'inherit' });
  process.exit(status ?? 1);
}

if (kind === 'unit') {
  // The modules under test are TypeScript: bundled first, with the types checked beside it.
  const checked = spawnSync(process.execPath, [join(packages, 'node_modules/typescript/bin/tsc'), '--noEmit', '-p', join(packages, 'stage/web')], { stdio: 'inherit' });
  if (checked.status !== 0) process.exit(1);
  const out = join(packages, 'unit');
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  const sources = readdirSync(join(here, 'unit')).filter((name) => name.endsWith('.test.ts'));
  await require('esbuild').build({
    entryPoints: sources.map((name) => join(here, 'unit', name)), bundle: true, format: 'esm', platform: 'node', outdir: out,
    outExtension: { '.js': '.mjs' }, nodePaths: [join(packages, 'node_modules')], logLevel: 'warning',
  });
  run(sources.map((name) => join(out, name.replace(/\.ts$/, '.mjs'))));
} else if (kind === 'e2e') {
  if (!['/usr/bin/chromium', process.env.FAROL_CHROMIUM].some((path) => path && existsSync(path))) skip('there is no Chromium (package chromium)');
  if (!existsSync(join(root, 'build/web/stage/web/dist/index.html'))) skip('the web page could not be built');
  const all = readdirSync(join(here, 'e2e')).filter((name) => name.endsWith('.test.mjs'));
  // One after the other: each has a server and a browser of its own.
  run((names.length ? names : all).map((name) => join(here, 'e2e', name)), ['--test-concurrency=1']);
} else {
  console.error('node tests/web/run.mjs unit|e2e [FILE...]');
  process.exit(2);
}
