import type { Viewer } from '../scene/viewer.ts';
export const Inspector = (_: { viewer: Viewer }) => <p class="note">…</p>;
