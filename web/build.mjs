// Builds the page into dist/ (or the folder named): node build.mjs [FOLDER]
// dist/index.html names its script and style by their hashed names in dist/assets; files that gain
// by it have a gzipped copy beside them, which the service sends where it is taken.
import { build } from 'esbuild';
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, 'dist');
const project = (path) => readFileSync(join(here, '..', path), 'utf8');

/** Loads a TypeScript module of this folder into this program. */
async function load(path) {
  const { outputFiles } = await build({
    entryPoints: [join(here, path)], bundle: true, write: false, format: 'esm', platform: 'node',
  });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString('base64')}`);
}

/** Modules that are made from the project's documents. */
const derived = {
  name: 'derived',
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: 'derived' }));
    onLoad({ filter: /.*/, namespace: 'derived' }, async ({ path }) => {
      const made = path === 'virtual:cures'
        ? (await load('derive/cures.ts')).curesOf(project('api/errors.md'))
        : (await load('derive/schema.ts')).schemaOf(project('api/scene.xsd'), project('docs/scene-language.md'));
      return { contents: JSON.stringify(made), loader: 'json' };
    });
  },
};

function write(path, bytes) {
  mkdirSync(dirname(join(out, path)), { recursive: true });
  writeFileSync(join(out, path), bytes);
  const packed = gzipSync(bytes, { level: 9 });
  if (packed.length < bytes.length * 0.9) writeFileSync(join(out, `${path}.gz`), packed);
}

rmSync(out, { recursive: true, force: true });
const { outputFiles, metafile } = await build({
  entryPoints: { app: join(here, 'src/main.tsx') },
  absWorkingDir: here, outdir: out, entryNames: 'assets/[name]-[hash]', chunkNames: 'assets/[name]-[hash]',
  assetNames: 'assets/[name]-[hash]', bundle: true, splitting: true, format: 'esm', target: 'es2021', minify: true,
  jsx: 'automatic', jsxImportSource: 'preact', metafile: true, write: false, logLevel: 'warning', legalComments: 'none',
  plugins: [derived],
});
for (const file of outputFiles) write(file.path.slice(join(out, '/').length), file.contents);

const icon = readFileSync(join(here, 'src/mark.svg'));
const iconPath = `assets/mark-${createHash('sha256').update(icon).digest('hex').slice(0, 8)}.svg`;
write(iconPath, icon);
const entry = Object.entries(metafile.outputs).find(([, one]) => one.entryPoint?.endsWith('src/main.tsx'));
const named = (path) => `/${join(here, path).slice(join(out, '/').length)}`;
const html = readFileSync(join(here, 'index.html'), 'utf8')
  .replace('{{icon}}', `/${iconPath}`)
  .replace('{{style}}', named(entry[1].cssBundle))
  .replace('{{script}}', named(entry[0]));
write('index.html', html);

// What a first visit loads, and all there is.
const size = (path) => gzipSync(readFileSync(join(out, path.replace(/^\//, '')))).length;
const statics = new Set(), queue = [entry[0]];
for (const path of queue) {
  if (statics.has(path)) continue;
  statics.add(path);
  queue.push(...metafile.outputs[path].imports.filter((one) => one.kind === 'import-statement').map((one) => one.path));
}
const first = [...statics].map(named).concat(named(entry[1].cssBundle)).reduce((sum, path) => sum + size(path), 0);
const all = outputFiles.reduce((sum, file) => sum + gzipSync(file.contents).length, 0);
console.log(`page: ${(first / 1000).toFixed(1)} kB compressed at first, ${(all / 1000).toFixed(1)} kB in all`);
