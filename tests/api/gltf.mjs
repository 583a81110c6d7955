// Writes each scene as binary glTF and holds it to the Khronos validator: no error, no warning.
//
//     node gltf.mjs PROGRAM OUTPUT_FOLDER FOLDER...
// Exit code 77: skipped, what it needs is not installed (scripts/setup does that).
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';

const [program, output, ...folders] = process.argv.slice(2);
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
if (!existsSync(path.join(here, 'node_modules/gltf-validator'))) {
    const reason = 'no gltf-validator in tests/api (scripts/setup test)';
    console.log(process.env.CI === 'true' ? `FAILED: ${reason}` : `SKIPPED: ${reason}`);
    process.exit(process.env.CI === 'true' ? 1 : 77);
}
const { default: validator } = await import('gltf-validator');
mkdirSync(output, { recursive: true });

function* scenesIn(folder) {
    for (const entry of readdirSync(folder, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1))) {
        const place = path.join(folder, entry.name);
        if (entry.isDirectory() && entry.name !== 'refused') yield* scenesIn(place);
        if (entry.isFile() && entry.name.endsWith('.xml')) yield place;
    }
}

let scenes = 0, failures = 0, bytes = 0;
for (const folder of folders) {
    for (const scene of scenesIn(folder)) {
        const file = path.join(output, `${scenes++}.glb`);
        const done = spawnSync(program, ['convert', scene, file, '--json'], { encoding: 'utf8' });
        if (done.status !== 0) {
            ++failures;
            console.log(`FAILED: ${scene}: farol convert ends with ${done.status}: ${done.stdout}${done.stderr}`);
            continue;
        }
        const model = readFileSync(file);
        bytes += model.length;
        const { issues } = await validator.validateBytes(new Uint8Array(model), { maxIssues: 20 });
        if (issues.numErrors + issues.numWarnings > 0) {
            ++failures;
            for (const one of issues.messages.filter(({ severity }) => severity < 2))
                console.log(`FAILED: ${scene}: ${one.code} at ${one.pointer}: ${one.message}`);
        }
    }
}
console.log(`${scenes} scenes, ${(bytes / 1e6).toFixed(1)} MB, ${failures} failed; validator ${validator.version()}`);
process.exit(failures === 0 && scenes > 80 ? 0 : 1);
