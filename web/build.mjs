// Builds the page into web/page (or the folder named): node build.mjs [FOLDER]
// index.html and embed.html name their script and style by their hashed names in assets. The same sources and packages
// give the same bytes. The packages are those of build/web (scripts/page).
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { reportFiles } from './report_files.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, 'page');
const packages = join(here, '../build/web');
const { build } = createRequire(join(packages, 'package.json'))('esbuild');

/** The project's documents are no part of the bundle: the server has them as modules beside it. */
const documents = {
  name: 'documents',
  setup({ onResolve }) {
    onResolve({ filter: /^document:/ }, ({ path }) => ({ path: `./${path.replace(':', '.')}.js`, external: true }));
  },
};

function write(path, bytes) {
  mkdirSync(dirname(join(out, path)), { recursive: true });
  writeFileSync(join(out, path), bytes);
}

rmSync(out, { recursive: true, force: true });
const { outputFiles, metafile } = await build({
  entryPoints: { app: join(here, 'src/main.tsx') },
  absWorkingDir: here, outdir: out, entryNames: 'assets/[name]-[hash]', chunkNames: 'assets/[name]-[hash]',
  assetNames: 'assets/[name]-[hash]', bundle: true, splitting: true, format: 'esm', target: 'es2021', charset: 'utf8', minify: true,
  jsx: 'automatic', jsxImportSource: 'preact', metafile: true, write: false, logLevel: 'warning', legalComments: 'none',
  plugins: [documents, reportFiles], nodePaths: [join(packages, 'node_modules')],
});
for (const file of outputFiles) write(file.path.slice(join(out, '/').length), file.contents);

const icon = readFileSync(join(here, 'src/mark.svg'));
const iconPath = `assets/mark-${createHash('sha256').update(icon).digest('hex').slice(0, 8)}.svg`;
write(iconPath, icon);
const entry = Object.entries(metafile.outputs).find(([, one]) => one.entryPoint?.endsWith('src/main.tsx'));
// Relative, so that the page works below any path.
const named = (path) => join(here, path).slice(join(out, '/').length);
for (const name of ['index.html', 'embed.html'])
  write(name, readFileSync(join(here, name), 'utf8')
    .replace('{{icon}}', iconPath)
    .replace('{{style}}', named(entry[1].cssBundle))
    .replace('{{script}}', named(entry[0])));

// What a first visit loads, and all there is.
const size = (path) => gzipSync(readFileSync(join(out, path))).length;
const statics = new Set(), queue = [entry[0]];
for (const path of queue) {
  if (statics.has(path)) continue;
  statics.add(path);
  queue.push(...metafile.outputs[path].imports.filter((one) => one.kind === 'import-statement').map((one) => one.path));
}
const first = [...statics].map(named).concat(named(entry[1].cssBundle)).reduce((sum, path) => sum + size(path), 0);
const isTranslation = ([, { entryPoint }]) => /^(languages\/|report:words\/)/.test(entryPoint ?? '');
const translations = Object.entries(metafile.outputs).filter(isTranslation).map(([path]) => size(named(path)));
const all = outputFiles.reduce((sum, file) => sum + gzipSync(file.contents).length, 0) - translations.reduce((sum, one) => sum + one, 0);
const kB = (bytes) => (bytes / 1000).toFixed(1);
console.log(`page: ${kB(first)} kB compressed at first, ${kB(all)} kB in all, a translation ${kB(Math.max(...translations))} kB`);
