// A class to try: scenes that the service has, handed in by seven students, five of them with a mistake.
import { getFiles, getSource, request, scenePath } from '../api.ts';
import { studentOf } from './names.ts';
import type { Handed } from './submissions.ts';
import { tarOf } from './tar.ts';
import type { Task } from './types.ts';

/** A mistake that students make, planted in a document's text; null: there is no place for it. */
type Mistake = (xml: string) => string | null;

const replaced = (pattern: RegExp, by: (...parts: string[]) => string): Mistake => (xml) => (pattern.test(xml) ? xml.replace(pattern, by as never) : null);

export const mistakes = {
  none: ((xml) => xml) as Mistake,
  sign: replaced(/(<rotate\b[^>]*\bangle=")(-?)([0-9.]*[1-9][0-9.]*")/i, (_, before, sign, rest) => `${before}${sign ? '' : '-'}${rest}`),
  order: replaced(/(<translate\b[^>]*\/>)(\s*)(<rotate\b[^>]*\/>)/i, (_, first, blank, second) => `${second}${blank}${first}`),
  light: replaced(/<light\b[^>]*\/>/i, () => ''),
  color: replaced(/<diffuse\b[^>]*\/>/i, () => '<diffuse R="30" G="60" B="220"/>'),
  camera: replaced(/(<position\b[^>]*\bx=")(-?[0-9.]+)(")/i, (_, before, x, after) => `${before}${(Number(x) + 2).toFixed(2)}${after}`),
  radians: replaced(/(<rotate\b[^>]*\bangle=")(-?[0-9.]*[1-9][0-9.]*)(")/i, (_, before, angle, after) => `${before}${(Number(angle) * Math.PI / 180).toFixed(4)}${after}`),
  broken: ((xml) => `This is my homework: ${xml.length} letters of XML, see my other e-mail`) as Mistake,
};

const students: [string, (keyof typeof mistakes)[]][] = [
  ['Ana Reis', ['none']], ['Bento Dias', ['sign', 'light']], ['Carla Lopes', ['order', 'color']], ['Duarte Melo', ['light', 'color']],
  ['Eva Pinto', ['radians', 'camera']], ['Filipe Sá', ['camera']], ['Gil Vaz', ['broken']],
];
const wantedScenes = ['robot-arm', 'torch'];
const maxFiles = 40;

interface SceneParts {
  id: string;
  xml: string;
  files: { path: string; file: Blob }[];
}

async function sceneOf(id: string): Promise<SceneParts> {
  const [{ main, files }, xml] = await Promise.all([getFiles(id), getSource(id)]);
  const beside = await Promise.all(files.filter(({ path }) => path !== main).slice(0, maxFiles).map(async ({ path }) =>
    ({ path, file: await (await request(`${scenePath(id)}/file?${new URLSearchParams({ path })}`)).blob() })));
  return { id, xml, files: beside };
}

/** The scenes of the example, where the service has them, else the first that it has. */
async function exampleScenes(): Promise<SceneParts[]> {
  const found = await Promise.all(wantedScenes.map((id) => sceneOf(id).catch(() => null)));
  const scenes = found.filter((one) => one !== null);
  if (scenes.length > 0) return scenes;
  const page = (await (await request('v1/scenes?page=1')).json()) as { scenes: { id: string; valid: boolean }[] };
  const first = page.scenes.find(({ valid }) => valid);
  return first ? [await sceneOf(first.id)] : [];
}

const xmlBlob = (text: string): Blob => new Blob([text], { type: 'application/xml' });

export interface ExampleClass {
  tasks: Task[];
  submissions: Handed[];
}

/** Makes the class; null where the service has no scenes. */
export async function exampleClass(): Promise<ExampleClass | null> {
  const scenes = await exampleScenes();
  if (scenes.length === 0) return null;
  const tasks = scenes.map(({ id, xml, files }): Task =>
    ({ name: id, rubric: null, reference: { name: id, fileName: `${id}.tar`, file: tarOf([{ path: `${id}.xml`, file: xmlBlob(xml) }, ...files]) } }));
  const submissions = students.map(([name, planned], number): Handed => {
    const parts = scenes.flatMap(({ id, xml }, at) => {
      const text = mistakes[planned[at] ?? planned[0] ?? 'none'](xml) ?? xml;
      return [{ path: `${id}.xml`, file: xmlBlob(text) }];
    });
    const folder = `${name}_${1001 + number}_assignsubmission_file_`, file = tarOf(parts);
    return { id: folder, ...studentOf(folder), fileName: `${folder}.tar`, bytes: file.size, file };
  });
  return { tasks, submissions };
}
