export const helpKeys: readonly (readonly [string, string])[] = [
  ['← → ↑ ↓', 'Orbit; so does a drag with one finger or the left button'],
  ['W A S D', 'Move the focus on the ground'],
  ['Shift', 'With a drag: pan; so does the right button, or two fingers'],
  ['+ −', 'Zoom; so do the wheel and a pinch'],
  ['R', 'Back to the scene’s own camera'],
  ['Space', 'Play or pause'],
  ['M', 'Walk: arrows turn (up turns down), W A S D move'],
  ['L', 'Light mode: A and Z raise and lower beta, X and C alpha of the camera’s light'],
  ['O P', 'Fast or reference quality; again for the scene’s own'],
  ['T', 'Turntable'],
  ['Click', 'Selects the model’s line in the XML'],
];
