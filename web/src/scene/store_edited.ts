// An edited scene becomes a scene of its own on the server: unlisted, with a link to share.
import { findingsOf, query, request, sentence, type SceneFacts } from '../api.ts';
import { formatView, scenePlace } from '../router.ts';
import { bodyOf } from './frame.ts';
import type { Viewer } from './viewer.ts';

/** Returns why it was not stored; empty: it was, and is opened. */
export async function storeEdited(viewer: Viewer): Promise<string> {
  try {
    const base: Record<string, string> = viewer.id === null ? {} : { base: viewer.id };
    const response = await request(`v1/scenes?${query(base)}`, {
      method: 'POST', ...bodyOf({ ...viewer.document(), text: viewer.written() }),
    });
    const scene = (await response.json()) as SceneFacts;
    const view = {
      orbit: viewer.orbit.value, walk: viewer.walk.value, time: viewer.clock.time.value, options: viewer.options.value,
    };
    viewer.forgetDraft();
    location.hash = scenePlace(scene.id, formatView(view));
    return '';
  } catch (fault) {
    viewer.report(fault);
    const [first] = findingsOf(fault);
    return first ? sentence(first) : String(fault);
  }
}
