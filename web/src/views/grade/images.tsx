// Reference and submission of one task: side by side, under a slider, and where they differ.
import { useEffect, useState } from 'preact/hooks';
import { expectedImages, viewImages } from '../../grade/store.ts';
import type { Grade, View, ViewImages } from '../../grade/types.ts';
import { msg, number, t } from '../../words.ts';

const cameras: Record<string, string> = { 'own camera': msg('own camera'), 'from the side': msg('from the side'), 'from above': msg('from above') };

/** The views of the usual rubric have names in the reader's language; a rubric's own names stay. */
function viewName(name: string): string {
  const [, camera = '', seconds] = /^(.*?)(?: at ([\d.]+) s)?$/.exec(name) ?? [], known = cameras[camera];
  if (!known) return name;
  return seconds === undefined ? t(known) : t('{camera} at {seconds} s', { camera: t(known), seconds: number(Number(seconds)) });
}

interface Loaded {
  expected: (Blob | null)[];
  images: ViewImages[];
}

/** The images of a result, read when they are shown. */
function useImages(task: string, key: string, grade: Grade): Loaded | null {
  const [loaded, setLoaded] = useState<Loaded | null>(null);
  useEffect(() => {
    let isGone = false;
    void Promise.all([expectedImages.get(task), viewImages.get(key)]).then(([expected, images]) => {
      if (!isGone) setLoaded({ expected: expected ?? [], images: images ?? [] });
    });
    return () => (isGone = true);
  }, [task, key, grade.views]);
  return loaded;
}

/** An address for an image as long as it is shown. */
function useUrl(image: Blob | null): string {
  const [url, setUrl] = useState('');
  useEffect(() => {
    if (!image) return setUrl('');
    const fresh = URL.createObjectURL(image);
    setUrl(fresh);
    return () => URL.revokeObjectURL(fresh);
  }, [image]);
  return url;
}

function Slider({ given, expected }: { given: string; expected: string }) {
  const [share, setShare] = useState(50);
  const follow = (event: PointerEvent): void => {
    if (!(event.buttons & 1)) return;
    const { left, width } = (event.currentTarget as HTMLElement).getBoundingClientRect();
    setShare(Math.min(100, Math.max(0, Math.round(100 * (event.clientX - left) / width))));
  };
  return (
    <div class="slider">
      <div class="compare" onPointerDown={(event) => {
        event.preventDefault();
        (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
        follow(event);
      }} onPointerMove={follow}>
        <img src={expected} alt={t('Reference')} />
        <img class="over" src={given} alt={t('Submission')} style={{ clipPath: `inset(0 ${100 - share}% 0 0)` }} />
        <hr style={{ left: `${share}%` }} />
        <span class="left">{t('Submission')}</span><span class="right">{t('Reference')}</span>
      </div>
      <input type="range" min="0" max="100" value={share} aria-label={t('Share of the submission that is shown')} onInput={(event) => setShare(Number(event.currentTarget.value))} />
    </div>
  );
}

const Figure = ({ src, name }: { src: string; name: string }) => (src ? <figure><img src={src} alt={name} /><figcaption>{name}</figcaption></figure> : null);

const percent = (share: number): string => number(100 * share, { maximumFractionDigits: 1 });

function figures(view: View): string {
  const { difference, flip, ssim, coverage, depth, normals } = view;
  return [
    difference !== undefined && t('{share} % of the image differs', { share: percent(difference) }),
    flip && t('FLIP {mean}, 95th percentile {percentile}', { mean: number(flip.mean), percentile: number(flip.p95) }),
    ssim !== undefined && `SSIM ${number(ssim)}`, coverage !== undefined && t('objects elsewhere {share} %', { share: percent(coverage) }),
    depth !== undefined && t('other depth {share} %', { share: percent(depth) }), normals !== undefined && t('other normals {share} %', { share: percent(normals) }),
  ].filter((one) => one).join(' · ');
}

const modes = { side: msg('Side by side'), slider: msg('Slider'), difference: msg('Difference') } as const;
type Mode = keyof typeof modes;

function Comparison({ loaded, grade, at, mode }: { loaded: Loaded; grade: Grade; at: number; mode: Mode }) {
  const view = grade.views[at] as View, expected = loaded.expected[at] ?? null, images = loaded.images[at];
  const reference = useUrl(expected), given = useUrl(images?.picture ?? expected), heat = useUrl(images?.heat ?? null);
  return (
    <>
      {mode === 'slider' && reference && given ? <Slider given={given} expected={reference} />
        : mode === 'difference' && heat ? <div class="one"><Figure src={heat} name={t('Difference: black none, white most')} /></div>
        : <div class="side"><Figure src={reference} name={t('Reference')} /><Figure src={given} name={t('Submission')} />{mode === 'side' && <Figure src={heat} name={t('Difference: black none, white most')} />}</div>}
      <p class="note">{expected && !images?.picture && !heat ? t('The images are equal.') : figures(view)}</p>
    </>
  );
}

export function Images({ task, resultKey, grade }: { task: string; resultKey: string; grade: Grade }) {
  const loaded = useImages(task, resultKey, grade), [mode, setMode] = useState<Mode>('side');
  // What differs most is seen first.
  const worst = grade.views.reduce((most, view, i) => ((view.difference ?? 0) > (grade.views[most]?.difference ?? 0) ? i : most), 0);
  const [at, setAt] = useState(worst);
  useEffect(() => setAt(worst), [resultKey]);
  const view = grade.views[at] ? at : worst;
  if (grade.views.length === 0 || !loaded) return null;
  return (
    <section class="images" aria-label={t('Images')}>
      <div class="choices" role="group" aria-label={t('View')}>
        {grade.views.map((one, i) => (
          <button key={one.name} type="button" aria-pressed={i === view} onClick={() => setAt(i)}>{viewName(one.name)}
            {one.difference !== undefined && <span class="note"> {one.difference ? `${percent(one.difference)} %` : t('equal')}</span>}</button>
        ))}
      </div>
      <div class="choices" role="group" aria-label={t('Comparison')}>
        {(Object.keys(modes) as Mode[]).map((one) => <button key={one} type="button" aria-pressed={one === mode} onClick={() => setMode(one)}>{t(modes[one])}</button>)}
      </div>
      <Comparison loaded={loaded} grade={grade} at={view} mode={mode} />
    </section>
  );
}
