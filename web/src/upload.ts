// Files of one's own: dropped or chosen, stored unlisted on the server, and opened.
import { signal } from '@preact/signals';
import { patient, Problem, query, request, type Finding, type SceneFacts } from './api.ts';
import { chooseFiles } from './files.ts';
import { scenePlace } from './router.ts';
import { bundleOf, type Loose, type NamedFile } from './scene/bundle.ts';
import { t } from './words.ts';

export const uploading = signal<string>('');
export const uploadProblem = signal<{ title: string; findings: Finding[] } | null>(null);

/** A scene that the server does not keep, because it is broken or keeps none: it is mended here. */
export const local = signal<{ name: string; loose: Loose; text: string; count: number } | null>(null);

const fault = (title: string, message: string): void => {
  uploadProblem.value = { title, findings: [{ code: '', severity: 'error', message }] };
};

/** Sends what was dropped and opens it; what is wrong is shown as sentences. */
export async function openFiles(files: readonly NamedFile[]): Promise<void> {
  if (files.length === 0) return fault(t('Nothing to open'), t('There is no file among what was dropped'));
  const bundle = await bundleOf(files);
  if ('message' in bundle) return fault(t('This cannot be opened'), bundle.message);
  uploading.value = bundle.name;
  uploadProblem.value = null;
  try {
    const response = await patient(() => request(`v1/scenes?${query({ public: 0 })}`, { method: 'POST', ...bundle.body() }));
    const scene = (await response.json()) as SceneFacts;
    location.hash = scenePlace(scene.id);
  } catch (problem) {
    const findings = problem instanceof Problem ? problem.findings : [];
    const main = bundle.loose?.files.find(({ path }) => path === bundle.loose?.main);
    if (bundle.loose && main && problem instanceof Problem && [400, 401, 403, 422].includes(problem.status)) {
      local.value = { name: bundle.name, loose: bundle.loose, text: await main.file.text(), count: (local.value?.count ?? 0) + 1 };
      if (problem.status === 401 || problem.status === 403) uploadProblem.value = { title: t('Shown, but not stored'), findings };
      location.hash = '#/new';
    } else if (findings.length > 0) uploadProblem.value = { title: t('“{name}” has problems', { name: bundle.name }), findings };
    else fault(t('“{name}” was not sent', { name: bundle.name }), t('The server does not answer'));
  } finally {
    uploading.value = '';
  }
}

/** Something is held over the page. */
export const dropping = signal(false);

/** The scene on show takes its parts first; null: none is on show. */
export const takesParts = signal<((files: readonly NamedFile[]) => boolean) | null>(null);

export const openDropped = (files: readonly NamedFile[]): void => {
  if (!takesParts.value?.(files)) void openFiles(files);
};

/** Opens what is chosen in the file dialog. */
export const pickFiles = (folder: boolean): void => void chooseFiles(folder).then(openFiles);
