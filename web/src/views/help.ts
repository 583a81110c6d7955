export const helpKeys: readonly (readonly [string, string])[] = [
  ['← → ↑ ↓', 'Orbit; so does a drag with one finger or the left button'],
  ['W A S D', 'Move the focus on the ground'],
  ['Shift', 'With a drag: pan; so does the right button, or two fingers'],
  ['+ −', 'Zoom; so do the wheel and a pinch'],
  ['R', 'Back to the scene’s own camera'],
  ['Space', 'Play or pause'],
  ['M', 'Walk: arrows turn (up turns down), W A S D move'],
  ['L', 'Light mode: A and Z raise and lower beta, X and C alpha of the camera’s light; so does one finger'],
  ['O P', 'Fast or reference quality; again for the scene’s own'],
  ['T', 'Turntable'],
  ['Click', 'Selects the model’s line in the XML'],
  ['Ctrl+Z', 'Undo: editor, inspector, files and camera; Ctrl+Shift+Z: redo'],
  ['?', 'This list'],
];

/** A place on the page, and a word about it. */
export const tourSteps: readonly (readonly [string, string, string])[] = [
  ['.stage', 'The image', 'Drag to go round the scene, turn the wheel to come nearer. A click on a model selects its line in the XML.'],
  ['.toolbar', 'The tools', 'Undo and redo, the scene’s own camera, walking, a light that moves with you, and the quality of the image at rest.'],
  ['.tool.worded[aria-pressed]', 'The panel', 'Display options, colours and lights, the files of the scene, and its XML with completion and error marks.'],
  ['.toolbar .tool.worded', 'Share', 'Links, a frame for another page, images, animations and a command.'],
];
