import type { Viewer } from './viewer.ts';
export async function turnLight(_viewer: Viewer, _alpha: number, _beta: number): Promise<void> {}
