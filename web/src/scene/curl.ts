// The picture on show as a command.
import { pictureUrl } from './frame.ts';
import type { Viewer } from './viewer.ts';

const quoted = (text: string): string => `'${text.replaceAll("'", "'\\''")}'`;

export function curlOf(viewer: Viewer): string {
  const origin = viewer.document();
  const url = quoted(new URL(pictureUrl(origin, { ...viewer.pictureOptions(), format: 'png' }), location.href).href.replaceAll('%2C', ','));
  if (origin.text === null) return `curl ${url} -o picture.png`;
  return `curl -H 'Content-Type: application/xml' --data-binary @scene.xml ${url} -o picture.png`;
}
