// What the help shows: keys, and the steps of the tour.
import { msg } from '../words.ts';

export const helpKeys: readonly (readonly [string, string])[] = [
  ['← → ↑ ↓', msg('Orbit; so does a drag with one finger or the left button')],
  ['W A S D', msg('Move the focus on the ground')],
  ['Shift', msg('With a drag: pan; so does the right button, or two fingers')],
  ['+ −', msg('Zoom; so do the wheel and a pinch')],
  ['R', msg('Back to the scene’s own camera')],
  ['Space', msg('Play or pause')],
  [', .', msg('A frame back or on')],
  ['B N', msg('The key before or after: something is where it began')],
  ['M', msg('Walk: arrows turn (up turns down), W A S D move')],
  ['L', msg('Light mode: A and Z raise and lower beta, X and C alpha of the camera’s light; so does one finger')],
  ['O P', msg('Fast or reference quality; again for the scene’s own')],
  ['T', msg('Turntable')],
  ['Click', msg('Selects the model’s line in the XML')],
  ['1 2 3 4', msg('Without handles, or handles that move, turn and scale what is selected')],
  ['5', msg('Measure a distance between two clicks')],
  ['Ctrl+Z', msg('Undo: editor, inspector, files and camera; Ctrl+Shift+Z: redo')],
  ['?', msg('This list')],
];

/** A place on the page, and a word about it. */
export const tourSteps: readonly (readonly [string, string, string])[] = [
  ['.stage', msg('The image'), msg('Drag to go round the scene, turn the wheel to come nearer. A click on a model selects its line in the XML.')],
  ['.toolbar', msg('The tools'), msg('Undo and redo, the scene’s own camera, walking, a light that moves with you, and the quality of the image at rest.')],
  ['.tool.worded[aria-pressed]', msg('The panel'), msg('Display options, colours and lights, the files of the scene, and its XML with completion and error marks.')],
  ['.toolbar .tool.worded', msg('Share'), msg('Links, a frame for another page, images, animations and a command.')],
];
