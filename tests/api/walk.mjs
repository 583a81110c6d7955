// Holds api/openapi.yaml to the schema of OpenAPI 3.1, and a live service to api/openapi.yaml: every
// route, status, schema and bound of a parameter. Then runs the examples of api/examples.
//
//     node walk.mjs PROGRAM SOURCE_FOLDER OUTPUT_FOLDER
// Exit code 77: skipped, what it needs is not installed (scripts/setup does that).
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';

const [program, source, output] = process.argv.slice(2);
if (!existsSync(path.join(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname),
                          'node_modules'))) {
    const reason = 'no packages of npm in tests/api (scripts/setup test)';
    console.log(process.env.CI === 'true' ? `FAILED: ${reason}` : `SKIPPED: ${reason}`);
    process.exit(process.env.CI === 'true' ? 1 : 77);
}
const { Validator } = await import('@seriousme/openapi-schema-validator');
const { default: Ajv } = await import('ajv/dist/2020.js');
const { default: formats } = await import('ajv-formats');
const { default: yaml } = await import('js-yaml');

let failures = 0, checks = 0;
function check(fine, what) {
    ++checks;
    if (fine) return;
    ++failures;
    console.log(`FAILED: ${what}`);
}

const document = yaml.load(readFileSync(path.join(source, 'api/openapi.yaml'), 'utf8'));
const linted = await new Validator().validate(structuredClone(document));
check(linted.valid, `the document is OpenAPI 3.1: ${JSON.stringify(linted.errors)}`);

const ajv = new Ajv({ strict: false, allErrors: true });
formats(ajv);
ajv.addSchema(document, 'api');
const follow = (one) => (one?.$ref ? one.$ref.slice(2).split('/').reduce((at, key) => at[key], document) : one);

/** Starts a service; returns it with its address. */
async function start(...flags) {
    const daemon = spawn(program, ['serve', '--port', '0', '--workers', '1', '--scenes', path.join(source, 'scenes'), ...flags],
                         { stdio: ['ignore', 'pipe', 'ignore'] });
    const base = await new Promise((resolve, reject) => {
        daemon.on('exit', () => reject(new Error('the service ended')));
        readline.createInterface(daemon.stdout).once('line', (line) => resolve(line.replace('listening on ', '')));
    });
    return { daemon, base };
}
// The examples of api/examples store scenes without a token.
const open = await start();
const { daemon, base } = await start('--token', 'walk', '--check-time', '0.05');

const teacher = { Authorization: 'Bearer walk' };

/** Sends, and checks status, media type and schema of the answer against the operation. */
async function ask(operation, method, target, options = {}) {
    const answer = await fetch(base + target, { method: method.toUpperCase(), ...options, headers: { ...teacher, ...options.headers } });
    const label = `${method} ${target}: ${answer.status}`;
    const said = follow(operation.responses[answer.status]);
    check(said !== undefined, `${label} is documented`);
    const bytes = Buffer.from(await answer.arrayBuffer());
    if (bytes.length === 0 || !said) return { answer, bytes };
    const type = (answer.headers.get('content-type') ?? '').split(';')[0];
    check(said.content?.[type] !== undefined, `${label} may be ${type}`);
    if (type.endsWith('json') && said.content?.[type]) {
        const schema = JSON.stringify(said.content[type].schema).replaceAll('"#/', '"api#/');
        const valid = ajv.validate(JSON.parse(schema), JSON.parse(bytes));
        check(valid, `${label} has its schema: ${ajv.errorsText()}`);
    }
    return { answer, bytes };
}

// It turns, for routes that show what moves.
const xml = '<world><group><transform><rotate time="2" x="0" y="1" z="0"/></transform><models><model file="box_1_2.3d"/></models></group></world>';
const sample = { method: 'POST', headers: { 'Content-Type': 'application/xml' }, body: xml };
const form = new FormData();
form.append('submission', new Blob([xml]), 'submission.xml');
form.append('reference', new Blob([xml]), 'reference.xml');
const graded = { method: 'POST', body: form };
const pair = new FormData();
pair.append('first', new Blob([xml]), 'scene.xml');
pair.append('second', new Blob([xml]), 'scene.xml');
const compared = { method: 'POST', body: pair };
const upload = await (await fetch(`${base}/v1/scenes`, { ...sample, headers: { ...teacher, ...sample.headers } })).json();

// An assignment whose right submission is what is submitted, with a student's code.
const assignment = new FormData();
assignment.append('assignment', new Blob([JSON.stringify({ title: 'Box', tries: 1000, triesPerHour: 1000, mask: true, retentionDays: 1,
                                                           shows: ['requirements', 'document', 'models', 'transforms'] })]));
assignment.append('reference', new Blob([xml]), 'reference.xml');
const assigned = { body: assignment };
const students = { headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ students: ['ana'] }) };
await fetch(`${base}/v1/assignments/box`, { method: 'PUT', headers: teacher, ...assigned });
const { codes } = await (await fetch(`${base}/v1/assignments/box/codes`, { method: 'POST', ...students, headers: { ...teacher, ...students.headers } })).json();
const mine = new FormData();
mine.append('submission', new Blob([xml.replace('box_1_2', 'box_1_3')]), 'mine.xml');
const checked = { body: mine, headers: { Authorization: `Bearer ${codes[0].code}` } };
await fetch(`${base}/v1/assignments/box/check`, { method: 'POST', ...checked });

/** Requests that are answered well, of the routes that take no scene alone. */
const bodies = { '/v1/grade': graded, '/v1/compare': compared, '/v1/assignments/{id}/codes': students, '/v1/assignments/{id}/check': checked };

// The page's files have names of their content; a build without npm has none.
const asset = (await (await fetch(`${base}/`)).text()).match(/\/assets\/([\w.-]+)/)?.[1];

/** A target that the operation answers with 200, 201 or 204. */
const targetOf = (pattern) => pattern.replace('{id}', pattern.includes('/assignments/') ? 'box' : upload.id).replace('{shape}', 'cone').replace('{file}', asset ?? 'none');
const fits = { args: '1,2,4,3', background: 'red', entity: 'scene.xml', eye: '3,2,5', target: '0,0,0', up: '0,1,0', q: 'box', student: 'ana', crop: '4x4+0+0', mask: 'axes' };

/** Values in the schema, and values beyond it. */
function probesOf({ name, schema }) {
    if (name === 'session' || name === 'seq') return { good: [], bad: ['/'] };
    if (schema.enum) return { good: schema.enum, bad: ['nonsense', ''] };
    const { minimum: low, maximum: high } = schema;
    if (low === undefined) return { good: fits[name] ? [fits[name]] : [], bad: [] };
    const step = schema.type === 'integer' ? 1 : Math.max(1e-9, Math.abs(low) * 1e-3);
    const beyond = schema.type === 'integer' ? 1 : (high ?? 0) * 1e-3;
    // The most frames are too many pixels, and the farthest near plane lies behind the far one.
    return { good: high === undefined ? [low] : ['frames', 'near'].includes(name) ? [low] : [low, high],
             bad: [low - step, ...(high === undefined ? [] : [high + beyond]), 'x'] };
}

async function walk(pattern, method, operation) {
    const options = method === 'put' ? assigned : method !== 'post' ? {} : (bodies[pattern] ?? sample);
    const target = targetOf(pattern);
    const query = pattern.includes('{shape}') ? '?args=1,2,4,3' : pattern.endsWith('/file') ? '?path=scene.xml' : '';
    if (method === 'delete') return;  // below, when nothing else needs the scene
    const { answer } = await ask(operation, method, target + query, options);
    check(answer.ok || (pattern.includes('{file}') && !asset), `${method} ${pattern} is answered`);
    await ask(operation, method, `${target}?nonsense=1`, options);
    const tag = answer.headers.get('etag');
    if (tag) {
        const again = await ask(operation, method, target + query, { headers: { 'If-None-Match': tag } });
        check(again.answer.status === 304, `${method} ${pattern} is 304 with its tag`);
    }
    if (pattern.includes('{id}')) await ask(operation, method, pattern.replace('{id}', 'missing'), method === 'put' ? assigned : {});
    if (method === 'post') {
        await ask(operation, method, target, { ...sample, headers: { 'Content-Type': 'text/plain' } });
        await ask(operation, method, target, { ...sample, body: '<world>' });
        await ask(operation, method, target, { ...sample, body: '<svg/>' });
        await ask(operation, method, target, { ...sample, headers: { 'Content-Type': 'application/zip' } });
    }
    for (const parameter of (operation.parameters ?? []).map(follow)) {
        if (parameter.in !== 'query') continue;
        const { good, bad } = probesOf(parameter);
        const small = ['width', 'height'].includes(parameter.name) || !operation.parameters.some((one) => follow(one).name === 'width') ? '' : '&width=16&height=12';
        const others = pattern.includes('{shape}') && parameter.name !== 'args' ? '&args=1,2,4,3' : small;
        for (const value of bad) {
            const refused = await ask(operation, method, `${target}?${parameter.name}=${encodeURIComponent(value)}${others}`, options);
            check(refused.answer.status === 400, `${pattern}: ${parameter.name}=${value} is refused, not ${refused.answer.status}`);
            if (refused.answer.status === 400)
                check(JSON.parse(refused.bytes).errors.some((one) => one.field !== undefined), `${pattern}: ${parameter.name}=${value} is named`);
        }
        if (pattern.endsWith('/thumbnail')) continue;  // as /image
        for (const value of good) {
            const side = { width: '&height=1', height: '&width=1' }[parameter.name] ?? others;
            const taken = await ask(operation, method, `${target}?${parameter.name}=${encodeURIComponent(value)}${side}`, options);
            const { status } = taken.answer;
            check(status < 400 || status === 422, `${pattern}: ${parameter.name}=${value} is taken, not ${status}`);
        }
    }
}

function runExample(command, ...words) {
    if (spawnSync(command, ['--version']).error) return console.log(`SKIPPED: no ${command}, so its example`);
    const folder = path.join(output, `example-${path.basename(words[0])}`);
    const done = spawnSync(command, [path.join(source, 'api/examples', words[0]), open.base, words[1], folder], { encoding: 'utf8' });
    check(done.status === 0, `${words[0]} ends well: ${done.stdout}${done.stderr}`);
    const pictures = existsSync(folder) ? readdirSync(folder).filter((name) => name.endsWith('.png')) : [];
    check(pictures.length === 4, `${words[0]} has four pictures`);
    for (const name of pictures)
        check(readFileSync(path.join(folder, name)).subarray(1, 4).toString() === 'PNG', `${words[0]}: ${name}`);
}

try {
    for (const [pattern, methods] of Object.entries(document.paths))
        for (const [method, operation] of Object.entries(methods)) await walk(pattern, method, operation);
    const removal = document.paths['/v1/scenes/{id}'].delete;
    for (const [id, status] of [[upload.id, 204], [upload.id, 404], ['house', 405]])
        check((await ask(removal, 'delete', `/v1/scenes/${id}`)).answer.status === status, `DELETE ${id} is ${status}`);
    rmSync(output, { recursive: true, force: true });
    mkdirSync(output, { recursive: true });
    const bundle = path.join(output, 'scene.tgz');
    execFileSync('tar', ['czf', bundle, '-C', path.join(source, 'scenes'), 'primitives']);
    for (const [command, example] of [['sh', 'client.sh'], ['python3', 'client.py'], ['node', 'client.mjs']])
        runExample(command, example, bundle);
} finally {
    for (const one of [daemon, open.daemon]) {
        one.removeAllListeners('exit');
        one.kill('SIGTERM');
    }
}
console.log(`${checks} checks, ${failures} failed`);
process.exit(failures === 0 && checks > 200 ? 0 : 1);
