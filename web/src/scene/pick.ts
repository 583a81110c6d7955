import type { Viewer } from './viewer.ts';
export async function pickModel(_viewer: Viewer, _x: number, _y: number): Promise<void> {}
