// Line icons on a 24-unit grid, drawn in the colour of the text.
const paths = {
  play: 'M7 4.5v15l12-7.5z',
  pause: 'M8 5v14M16 5v14',
  home: 'M4 11.5 12 5l8 6.5M6.5 10v9h11v-9',
  link: 'M10 14a4 4 0 0 0 6 .4l3-3a4 4 0 0 0-5.7-5.7L12 7M14 10a4 4 0 0 0-6-.4l-3 3A4 4 0 0 0 10.700 18.300L12 17',
  download: 'M12 4v11m-4.500-4.500L12 15l4.500-4.500M5 19.500h14',
  terminal: 'm5 7 4.500 4.500L5 16M12 17h7',
  turntable: 'M4.500 12c0-2 3.400-3.500 7.500-3.500s7.500 1.500 7.500 3.500-3.400 3.500-7.500 3.500c-.7 0-1.400 0-2-.1m2.500-2.600L10 15.400l2.500 2.600',
  walk: 'M13 5.200a1.200 1.200 0 1 0 0-.1M9 21l2.500-5.500M15.500 21 14 16l-2.800-2.500L12.500 8 8.500 10v3M12.500 8l2 3.500 3 .5',
  lamp: 'M9.500 18h5M10 21h4M12 3a6 6 0 0 1 3.500 10.900V15h-7v-1.100A6 6 0 0 1 12 3z',
  panel: 'M4 5h16v14H4zM14.500 5v14',
  code: 'm8.500 8-4 4 4 4M15.500 8l4 4-4 4',
  sliders: 'M4 8h9m5 0h2M4 16h2m5 0h9M13 8a2.200 2.200 0 1 0 5 0 2.200 2.200 0 1 0-5 0M6 16a2.200 2.200 0 1 0 5 0 2.200 2.200 0 1 0-5 0',
  eye: 'M2.500 12S6 5.500 12 5.500 21.500 12 21.500 12 18 18.500 12 18.500 2.500 12 2.500 12zM12 9.200a2.800 2.800 0 1 0 .01 0',
  help: 'M12 3.500a8.500 8.500 0 1 0 .01 0M9.600 9.500a2.500 2.500 0 1 1 3.600 2.300c-.8.400-1.200 1-1.200 2M12 16.700v.2',
  upload: 'M12 16V5m-4.500 4.500L12 5l4.500 4.500M5 19.500h14',
  search: 'M10.500 4.500a6 6 0 1 0 .01 0M15 15l5 5',
  close: 'm6 6 12 12M18 6 6 18',
  sun: 'M12 8a4 4 0 1 0 .01 0M12 2.500v2M12 19.500v2M2.500 12h2M19.500 12h2M5.300 5.300l1.400 1.400M17.300 17.300l1.400 1.400M18.700 5.300l-1.400 1.400M6.700 17.300l-1.400 1.400',
  moon: 'M19.500 14.500A8 8 0 0 1 9.500 4.500a8 8 0 1 0 10 10z',
  fullscreen: 'M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5',
  plus: 'M12 5v14M5 12h14',
  rename: 'M4 20h4L19 9l-4-4L4 16zM13 7l4 4',
  undo: 'M8 5 4 9l4 4M4 9h9a5.500 5.500 0 0 1 0 11h-4',
  redo: 'm16 5 4 4-4 4M20 9h-9a5.500 5.500 0 0 0 0 11h4',
  up: 'm6 15 6-6 6 6',
  down: 'm6 9 6 6 6-6',
  error: 'M8.500 3.500h7l5 5v7l-5 5h-7l-5-5v-7zM12 8v5M12 16v.2',
  warning: 'M12 4 3 19.500h18zM12 10v4.500M12 17v.2',
  offline: 'M3 3l18 18M5 12.500a10 10 0 0 1 4-2.300M19 12.500a10 10 0 0 0-6-2.800M8.500 16a5 5 0 0 1 7 0M12 19.500v.2',
  lost: 'M12 21s-6.500-6-6.500-11a6.500 6.500 0 0 1 13 0c0 5-6.500 11-6.500 11zM10 8.500l4 4M14 8.500l-4 4',
} as const;

export type IconName = keyof typeof paths;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 24 24" aria-hidden="true" fill={name === 'play' ? 'currentColor' : 'none'}>
      <path d={paths[name]} />
    </svg>
  );
}

/** The mark: a lighthouse and its beam. */
export function Mark() {
  return (
    <svg class="mark" viewBox="0 0 32 32" aria-hidden="true">
      <path class="beam" d="M17.500 9.500 31 4v11z" />
      <path class="tower" d="M12.400 13h5.200l1.600 14h-8.400z" />
      <path class="stripe" d="M12 17h6l.35 3H11.650zM11.300 23h7.400l.35 3h-8.100z" />
      <path class="tower" d="M12 7.500 15 5l3 2.500V12h-6z" />
      <path class="lamp" d="M13.500 8.500h3V11h-3z" />
      <path class="ground" d="M6 28.500h18" />
    </svg>
  );
}
