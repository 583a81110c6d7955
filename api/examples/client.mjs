// Keeps a scene with its files, orbits about it, and deletes it; Node 18 or later, nothing else.
//
//     node client.mjs http://127.0.0.1:8080 scene.zip pictures/
import { mkdir, readFile, writeFile } from 'node:fs/promises';

const [base, bundle, folder] = process.argv.slice(2);

/** The answer; ends with the service's own words where it refuses. */
async function ask(path, options) {
    const answer = await fetch(new URL(path, base), options);
    if (answer.ok) return answer;
    const problem = await answer.json();
    for (const one of problem.errors)
        console.error(`${one.file ?? ''}:${one.line ?? ''}: ${one.message} [${one.code}]`);
    process.exit(1);
}

await mkdir(folder, { recursive: true });
const kept = await ask('/v1/scenes', {
    method: 'POST',
    headers: { 'Content-Type': 'application/zip' },
    body: await readFile(bundle),
});
const scene = await kept.json();
console.log(`${scene.title}: ${scene.counts.triangles} triangles, until ${scene.expires}`);
for (let azimuth = 0; azimuth < 360; azimuth += 90) {
    const picture = await ask(`${scene.links.image}?width=200&height=150&azimuth=${azimuth}`);
    const name = `${folder}/${String(azimuth).padStart(3, '0')}.png`;
    await writeFile(name, Buffer.from(await picture.arrayBuffer()));
}
await ask(kept.headers.get('Location'), { method: 'DELETE' });
