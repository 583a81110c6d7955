// What the service finds between two: measures of their images, and causes in their scenes.
import { request, query } from '../api.ts';
import { number, t } from '../words.ts';
import type { Opened } from './source.ts';

export interface Measures {
  mean: number; // levels of 255
  max: number;
  within: readonly { levels: number; share: number }[]; // of the pixels
  ssim: number | null;
  flip: { mean: number };
}

export interface Cause {
  message: string;
  seen: boolean;
  line?: number;
  file?: string;
}

/** Of two images of one size, as PNG. */
export async function measure(first: Blob, second: Blob): Promise<Measures> {
  const form = new FormData();
  form.append('first', first, 'first.png');
  form.append('second', second, 'second.png');
  return (await (await request('v1/compare', { method: 'POST', body: form })).json()) as Measures;
}

/** What of the second scene is not as in the first, with lines of the second. */
export async function causesOf(first: Opened, second: Opened): Promise<Cause[]> {
  const [reference, submission] = await Promise.all([first.part(), second.part()]), form = new FormData();
  form.append('reference', reference.blob, reference.fileName);
  form.append('submission', submission.blob, submission.fileName);
  const response = await request(`v1/grade?${query({ pictures: 0 })}`, { method: 'POST', body: form });
  const { findings, reason } = (await response.json()) as { findings?: (Cause & { places?: Cause[] })[]; reason?: { message: string } };
  if (!findings || reason) throw new Error(reason?.message ?? t('The scenes cannot be compared'));
  return findings.map(({ message, seen, line, file, places }) => {
    const place = line ? { line, file } : places?.find((one) => one.line);
    return { message, seen, ...(place?.line ? { line: place.line } : {}), ...(place?.file ? { file: place.file } : {}) };
  });
}

/** The measures as sentences. */
export function sentences({ mean, max, within, ssim, flip }: Measures): string[] {
  const percent = (share: number): string => number(share, { style: 'percent', maximumFractionDigits: share > 0.999 ? 3 : 1 });
  if (max === 0) return [t('The images are equal, pixel by pixel.')];
  const close = within.find(({ levels }) => levels === 6)?.share ?? 0;
  return [
    t('{share} of the pixels are as good as equal (within 6 of 255 levels); the largest difference is {max} levels, the mean {mean}.', { share: percent(close), max, mean: number(mean, { maximumFractionDigits: 2 }) }),
    flip.mean < 0.01 ? t('Side by side the eye hardly sees a difference (FLIP {flip}).', { flip: number(flip.mean, { maximumFractionDigits: 4 }) })
      : flip.mean < 0.1 ? t('The difference is small but visible (FLIP {flip}).', { flip: number(flip.mean, { maximumFractionDigits: 3 }) })
        : t('The difference is clear to see (FLIP {flip}).', { flip: number(flip.mean, { maximumFractionDigits: 3 }) }),
    ...(ssim === null ? [] : [t('Structures agree to {share} (SSIM).', { share: percent(Math.max(0, ssim)) })]),
  ];
}
